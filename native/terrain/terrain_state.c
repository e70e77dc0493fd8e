// What walkers and wear have made of the ground, kept and taken back.
//
// Kept is which tiles there are, and of those that differ from bare ground their fields; base heights and
// kinds come from the ground again, cover from what grows, unless a tile's is another.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "base/parallel.h"
#include "terrain/terrain_inside.h"

#define NAME "grnd"
#define VERSION 1
#define MIN_TILE 17  // bytes of a tile are no fewer

// ---- which ground this is ------------------------------------------------------------------------

static uint64_t fold(uint64_t sum, const void* bytes, size_t count)
{
    uint64_t words[DP_DIGEST_WORDS];
    if (count == 0) return sum;
    dp_digest(bytes, count, words);
    for (int k = 0; k < DP_DIGEST_WORDS; ++k) sum = (sum ^ words[k]) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 32;
}

#define NORMAL(name, unit, lowest, highest, normal, meaning) .name = (float)(normal),
#define FIRST_NUMBERS 7  // of a soil; those after them count where they are not as usual

static uint64_t fold_soils(uint64_t sum, const DpTerrain* terrain, const DpSoil* soil)
{
    const DpSoil normal = {DP_SOIL_NUMBERS(NORMAL)};
    const size_t first = FIRST_NUMBERS * sizeof(float), soils = (size_t)terrain->soil_count;
    char         row[255 * FIRST_NUMBERS * sizeof(float)];
    for (size_t s = 0; s < soils; ++s) memcpy(row + s * first, &soil[s], first);
    sum = fold(sum, row, soils * first);
    for (size_t s = 0; s < soils; ++s)
        for (size_t k = FIRST_NUMBERS; k < sizeof normal / sizeof(float); ++k) {
            float value, usual;
            memcpy(&value, (const char*)&soil[s] + k * sizeof value, sizeof value);
            memcpy(&usual, (const char*)&normal + k * sizeof usual, sizeof usual);
            const double chosen[3] = {(double)s, (double)k, (double)value};
            if (value < usual || value > usual) sum = fold(sum, chosen, sizeof chosen);
        }
    return sum;
}

// a number that other ground does not have
static uint64_t name_of(const DpTerrain* terrain)
{
    const Source*     source = &terrain->source;
    const MeshGround* mesh = &source->mesh;
    const double      number[] = {terrain->grid.cell,
                                  terrain->grid.x0,
                                  terrain->grid.y0,
                                  terrain->datum,
                                  source->height,
                                  source->x0,
                                  source->y0,
                                  source->spacing,
                                  (double)source->kind,
                                  (double)source->nx,
                                  (double)source->ny,
                                  (double)source->kind_count,
                                  (double)mesh->vertex_count,
                                  (double)mesh->triangle_count,
                             terrain->cover ? 1.0 : 0.0};
    const size_t      heights = (size_t)source->nx * (size_t)source->ny;
    const size_t      vertices = 3 * (size_t)mesh->vertex_count;
    uint64_t          sum = fold(1, number, sizeof number);
    sum = fold_soils(sum, terrain, terrain->row ? terrain->row : terrain->soils);
    for (int t = 1; t < terrain->times; ++t)
        sum = fold_soils(sum, terrain, terrain->row + t * terrain->soil_count);
    for (int k = 0; terrain->layers && k < terrain->layer_start[terrain->soil_count]; ++k) {
        const DpLayer* layer = &terrain->layers[k];
        sum = fold(sum, &layer->soil, sizeof layer->soil);
        sum = fold(sum, &layer->thickness, sizeof layer->thickness);
        sum = fold(sum, &layer->name, sizeof layer->name);
    }
    sum = fold(sum, terrain->time, (size_t)terrain->times * sizeof *terrain->time);
    sum = fold(sum, source->heights, heights * sizeof *source->heights);
    sum = fold(sum, source->kind_weight,
               (size_t)source->kind_count * source->weights * sizeof *source->kind_weight);
    sum = fold(sum, mesh->vertex, vertices * sizeof *mesh->vertex);
    return fold(sum, mesh->triangle, 3 * (size_t)mesh->triangle_count * sizeof *mesh->triangle);
}

// ---- saving --------------------------------------------------------------------------------------

typedef struct Saving
{
    const DpTerrain* terrain;
    uint8_t*         kept;
} Saving;

