#include "refine/refine.h"

#include <stdint.h>

#include "../check.h"

// a square of two triangles, 8 m wide, from the origin
static const double square_point[] = {0, 0, 0, 8, 0, 0, 8, 8, 2, 0, 8, 2};
static const int    square_face[] = {0, 1, 2, 0, 2, 3};

typedef struct Side
{
    int a, b;
} Side;

static int by_points(const void* one, const void* two)
{
    const Side *a = one, *b = two;
    return a->a != b->a ? (a->a < b->a ? -1 : 1) : (a->b > b->b) - (a->b < b->b);
}

// how many edges have one triangle alone, their length, and whether none has more than two
static int border(const DpRefined* made, double* length, int* at_most_two)
{
    const size_t count = 3 * (size_t)made->triangles;
    Side*        side = malloc(count * sizeof *side);
    for (size_t k = 0; k < count; ++k) {
        const int* face = made->triangle + 3 * (k / 3);
        const int  a = face[k % 3], b = face[(k + 1) % 3];
        side[k] = (Side){a < b ? a : b, a < b ? b : a};
    }
    qsort(side, count, sizeof *side, by_points);
    int alone = 0;
    *length = 0.0;
    *at_most_two = 1;
    for (size_t k = 0; k < count;) {
        size_t end = k + 1;
        while (end < count && by_points(side + k, side + end) == 0) ++end;
        if (end - k > 2) *at_most_two = 0;
        if (end - k == 1) {
            const double *a = made->point + 3 * side[k].a, *b = made->point + 3 * side[k].b;
            *length += sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                            (a[2] - b[2]) * (a[2] - b[2]));
            ++alone;
        }
        k = end;
    }
    free(side);
    return alone;
}

static double longest_of(const DpRefined* made, int t)
{
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double* a = made->point + 3 * made->triangle[3 * t + k];
        const double* b = made->point + 3 * made->triangle[3 * t + (k + 1) % 3];
        double        sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
        longest = fmax(longest, sqrt(sum));
    }
    return longest;
}

static double area_of(const DpRefined* made, int t)
{
    const double* p[3];
    for (int k = 0; k < 3; ++k) p[k] = made->point + 3 * made->triangle[3 * t + k];
    return 0.5 *
           ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]));
}

TEST(edges_are_short_where_wished_and_nothing_gapes)
{
    const double   corner[] = {1.0, 1.0, 1.5, 1.0, 2.0, 1.0}, size[] = {0.05, 0.05, 0.02};
    const DpWishes wishes = {corner, size, 3, 0.5};
    DpRefined      made;
    CHECK(dp_refine(square_point, 4, square_face, 2, &wishes, 1000000, &made) == DP_OK);
    CHECK(made.valid && made.given == 4 && made.triangles > 1000 && made.triangles < 60000);
    double length, area = 0.0;
    int    at_most_two, fine = 0;
    border(&made, &length, &at_most_two);
    CHECK(at_most_two);
    const double side = 2.0 * (8.0 + sqrt(64.0 + 4.0));
    CHECK_NEAR(length, side, 1e-9);  // a point within an edge would leave both sides of it alone
    for (int t = 0; t < made.triangles; ++t) {
        double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 2; ++axis) {
                const double at = made.point[3 * made.triangle[3 * t + k] + axis];
                low[axis] = fmin(low[axis], at), high[axis] = fmax(high[axis], at);
            }
        if (low[0] < 2.5 && high[0] > 1.0 && low[1] < 1.5 && high[1] > 1.0) {
            CHECK(longest_of(&made, t) <= 0.05 * sqrt(2.0 * 1.02));
            ++fine;
        }
        CHECK(area_of(&made, t) > 0.0);  // none is turned over
        area += area_of(&made, t);
    }
    CHECK(fine > 1000);
    CHECK_NEAR(area, 64.0, 1e-9);
    dp_refined_free(&made);
}

