// tests of sim_slide.c: what soles held slides until it rests, at once or in its time. MODEL 6.4
#include "base/alloc.h"
#include "base/stream.h"
#include "stand.h"

#define SIDE 260  // cells around the origin that are looked at

static Stand stand;

static DpSoil flowing(double seconds)
{
    DpSoil soil = dp_soil_default();
    soil.flow_time = (float)seconds;
    return soil;
}

static void begin(const DpSoil* soil, int limbs)
{
    stand_make(&stand, limbs);
    stand_load(&stand, soil, dp_sim_options_default());
}

// a block of loose soil with its middle at a cell
static void pile(long i, long j, long side, float high)
{
    DpLease*         lease = dp_lease_create();
    DpSoilPatch*     patch = NULL;
    const DpCellRect at = dp_cells(i - side / 2, j - side / 2, side, side);
    CHECK(dp_terrain_acquire(stand.terrain, lease, at, &patch) == DP_OK);
    for (int y = 0; y < patch->ny; ++y)
        for (int x = 0; x < patch->nx; ++x) patch->heap[y * patch->row + x] = high;
    dp_terrain_commit(stand.terrain, lease, dp_cells(0, 0, side, side));
    dp_lease_destroy(lease);
}

// what lies there: its volume, its steepest slope, and how many columns of its middle row it covers
typedef struct Lies
{
    double volume, slope;
    long   wide;
} Lies;

static Lies look(long i, long j)
{
    float* heap = dp_alloc((size_t)SIDE * SIDE, sizeof *heap);
    Lies   lies = {0.0, 0.0, 0};
    CHECK(dp_terrain_read(stand.terrain, DP_FIELD_HEAP, i - SIDE / 2, j - SIDE / 2, SIDE, SIDE,
                          heap) == DP_OK);
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x) {
            const float here = heap[y * SIDE + x];
            lies.volume += (double)here * CELL * CELL;
            lies.wide += y == SIDE / 2 && here > 0.0f;
            if (x > 0)
                lies.slope = fmax(lies.slope, fabs((double)(here - heap[y * SIDE + x - 1])) / CELL);
        }
    dp_free(heap);
    return lies;
}

static double at_rest(const DpSoil* soil)
{
    return tan((double)soil->rest_angle + dp_sim_options_default().tolerance) * 1.0001;
}

// how many sweeps fall into the interval from a sample, on bare ground far from all that lies
static int sweeps_at(int sample)
{
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(stand.terrain, stand.sim->scratch[0].lease, dp_cells(-999, 0, 9, 9),
                             &patch) == DP_OK);
    return dp_slide_sweeps(stand.sim, patch, sample);
}

TEST(a_soil_that_takes_time_goes_a_cell_in_its_share_of_it)
{
    const double seconds[] = {0.37, 1.07, 3.1, 41.0};
    for (int n = 0; n < 4; ++n) {
        const DpSoil soil = flowing(seconds[n]);
        begin(&soil, 1);
        int    sum = 0;
        double cells = 0.0;  // 0.1 m in flow_time
        for (int k = 0; k + 1 < TIMES; ++k) {
            sum += sweeps_at(k);
            cells = 0.1 * stand.time[k + 1] / ((double)soil.flow_time * CELL);
            CHECK(sum == (int)floor(cells));
        }
        CHECK(sweeps_at(-1) == stand.sim->options.max_sweeps);
        stand.sim->options.max_sweeps = 1;
        CHECK(sweeps_at(0) <= 1);
        stand_drop(&stand);
    }
    const DpSoil sand = dp_soil_default();
    begin(&sand, 1);
    CHECK(sweeps_at(0) == stand.sim->options.max_sweeps);
    stand_drop(&stand);
}

// a print comes to rest, however far its soil goes beyond the cells that were trodden
TEST(what_a_sole_held_slides_until_it_rests)
{
    const DpSoil soil = dp_soil_default();
    const float  high[] = {0.02f, 0.1f, 0.6f};
    for (int n = 0; n < 3; ++n) {
        begin(&soil, 1);
        pile(3, -4, 6, high[n]);
        Limb* limb = &stand.sim->limb[0];
        CHECK(dp_limb_settle(stand.sim, limb, 0, &stand.sim->scratch[0]) == DP_OK);
        CHECK(look(3, -4).slope > at_rest(&soil));  // nothing was trodden: nothing is looked at
        limb->trodden = dp_cells(0, -7, 6, 6);
        CHECK(dp_limb_settle(stand.sim, limb, 0, &stand.sim->scratch[0]) == DP_OK);
        const Lies lies = look(3, -4);
        CHECK(lies.slope <= at_rest(&soil) && !limb->flows);
        CHECK_CLOSE(lies.volume, 36 * (double)high[n] * CELL * CELL, 1e-5);
        stand_drop(&stand);
    }
}

