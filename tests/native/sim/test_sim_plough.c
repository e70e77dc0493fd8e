// tests of sim_plough.c: soles that slide while they press push what is in their way ahead. MODEL 6.18
#include "stand.h"

#define LOAD 600.0
#define WAY 0.3  // [m], from the 60th sample to the 160th

static Stand s;

static DpSoil soft(void)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 5e5f, soil.layer_depth = 0.4f, soil.settle_time = 0.05f;
    return soil;
}

// it stands, goes along x and turns about its middle, and stands there
static void slide(double way, double turn)
{
    stand_make(&s, 1);
    stand_on(&s, 0, 1, TIMES - 10, 0.0, 0.0, LOAD);
    for (int t = 0; t < TIMES; ++t) {
        const double w = dp_clamp((t - 60) / 100.0, 0.0, 1.0);
        s.pose[0][t][0] = s.point[0][t][0] = way * w;
        s.pose[0][t][3] = cos(0.5 * turn * w), s.pose[0][t][6] = sin(0.5 * turn * w);
    }
}

static void balances(const DpSimReport* told)
{
    CHECK_CLOSE(told->heaped, told->displaced + told->loosened - told->pressed_heap, 1e-6);
}

static double heap_of(long i0, long i1, long j0, long j1)
{
    double sum = 0.0;
    for (long j = j0; j < j1; ++j)
        for (long i = i0; i < i1; ++i) sum += stand_read(&s, DP_FIELD_HEAP, i, j);
    return sum * CELL * CELL;
}

TEST(what_is_in_its_way_lies_ahead_of_it)
{
    for (int law = 0; law < 2; ++law) {
        const DpSoil soil = soft();
        DpSimOptions chosen = dp_sim_options_default();
        chosen.law = (DpContactLaw)law;
        slide(WAY, 0.0);
        stand_load(&s, &soil, chosen);
        CHECK(dp_sim_run(s.sim, 59) == DP_OK);
        const DpSimReport before = dp_sim_report(s.sim);
        CHECK_NEAR(before.loosened, 0.0, 1e-12);
        CHECK(dp_sim_run(s.sim, TIMES - 20) == DP_OK);
        const DpSimReport told = dp_sim_report(s.sim);
        const double      track = before.deepest * 0.1 * WAY;
        CHECK_CLOSE(told.loosened, track, 0.08);
        CHECK_CLOSE(told.pressed - before.pressed + told.loosened, track, 0.04);
        balances(&told);
        const double ahead = heap_of(34, 60, -30, 30), behind = heap_of(-40, -5, -30, 30);
        CHECK(ahead > 0.25 * told.heaped && ahead > 4.0 * behind);
        CHECK_CLOSE(heap_of(-5, 35, -40, 0), heap_of(-5, 35, 0, 40), 1e-4);  // windrows
        CHECK(dp_sim_settle(s.sim) == DP_OK);
        const DpSimReport end = dp_sim_report(s.sim);
        balances(&end);
        stand_drop(&s);
    }
}

// half of its front goes one way, half the other: what it cuts lies all around
TEST(a_sole_that_turns_on_the_spot_pushes_to_both_sides)
{
    const DpSoil soil = soft();
    slide(0.0, 0.7);
    stand_load(&s, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(s.sim, TIMES - 20) == DP_OK);
    const DpSimReport told = dp_sim_report(s.sim);
    const double      front = 0.5 * 0.05 * 0.05 * 0.7;  // half of a side sweeps over so much [m^2]
    const double      swept = 4.0 * front * told.deepest;
    CHECK(told.loosened > 0.7 * swept && told.loosened < 1.05 * swept);
    CHECK_CLOSE(heap_of(-40, 0, -40, 40), heap_of(0, 40, -40, 40), 0.03);
    CHECK_CLOSE(heap_of(-40, 40, -40, 0), heap_of(-40, 40, 0, 40), 0.03);
    balances(&told);
    stand_drop(&s);
}

// what a step tells of how a sole's points go
TEST(its_points_go_as_its_poses_and_its_slip_say)
{
    const DpSoil      soil = soft();
    const DpSoilPatch patch = {.nx = 1, .ny = 1, .cell = CELL, .x0 = 0.01, .y0 = 0.0};
    DpSlide           slides;
    slide(WAY, 0.5);
    stand_load(&s, &soil, dp_sim_options_default());
    const Limb*  limb = &s.sim->limb[0];
    const DpVec3 none = dp_vec3(0.0, 0.0, 0.0);
    CHECK(!dp_limb_slides(s.sim, limb, &patch, 30, 0.0, 1.0, none, &slides));
    CHECK(dp_limb_slides(s.sim, limb, &patch, 30, 0.0, 1.0, dp_vec3(0.002, 0.001, 0.0), &slides));
    CHECK_NEAR(slides.at[0], 0.002, 1e-12);
    CHECK_NEAR(slides.at[1], 0.001, 1e-12);
    CHECK(dp_limb_slides(s.sim, limb, &patch, 60, 0.0, 0.5, none, &slides));
    CHECK_NEAR(slides.at[0], 0.0015, 1e-5);  // in half a sample, at x = 0.01
    CHECK_NEAR(slides.at[1], 0.0025 * (0.01 - 0.0015), 1e-5);
    CHECK_NEAR(slides.by_x[1], 0.0025, 1e-6);
    CHECK_NEAR(slides.by_y[0], -0.0025, 1e-6);
    CHECK_NEAR(slides.by_z[0], 0.0, 1e-9);
    CHECK(!dp_limb_slides(s.sim, limb, &patch, TIMES - 5, 0.0, 1.0, none, &slides));  // in the air
    stand_drop(&s);
}

