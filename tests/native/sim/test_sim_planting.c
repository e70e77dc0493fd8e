// tests of sim_planting.c: plants come onto the ground, are looked at, and rest. TRAIL 4.1
#include "planted.h"
#include "sim/sim_inside.h"

#define HIGH 2000.25
#define SLOPE 0.5

// ground that rises along x from HIGH on, 4 m wide; two plants a metre apart, on it
static World planted_slope(const DpPlantKind* kind, const float* xy, int count)
{
    const float    height[4] = {(float)HIGH, (float)(HIGH + 4.0 * SLOPE), (float)HIGH,
                                (float)(HIGH + 4.0 * SLOPE)};
    const DpSoil   soil = dp_soil_default();
    const DpGround slope = {
        .kind = DP_GROUND_HEIGHTS, .nx = 2, .ny = 2, .spacing = 4.0, .heights = height};
    const DpTerrainOptions options = {{0.02, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    const DpSimOptions     choice = dp_sim_options_default();
    World                  world = {.plants = dp_plants_create(1)};
    CHECK(dp_terrain_create(&world.terrain, &options, &slope) == DP_OK);
    CHECK(dp_sim_create(&world.sim, world.terrain, &choice) == DP_OK);
    CHECK(dp_sim_plant(world.sim, world.plants) == DP_OK);
    CHECK(dp_sim_grow(world.sim, kind, xy, count, &world.stand, &world.grown) == DP_OK);
    return world;
}

static const DpPlantKind* kind_of(float width)
{
    static DpPlantKind kind;
    kind = dp_plant_kind_default();
    kind.width = width;
    return &kind;
}

// Every stem stands on the slope, at an edge of the ground, too; heights are those of the world, and what is shown is
// what stands until somebody lays it.
TEST(stems_stand_on_the_ground_of_the_world)
{
    const float        xy[] = {1.0f, 2.0f, 0.001f, 2.0f, 3.999f, 3.999f};
    const DpPlantKind* kind = kind_of(0.05f);
    World              world = planted_slope(kind, xy, 3);
    const DpPlantShape shape = dp_plant_shape(kind);
    float              at[3 * 64], shown[3 * 64];
    CHECK(world.grown == 3 && world.stand == 0 && shape.particles <= 64);
    for (int k = 0; k < 3; ++k) {
        CHECK(dp_sim_stands(world.sim, 0, k, at) == DP_OK);
        for (int stem = 0; stem < shape.stems; ++stem) {
            const float* foot = at + 3 * (stem * shape.rows + 1);
            CHECK_NEAR(foot[2], HIGH + SLOPE * (double)foot[0], 1e-3);
            CHECK_NEAR(foot[3 * (shape.rows - 2) + 2] - foot[2], (double)kind->height, 1e-3);
        }
        for (int laid = 0; laid < 2; ++laid) {
            CHECK(dp_sim_shown(world.sim, 0, k, shown) == DP_OK);
            for (int n = 0; n < 3 * shape.particles; ++n) CHECK_NEAR(shown[n], at[n], 1e-3);
            CHECK(dp_sim_lay(world.sim) == DP_OK);
        }
    }
    CHECK(dp_sim_stands(world.sim, 0, 3, at) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_shown(world.sim, 1, 0, shown) == DP_BAD_ARGUMENT);
    world_drop(&world);
}

// ground that was asked for before tells of what grew since, as far as roots reach: E = E_g + E_v, TRAIL (9)
TEST(what_grows_later_covers_ground_that_is_there)
{
    const float        first[] = {3.5f, 3.5f}, later[] = {1.0f, 2.0f};
    const DpPlantKind* kind = kind_of(0.05f);
    World              world = planted_slope(kind, first, 1);
    const double       radius = (double)kind->root_radius;
    float              cover[60], modulus[60];
    CHECK(dp_terrain_touch(world.terrain, dp_cells(0, 0, 200, 200)) == DP_OK);
    CHECK(dp_sim_grow(world.sim, kind, later, 1, &world.stand, &world.grown) == DP_OK);
    CHECK(world.stand == 1 && world.grown == 1);
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_PLANT_STRENGTH, 20, 99, 60, 1, cover) == DP_OK);
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_MODULUS, 20, 99, 60, 1, modulus) == DP_OK);
    const double bare = (double)dp_soil_default().young_modulus;
    const double k_ref = (double)kind->full_density * DP_PI * radius * radius / 3.0;
    for (int i = 0; i < 60; ++i) {
        const double x = 0.02 * (20 + i + 0.5) - 1.0, y = 0.02 * 99.5 - 2.0;
        const double want = fmin(fmax(1.0 - hypot(x, y) / radius, 0.0) / k_ref, 1.0);
        CHECK_NEAR(cover[i], want, 1e-5);
        CHECK_NEAR(modulus[i], bare + (double)kind->modulus * want, 200.0);
    }
    world_drop(&world);
}

