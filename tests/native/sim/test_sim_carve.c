// tests of sim_carve.c: bodies that go where they are moved to. SUMNER99, MODEL 6.11
#include "stand.h"

#define SIDE 0.1  // of the plate [m]
#define SHARE 0.35
#define DISPLACED (2.0 * SHARE)

static Stand s;

static DpSoil soil_of(void)
{
    DpSoil soil = dp_soil_default();
    soil.poisson_ratio = (float)SHARE;
    return soil;
}

// the plate goes along a way, told by sample; all the while it says that it touches
static void move(int from, double x, double z)
{
    for (int t = from; t < TIMES; ++t) {
        s.pose[0][t][0] = x, s.pose[0][t][1] = 0.05, s.pose[0][t][2] = z;
        s.touching[0][t] = 1;
    }
}

static void carve(DpSoil soil)
{
    DpSimOptions chosen = dp_sim_options_default();
    chosen.law = DP_CONTACT_CARVE;
    stand_load(&s, &soil, chosen);
}

// what lies is what was displaced and cut, less what was pressed out of heaps: MODEL 11.3
static void balances(const DpSimReport* told)
{
    CHECK_CLOSE(told->heaped, told->displaced + told->loosened - told->pressed_heap, 1e-6);
}

TEST(a_body_leaves_its_depth_and_displaces_2_nu)
{
    stand_make(&s, 1);
    move(0, 0.05, 0.02);
    for (int t = 1; t <= 10; ++t) move(t, 0.05, 0.02 - 0.007 * t);  // to 5 cm deep
    carve(soil_of());
    CHECK(dp_sim_run(s.sim, 20) == DP_OK);
    const DpSimReport told = dp_sim_report(s.sim);
    CHECK(told.contacts == 1);
    CHECK_NEAR(told.deepest, 0.05, 1e-6);
    CHECK_CLOSE(told.pressed, 0.05 * SIDE * SIDE, 1e-3);
    CHECK_CLOSE(told.displaced, DISPLACED * told.pressed, 1e-6);
    CHECK_NEAR(told.loosened, 0.0, 1e-12);  // straight down nothing is cut
    balances(&told);
    for (long i = 0; i < 10; ++i)
        CHECK_NEAR(stand_read(&s, DP_FIELD_COMPRESSION, i, 5), 0.05, 1e-6);
    CHECK_NEAR(stand_read(&s, DP_FIELD_COMPRESSION, 20, 5), 0.0, 0.0);
    stand_drop(&s);
}

TEST(what_stays_over_the_ground_changes_nothing)
{
    stand_make(&s, 1);
    for (int t = 0; t < TIMES; ++t) move(t, 0.05 + 0.01 * t, t < 100 ? 0.05 : 0.0001);
    carve(soil_of());
    CHECK(dp_sim_run(s.sim, 99) == DP_OK);
    CHECK(dp_sim_report(s.sim).contacts == 0 && !s.sim->limb[0].stands);
    CHECK(dp_sim_run(s.sim, TIMES - 1) == DP_OK);
    const DpSimReport told = dp_sim_report(s.sim);
    CHECK_NEAR(told.deepest, 0.0, 0.0);
    CHECK_NEAR(told.heaped, 0.0, 0.0);
    stand_drop(&s);
}

// mean place along x of the heap, and how much of it lies within the given columns
static double heap_of(long i0, long i1, double* middle)
{
    static float heap[120 * 400];
    double       sum = 0.0, along = 0.0;
    CHECK(dp_terrain_read(s.terrain, DP_FIELD_HEAP, i0, -55, (int)(i1 - i0), 120, heap) == DP_OK);
    for (int k = 0; k < 120 * (int)(i1 - i0); ++k) {
        sum += (double)heap[k];
        along += (double)heap[k] * CELL * ((double)(i0 + k % (i1 - i0)) + 0.5);
    }
    if (middle) *middle = sum > 0.0 ? along / sum : 0.0;
    return sum * CELL * CELL;
}

