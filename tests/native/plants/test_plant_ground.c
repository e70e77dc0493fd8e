// The ground under plants: grids first, then functions; ceilings; nothing falls through a rim.
#include "plants/lawn.h"
#include "plants/plant_inside.h"

#define CELL 0.01

// a wall of 3 cm along y from x = 0.03 on, steep over one cell
static double wall(const void* context, double x, double y)
{
    int* asked = (int*)(size_t)context;
    (void)y;
    if (asked) ++*asked;
    return x < 0.03 ? 0.0 : x < 0.04 ? 3.0 * (x - 0.03) : 0.03;
}

TEST(limp_stems_lie_still_over_a_rim)
{
    const DpPlantKind   kind = dp_plant_kind_default();
    const DpPlantShape  shape = dp_plant_shape(&kind);
    const DpPlantGround ground = {.cell = CELL, .at = wall};
    DpPlants*           plants = lawn(&kind, 1, 1, 0.1, 3);
    double*             strength = dp_alloc((size_t)shape.bends, sizeof(double));
    float*              at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    float*              push = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    DpPlantsReport      told = {0};
    for (int p = 0; p < shape.particles; ++p)
        push[3 * p] =
            p % shape.rows > 1 ? 0.8f : 0.0f;  // broken at its foot, falls towards the wall
    CHECK(dp_plants_write(plants, 0, 0, NULL, push, strength) == DP_OK);
    double lowest = 1.0;
    for (int k = 0; k < 240; ++k) {
        CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
        dp_plants_read(plants, 0, 0, at, NULL, NULL);
        for (int p = 0; p < shape.particles; ++p)
            if (p % shape.rows > 0)
                lowest = fmin(lowest, (double)at[3 * p + 2] - wall(NULL, (double)at[3 * p], 0.0));
    }
    double over = 0.0;  // some of it lies on the wall
    for (int p = 0; p < shape.particles; ++p)
        over = fmax(over, at[3 * p] > 0.045f ? (double)at[3 * p + 2] : 0.0);
    printf("  lowest %.3f mm over the ground, %.1f mm on the wall\n", 1e3 * lowest, 1e3 * over);
    CHECK(lowest > -1e-5);
    CHECK(over >= 0.03 - 1e-6);
    CHECK(told.awake == 0);  // it came to rest
    dp_free(strength), dp_free(at), dp_free(push);
    dp_plants_destroy(plants);
}

TEST(stems_stand_upright_on_both_sides_of_an_edge)
{
    float               height[41 * 41];  // a print's edge: 2 cm down within one cell
    const DpPlantGround ground = {
        .nx = 41, .ny = 41, .row = 41, .cell = CELL, .x0 = -0.205, .y0 = -0.2, .height = height};
    for (int k = 0; k < 41 * 41; ++k) height[k] = k % 41 > 20 ? -0.02f : 0.0f;
    for (int form = 0; form < 2; ++form) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.form = form;
        const DpPlantShape shape = dp_plant_shape(&kind);
        DpPlants*          plants = lawn(&kind, 1, 1, 0.1, 3);
        float*             push = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
        double*            strength = dp_alloc((size_t)shape.bends, sizeof(double));
        DpPlantsReport     told;
        for (int p = 0; p < shape.particles; ++p) push[3 * p] = p % shape.rows > 1 ? 0.01f : 0.0f;
        CHECK(dp_plants_write(plants, 0, 0, NULL, push, NULL) == DP_OK);
        for (int k = 0; k < 600; ++k)
            CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
        const Strain s = strain_of(plants, &kind, 1);
        CHECK(dp_plants_read(plants, 0, 0, NULL, NULL, strength) == DP_OK);
        double weakest = 1.0;
        for (int b = 0; b < shape.bends; ++b) weakest = fmin(weakest, strength[b]);
        printf("  %.2f mm off upright after ten seconds, reserves %.3f\n", 1e3 * s.away, weakest);
        CHECK(s.lowest < -0.019);  // some stand on either side
        CHECK(s.away < 0.002);
        CHECK_NEAR(weakest, kind.strength, 1e-6);
        dp_free(push), dp_free(strength);
        dp_plants_destroy(plants);
    }
}

TEST(what_stands_over_all_ground_asks_for_none)
{
    const DpPlantKind   kind = dp_plant_kind_default();
    int                 asked = 0;
    const DpPlantGround ground = {.cell = CELL, .at = wall, .context = &asked};
    DpPlants*           plants = lawn(&kind, 2, 2, 0.5, 3);
    float               push[84] = {0};
    DpPlantsReport      told;
    for (int p = 0; p < 28; ++p) push[3 * p] = p % 7 > 1 ? 0.05f : 0.0f;
    for (int k = 0; k < 4; ++k) dp_plants_write(plants, 0, k, NULL, push, NULL);
    CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
    asked = 0;
    for (int k = 0; k < 5; ++k)
        CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
    // rows 2 upward stand 2 to 10 cm high; those under the wall's 3 cm may ask
    printf("  asked %d times for %d particles and steps\n", asked, 5 * told.awake * 28);
    CHECK(told.awake == 4 && asked < 5 * 4 * 28 / 3);
    dp_plants_destroy(plants);
}