TEST(shares_are_those_of_the_points)
{
    const double   corner[] = {3.0, 3.0}, size[] = {0.1};
    const DpWishes wishes = {corner, size, 1, 1.0};
    DpRefined      made;
    CHECK(dp_refine(square_point, 4, square_face, 2, &wishes, 1000000, &made) == DP_OK);
    for (int t = 0; t < made.triangles; ++t)
        for (int k = 0; k < 3; ++k) {
            const int*   of = square_face + 3 * made.source[t];
            const float* share = made.weight + 9 * t + 3 * k;
            for (int axis = 0; axis < 3; ++axis) {
                double at = 0.0;
                for (int s = 0; s < 3; ++s) at += (double)share[s] * square_point[3 * of[s] + axis];
                CHECK_NEAR(made.point[3 * made.triangle[3 * t + k] + axis], at, 1e-12);
            }
        }
    for (int p = made.given; p < made.points; ++p) {
        const int*   of = square_face + 3 * made.point_source[p - made.given];
        const float* share = made.point_weight + 3 * (p - made.given);
        for (int axis = 0; axis < 3; ++axis) {
            double at = 0.0;
            for (int s = 0; s < 3; ++s) at += (double)share[s] * square_point[3 * of[s] + axis];
            CHECK_NEAR(made.point[3 * p + axis], at, 1e-12);
        }
    }
    dp_refined_free(&made);
}

TEST(what_no_wish_reaches_stays_as_it_is)
{
    // a row of squares; the wish lies within the first
    double point[2 * 9 * 3];
    int    face[16 * 3];
    for (int k = 0; k < 9; ++k) {
        const double at[] = {k, 0, 0, k, 1, 0};
        memcpy(point + 6 * k, at, sizeof at);
    }
    for (int k = 0; k < 8; ++k) {
        const int of[] = {2 * k, 2 * k + 2, 2 * k + 3, 2 * k, 2 * k + 3, 2 * k + 1};
        memcpy(face + 6 * k, of, sizeof of);
    }
    const double   corner[] = {0.2, 0.4}, size[] = {0.01};
    const DpWishes wishes = {corner, size, 1, 0.1};
    DpRefined      made;
    CHECK(dp_refine(point, 18, face, 16, &wishes, 1000000, &made) == DP_OK);
    CHECK(made.cut[0] && made.cut[1]);
    for (int t = 4; t < 16; ++t) CHECK(!made.cut[t]);
    CHECK(memcmp(made.triangle + 12, face + 12, 36 * sizeof *face) == 0);
    CHECK(memcmp(made.point, point, sizeof point) == 0);
    dp_refined_free(&made);

    const DpWishes none = {corner, size, 0, 0.1};
    CHECK(dp_refine(point, 18, face, 16, &none, 1000000, &made) == DP_OK);
    CHECK(made.triangles == 16 && made.points == 18 && made.valid);
    CHECK(memcmp(made.triangle, face, sizeof face) == 0);
    dp_refined_free(&made);
}

TEST(a_far_wish_on_a_huge_square_costs_its_depth_only)
{
    const double   point[] = {-1000, -1000, 0, 1000, -1000, 0, 1000, 1000, 0, -1000, 1000, 0};
    const double   corner[] = {700.0, -300.0}, size[] = {0.005};
    const DpWishes wishes = {corner, size, 1, 0.05};
    DpRefined      made;
    CHECK(dp_refine(point, 4, square_face, 2, &wishes, 1000000, &made) == DP_OK);
    CHECK(made.valid && made.triangles > 200 && made.triangles < 5000);
    dp_refined_free(&made);
}

TEST(a_long_thin_face_costs_no_more_than_a_square)
{
    const double   corner[] = {3.0, 0.4}, size[] = {0.01};
    const DpWishes wishes = {corner, size, 1, 0.2};
    const double   thin[] = {0, 0, 0, 60, 0, 0, 60, 1, 0, 0, 1, 0};
    const double   square[] = {0, 0, 0, 8, 0, 0, 8, 8, 0, 0, 8, 0};
    DpRefined      one, other;
    CHECK(dp_refine(thin, 4, square_face, 2, &wishes, 1000000, &one) == DP_OK);
    CHECK(dp_refine(square, 4, square_face, 2, &wishes, 1000000, &other) == DP_OK);
    CHECK(one.valid && one.triangles < 2 * other.triangles);
    double least = 180.0;  // the sharpest corner where it is fine
    for (int t = 0; t < one.triangles; ++t)
        if (longest_of(&one, t) < 0.02) {
            const double height = 2.0 * area_of(&one, t) / longest_of(&one, t);
            least = fmin(least, height / longest_of(&one, t));
        }
    CHECK(least > 0.2);
    dp_refined_free(&one);
    dp_refined_free(&other);
}