// pushed along, it cuts what comes from ahead, whole, and carries it there: none of it is displaced
TEST(what_is_met_from_the_side_is_cut_and_piled_up_ahead)
{
    for (int back = -1; back <= 1; back += 2) {
        stand_make(&s, 1);
        move(0, 0.0, -0.03);
        for (int t = 10; t <= 60; ++t) move(t, 0.012 * back * (t - 10), -0.03);  // 60 cm
        carve(soil_of());
        CHECK(dp_sim_run(s.sim, 8) == DP_OK);
        const DpSimReport before = dp_sim_report(s.sim);
        CHECK_CLOSE(before.pressed, 0.03 * SIDE * SIDE, 1e-3);
        CHECK(dp_sim_run(s.sim, 62) == DP_OK);
        const DpSimReport told = dp_sim_report(s.sim);
        CHECK_CLOSE(told.loosened, 0.03 * SIDE * 0.6, 0.02);
        CHECK_CLOSE(told.pressed, before.pressed, 0.02);
        CHECK_CLOSE(told.displaced - told.pressed_heap, DISPLACED * before.pressed, 0.05);
        balances(&told);
        const double front = back * (0.6 + 0.5 * SIDE);
        double       middle;
        const double all = heap_of(-120, 120, &middle);
        const long   at = lround(front / CELL);
        const double ahead = back > 0 ? heap_of(at - 1, 120, NULL) : heap_of(-120, at + 1, NULL);
        CHECK_CLOSE(all, told.heaped, 1e-5);
        CHECK(ahead > 0.25 * all);    // most of the rest is left at its sides on the way
        CHECK(back * middle > 0.4);   // of a way of 0.6
        for (int n = 0; n < 50; ++n)  // no wall and no ridge across its way
            CHECK_NEAR(stand_read(&s, DP_FIELD_COMPRESSION, back * n, 5), 0.03, 0.002);
        stand_drop(&s);
    }
}

// One that goes ahead and down presses by no more than it comes down, and cuts the rest: 1 cm ahead and 1 mm down a
// step. Columns at its ends are under it for a part of a step.
TEST(what_comes_down_as_it_goes_presses_and_cuts)
{
    const int steps = 20;
    stand_make(&s, 1);
    move(0, 0.0, 0.0005);
    for (int t = 1; t <= steps; ++t) move(t, 0.01 * t, -0.001 * t);
    carve(soil_of());
    CHECK(dp_sim_run(s.sim, steps) == DP_OK);
    const DpSimReport told = dp_sim_report(s.sim);
    const double      pressed = 0.001 * steps * SIDE * SIDE;
    const double      cut = 0.01 * SIDE * 0.001 * 0.5 * steps * (steps - 1);
    CHECK(told.pressed > 0.9 * pressed && told.pressed < 1.001 * pressed);
    CHECK_CLOSE(told.loosened, cut, 0.1);
    CHECK_CLOSE(told.pressed + told.loosened, pressed + cut, 0.03);
    balances(&told);
    stand_drop(&s);
}

// one that tips about its middle presses where its edge comes down, and cuts nothing
TEST(what_tips_presses_on_one_side)
{
    stand_make(&s, 1);
    move(0, 0.05, 0.0);
    for (int t = 0; t < TIMES; ++t) {
        const double angle = fmin(t, 10) * 0.02;  // about y: what lies at +x comes down
        s.pose[0][t][3] = cos(0.5 * angle), s.pose[0][t][5] = sin(0.5 * angle);
    }
    carve(soil_of());
    CHECK(dp_sim_run(s.sim, 12) == DP_OK);
    const DpSimReport told = dp_sim_report(s.sim);
    CHECK_CLOSE(told.pressed, SIDE * 0.5 * 0.05 * 0.05 * tan(0.2), 0.05);
    CHECK(told.loosened < 0.05 * told.pressed);
    CHECK_NEAR(stand_read(&s, DP_FIELD_COMPRESSION, 8, 5), 0.035 * tan(0.2), 1e-3);
    CHECK_NEAR(stand_read(&s, DP_FIELD_COMPRESSION, 2, 5), 0.0, 1e-6);
    balances(&told);
    stand_drop(&s);
}