#define HOLDS 0.02  // [m]

// what flows of a way along x of the sole in so many steps, whose place changes as it goes, and turning about its middle
static double flows(Limb* limb, double way, double turn, int steps)
{
    DpSoil soil = soft();
    soil.flow_shear = (float)HOLDS;
    const DpSoilPatch patch = {.nx = 21, .ny = 11, .cell = CELL, .x0 = 3.0, .y0 = 5.0};
    double            sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double x = 3.1 + way * k / steps, z = 0.5;
        DpSlide      slide = {.by_z = {0.004 / z, 0.0}, .by_x = {0.0, turn / steps}};
        slide.by_y[0] = -turn / steps;
        slide.at[0] = way / steps - 0.004 + 0.05 * turn / steps;  // the place turns on the spot
        slide.at[1] = -(x - 3.1) * turn / steps;
        dp_limb_shears(limb, &patch, &soil, dp_vec3(x, 5.1, z), &slide);
        const double radius = 0.5 * limb->length, around = turn / steps * radius;
        sum += (1.0 - slide.held) * hypot(way / steps, around * sqrt(0.5));
    }
    return sum;
}

// of a way, or of a turn on the spot, flows what is longer than the soil holds, in any number of steps
TEST(a_shear_holds_what_slides_a_little)
{
    for (int turns = 0; turns < 2; ++turns)
        for (int k = 0; k < 3; ++k) {
            static const double far[] = {0.002, 0.02, 0.3};
            for (int steps = 1; steps < 400; steps *= 19) {
                Limb         limb = {.length = 0.2};
                const double wanted = far[k] + HOLDS * expm1(-far[k] / HOLDS);
                const double turn = far[k] / (0.1 * sqrt(0.5));
                const double found =
                    turns ? flows(&limb, 0.0, turn, steps) : flows(&limb, far[k], 0.0, steps);
                CHECK_CLOSE(found, wanted, 1e-6);
            }
        }
    for (int k = 0; k < 2; ++k) {  // in a walk: all but what is held of a way of 0.3 m
        DpSoil        soil = soft();
        static double cut[2];
        soil.flow_shear = k ? (float)HOLDS : 0.0f;
        slide(WAY, 0.0);
        stand_load(&s, &soil, dp_sim_options_default());
        CHECK(dp_sim_run(s.sim, TIMES - 20) == DP_OK);
        cut[k] = dp_sim_report(s.sim).loosened;
        stand_drop(&s);
        if (k) CHECK_CLOSE(cut[1] / cut[0], 1.0 - HOLDS / WAY, 0.02);
    }
}

// a sole that is set down again begins anew: its second short slide is held as the first was
TEST(each_stance_shears_anew)
{
    DpSoil soil = soft();
    soil.flow_shear = (float)HOLDS;
    stand_make(&s, 1);
    for (int k = 0; k < 2; ++k) {
        stand_on(&s, 0, 100 * k, 100 * k + 80, k, 0.0, LOAD);
        for (int t = 100 * k + 40; t < 100 * k + 90; ++t)
            s.pose[0][t][0] = s.point[0][t][0] = k + 5e-4 * (t - 100 * k - 40);
    }
    for (int t = 90; t < 100; ++t) s.pose[0][t][2] = 0.3;
    stand_load(&s, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(s.sim, 95) == DP_OK);
    const double first = dp_sim_report(s.sim).loosened;
    CHECK(dp_sim_run(s.sim, TIMES - 6) == DP_OK);
    CHECK(first > 0.0);
    CHECK_CLOSE(dp_sim_report(s.sim).loosened, 2.0 * first, 1e-3);
    stand_drop(&s);
}

// nothing flows until half of what has sheared is sheared back, and it flows the other way then
TEST(who_goes_back_shears_anew)
{
    Limb limb = {.length = 0.2};
    CHECK(flows(&limb, 0.4, 0.0, 100) > 0.37);
    CHECK_NEAR(limb.shear.field[0], HOLDS, 1e-6);
    CHECK_NEAR(flows(&limb, -0.99 * log(2.0) * HOLDS, 0.0, 20), 0.0, 1e-6);
    CHECK_CLOSE(flows(&limb, -0.4, 0.0, 1000), 0.4 - HOLDS, 2e-3);
    CHECK_NEAR(limb.shear.field[0], -HOLDS, 1e-6);
}

int main(void)
{
    RUN(what_is_in_its_way_lies_ahead_of_it);
    RUN(a_sole_that_turns_on_the_spot_pushes_to_both_sides);
    RUN(a_shear_holds_what_slides_a_little);
    RUN(each_stance_shears_anew);
    RUN(who_goes_back_shears_anew);
    RUN(its_points_go_as_its_poses_and_its_slip_say);
    return check_done();
}
