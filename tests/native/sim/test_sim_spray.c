// tests of sim_spray.c: MODEL 6.15, MODEL 11.24
#include "spray/usual.h"
#include "stand.h"

#define NEWTON 700.0

static Stand stand;

// Soles that stand until 0.4 s and are then swung up and back in 0.25 s, in a line along x.
static void kick(Stand* s, int limbs, const DpSoil* soil, int workers,
                 const DpSprayNumbers* numbers)
{
    DpSimOptions options = dp_sim_options_default();
    options.workers = workers;
    stand_make(s, limbs);
    for (int l = 0; l < limbs; ++l) {
        stand_on(s, l, 5, 40, 0.6 * l, 0.03 * l, NEWTON);
        for (int t = 40; t < TIMES; ++t) {
            const double w = dp_smoothstep((t - 39) / 25.0);
            s->pose[l][t][0] = 0.6 * l - 0.7 * w, s->pose[l][t][2] = 0.5 * w;
        }
    }
    stand_load(s, soil, options);
    if (numbers) CHECK(dp_sim_spray(s->sim, numbers) == DP_OK);
}

static void check_ledger(const Stand* s)
{
    const DpSimReport r = dp_sim_report(s->sim);
    const double      laid = r.displaced + r.loosened - r.pressed_heap;
    CHECK_NEAR(r.heaped + r.stuck + r.airborne + r.beside, laid, 1e-6 * laid);
    double heap, pressed, deepest;
    dp_terrain_totals(s->terrain, &heap, &pressed, &deepest);
    CHECK_NEAR(pressed, r.pressed + r.loosened, 1e-6 * pressed);
}

TEST(nothing_is_lost_on_the_way)
{
    const DpSoil         soil = dp_soil_default();
    const DpSprayNumbers numbers = usual();
    double               most = 0.0;
    kick(&stand, 2, &soil, 1, &numbers);
    for (int k = 5; k < TIMES; k += 5) {
        CHECK(dp_sim_run(stand.sim, k) == DP_OK);
        check_ledger(&stand);
        most = fmax(most, dp_sim_report(stand.sim).airborne);
    }
    const DpSimReport before = dp_sim_report(stand.sim);
    CHECK_CLOSE(before.thrown + before.stuck, 2.0 * 0.01 * numbers.adhesion, 0.04);
    CHECK(most > 0.3 * before.thrown && before.thrown > 1e-5 && before.beside <= 0.0);
    CHECK(dp_sim_settle(stand.sim) == DP_OK);
    CHECK(dp_sim_report(stand.sim).airborne <= 0.0);
    check_ledger(&stand);
    stand_drop(&stand);
}

TEST(who_stands_throws_nothing)
{
    const DpSoil         soil = dp_soil_default();
    const DpSprayNumbers numbers = usual();
    stand_make(&stand, 1);
    stand_on(&stand, 0, 0, TIMES, 0.0, 0.0, NEWTON);
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(dp_sim_spray(stand.sim, &numbers) == DP_OK);
    CHECK(dp_sim_run(stand.sim, TIMES - 1) == DP_OK);
    const DpSimReport report = dp_sim_report(stand.sim);
    CHECK(report.thrown <= 0.0 && report.stuck <= 0.0 && dp_sim_grains(stand.sim) == 0);
    stand_drop(&stand);
}

// Heaps where it landed lie behind, where the soles were swung to; none stands steeper than its soil rests.
TEST(it_lands_where_it_was_thrown_and_lies_at_rest)
{
    const DpSoil         soil = dp_soil_default();
    const DpSprayNumbers numbers = usual();
    double               sum = 0.0, at = 0.0;
    kick(&stand, 1, &soil, 1, &numbers);
    CHECK(dp_sim_run(stand.sim, TIMES - 1) == DP_OK);
    CHECK(dp_sim_settle(stand.sim) == DP_OK);
    for (long j = -60; j < 60; ++j)
        for (long i = -250; i < -20; ++i) {
            const double heap = stand_read(&stand, DP_FIELD_HEAP, i, j);
            sum += heap, at += heap * CELL * (double)i;
        }
    CHECK(sum * CELL * CELL > 0.5 * dp_sim_report(stand.sim).thrown);
    CHECK(at / sum < -0.5 && at / sum > -2.0);
    const double most = CELL * tan((double)soil.rest_angle + dp_sim_options_default().tolerance);
    for (long j = -60; j < 60; ++j)
        for (long i = -250; i < 60; ++i)
            if (stand_read(&stand, DP_FIELD_HEAP, i, j) > 1e-6)
                CHECK(stand_read(&stand, DP_FIELD_HEIGHT_CHANGE, i, j) -
                          stand_read(&stand, DP_FIELD_HEIGHT_CHANGE, i - 1, j) <
                      most + 1e-6);
    stand_drop(&stand);
}

