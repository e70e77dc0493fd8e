// tests of sim_hold.c: what is under a sole that stands stays as it is, whatever presses, slides or lifts beside it. MODEL 6.4
#include "stand.h"

#define GAP 0.02
#define CELLS 8  // of a sole's side that lie wholly under it
#define LIGHT 200.0
#define HEAVY 1400.0

static const DpField seen[] = {DP_FIELD_COMPRESSION, DP_FIELD_HEAP};

static DpSoil soft(void)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 8e4f, soil.poisson_ratio = 0.4f, soil.settle_time = 0.05f;
    soil.rest_angle = 0.4f, soil.wall_angle = 0.7f;
    return soil;
}

// what is under the inner cells of a sole about (x, 0.05), compression and heap
static void under(const Stand* s, double x, float out[2][CELLS * CELLS])
{
    const long i = (long)lround((x - 0.04) / CELL), j = 1;
    for (int f = 0; f < 2; ++f)
        CHECK(dp_terrain_read(s->terrain, seen[f], i, j, CELLS, CELLS, out[f]) == DP_OK);
}

static double most(float out[2][CELLS * CELLS], float was[2][CELLS * CELLS])
{
    double far = 0.0;
    for (int f = 0; f < 2; ++f)
        for (int k = 0; k < CELLS * CELLS; ++k)
            far = fmax(far, fabs((double)(out[f][k] - was[f][k])));
    return far;
}

// One stands all the time, the other comes beside it and goes; `first` is the number of the one that stands.
static void stand_beside(Stand* s, int first, DpHeapLaw law)
{
    const DpSoil soil = soft();
    DpSimOptions chosen = dp_sim_options_default();
    chosen.heap_law = law;
    stand_make(s, 2);
    stand_on(s, first, 0, TIMES - 40, 0.05, 0.05, LIGHT);
    stand_on(s, 1 - first, 60, 120, 0.15 + GAP, 0.05, HEAVY);
    stand_load(s, &soil, chosen);
}

static void nothing_moves_under(int first, DpHeapLaw law)
{
    static Stand s;
    static float before[2][CELLS * CELLS], beside[2][CELLS * CELLS], now[2][CELLS * CELLS];
    stand_beside(&s, first, law);
    CHECK(dp_sim_run(s.sim, 58) == DP_OK);
    under(&s, 0.05, before);
    for (int t = 59; t < TIMES - 42; ++t) {
        CHECK(dp_sim_run(s.sim, t) == DP_OK);
        under(&s, 0.05, now);
        CHECK_NEAR(most(now, before), 0.0, 0.0);
        under(&s, 0.15 + GAP, now);  // nor under the other, once it has come to rest
        if (t == 90) memcpy(beside, now, sizeof now);
        if (t > 90 && t < 118) CHECK_NEAR(most(now, beside), 0.0, 0.0);
        if (t == 90) CHECK(now[1][0] == 0.0f && now[1][CELLS * CELLS - 1] == 0.0f);
    }
    CHECK(dp_sim_run(s.sim, TIMES - 1) == DP_OK);
    CHECK(dp_sim_settle(s.sim) == DP_OK);
    under(&s, 0.05, now);
    CHECK(most(now, before) > 1e-3);  // nobody holds it any more: it slides
    const DpSimReport report = dp_sim_report(s.sim);
    CHECK_CLOSE(report.heaped, report.displaced + report.loosened - report.pressed_heap, 1e-6);
    stand_drop(&s);
}

TEST(nothing_moves_under_who_presses_first)
{
    nothing_moves_under(0, DP_HEAP_REST);
}

TEST(nothing_moves_under_who_presses_last)
{
    nothing_moves_under(1, DP_HEAP_REST);
}

TEST(nor_does_a_rim_lie_there)
{
    nothing_moves_under(0, DP_HEAP_PAPER);
    nothing_moves_under(1, DP_HEAP_PAPER);
}

// cells of another limb are held but where the sole itself touches, and those beside the patch are not asked for
TEST(cells_of_others_are_held)
{
    static Stand s;
    stand_beside(&s, 0, DP_HEAP_REST);
    CHECK(dp_sim_run(s.sim, 70) == DP_OK);
    WorkerScratch*   scratch = &s.sim->scratch[0];
    Limb*            limb = &s.sim->limb[1];
    DpSoilPatch*     patch = NULL;
    const DpCellRect at = limb->patch;
    CHECK(limb->group == s.sim->limb[0].group);
    CHECK(dp_limb_lease(s.sim, scratch, at, &patch) == DP_OK);
    int32_t* ring = scratch->imprint.ring;
    ring[(5 - at.j0) * patch->row + (5 - at.i0)] = 0;
    CHECK(dp_hold_group(s.sim, limb, &scratch->imprint, patch->row));
    int held = 0, touched = 0;
    for (long j = at.j0; j < at.j1; ++j)
        for (long i = at.i0; i < at.i1; ++i) {
            const int32_t value = ring[(j - at.j0) * patch->row + (i - at.i0)];
            held += value == DP_RING_HELD, touched += value == 0;
            if (value == DP_RING_HELD) CHECK(i >= 0 && i <= 10 && j >= 0 && j <= 10);
        }
    CHECK(touched == 1 && held >= 80);
    dp_limb_bare(scratch, patch);
    CHECK(dp_hold_all(s.sim, at, &scratch->imprint, patch->row));
    const DpCellRect away = dp_cells(300, 300, 20, 20);
    CHECK(dp_limb_lease(s.sim, scratch, away, &patch) == DP_OK);
    CHECK(!dp_hold_all(s.sim, away, &scratch->imprint, patch->row));
    stand_drop(&s);
}

int main(void)
{
    RUN(nothing_moves_under_who_presses_first);
    RUN(nothing_moves_under_who_presses_last);
    RUN(nor_does_a_rim_lie_there);
    RUN(cells_of_others_are_held);
    return check_done();
}
