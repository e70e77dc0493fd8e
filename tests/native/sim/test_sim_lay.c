// tests of sim_lay.c: soil that finds no place waits, and is counted once it lies
#include "stand.h"

static float   base[40 * 40], rest[40 * 40], kept[3][40 * 40], modulus[40 * 40];
static uint8_t kind[40 * 40];

// level ground of n x n cells around a sole of 4 x 4 that covers cells 0 .. 3; without a border where n is 4
static DpSoilPatch patch_of(int n, const DpSoil* soil)
{
    for (int k = 0; k < n * n; ++k) {
        base[k] = 0.0f, rest[k] = 0.6f, modulus[k] = 1e6f;
        for (int g = 0; g < 3; ++g) kept[g][k] = 0.0f;
    }
    return (DpSoilPatch){.nx = n,
                         .ny = n,
                         .row = n,
                         .cell = CELL,
                         .base_height = base,
                         .compression = kept[0],
                         .heap = kept[1],
                         .pressure_time = kept[2],
                         .modulus = modulus,
                         .rest_slope = rest,
                         .kind = kind,
                         .soils = soil,
                         .soil_count = 1};
}

static void stand_there(WorkerScratch* scratch, const DpSoilPatch* patch)
{
    CHECK(dp_limb_fit(scratch, patch) == DP_OK);
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const bool under = i < 4 && j < 4;
            scratch->imprint.ring[j * patch->row + i] = under ? 0 : DP_RING_FAR;
            scratch->imprint.cover[j * patch->row + i] = under ? 1.0f : 0.0f;
        }
    scratch->imprint.i0 = scratch->imprint.j0 = 0, scratch->imprint.i1 = scratch->imprint.j1 = 4;
}

TEST(what_finds_no_place_waits)
{
    static Stand      s;
    const DpSoil      soil = dp_soil_default();
    const DpFootForce foot = {{0.0, 0.0, -500.0}, {0.015, 0.015, 0.0}, {0.0, 0.0, 1.0}};
    stand_make(&s, 1);
    stand_load(&s, &soil, dp_sim_options_default());
    WorkerScratch* scratch = &s.sim->scratch[0];
    Limb*          limb = &s.sim->limb[0];
    DpSoilPatch    patch = patch_of(4, &soil);
    for (int step = 1; step <= 2; ++step) {
        stand_there(scratch, &patch);
        CHECK(dp_limb_lay(s.sim, limb, &patch, scratch, &foot, 1e-5, 350.0,
                          dp_vec3(0.0, 0.0, 0.0)) == DP_OK);
        CHECK_NEAR(limb->unlaid, step * 1e-5, 1e-18);
        CHECK_NEAR(limb->laid, 0.0, 0.0);
    }
    patch = patch_of(40, &soil);
    stand_there(scratch, &patch);
    CHECK(dp_limb_lay(s.sim, limb, &patch, scratch, &foot, 3e-5, 350.0, dp_vec3(0.0, 0.0, 0.0)) ==
          DP_OK);
    CHECK_NEAR(limb->unlaid, 0.0, 0.0);
    CHECK_CLOSE(limb->laid, 5e-5, 1e-9);
    double lies = 0.0;
    for (int k = 0; k < 40 * 40; ++k) lies += (double)kept[1][k] * CELL * CELL;
    CHECK_CLOSE(lies, 5e-5, 1e-6);
    CHECK(dp_limb_lay(s.sim, limb, &patch, scratch, &foot, 0.0, 350.0, dp_vec3(0.0, 0.0, 0.0)) ==
          DP_OK);
    CHECK_CLOSE(limb->laid, 5e-5, 1e-9);
    stand_drop(&s);
}

// a patch that is acquired with no sole on it has room, and no cell of it is touched
TEST(no_sole_stands_on_a_lease)
{
    static Stand s;
    const DpSoil soil = dp_soil_default();
    stand_make(&s, 1);
    stand_load(&s, &soil, dp_sim_options_default());
    WorkerScratch* scratch = &s.sim->scratch[0];
    for (int k = 1; k <= 2; ++k) {  // a larger one after it
        const int    nx = 30 * k, ny = 40 * k;
        DpSoilPatch* patch = NULL;
        CHECK(dp_limb_lease(s.sim, scratch, dp_cells(-10, -20, nx, ny), &patch) == DP_OK);
        CHECK(patch->nx == nx && patch->ny == ny);
        CHECK(scratch->imprint.bottom && scratch->imprint.cover && scratch->met);
        for (int c = 0; c < patch->row * ny && scratch->imprint.ring; ++c) {
            CHECK(scratch->imprint.ring[c] == DP_RING_FAR);
            scratch->imprint.ring[c] = 0;
            scratch->imprint.bottom[c] = scratch->imprint.cover[c] = scratch->met[c] = 1.0f;
        }
    }
    stand_drop(&s);
}

int main(void)
{
    RUN(what_finds_no_place_waits);
    RUN(no_sole_stands_on_a_lease);
    return check_done();
}
