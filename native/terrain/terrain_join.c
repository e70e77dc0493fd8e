// Tiles of several states in one terrain, as of ground that was pressed in parts.
#include <string.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

void dp_terrain_list(const DpTerrain* terrain, int32_t* tile)
{
    for (size_t t = 0; t < terrain->tiles; ++t) {
        tile[2 * t] = (int32_t)terrain->sorted[t]->tx;
        tile[2 * t + 1] = (int32_t)terrain->sorted[t]->ty;
    }
}

// Which of the state's tiles are asked for; false where one is not there, or is in the terrain, or they do not rise.
static bool choose(const DpTerrain* terrain, const DpTerrain* from, const int32_t* tile,
                   size_t count, size_t* chosen)
{
    size_t at = 0;
    for (size_t k = 0; k < count; ++k) {
        const long tx = tile[2 * k], ty = tile[2 * k + 1];
        while (at < from->tiles && (from->sorted[at]->tx != tx || from->sorted[at]->ty != ty)) ++at;
        if (at == from->tiles || dp_tile_find(terrain, tx, ty)) return false;
        chosen[k] = at++;
    }
    return true;
}

DpStatus dp_terrain_join(DpTerrain* terrain, DpTerrainState* state, const int32_t* tile,
                         size_t count)
{
    if (!terrain || !state || (count > 0 && !tile) || terrain->cover) return DP_BAD_ARGUMENT;
    DpTerrain* from = &state->ground;
    size_t*    chosen = dp_alloc(count + 1, sizeof *chosen);
    Tile**     fresh = dp_alloc(count + 1, sizeof *fresh);
    DpStatus   status = chosen && fresh ? DP_OK : DP_NO_MEMORY;
    if (status == DP_OK && !choose(terrain, from, tile, count, chosen)) status = DP_BAD_ARGUMENT;
    for (size_t k = 0; status == DP_OK && k < count; ++k) fresh[k] = from->sorted[chosen[k]];
    if (status == DP_OK && !dp_tile_adopt(terrain, fresh, count, false)) status = DP_NO_MEMORY;
    for (size_t k = 0; status == DP_OK && k < count; ++k) {
        if (state->kept[chosen[k]]) dp_tile_mark(terrain, fresh[k]);
        from->sorted[chosen[k]] = NULL;  // it is the terrain's now
    }
    dp_free(chosen), dp_free(fresh);
    if (status == DP_OK) dp_terrain_state_destroy(state);
    return status;
}
