// Where plants grow by chance: apart from each other, without seams.
#include "lawn.h"

TEST(places_keep_their_distance)
{
    float  root[2 * 2000], again[2 * 2000];
    int    count = 0, count2 = 0;
    double nearest = 1e9;
    CHECK(dp_plants_place(-1, 2, 3, 6, 80.0, NULL, 0, 0, 5, root, 2000, &count) == DP_OK);
    CHECK(count == 1280);
    for (int a = 0; a < count; ++a) {
        CHECK(root[2 * a] >= -1 && root[2 * a] <= 3 && root[2 * a + 1] >= 2 &&
              root[2 * a + 1] <= 6);
        for (int b = 0; b < a; ++b)
            nearest = fmin(nearest, hypot((double)(root[2 * a] - root[2 * b]),
                                          (double)(root[2 * a + 1] - root[2 * b + 1])));
    }
    CHECK(nearest >= sqrt(0.5 / 80.0) - 1e-6);
    dp_plants_place(-1, 2, 3, 6, 80.0, NULL, 0, 0, 5, again, 2000, &count2);
    CHECK(count2 == count && memcmp(root, again, (size_t)count * 2 * sizeof(float)) == 0);
    count2 = 0;
    dp_plants_place(-1, 2, 3, 6, 80.0, NULL, 0, 0, 6, again, 2000, &count2);
    CHECK(memcmp(root, again, (size_t)count * 2 * sizeof(float)) != 0);

    // nothing grows where the weight is nothing, half where it is half
    const float weight[4] = {0.0f, 1.0f, 1.0f, 0.5f};
    int         in[4] = {0};
    count = 0;
    CHECK(dp_plants_place(0, 0, 4, 4, 80.0, weight, 2, 2, 5, root, 2000, &count) == DP_OK);
    for (int k = 0; k < count; ++k) ++in[(root[2 * k] > 2) + 2 * (root[2 * k + 1] > 2)];
    CHECK(in[0] == 0);
    CHECK_CLOSE(count, 80 * 4 * 2.5, 0.01);
    CHECK_CLOSE(in[3], 0.5 * in[1], 0.15);
    CHECK_CLOSE(in[2], in[1], 0.1);
    CHECK(dp_plants_place(0, 0, 0, 4, 80.0, NULL, 0, 0, 5, root, 2000, &count) == DP_BAD_ARGUMENT);
    count = 2001;
    CHECK(dp_plants_place(0, 0, 4, 4, 80.0, NULL, 0, 0, 5, root, 2000, &count) == DP_BAD_ARGUMENT);
}

// a neighbour's roots stay, and those that come keep their distance from them
TEST(fields_side_by_side_have_no_seam)
{
    float  root[2 * 2000];
    int    one = 0;
    double nearest = 1e9;
    CHECK(dp_plants_place(0, 0, 2, 2, 80.0, NULL, 0, 0, 5, root, 2000, &one) == DP_OK);
    int both = one;
    CHECK(dp_plants_place(2, 0, 4, 2, 80.0, NULL, 0, 0, 6, root, 2000, &both) == DP_OK);
    CHECK(one == 320 && both == 640);
    for (int a = 0; a < both; ++a) {
        CHECK((root[2 * a] < 2.0f) == (a < one));
        for (int b = 0; b < a; ++b)
            nearest = fmin(nearest, hypot((double)(root[2 * a] - root[2 * b]),
                                          (double)(root[2 * a + 1] - root[2 * b + 1])));
    }
    CHECK(nearest >= sqrt(0.5 / 80.0) - 1e-6);
}

// cells of the look-up are wider than roots stand apart when few may come
TEST(few_roots_keep_their_distance_too)
{
    float  root[2 * 100];
    int    count = 0;
    double nearest = 1e9;
    CHECK(dp_plants_place(0, 0, 1, 1, 400.0, NULL, 0, 0, 9, root, 100, &count) == DP_OK);
    CHECK(count == 100);
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < a; ++b)
            nearest = fmin(nearest, hypot((double)(root[2 * a] - root[2 * b]),
                                          (double)(root[2 * a + 1] - root[2 * b + 1])));
    CHECK(nearest >= sqrt(0.5 / 400.0) - 1e-6);
}

int main(void)
{
    RUN(places_keep_their_distance);
    RUN(fields_side_by_side_have_no_seam);
    RUN(few_roots_keep_their_distance_too);
    return check_done();
}