TEST(what_cannot_be_planted_is_refused)
{
    const float        xy[] = {1.0f, 2.0f}, far[] = {1.0f, 2.0f, 2e7f, 0.0f}, none[] = {9.0f, 9.0f};
    const DpPlantKind* kind = kind_of(0.05f);
    World              world = planted_slope(kind, xy, 1);
    DpPlantKind        bad = *kind;
    int                stand, grown;
    bad.sway = NAN;
    CHECK(dp_sim_plant(world.sim, world.plants) == DP_BAD_ARGUMENT);  // they are there already
    CHECK(dp_sim_grow(world.sim, &bad, xy, 1, &stand, &grown) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_grow(world.sim, kind, far, 2, &stand, &grown) == DP_BAD_ARGUMENT);
    CHECK(stand == -1 && grown == 0);
    CHECK(dp_sim_grow(world.sim, kind, none, 1, &stand, &grown) == DP_OK);
    CHECK(stand == -1 && grown == 0);
    CHECK(dp_sim_pass_time(world.sim, -1.0) == DP_BAD_ARGUMENT);
    world_drop(&world);

    float bare[3];
    CHECK(world_make(&world, NULL, 0.0, 0.0, 1.0, 0.5, 0.02, 1) == DP_OK);
    CHECK(dp_sim_pass_time(world.sim, 1.0) == DP_OK);  // nothing grows: nothing to do
    CHECK(dp_sim_lay(world.sim) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_stands(world.sim, 0, 0, bare) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_shown(world.sim, 0, 0, bare) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_grass(world.sim) == NULL);
    world_drop(&world);
}