static void look_at(void* context, int index, int worker)
{
    static const float nothing[TILE_CELLS];
    const Saving*      saving = context;
    const DpTerrain*   terrain = saving->terrain;
    Tile*              tile = tile_at(terrain, (size_t)index);
    uint8_t            kept = 0;
    (void)worker;
    for (int k = 0; k < KEPT_FIELDS; ++k)
        if (memcmp(tile_kept_in(tile, k), nothing, sizeof nothing) != 0) kept |= KEPT_TRAIL;
    for (int k = 0; k < terrain->coats; ++k)
        if (memcmp(tile_coats(terrain, tile) + k * TILE_CELLS, nothing, sizeof nothing) != 0)
            kept |= KEPT_TRAIL;
    if (terrain->cover) {
        float fresh[2 * TILE_CELLS];
        dp_tile_cover(terrain, tile->tx, tile->ty, fresh);
        if (memcmp(tile->plant, fresh, sizeof fresh) != 0) kept |= KEPT_COVER;
    }
    saving->kept[index] = kept;
}

void dp_terrain_save(const DpTerrain* terrain, DpStateWriter* writer)
{
    uint8_t* kept = dp_alloc(terrain->tiles + 1, 1);
    if (!kept) {
        if (writer->status == DP_OK) writer->status = DP_NO_MEMORY;
        return;
    }
    Saving saving = {terrain, kept};
    dp_parallel_for((int)terrain->tiles, terrain->workers, look_at, &saving);
    dp_write_chunk(writer, NAME, VERSION);
    dp_write_u64(writer, name_of(terrain));
    dp_write_u64(writer, KEPT_FIELDS);
    dp_write_u64(writer, terrain->tiles);
    for (size_t t = 0; t < terrain->tiles; ++t) {
        Tile* tile = tile_at(terrain, t);
        dp_write_i64(writer, tile->tx);
        dp_write_i64(writer, tile->ty);
        dp_write_u8(writer, kept[t]);
        for (int k = 0; k < KEPT_FIELDS && (kept[t] & KEPT_TRAIL); ++k)
            dp_write_runs(writer, tile_kept_in(tile, k), TILE_CELLS);
        if (terrain->springs && (kept[t] & KEPT_TRAIL))
            dp_write_runs(writer, tile_spring(terrain, tile), TILE_CELLS);
        for (int k = 0; k < terrain->coats && (kept[t] & KEPT_TRAIL); ++k)
            dp_write_runs(writer, tile_coats(terrain, tile) + k * TILE_CELLS, TILE_CELLS);
        if (kept[t] & KEPT_COVER) dp_write_runs(writer, tile->plant, 2 * TILE_CELLS);
    }
    dp_write_end(writer);
    dp_free(kept);
}

// ---- loading -------------------------------------------------------------------------------------

// numbers a field can hold: finite and >= 0
static void read_field(DpStateReader* reader, float* value, size_t count)
{
    bool holds = true;
    dp_read_runs(reader, value, count);
    for (size_t n = 0; n < count; ++n) holds = holds && value[n] >= 0.0f && isfinite(value[n]);
    dp_read_check(reader, holds);
}

// how a tile's cells were pressed: finite
static void read_spring(DpStateReader* reader, float* value)
{
    bool holds = true;
    dp_read_runs(reader, value, TILE_CELLS);
    for (size_t n = 0; n < TILE_CELLS; ++n) holds = holds && isfinite(value[n]);
    dp_read_check(reader, holds);
}

// the next tile, after the one before it; NULL without memory, or when there is something wrong
static Tile* read_tile(const DpTerrain* terrain, DpStateReader* reader, const Tile* before,
                       uint8_t* kept)
{
    const long    end = MAX_CELL_INDEX / DP_TILE - 1;
    const int64_t tx = dp_read_int(reader, -end, end), ty = dp_read_int(reader, -end, end);
    *kept = dp_read_u8(reader);
    dp_read_check(reader, *kept <= (KEPT_TRAIL | KEPT_COVER));
    dp_read_check(reader, terrain->cover || !(*kept & KEPT_COVER));
    dp_read_check(reader, !before || before->ty < ty || (before->ty == ty && before->tx < tx));
    dp_memory_ease(TILE_BYTES);
    Tile* tile = reader->status == DP_OK ? dp_tile_create(terrain, (long)tx, (long)ty) : NULL;
    for (int k = 0; tile && k < KEPT_FIELDS && (*kept & KEPT_TRAIL); ++k)
        read_field(reader, tile_kept(tile, k), TILE_CELLS);
    if (tile && terrain->springs && (*kept & KEPT_TRAIL))
        read_spring(reader, tile_spring(terrain, tile));
    for (int k = 0; tile && k < terrain->coats && (*kept & KEPT_TRAIL); ++k)
        read_field(reader, tile_coats(terrain, tile) + k * TILE_CELLS, TILE_CELLS);
    if (tile && (*kept & KEPT_COVER)) read_field(reader, tile->plant, 2 * TILE_CELLS);
    return tile;
}

