// tests of imprint_raster.c alone: triangles on a grid of samples, against asking every sample.
#include "check.h"
#include "imprint/imprint_raster.h"

#define SIDE 41
#define PAST (SIDE - 1)
#define ROW 56  // a multiple of 8, and 8 to spare

static float        low[SIDE * ROW];
static DpSampleRect due[64];

static void lower(const double* corner, const int32_t* triangle, int count)
{
    const DpSamples samples = {0, SIDE, 0, SIDE, PAST, PAST, ROW, low};
    for (int k = 0; k < SIDE * ROW; ++k) low[k] = INFINITY;
    dp_samples_lower(&samples, corner, triangle, count, due);
}

// the plane through three corners at (u, v); NaN outside, or so near to an edge that either may be right
static double height_at(const double* a, const double* b, const double* c, double u, double v)
{
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    const double one = ((u - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (v - a[1])) / twice;
    const double two = ((b[0] - a[0]) * (v - a[1]) - (u - a[0]) * (b[1] - a[1])) / twice;
    const double edge = fmin(fmin(one, two), 1.0 - one - two);
    if (fabs(edge) < 1e-9) return NAN;
    return edge < 0.0 ? INFINITY : a[2] + one * (b[2] - a[2]) + two * (c[2] - a[2]);
}

TEST(a_triangle_lowers_what_lies_under_it)
{
    const int32_t triangle[3] = {0, 1, 2};
    unsigned      seed = 5;
    int           under = 0;
    for (int turn = 0; turn < 300; ++turn) {
        double corner[9];
        for (int k = 0; k < 9; ++k)
            corner[k] =
                k % 3 == 2 ? 0.2 * check_random(&seed) : 100.0 * (check_random(&seed) - 0.5);
        lower(corner, triangle, 1);
        for (int q = 0; q < SIDE; ++q)
            for (int p = 0; p < SIDE; ++p) {
                const double want =
                    height_at(corner, corner + 3, corner + 6, 2 * p - PAST, 2 * q - PAST);
                if (isnan(want)) continue;
                const float got = low[q * ROW + p];
                CHECK(isinf(want) ? isinf(got) : fabs((double)got - want) < 1e-6);
                under += !isinf(want);
            }
        for (int q = 0; q < SIDE; ++q)
            for (int p = SIDE; p < ROW; ++p) CHECK(isinf(low[q * ROW + p]));
    }
    CHECK(under > 10000);
}

// Two corners of height 0 on a line through samples, (3 k, k), where large numbers cancel and every rounding shows;
// the third is far above, or below, and so near the line that a row has one sample. Whichever corner a plane starts from, no order of them changes a bit.
TEST(no_order_of_corners_changes_a_bit)
{
    static float        first[SIDE * ROW];
    static const int8_t order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                       {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const int32_t       triangle[3] = {0, 1, 2};
    unsigned            seed = 9;
    int                 rounded = 0;
    for (int turn = 0; turn < 400; ++turn) {
        const double high = 1e4 * check_random(&seed);
        const double corner[9] = {-30.0,
                                  -10.0,
                                  0.0,
                                  30.0,
                                  10.0,
                                  0.0,
                                  0.1 + 1.5 * check_random(&seed),
                                  0.5 * check_random(&seed) - 0.4,
                                  turn % 2 ? high : -high};
        for (int n = 0; n < 6; ++n) {
            double turned[9];
            for (int k = 0; k < 9; ++k) turned[k] = corner[3 * order[n][k / 3] + k % 3];
            lower(turned, triangle, 1);
            if (n == 0) memcpy(first, low, sizeof low);
            CHECK(memcmp(first, low, sizeof low) == 0);
        }
        for (int k = -8; k <= 8; k += 2) {
            const float on_line = first[(k + PAST) / 2 * ROW + (3 * k + PAST) / 2];
            rounded += fabsf(on_line) > 0.0f && fabsf(on_line) < 1e-9f;
        }
    }
    CHECK(rounded > 100);
}

// What lies a little lower than what is there already is not hidden by it, whichever side is thought to be below: a
// third triangle, high up and aside, tells so.
TEST(a_little_lower_is_seen)
{
    const double corner[27] = {-200, -100, 0.1,    200, -100, 0.1,    0,  400, 0.1,
                               -200, -100, 0.0995, 200, -100, 0.0995, 0,  400, 0.0995,
                               36,   36,   1e5,    39,  36,   1e5,    38, 39,  1e5};
    for (int turn = 0; turn < 8; ++turn) {
        int32_t triangle[9];
        for (int t = 0; t < 3; ++t) {
            const int turned = turn >> t & 1;
            triangle[3 * t] = 3 * t;
            triangle[3 * t + 1] = 3 * t + 1 + turned, triangle[3 * t + 2] = 3 * t + 2 - turned;
        }
        lower(corner, triangle, 3);
        CHECK(low[(SIDE / 2) * ROW + SIDE / 2] == 0.0995f);
    }
}

// the lowest of many, whichever side is up and in whatever order they come; what is hidden changes nothing
TEST(the_lowest_of_many_is_kept)
{
    static double  corner[9 * 40];
    static int32_t triangle[3 * 40];
    unsigned       seed = 21;
    for (int turn = 0; turn < 40; ++turn) {
        for (int k = 0; k < 9 * 40; ++k)
            corner[k] = k % 3 == 2 ? (turn % 2 ? 0.05 : 0.5) * check_random(&seed)
                                   : 90.0 * (check_random(&seed) - 0.5);
        for (int t = 0; t < 40; ++t)
            for (int k = 0; k < 3; ++k) triangle[3 * t + k] = 3 * t + k;
        lower(corner, triangle, 40);
        for (int q = 0; q < SIDE; ++q)
            for (int p = 0; p < SIDE; ++p) {
                double want = INFINITY;
                for (int t = 0; t < 40; ++t) {
                    const double z = height_at(corner + 9 * t, corner + 9 * t + 3,
                                               corner + 9 * t + 6, 2 * p - PAST, 2 * q - PAST);
                    want = isnan(z) || isnan(want) ? NAN : fmin(want, z);
                }
                if (isnan(want)) continue;
                const float got = low[q * ROW + p];
                CHECK(isinf(want) ? isinf(got) : fabs((double)got - want) < 1e-6);
            }
    }
}

TEST(samples_are_found_at_both_ends)
{
    for (int past = 1; past < 12; ++past)
        for (double x = -2.0 * past; x <= 2.0 * past; x += 0.25) {
            int first = -1, last = past + 1;  // at most one beyond the grid
            while (first <= past && 2 * first - past < x) ++first;
            while (last > -1 && 2 * last - past > x) --last;
            CHECK(dp_samples_first(x, past) == first);
            CHECK(dp_samples_last(x, past) == last);
        }
}

TEST(a_window_is_all_that_is_touched)
{
    const double    corner[9] = {-60, -50, 0.1, 70, -40, 0.1, 0, 90, 0.1};
    const int32_t   triangle[3] = {0, 1, 2};
    static float    part[SIDE * ROW];
    const DpSamples samples = {11, 24, 7, 15, PAST, PAST, 24, part};
    for (int k = 0; k < SIDE * ROW; ++k) part[k] = INFINITY;
    lower(corner, triangle, 1);
    dp_samples_lower(&samples, corner, triangle, 1, due);
    for (int k = 0; k < SIDE * ROW; ++k) {
        const int p = k % 24 + 11, q = k / 24 + 7;
        CHECK(part[k] == (p < 24 && q < 15 ? low[q * ROW + p] : INFINITY));
    }
}

int main(void)
{
    RUN(a_triangle_lowers_what_lies_under_it);
    RUN(no_order_of_corners_changes_a_bit);
    RUN(a_little_lower_is_seen);
    RUN(the_lowest_of_many_is_kept);
    RUN(samples_are_found_at_both_ends);
    RUN(a_window_is_all_that_is_touched);
    return check_done();
}