TEST(three_triangles_on_one_edge_are_cut_alike)
{
    const double   point[] = {0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0, 0.5, 0, 1};
    const int      face[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    const double   corner[] = {0.4, 0.2}, size[] = {0.05};
    const DpWishes wishes = {corner, size, 1, 0.2};
    DpRefined      made;
    CHECK(dp_refine(point, 5, face, 3, &wishes, 100000, &made) == DP_OK);
    CHECK(made.valid && made.cut[0]);
    double length;
    int    at_most_two;
    border(&made, &length, &at_most_two);
    CHECK_NEAR(length, 4.0 * sqrt(1.25) + 2.0 * sqrt(1.25),
               1e-9);  // none of 0-1, whoever is cut there
    dp_refined_free(&made);
}

TEST(too_many_stops_without_gaps)
{
    const double   corner[] = {0.0, 0.0}, size[] = {0.001};
    const DpWishes wishes = {corner, size, 1, 8.0};
    DpRefined      made;
    CHECK(dp_refine(square_point, 4, square_face, 2, &wishes, 3000, &made) == DP_OK);
    CHECK(!made.valid && made.triangles >= 3000 && made.triangles < 12100);
    double length;
    int    at_most_two;
    border(&made, &length, &at_most_two);
    CHECK(at_most_two);
    CHECK_NEAR(length, 2.0 * (8.0 + sqrt(68.0)), 1e-9);
    dp_refined_free(&made);
}

TEST(triangles_without_area_end)
{
    const double   point[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0};
    const int      face[] = {0, 1, 2, 0, 1, 3, 1, 1, 2, 0, 0, 0};
    const double   corner[] = {0.0, 0.0}, size[] = {0.05};
    const DpWishes wishes = {corner, size, 1, 1.0};
    DpRefined      made;
    CHECK(dp_refine(point, 4, face, 4, &wishes, 100000, &made) == DP_OK);
    CHECK(made.valid && made.triangles > 400);
    dp_refined_free(&made);
}

TEST(bad_input_is_refused)
{
    const double   corner[] = {0.0, 0.0, 1e30, 0.0}, size[] = {0.05, -1.0, 0.1};
    const int      wrong[] = {0, 1, 4};
    const double   nowhere[] = {0, 0, 0, 8, 0, 0, 8, NAN, 2};
    const DpWishes wishes = {corner, size, 1, 1.0}, below = {corner, size + 1, 1, 1.0},
                   flat = {corner, size, 1, 0.0};
    DpRefined made;
    CHECK(dp_refine(square_point, 4, wrong, 1, &wishes, 100, &made) == DP_BAD_ARGUMENT);
    CHECK(dp_refine(nowhere, 3, square_face, 1, &wishes, 100, &made) == DP_BAD_ARGUMENT);
    CHECK(dp_refine(square_point, 4, square_face, 2, &below, 100, &made) == DP_BAD_ARGUMENT);
    CHECK(dp_refine(square_point, 4, square_face, 2, &flat, 100, &made) == DP_BAD_ARGUMENT);
    const double   two[] = {0.05, 0.05};
    const DpWishes apart = {corner, two, 2, 1.0};
    CHECK(dp_refine(square_point, 4, square_face, 2, &apart, 100, &made) == DP_BAD_ARGUMENT);
    CHECK(!made.point && made.triangles == 0);
}

TEST(no_memory_leaves_nothing)
{
    const double   corner[] = {1.0, 1.0}, size[] = {0.05};
    const DpWishes wishes = {corner, size, 1, 0.5};
    DpRefined      made;
    for (long k = 0; k < 60; ++k) {
        dp_alloc_fail_after(k);
        const DpStatus status = dp_refine(square_point, 4, square_face, 2, &wishes, 1000000, &made);
        dp_alloc_fail_after(-1);
        CHECK(status == DP_OK || (status == DP_NO_MEMORY && !made.point));
        dp_refined_free(&made);
    }
}

int main(void)
{
    RUN(edges_are_short_where_wished_and_nothing_gapes);
    RUN(shares_are_those_of_the_points);
    RUN(what_no_wish_reaches_stays_as_it_is);
    RUN(a_far_wish_on_a_huge_square_costs_its_depth_only);
    RUN(a_long_thin_face_costs_no_more_than_a_square);
    RUN(three_triangles_on_one_edge_are_cut_alike);
    RUN(too_many_stops_without_gaps);
    RUN(triangles_without_area_end);
    RUN(bad_input_is_refused);
    RUN(no_memory_leaves_nothing);
    return check_done();
}