TEST(the_same_for_any_number_of_workers)
{
    static Stand         other;
    const DpSoil         soil = dp_soil_default();
    const DpSprayNumbers numbers = usual();
    kick(&stand, 2, &soil, 1, &numbers), kick(&other, 2, &soil, 4, &numbers);
    CHECK(dp_sim_run(stand.sim, 55) == DP_OK && dp_sim_run(other.sim, 55) == DP_OK);
    const int count = dp_sim_grains(stand.sim);
    CHECK(count > 500 && dp_sim_grains(other.sim) == count);
    for (int n = 0; n < count; ++n) {
        const DpGrain a = dp_sim_grain(stand.sim, n), b = dp_sim_grain(other.sim, n);
        CHECK(memcmp(&a.at, &b.at, sizeof a.at) == 0 && a.name == b.name);
    }
    CHECK(dp_sim_run(stand.sim, 150) == DP_OK && dp_sim_run(other.sim, 150) == DP_OK);
    for (long j = -40; j < 40; ++j)
        for (long i = -200; i < 100; ++i)
            CHECK(stand_read(&stand, DP_FIELD_HEAP, i, j) ==
                  stand_read(&other, DP_FIELD_HEAP, i, j));
    stand_drop(&stand), stand_drop(&other);
}

TEST(a_state_goes_on_to_the_bit)
{
    static Stand         other;
    const DpSoil         soil = dp_soil_default();
    const DpSprayNumbers numbers = usual();
    DpStateWriter        writer = {0};
    kick(&stand, 2, &soil, 1, &numbers);
    CHECK(dp_sim_run(stand.sim, 50) == DP_OK);
    CHECK(dp_sim_save_state(stand.sim, &writer) == DP_OK);
    kick(&other, 2, &soil, 1, NULL);  // of another: it has no spray
    CHECK(dp_sim_load_state(other.sim, writer.bytes, writer.size) == DP_BAD_FILE);
    stand_drop(&other);
    kick(&other, 2, &soil, 1, &numbers);
    CHECK(dp_sim_load_state(other.sim, writer.bytes, writer.size - 9) == DP_BAD_FILE);
    CHECK(dp_sim_load_state(other.sim, writer.bytes, writer.size) == DP_OK);
    dp_write_drop(&writer);
    CHECK(dp_sim_run(stand.sim, 70) == DP_OK && dp_sim_run(other.sim, 70) == DP_OK);
    CHECK(dp_sim_grains(stand.sim) > 0);
    CHECK(dp_sim_grains(stand.sim) == dp_sim_grains(other.sim));
    for (int n = 0; n < dp_sim_grains(stand.sim); ++n) {
        const DpGrain a = dp_sim_grain(stand.sim, n), b = dp_sim_grain(other.sim, n);
        CHECK(memcmp(&a.at, &b.at, sizeof a.at) == 0);
    }
    const DpSimReport a = dp_sim_report(stand.sim), b = dp_sim_report(other.sim);
    CHECK(a.heaped == b.heaped && a.thrown == b.thrown && a.stuck == b.stuck);
    stand_drop(&stand), stand_drop(&other);
}

TEST(bad_numbers_and_a_second_time_are_refused)
{
    const DpSoil   soil = dp_soil_default();
    DpSprayNumbers numbers = usual(), bad = usual();
    bad.particle_size = -1.0;
    kick(&stand, 1, &soil, 1, NULL);
    CHECK(dp_sim_spray(stand.sim, &bad) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_spray(stand.sim, &numbers) == DP_OK);
    CHECK(dp_sim_spray(stand.sim, &numbers) == DP_BAD_ARGUMENT);
    stand_drop(&stand);
}

int main(void)
{
    RUN(nothing_is_lost_on_the_way);
    RUN(who_stands_throws_nothing);
    RUN(it_lands_where_it_was_thrown_and_lies_at_rest);
    RUN(the_same_for_any_number_of_workers);
    RUN(a_state_goes_on_to_the_bit);
    RUN(bad_numbers_and_a_second_time_are_refused);
    return check_done();
}