// no soil lies and nothing is pressed where there is no ground
static bool stands_on_ground(const Tile* tile)
{
    bool holds = true;
    for (int n = 0; n < TILE_CELLS; ++n)
        for (int k = 0; k < KEPT_FIELDS; ++k)
            holds = holds && (!isnan(tile->base_height[n]) || !(tile_kept_in(tile, k)[n] > 0.0f));
    return holds;
}

static DpStatus read_tiles(DpTerrainState* state, DpStateReader* reader, size_t count)
{
    DpTerrain* ground = &state->ground;
    Tile**     fresh = dp_alloc(count + 1, sizeof *fresh);
    size_t     created = 0;
    state->kept = dp_alloc(count + 1, 1);
    bool enough = fresh && state->kept;
    while (enough && created < count && reader->status == DP_OK) {
        fresh[created] =
            read_tile(ground, reader, created ? fresh[created - 1] : NULL, &state->kept[created]);
        if (fresh[created])
            ++created;
        else if (reader->status == DP_OK)
            enough = false;
    }
    enough = enough && reader->status == DP_OK && dp_tile_adopt(ground, fresh, created, false);
    for (size_t t = 0; t < created && !enough; ++t) dp_tile_destroy(fresh[t]);
    dp_free(fresh);
    if (reader->status != DP_OK) return reader->status;
    if (!enough) return DP_NO_MEMORY;
    for (size_t t = 0; t < ground->tiles; ++t)
        if (state->kept[t] & KEPT_TRAIL)
            dp_read_check(reader, stands_on_ground(tile_at(ground, t)));
    return reader->status;
}

static void drop_tiles(DpTerrain* ground)
{
    for (size_t t = 0; t < ground->tiles; ++t) dp_tile_destroy(ground->sorted[t]);
    dp_free(ground->sorted);
    dp_free(ground->marked);
    dp_free(ground->slot);
}

// the terrain's own, but for its tiles: of these it has none
static void borrow(DpTerrain* ground, const DpTerrain* terrain)
{
    memcpy(ground, terrain, sizeof *ground);
    ground->sorted = ground->marked = ground->slot = NULL;
    ground->slots = ground->tiles = 0;
    atomic_init(&ground->marks, 0);
}

DpStatus dp_terrain_load(const DpTerrain* terrain, DpStateReader* reader, DpTerrainState** state)
{
    if (!terrain || !reader || !state) return DP_BAD_ARGUMENT;
    DpTerrainState* loaded = dp_alloc(1, sizeof *loaded);
    if (!loaded) return DP_NO_MEMORY;
    borrow(&loaded->ground, terrain);
    dp_read_chunk(reader, NAME, VERSION);
    dp_read_check(reader, dp_read_u64(reader) == name_of(terrain));
    dp_read_check(reader, dp_read_u64(reader) == KEPT_FIELDS);
    const size_t count = dp_read_count(reader, INT32_MAX / 4, MIN_TILE);
    DpStatus     status = reader->status;
    if (status == DP_OK && count > 0) status = read_tiles(loaded, reader, count);
    if (status == DP_OK) {
        dp_read_end(reader);
        status = reader->status;
    }
    if (status != DP_OK) {
        dp_terrain_state_destroy(loaded);
        return status;
    }
    *state = loaded;
    return DP_OK;
}

static void ask_cover(void* context, int index, int worker)
{
    const DpTerrainState* state = context;
    Tile*                 tile = tile_at(&state->ground, (size_t)index);
    (void)worker;
    if (state->kept[index] & KEPT_COVER) return;
    dp_tile_cover(&state->ground, tile->tx, tile->ty, tile->plant);
}

void dp_terrain_restore(DpTerrain* terrain, DpTerrainState* state)
{
    DpTerrain* ground = &state->ground;
    if (terrain->cover) dp_parallel_for((int)ground->tiles, terrain->workers, ask_cover, state);
    drop_tiles(terrain);
    terrain->sorted = ground->sorted, terrain->marked = ground->marked;
    terrain->slot = ground->slot, terrain->slots = ground->slots;
    terrain->tiles = ground->tiles;
    atomic_store(&terrain->marks, 0);
    for (size_t t = 0; t < terrain->tiles; ++t)
        if (state->kept[t] || terrain->cover) dp_tile_mark(terrain, terrain->sorted[t]);
    ground->sorted = ground->marked = ground->slot = NULL, ground->tiles = 0;
    dp_terrain_state_destroy(state);
}

void dp_terrain_state_destroy(DpTerrainState* state)
{
    if (!state) return;
    drop_tiles(&state->ground);
    dp_free(state->kept);
    dp_free(state);
}
