// plants from roots: shape, reserves, placement.
#include "lawn.h"

TEST(the_papers_plant)
{
    const DpPlantKind  kind = dp_plant_kind_default();
    const DpPlantShape shape = dp_plant_shape(&kind);
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_OK);
    CHECK(shape.rows == 7 && shape.stems == 4 && shape.particles == 28 && shape.bends == 20);
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 1);
    float     at[84];
    CHECK(dp_plants_read(plants, 0, 0, at, NULL, NULL) == DP_OK);
    double top = 0.0, wide = 0.0;
    for (int p = 0; p < 28; ++p) {
        top = fmax(top, (double)at[3 * p + 2]);
        for (int q = 0; q < 28; ++q)
            wide = fmax(wide, hypot((double)(at[3 * p] - at[3 * q]),
                                    (double)(at[3 * p + 1] - at[3 * q + 1])));
    }
    CHECK_NEAR(top, 0.10, 1e-6);
    CHECK_NEAR(wide, 0.05, 1e-6);
    CHECK(dp_plants_count(plants, 0) == 1 && dp_plants_count(plants, -1) == 1);
    dp_plants_destroy(plants);
    dp_plants_destroy(NULL);
}

TEST(a_tuft_crosses)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.form = DP_PLANT_TUFT;
    kind.sheets = 3;
    const DpPlantShape shape = dp_plant_shape(&kind);
    CHECK(shape.stems == 12 && shape.particles == 84);
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 3);
    float*    at = dp_alloc(84, 3 * sizeof(float));
    dp_plants_read(plants, 0, 0, at, NULL, NULL);
    // sheets are turned by 60 degrees against each other
    double angle[3];
    for (int s = 0; s < 3; ++s) {
        const float *a = at + 3 * 28 * s, *b = a + 3 * 21;
        angle[s] = atan2((double)(b[1] - a[1]), (double)(b[0] - a[0]));
    }
    CHECK_NEAR(cos(angle[1] - angle[0]), 0.5, 1e-5);
    CHECK_NEAR(cos(angle[2] - angle[0]), -0.5, 1e-5);
    dp_free(at);
    dp_plants_destroy(plants);
}

TEST(reserves_spread_as_told)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.spread = 1.3f;
    DpPlants *a = lawn(&kind, 60, 50, 0.1, 11), *b = lawn(&kind, 60, 50, 0.1, 12);
    double    sum = 0.0, squares = 0.0;
    int       same = 0, near = 0, far = 0;
    for (int k = 0; k < 3000; ++k) {
        const double z = log(dp_plants_reserve(a, 0, k) / 0.1);
        sum += z, squares += z * z;
        near += fabs(z)<0.25 * 1.3, far += fabs(z)> 2.0 * 1.3;
        same += fabs(z - log(dp_plants_reserve(b, 0, k) / 0.1)) < 1e-9;
    }
    CHECK_NEAR(sum / 3000, 0.0, 0.1);
    CHECK_NEAR(sqrt(squares / 3000), 1.3, 0.1);
    // (1 + t) exp(-t) are farther out than t^2 / sqrt(120): t = 1.655 and 4.681
    CHECK_NEAR(near / 3000.0, 1.0 - 2.655 * exp(-1.655), 0.03);
    CHECK_NEAR(far / 3000.0, 5.681 * exp(-4.681), 0.012);
    CHECK(same == 0);

    // or as told, in the order in which they were planted, until somebody treads on them
    float z[3000];
    for (int k = 0; k < 3000; ++k) z[k] = (float)(k % 7 - 3);
    CHECK(dp_plants_vary(a, 0, z) == DP_OK);
    for (int k = 0; k < 3000; ++k)
        CHECK_NEAR(dp_plants_reserve(a, 0, k), 0.1 * exp(1.3 * (double)z[k]), 1e-5);
    CHECK(dp_plants_vary(a, 1, z) == DP_BAD_ARGUMENT && dp_plants_vary(a, 0, NULL) != DP_OK);
    CHECK(dp_plants_write(a, 0, 5, NULL, NULL, NULL) == DP_OK);
    CHECK(dp_plants_vary(a, 0, z) == DP_BAD_ARGUMENT);
    z[9] = NAN;
    CHECK(dp_plants_vary(b, 0, z) == DP_BAD_ARGUMENT);
    dp_plants_destroy(a), dp_plants_destroy(b);
}

TEST(bad_kinds_and_roots_are_refused)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.spacing = 0.0f;
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    kind = dp_plant_kind_default(), kind.sway = NAN;
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    kind = dp_plant_kind_default(), kind.break_angle = 0.1f;
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    kind = dp_plant_kind_default(), kind.height = 9.0f;  // too many rows
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_kind_check(NULL, NULL) == DP_BAD_ARGUMENT);

    kind = dp_plant_kind_default();
    float     root[3] = {0.0f, NAN, 0.0f};
    int       stand = 0;
    DpPlants* plants = dp_plants_create(0);
    CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_add(plants, &kind, root, NULL, 0, &stand) == DP_BAD_ARGUMENT);
    root[1] = 0.0f;
    for (long passes = 0; passes < 12; ++passes) {  // memory gives out anywhere
        dp_alloc_fail_after(passes);
        CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_NO_MEMORY);
    }
    dp_alloc_fail_after(-1);
    CHECK(dp_plants_count(plants, -1) == 0);
    CHECK(dp_plants_read(plants, 0, 0, NULL, NULL, NULL) == DP_BAD_ARGUMENT);
    dp_plants_destroy(plants);
}

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

int main(void)
{
    RUN(the_papers_plant);
    RUN(a_tuft_crosses);
    RUN(reserves_spread_as_told);
    RUN(bad_kinds_and_roots_are_refused);
    RUN(places_keep_their_distance);
    RUN(fields_side_by_side_have_no_seam);
    return check_done();
}