// walls of a print that fall are told as loosened, at once or in their time
TEST(walls_that_fall_are_counted)
{
    const double takes[3] = {0.0, 0.3, 0.001};  // at once, over many samples, within one
    for (int n = 0; n < 3; ++n) {
        DpSoil soil = flowing(takes[n]);
        soil.wall_angle = 0.8f;
        begin(&soil, 1);
        DpLease*     lease = dp_lease_create();
        DpSoilPatch* patch = NULL;
        CHECK(dp_terrain_acquire(stand.terrain, lease, dp_cells(0, 0, 10, 10), &patch) == DP_OK);
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 10; ++x) patch->compression[y * patch->row + x] = 0.1f;
        dp_terrain_commit(stand.terrain, lease, dp_cells(0, 0, 10, 10));
        dp_lease_destroy(lease);
        Limb* limb = &stand.sim->limb[0];
        limb->trodden = dp_cells(0, 0, 10, 10), limb->loosened = 1.0;
        for (int k = 0; k < (n == 1 ? 150 : 1); ++k) {
            CHECK(dp_limb_settle(stand.sim, limb, k, &stand.sim->scratch[0]) == DP_OK);
            CHECK_NEAR(limb->loosened - 1.0, look(5, 5).volume, 1e-9);
        }
        CHECK(limb->loosened > 1.0 + 1e-5);
        stand_drop(&stand);
    }
}

// in slow soil a pile goes one cell a sweep on every side, and slides on; at the end it rests as sand does
TEST(slow_soil_slides_on)
{
    const DpSoil soil = flowing(1.0);  // a sweep about every tenth sample
    begin(&soil, 1);
    pile(0, 0, 6, 0.2f);
    Limb* limb = &stand.sim->limb[0];
    limb->trodden = dp_cells(-3, -3, 6, 6);
    limb->flows = limb->left = true;
    long wide = look(0, 0).wide;
    for (int k = 0; k < 60; ++k) {
        const int sweeps = sweeps_at(k);
        CHECK(dp_limb_settle(stand.sim, limb, k, &stand.sim->scratch[0]) == DP_OK);
        const long now = look(0, 0).wide;
        CHECK(now <= wide + 2 * sweeps && now >= wide && limb->flows);
        wide = now;
    }
    CHECK(wide >= 10 && look(0, 0).slope > at_rest(&soil));
    CHECK(dp_limb_settle(stand.sim, limb, -1, &stand.sim->scratch[0]) == DP_OK);
    CHECK(look(0, 0).slope <= at_rest(&soil) && !limb->flows);
    CHECK_CLOSE(look(0, 0).volume, 36 * 0.2 * CELL * CELL, 1e-5);
    stand_drop(&stand);
}

TEST(a_print_is_left_where_its_limb_stands_elsewhere)
{
    const DpSoil soil = flowing(1.0);
    begin(&soil, 1);
    DpSim* sim = stand.sim;
    Limb*  limb = &sim->limb[0];
    for (long away = 0; away < 20; ++away) {
        sim->slides = 0;
        limb->trodden = dp_cells(0, 0, 10, 10), limb->patch = dp_cells(10 + away, 0, 10, 10);
        limb->flows = true;
        CHECK(dp_slide_leave(sim, limb) == DP_OK);
        const bool leaves = away >= 8;  // cells that are looked at around what slides
        CHECK(sim->slides == leaves && limb->flows == !leaves);
        CHECK(dp_cells_empty(limb->trodden) == leaves);
        if (leaves)
            CHECK(sim->slide[0].i0 == 0 && sim->slide[0].i1 == 10 && sim->slide[0].j1 == 10);
    }
    dp_free(sim->slide), sim->slide = NULL, sim->slides = 0;
    limb->trodden = dp_cells(0, 0, 10, 10), limb->flows = true;
    dp_alloc_fail_after(0);
    CHECK(dp_slide_leave(sim, limb) == DP_NO_MEMORY && sim->slides == 0 && limb->flows);
    dp_alloc_fail_after(-1);
    stand_drop(&stand);
}