// Grass that was walked over is shown lying, though its stems may stand again; without anybody to lay it, it is not.
TEST(what_was_trodden_is_shown_lying)
{
    DpPlantKind kind = dp_plant_kind_default();
    Stride      s = stride_make(1, 3, 80.0, STRIDE_RATE);
    World       world;
    float       at[3 * 64], shown[3 * 64];
    kind.degrade_rate = 0.2f;
    CHECK(world_make(&world, &kind, -0.1, -0.2, 0.8, 0.05, 0.02, 2) == DP_OK);
    CHECK(dp_sim_lay(world.sim) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    const DpPlantShape shape = dp_plant_shape(&kind);
    int                lying = 0, untouched = 0;
    for (int k = 0; k < world.grown; ++k) {
        CHECK(dp_sim_shown(world.sim, 0, k, shown) == DP_OK);
        CHECK(dp_sim_stands(world.sim, 0, k, at) == DP_OK);
        const double root[2] = {(double)at[0], (double)at[1]};
        float        crushed = 0.0f;
        dp_grass_read(dp_sim_grass(world.sim), (long)floor(root[0] / 0.02),
                      (long)floor(root[1] / 0.02), 1, 1, NULL, NULL, &crushed);
        float top = 0.0f;
        for (int p = 0; p < shape.particles; ++p) top = fmaxf(top, shown[3 * p + 2]);
        lying += crushed > 0.4f && (double)top < 0.8 * (double)kind.height;
        untouched += crushed == 0.0f && (double)top > 0.95 * (double)kind.height;
    }
    CHECK(lying > 5 && untouched > 5);
    world_drop(&world);
    stride_drop(&s);
}

// ground that is smaller than a plant is level as far as that can tell
TEST(on_a_speck_of_ground_stems_stand_level)
{
    const float        height[4] = {1.0f, 1.01f, 1.0f, 1.01f}, xy[2] = {0.01f, 0.01f};
    const DpPlantKind* kind = kind_of(0.05f);
    const DpSoil       soil = dp_soil_default();
    const DpGround     speck = {
            .kind = DP_GROUND_HEIGHTS, .nx = 2, .ny = 2, .spacing = 0.02, .heights = height};
    const DpTerrainOptions options = {{0.005, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    const DpSimOptions     choice = dp_sim_options_default();
    const DpPlantShape     shape = dp_plant_shape(kind);
    World                  world = {.plants = dp_plants_create(1)};
    float                  at[3 * 64];
    CHECK(dp_terrain_create(&world.terrain, &options, &speck) == DP_OK);
    CHECK(dp_sim_create(&world.sim, world.terrain, &choice) == DP_OK);
    CHECK(dp_sim_plant(world.sim, world.plants) == DP_OK);
    CHECK(dp_sim_grow(world.sim, kind, xy, 1, &world.stand, &world.grown) == DP_OK);
    CHECK(world.grown == 1 && dp_sim_stands(world.sim, 0, 0, at) == DP_OK);
    for (int stem = 0; stem < shape.stems; ++stem)
        CHECK_NEAR(at[3 * (stem * shape.rows + 1) + 2], 1.005, 1e-5);
    world_drop(&world);
}

// plants that stand before they come to a ground are as large as those that grow on it
TEST(plants_may_stand_before_they_have_a_ground)
{
    const DpPlantKind*     kind = kind_of(0.05f);
    const float            root[3] = {0.5f, 0.5f, 0.0f};
    const DpSimOptions     choice = dp_sim_options_default();
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    const DpSoil           soil = dp_soil_default();
    World                  world = {.plants = dp_plants_create(1)};
    const DpTerrainOptions options = {{0.02, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    CHECK(dp_plants_add(world.plants, kind, root, NULL, 1, &world.stand) == DP_OK);
    CHECK(dp_terrain_create(&world.terrain, &options, &flat) == DP_OK);
    CHECK(dp_sim_create(&world.sim, world.terrain, &choice) == DP_OK);
    CHECK(dp_stage_margin(world.sim) <= 0.0);
    CHECK(dp_sim_plant(world.sim, world.plants) == DP_OK);
    CHECK(world.sim->stage.extent >= (double)kind->height);
    CHECK_NEAR(dp_stage_margin(world.sim),
               fmin(dp_plants_extent(world.plants) + (double)kind->root_radius, 0.5), 1e-9);
    DpPlantKind tall = *kind;
    tall.height = 0.8f, tall.spacing = 0.1f;
    CHECK(dp_plants_add(world.plants, &tall, root, NULL, 1, &world.stand) == DP_OK);
    CHECK(dp_sim_grow(world.sim, kind, root, 1, &world.stand, &world.grown) == DP_OK);
    CHECK(world.sim->stage.extent >= 0.8);
    CHECK_NEAR(dp_stage_margin(world.sim), 0.5, 0.0);  // and no farther beside a sole
    world_drop(&world);
}

TEST(roots_need_ground)
{
    const DpPlantKind kind = dp_plant_kind_default();
    const float       xy[6] = {0.5f, 0.5f, -3.0f, 0.5f, 1.5f, 0.5f};
    const float       height[4] = {0.0f, 1.0f, 0.0f, 1.0f};  // rises along x
    const DpSoil      soil = dp_soil_default();
    const DpGround    slope = {
           .kind = DP_GROUND_HEIGHTS, .nx = 2, .ny = 2, .spacing = 2.0, .heights = height};
    const DpTerrainOptions options = {{0.01, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    const DpSimOptions     choice = dp_sim_options_default();
    World                  world = {.plants = dp_plants_create(1)};
    CHECK(dp_terrain_create(&world.terrain, &options, &slope) == DP_OK);
    CHECK(dp_sim_create(&world.sim, world.terrain, &choice) == DP_OK);
    CHECK(dp_sim_grow(world.sim, &kind, xy, 3, &world.stand, &world.grown) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_plant(world.sim, world.plants) == DP_OK);
    CHECK(dp_sim_plant(world.sim, world.plants) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_grow(world.sim, &kind, xy, 3, &world.stand, &world.grown) == DP_OK);
    CHECK(world.stand == 0 && world.grown == 2);
    float at[3 * 64], foot[3] = {0};
    CHECK(dp_plants_read(world.plants, 0, 1, at, NULL, NULL) == DP_OK);
    const DpPlantShape shape = dp_plant_shape(&kind);
    for (int stem = 0; stem < shape.stems; ++stem)
        for (int d = 0; d < 3; ++d)
            foot[d] += at[3 * (stem * shape.rows + 1) + d] / (float)shape.stems;
    CHECK_NEAR(foot[0], 1.5, 1e-4);
    CHECK_NEAR(foot[2], 0.75, 1e-4);
    const float dx = at[3 * (3 * shape.rows + 1)] - at[3],
                dz = at[3 * (3 * shape.rows + 1) + 2] - at[5];
    CHECK_NEAR(dz, 0.5 * (double)dx, 1e-4);  // stems stand along the slope
    CHECK(dp_sim_grow(world.sim, &kind, xy + 2, 1, &world.stand, &world.grown) == DP_OK);
    CHECK(world.stand == -1 && world.grown == 0);
    world_drop(&world);
}

int main(void)
{
    RUN(stems_stand_on_the_ground_of_the_world);
    RUN(what_grows_later_covers_ground_that_is_there);
    RUN(what_cannot_be_planted_is_refused);
    RUN(what_was_trodden_is_shown_lying);
    RUN(on_a_speck_of_ground_stems_stand_level);
    RUN(roots_need_ground);
    RUN(plants_may_stand_before_they_have_a_ground);
    return check_done();
}