// between two samples it goes on: 25 cm a sample, two and a half times its length
TEST(a_fast_body_leaves_no_gaps)
{
    stand_make(&s, 1);
    for (int t = 0; t < TIMES; ++t) move(t, 0.25 * t, -0.02);
    carve(soil_of());
    CHECK(dp_sim_run(s.sim, 6) == DP_OK);
    for (long i = -4; i < 150; ++i)
        CHECK_NEAR(stand_read(&s, DP_FIELD_COMPRESSION, i, 5), 0.02, 1e-6);
    const DpSimReport told = dp_sim_report(s.sim);
    balances(&told);
    stand_drop(&s);
}

// how deep it may get, from the highest ground under all of its way; the cells it needs hold both its ends
TEST(its_depth_counts_from_the_highest_ground_on_its_way)
{
    stand_make(&s, 1);
    move(0, 0.0, -0.03);
    move(1, 0.3, 0.2);
    carve(soil_of());
    Limb*        limb = &s.sim->limb[0];
    const double depth = dp_carve_depth(s.sim, limb, 0);
    CHECK(depth >= 0.03 && depth < 0.03 + 0.4 / 24.0 + 2.0 * CELL);
    const DpCellRect at = dp_carve_cells(s.sim, limb, 0.0);
    CHECK(at.i0 <= -5 && at.i0 >= -7 && at.i1 >= 35 && at.i1 <= 37);
    CHECK(at.j0 <= 0 && at.j0 >= -2 && at.j1 >= 10 && at.j1 <= 12);
    CHECK(dp_carve_depth(s.sim, limb, 1) <= 0.0);  // it hangs in the air
    stand_drop(&s);
}

// on a slope the highest place under the box lies at its corner; from probe to probe it may be higher by as far as these
// lie apart, and by a cell
TEST(its_depth_counts_from_the_highest_corner)
{
    static const float     height[4] = {-0.6f, 0.2f, -0.2f, 0.6f};  // 0.2 x + 0.1 y
    static const double    mass = 70.0;
    static const int32_t   owner = 0;
    const DpSoil           soil = soil_of();
    const DpMesh           sole = {4, 2, STAND_BOX, STAND_FACES};
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    const DpGround         slope = {.kind = DP_GROUND_HEIGHTS,
                                    .nx = 2,
                                    .ny = 2,
                                    .x0 = -2.0,
                                    .y0 = -2.0,
                                    .spacing = 4.0,
                                    .heights = height};
    DpSimOptions           chosen = dp_sim_options_default();
    stand_make(&s, 1);
    move(0, 0.0, 0.0);
    move(1, 0.3, 0.2);
    const DpGait gait = {.times = TIMES,
                         .walkers = 1,
                         .limbs = 1,
                         .parts = 1,
                         .time = s.time,
                         .mass = &mass,
                         .pose = &s.pose[0][0][0],
                         .limb_walker = &owner,
                         .part_limb = &owner,
                         .sole = &sole};
    chosen.law = DP_CONTACT_CARVE;
    CHECK(dp_terrain_create(&s.terrain, &options, &slope) == DP_OK);
    CHECK(dp_sim_create(&s.sim, s.terrain, &chosen) == DP_OK);
    CHECK(dp_sim_load(s.sim, &gait, &s.touching[0][0], &s.force[0][0][0], &s.point[0][0][0]) ==
          DP_OK);
    const double highest = 0.2 * 0.35 + 0.1 * 0.1;  // of -0.05 .. 0.35 by 0 .. 0.1
    CHECK_NEAR(dp_carve_depth(s.sim, &s.sim->limb[0], 0), highest + 0.4 / 24.0 + CELL, 1e-5);
    stand_drop(&s);
}

int main(void)
{
    RUN(a_body_leaves_its_depth_and_displaces_2_nu);
    RUN(what_stays_over_the_ground_changes_nothing);
    RUN(what_is_met_from_the_side_is_cut_and_piled_up_ahead);
    RUN(what_comes_down_as_it_goes_presses_and_cuts);
    RUN(what_tips_presses_on_one_side);
    RUN(a_fast_body_leaves_no_gaps);
    RUN(its_depth_counts_from_the_highest_ground_on_its_way);
    RUN(its_depth_counts_from_the_highest_corner);
    return check_done();
}