TEST(of_two_grids_the_first_counts_and_functions_come_last)
{
    const DpPlantKind   kind = dp_plant_kind_default();
    float               low[40 * 40], high[10 * 10], at[84];
    const DpPlantGround elsewhere = {.cell = CELL, .at = wall};
    const DpPlantGround wide = {.nx = 40,
                                .ny = 40,
                                .row = 40,
                                .cell = CELL,
                                .x0 = -0.2,
                                .y0 = -0.2,
                                .height = low,
                                .next = &elsewhere};
    const DpPlantGround small = {.nx = 10,
                                 .ny = 10,
                                 .row = 10,
                                 .cell = CELL,
                                 .x0 = -0.05,
                                 .y0 = -0.05,
                                 .height = high,
                                 .next = &wide};
    DpPlants*           plants = lawn(&kind, 2, 1, 1.0, 3);
    for (int k = 0; k < 1600; ++k) low[k] = -0.5f;
    for (int k = 0; k < 100; ++k) high[k] = 0.25f;
    CHECK(dp_plants_follow(plants, &small) == DP_OK);
    dp_plants_read(plants, 0, 0, at, NULL, NULL);
    CHECK_NEAR(at[3 + 2], 0.25, 1e-6);
    dp_plants_read(plants, 0, 1, at, NULL, NULL);
    CHECK_NEAR(at[3 + 2], 0.0, 1e-6);  // no grid tells of it: as it stood
    CHECK(dp_plants_follow(plants, &wide) == DP_OK);
    dp_plants_read(plants, 0, 0, at, NULL, NULL);
    CHECK_NEAR(at[3 + 2], -0.5, 1e-6);
    dp_plants_destroy(plants);
}

TEST(off_the_ground_plants_stand_on_their_own_plane)
{
    const float         height[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    const DpPlantGround ground = {.nx = 2, .ny = 2, .row = 2, .cell = 1.0, .height = height};
    PlantBlock          block = {.count = 1};
    block.root[0][0] = 5.0f, block.root[1][0] = 6.0f, block.root[2][0] = 2.0f;
    block.slope[0][0] = 0.5f, block.slope[1][0] = -0.25f;
    CHECK_NEAR(dp_plant_floor_at(&block, &ground, 0, 0.5, 0.5), 1.0, 1e-12);
    CHECK_NEAR(dp_plant_floor_at(&block, &ground, 0, 7.0, 7.0), 2.0 + 0.5 * 2 - 0.25, 1e-12);
    CHECK_NEAR(dp_plant_floor_at(&block, NULL, 0, 5.0, 6.0), 2.0, 1e-12);
}

// wherever the highest cell within reach is, and however many lie beside it
TEST(ceilings_see_every_cell_around)
{
    static float        height[41 * 41];
    const DpPlantKind   kind = dp_plant_kind_default();
    const DpPlantGround ground = {
        .nx = 41, .ny = 41, .row = 41, .cell = CELL, .x0 = -0.2, .y0 = -0.2, .height = height};
    DpPlants*    plants = lawn(&kind, 1, 1, 0.1, 3);
    PlantStand*  stand = &plants->stand[0];
    const double span = (double)(stand->extent + kind.radius);
    CHECK(span > 0.08 && span < 0.18);
    int within = 0;
    for (int k = 0; k < 41 * 41; ++k) {
        const double x = -0.2 + CELL * (k % 41), y = -0.2 + CELL * (k / 41);
        height[k] = 1.0f;
        CHECK(dp_plant_ground_lane(stand, &stand->block[0], &ground, 0));
        height[k] = 0.0f;
        const float ceiling = stand->block[0].ceiling[0];
        const bool  sees = fabs(x) <= span && fabs(y) <= span;
        within += sees;
        if (sees) CHECK(ceiling == 1.0f);
        if (fabs(x) > span + CELL || fabs(y) > span + CELL) CHECK(ceiling == 0.0f);
    }
    CHECK(within > 200);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(limp_stems_lie_still_over_a_rim);
    RUN(stems_stand_upright_on_both_sides_of_an_edge);
    RUN(what_stands_over_all_ground_asks_for_none);
    RUN(of_two_grids_the_first_counts_and_functions_come_last);
    RUN(off_the_ground_plants_stand_on_their_own_plane);
    RUN(ceilings_see_every_cell_around);
    return check_done();
}
