// tests of soil_heap_share.c: which share of what is pushed aside a border cell asks for. TRAIL (11), TRAIL (12)
#include "check.h"
#include "ground.h"
#include "soil/soil_heaps.h"

#define SIDE 15

static double clip(double x)
{
    return x > 0.0 ? x : 0.0;
}

// by the words of the paper: beta times how far the cell lies ahead, and the rest alike
static double want(const HeapShares* s, double x, double y)
{
    const double far = hypot(x, y);
    return s->beta * (far > 0.0 ? clip((s->dir_x * x + s->dir_y * y) / far) : 0.0) + 1.0 - s->beta;
}

TEST(a_cell_ahead_of_the_push_asks_for_more)
{
    Ground   ground = ground_make(SIDE, SIDE, 0.01, dp_soil_default());
    unsigned seed = 4;
    for (int turn = 0; turn < 200; ++turn) {
        const double     angle = 2.0 * DP_PI * check_random(&seed);
        const HeapShares s = {.beta = check_random(&seed),
                              .dir_x = cos(angle),
                              .dir_y = sin(angle),
                              .from_x = SIDE * check_random(&seed),
                              .from_y = SIDE * check_random(&seed)};
        const int    i = (int)(SIDE * check_random(&seed)), j = (int)(SIDE * check_random(&seed));
        const double got = dp_soil_heap_share(&s, &ground.patch, i, j);
        CHECK_NEAR(got, want(&s, i - s.from_x, j - s.from_y), 2e-9);
        CHECK(ldexp(got, 30) == floor(ldexp(got, 30)));  // in steps of 2^-30
    }
    ground_free(&ground);
}

// what was cut goes away from the touched cells around a border cell, the rest as without
TEST(what_was_cut_goes_one_way)
{
    Ground   ground = ground_make(SIDE, SIDE, 0.01, dp_soil_default());
    unsigned seed = 6;
    for (int turn = 0; turn < 200; ++turn) {
        const double     angle = 2.0 * DP_PI * check_random(&seed);
        const HeapShares s = {.beta = check_random(&seed),
                              .dir_y = 1.0,
                              .from_x = 3.0,
                              .cut = turn % 20 ? check_random(&seed) : 1.0,
                              .cut_x = cos(angle),
                              .cut_y = sin(angle),
                              .imprint = &ground.imprint};
        const HeapShares cut = {.beta = s.cut, .dir_x = s.cut_x, .dir_y = s.cut_y};
        for (int k = 0; k < SIDE * SIDE; ++k)
            ground.imprint.ring[k] = check_random(&seed) < 0.3 ? 0 : 1;
        const int i = (int)(SIDE * check_random(&seed)), j = (int)(SIDE * check_random(&seed));
        double    x = 0.0, y = 0.0;
        for (int q = 0; q < 9; ++q) {
            const int u = i + q % 3 - 1, v = j + q / 3 - 1;
            if (u < 0 || v < 0 || u >= SIDE || v >= SIDE || ground.imprint.ring[v * SIDE + u])
                continue;
            x += i - u, y += j - v;
        }
        const double ahead = want(&cut, x, y) - (1.0 - s.cut);
        const double rest = (1.0 - s.cut) * want(&s, i - s.from_x, j - s.from_y);
        CHECK_NEAR(dp_soil_heap_share(&s, &ground.patch, i, j), ahead + rest, 2e-9);
    }
    ground_free(&ground);
}

TEST(shares_differ_from_place_to_place_on_rough_ground_only)
{
    static float     uneven[SIDE * SIDE];
    Ground           ground = ground_make(SIDE, SIDE, 0.01, dp_soil_default());
    const HeapShares even = {.even = true}, ahead = {.beta = 0.5, .dir_x = 1.0, .from_x = -3.0};
    CHECK(dp_soil_heap_share(&even, &ground.patch, 3, 4) == 1.0);
    const double alike = dp_soil_heap_share(&ahead, &ground.patch, 3, 4);
    ground.patch.uneven = uneven;
    CHECK(dp_soil_heap_share(&even, &ground.patch, 3, 4) == 1.0);
    CHECK(dp_soil_heap_share(&ahead, &ground.patch, 3, 4) == alike);
    uneven[4 * SIDE + 3] = 0.5f;
    const double more = dp_soil_heap_share(&even, &ground.patch, 3, 4);
    CHECK(more > 1.2);
    CHECK_NEAR(dp_soil_heap_share(&ahead, &ground.patch, 3, 4), alike * more, 2e-9);
    uneven[4 * SIDE + 3] = -0.5f;
    CHECK_NEAR(dp_soil_heap_share(&even, &ground.patch, 3, 4) * more, 1.0,
               0.2);  // its mean is about 1
    ground_free(&ground);
}

int main(void)
{
    RUN(a_cell_ahead_of_the_push_asks_for_more);
    RUN(what_was_cut_goes_one_way);
    RUN(shares_differ_from_place_to_place_on_rough_ground_only);
    return check_done();
}
