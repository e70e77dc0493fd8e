// Where grass keeps its cells: tiles in order, each with what grows on it.
#include "grass/grass_inside.h"
#include "plants/lawn.h"

#define CELL 0.01

TEST(tiles_stay_in_order_and_are_found)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 2, 2, 0.1, 1);
    DpGrass*          grass;
    unsigned          chance = 3;
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    for (int k = 0; k < 60; ++k) {
        const long tx = (long)(9 * check_random(&chance)) - 4;
        const long ty = (long)(9 * check_random(&chance)) - 4;
        GrassTile* tile = dp_grass_touch(grass, tx, ty);
        CHECK(tile && tile->tx == tx && tile->ty == ty && dp_grass_touch(grass, tx, ty) == tile);
        CHECK(dp_grass_find(grass, tx, ty) == tile);
    }
    for (int t = 1; t < grass->tiles; ++t) {
        const GrassTile *a = grass->tile[t - 1], *b = grass->tile[t];
        CHECK(a->ty < b->ty || (a->ty == b->ty && a->tx < b->tx));
    }
    CHECK(grass->tiles > 30 && !dp_grass_find(grass, 5, 0) && !dp_grass_find(grass, 0, -5));
    const int tiles = grass->tiles;
    for (long left = 0; left < 2; ++left) {
        dp_alloc_fail_after(left);
        if (!dp_grass_touch(grass, 100, 100)) CHECK(grass->tiles == tiles);
        dp_alloc_fail_after(-1);
    }
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

// one plant 0.1 m high at the corner of four tiles: its stems grow as far as its roots hold the soil
TEST(stems_are_those_of_the_plants_around)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.root_radius = 0.2f;
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 1);
    DpGrass*  grass;
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    for (long k = 0; k < 4; ++k) {
        const long       tx = k % 2 - 1, ty = k / 2 - 1;
        const GrassTile* tile = dp_grass_touch(grass, tx, ty);
        double           area = 0.0;
        for (int p = 0; p < CELLS; ++p) {
            const double x = ((double)(tx * DP_TILE + p % DP_TILE) + 0.5) * CELL;
            const double y = ((double)(ty * DP_TILE + p / DP_TILE) + 0.5) * CELL;
            const bool   grows = sqrt(x * x + y * y) < 0.2;
            CHECK_NEAR(tile->height[p], grows ? 0.1 : 0.0, 1e-6);
            CHECK((tile->rate[p] > 0.0f) == grows && tile->stays[p] == 0.0f);
            area += grows ? CELL * CELL : 0.0;
        }
        CHECK_NEAR(area, 0.25 * DP_PI * 0.04, 1e-3);
        CHECK(tile->healing > 0.0f && dp_cells_empty(tile->moves));
    }
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

TEST(what_may_move_is_remembered)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 1, 1, 1.0, 1);
    DpGrass*          grass;
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    GrassTile* tile = dp_grass_touch(grass, 0, 0);
    dp_grass_may_move(tile, 7, 60), dp_grass_may_move(tile, 3, 61);
    CHECK(tile->moves.i0 == 3 && tile->moves.i1 == 8);
    CHECK(tile->moves.j0 == 60 && tile->moves.j1 == 62);
    CHECK(memcmp(&tile->moves, &tile->brisk, sizeof tile->moves) == 0);
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(tiles_stay_in_order_and_are_found);
    RUN(stems_are_those_of_the_plants_around);
    RUN(what_may_move_is_remembered);
    return check_done();
}