// who steps beside a print that still slides keeps it; a stance on ground that rests begins with none
TEST(a_stance_beside_a_sliding_print_keeps_it)
{
    const DpSoil soil = flowing(1.0);
    for (int flows = 0; flows < 2; ++flows) {
        stand_make(&stand, 1);
        stand_on(&stand, 0, 5, 50, 0.1, 0.0, 150.0);
        stand_load(&stand, &soil, dp_sim_options_default());
        Limb*            limb = &stand.sim->limb[0];
        const DpCellRect print = dp_cells(0, -5, 8, 8);
        limb->trodden = print, limb->flows = flows;
        CHECK(dp_step_plan(stand.sim, 4) == DP_OK && limb->begins);
        CHECK(dp_cells_empty(limb->trodden) == !flows && stand.sim->slides == 0);
        if (flows) CHECK(limb->trodden.i0 == print.i0 && limb->trodden.j1 == print.j1);
        stand_drop(&stand);
    }
}

// prints that nobody stands on slide by themselves, but for one that a sole holds; at the end all do
TEST(prints_that_were_left_slide_by_themselves)
{
    const DpSoil soil = flowing(1.0);
    begin(&soil, 1);
    DpSim* sim = stand.sim;
    Limb*  limb = &sim->limb[0];
    pile(0, 0, 6, 0.1f), pile(600, 0, 6, 0.1f);
    CHECK(dp_make_room(&sim->slide, 2, sizeof *sim->slide));
    sim->slide[0] = dp_cells(-3, -3, 6, 6), sim->slide[1] = dp_cells(597, -3, 6, 6),
    sim->slides = 2;
    const Lies before = look(0, 0);
    int        some[2], none = 0;  // samples with a sweep, and one without
    while (sweeps_at(none) > 0) ++none;
    for (int k = 0, n = 0; n < 2; ++k)
        if (sweeps_at(k) == 1) some[n++] = k;
    CHECK(dp_slide_step(sim, none) == DP_OK);
    CHECK(sim->slides == 2 && look(0, 0).slope == before.slope && look(600, 0).wide == 6);
    limb->active = true, limb->lifts = false;
    limb->patch = dp_cells(605, 0, 10, 10);  // 2 cells beside the other
    CHECK(dp_slide_step(sim, some[0]) == DP_OK);
    CHECK(sim->slides == 2 && look(0, 0).wide == 8 && look(600, 0).wide == 6);
    limb->lifts = true;  // it holds nothing any more
    CHECK(dp_slide_step(sim, some[1]) == DP_OK);
    CHECK(look(600, 0).wide == 8 && sim->slides == 2);
    limb->lifts = false;
    CHECK(dp_slide_step(sim, -1) == DP_OK && sim->slides == 0);
    for (long at = 0; at <= 600; at += 600) {
        CHECK(look(at, 0).slope <= at_rest(&soil));
        CHECK_CLOSE(look(at, 0).volume, 36 * 0.1 * CELL * CELL, 1e-5);
    }
    stand_drop(&stand);
}

// a state keeps the prints that slide; one that holds none where it tells of one is damaged, and changes nothing
TEST(prints_that_slide_are_kept_with_the_state)
{
    const DpSoil soil = flowing(1.0);
    for (int damaged = 0; damaged < 2; ++damaged) {
        DpStateWriter writer = {0};
        begin(&soil, 1);
        CHECK(dp_make_room(&stand.sim->slide, 1, sizeof *stand.sim->slide));
        stand.sim->slide[0] = damaged ? dp_cells(5, 5, 0, 3) : dp_cells(-3, -4, 6, 7);
        stand.sim->slides = 1;
        CHECK(dp_sim_save_state(stand.sim, &writer) == DP_OK);
        stand_drop(&stand);
        begin(&soil, 1);
        CHECK(dp_sim_load_state(stand.sim, writer.bytes, writer.size) ==
              (damaged ? DP_BAD_FILE : DP_OK));
        CHECK(stand.sim->slides == !damaged);
        if (!damaged)
            CHECK(stand.sim->slide[0].i0 == -3 && stand.sim->slide[0].j1 == 3 &&
                  stand.sim->slide[0].i1 == 3 && stand.sim->slide[0].j0 == -4);
        dp_write_drop(&writer);
        stand_drop(&stand);
    }
}

int main(void)
{
    RUN(a_soil_that_takes_time_goes_a_cell_in_its_share_of_it);
    RUN(what_a_sole_held_slides_until_it_rests);
    RUN(walls_that_fall_are_counted);
    RUN(slow_soil_slides_on);
    RUN(a_print_is_left_where_its_limb_stands_elsewhere);
    RUN(a_stance_beside_a_sliding_print_keeps_it);
    RUN(prints_that_were_left_slide_by_themselves);
    RUN(prints_that_slide_are_kept_with_the_state);
    return check_done();
}
