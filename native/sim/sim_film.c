// sim/sim_film.c - films of the ground: which tiles are new in each, and what they show.
#include <limits.h>
#include <stdatomic.h>
#include <string.h>

#include "base/alloc.h"
#include "base/os.h"
#include "base/parallel.h"
#include "sim/sim_atlas.h"
#include "sim/sim_inside.h"

#define TILE_CELLS (DP_TILE * DP_TILE)
#define MAX_TILES (1 << 22)  // of one film

struct DpFilm
{
    DpReel*   reel;
    DpFilm*   next;  // of the reel's
    long      tile_x, tile_y;
    int       tiles_x, tiles_y;  // of ground
    Atlas*    atlas;             // NULL: the picture's tiles are the ground's
    int       columns, rows;     // of the picture
    int       field[DP_FILM_FIELDS];
    int       fields;
    bool      of_ground, of_grass, of_soles;  // whose changes it shows
    DpFrames* frames;
    uint8_t*  changed;  // tiles of the picture that are not what was written last (rows, columns)
};

struct DpReel
{
    DpSim*    sim;
    DpWriter* writer;
    DpFilm*   first;
    int       workers;
    DpLock    lock;  // of the list, and of what its films hold
};

// ---- what a film shows -------------------------------------------------------------------------

// One field of cells (DP_TILE, DP_TILE).
static void read_cells(const DpSim* sim, int field, const DpCellRect* at, float* cell)
{
    const int axis = field - DP_FIELD_LEAN_X;
    DpStatus  status = DP_OK;
    if (dp_sim_is_of_layers(sim, field))
        status = dp_sim_layers(sim, field, at, cell);
    else if (dp_terrain_knows(sim->terrain, field))
        status = dp_terrain_read(sim->terrain, field, at->i0, at->j0, DP_TILE, DP_TILE, cell);
    else if (field == DP_FIELD_PRESSURE)
        dp_sim_pressure(sim, at->i0, at->j0, DP_TILE, DP_TILE, cell);
    else
        dp_grass_read(dp_sim_grass(sim), at->i0, at->j0, DP_TILE, DP_TILE, axis == 0 ? cell : NULL,
                      axis == 1 ? cell : NULL, axis == 2 ? cell : NULL);
    if (status != DP_OK) memset(cell, 0, TILE_CELLS * sizeof *cell);
}

// A tile of the picture; value (DP_TILE, DP_TILE, fields).
static void fill_tile(const DpFilm* film, int index, float* value)
{
    const DpSim* sim = film->reel->sim;
    const long   tx = film->tile_x + index % film->columns;
    const long   ty = film->tile_y + index / film->columns;
    DpCellRect   at = dp_cells(tx * DP_TILE, ty * DP_TILE, DP_TILE, DP_TILE);
    if (film->atlas && !dp_atlas_cells(film->atlas, index, &at)) {
        memset(value, 0, (size_t)TILE_CELLS * (size_t)film->fields * sizeof *value);
        return;
    }
    for (int f = 0; f < film->fields; ++f) {
        const bool own = dp_terrain_knows(sim->terrain, film->field[f]) &&
                         !dp_sim_is_of_layers(sim, film->field[f]);
        if (own && !film->atlas) {
            dp_terrain_tile(sim->terrain, tx, ty, film->field[f], value + f, film->fields);
            continue;
        }
        float cell[TILE_CELLS];
        read_cells(sim, film->field[f], &at, cell);
        for (int n = 0; n < TILE_CELLS; ++n) value[n * film->fields + f] = cell[n];
    }
}

// Planted ground shows before anybody walks on it, and so do trodden ground and its height: films of
// these begin with every tile.
typedef struct Packing
{
    const DpFilm* film;
    atomic_int    failed;
} Packing;

static void pack_start(void* context, int index, int worker)
{
    Packing*      packing = context;
    const DpFilm* film = packing->film;
    const size_t  size = (size_t)TILE_CELLS * (size_t)film->fields;
    float*        value = dp_alloc(size, sizeof *value);
    bool          any = false;
    DpStatus      status = value ? DP_OK : DP_NO_MEMORY;
    if (value) fill_tile(film, index, value);
    for (size_t k = 0; value && !any && k < size; ++k)
        any = !(value[k] >= 0.0f && value[k] <= 0.0f);
    if (any)
        status = dp_frames_set_tile(film->frames, index % film->columns, index / film->columns,
                                    value, worker);
    if (status != DP_OK) atomic_store(&packing->failed, (int)status);
    dp_free(value);
}

// ---- what changed ------------------------------------------------------------------------------

static void mark(const DpFilm* film, long tx, long ty)
{
    const long i = tx - film->tile_x, j = ty - film->tile_y;
    if (film->atlas)
        dp_atlas_mark(film->atlas, i, j, film->changed);
    else if (i >= 0 && j >= 0 && i < film->tiles_x && j < film->tiles_y)
        film->changed[j * film->tiles_x + i] = 1;
}

static void mark_ground(void* context, long tx, long ty)
{
    const DpReel* reel = context;
    for (const DpFilm* film = reel->first; film; film = film->next)
        if (film->of_ground) mark(film, tx, ty);
}

static void mark_grass(void* context, long tx, long ty)
{
    const DpReel* reel = context;
    for (const DpFilm* film = reel->first; film; film = film->next)
        if (film->of_grass) mark(film, tx, ty);
}

static void mark_sole(void* context, long tx, long ty)
{
    mark(context, tx, ty);
}

static DpStatus write_changed(DpFilm* film, const char* path, double time, const char** failed)
{
    DpReel*        reel = film->reel;
    const DpSim*   sim = reel->sim;
    const DpStatus status = dp_writer_outcome(reel->writer, false, failed);
    if (status != DP_OK) return status;
    dp_terrain_changed(sim->terrain, mark_ground, reel);
    if (dp_sim_grass(sim)) dp_grass_changed(dp_sim_grass(sim), mark_grass, reel);
    if (film->of_soles) dp_sim_soles(sim, mark_sole, film);
    DpTiles* tiles = dp_writer_tiles(reel->writer, film->frames);
    if (!tiles) return DP_NO_MEMORY;
    const int count = film->columns * film->rows;
    for (int k = 0; k < count; ++k) {
        if (!film->changed[k]) continue;
        float* value = dp_tiles_add(tiles, k % film->columns, k / film->columns);
        if (!value) {
            dp_writer_drop(reel->writer, tiles);
            return DP_NO_MEMORY;
        }
        fill_tile(film, k, value);
    }
    memset(film->changed, 0, (size_t)count);
    if (film->of_soles) dp_sim_soles(sim, mark_sole, film);  // they will not stay
    return dp_writer_give(reel->writer, tiles, path, time);
}

DpStatus dp_film_list(DpFilm* film, const char* path)
{
    dp_writer_wait(film->reel->writer);
    return dp_frames_list(film->frames, path);
}

DpStatus dp_film_write(DpFilm* film, const char* path, double time, const char** failed)
{
    dp_lock_take(&film->reel->lock);
    const DpStatus status = write_changed(film, path, time, failed);
    dp_lock_give(&film->reel->lock);
    return status;
}

// ---- a life ------------------------------------------------------------------------------------

DpStatus dp_reel_create(DpReel** reel, DpSim* sim, int workers)
{
    DpReel* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    created->sim = sim;
    created->workers = workers;
    const DpStatus status = dp_writer_create(&created->writer, workers);
    if (status != DP_OK) {
        dp_free(created);
        return status;
    }
    dp_lock_create(&created->lock);
    *reel = created;
    return DP_OK;
}

static void drop(DpFilm* film)
{
    dp_frames_destroy(film->frames);
    dp_atlas_destroy(film->atlas);
    dp_free(film->changed);
    dp_free(film);
}

void dp_reel_destroy(DpReel* reel)
{
    if (!reel) return;
    dp_writer_destroy(reel->writer);
    while (reel->first) {
        DpFilm* film = reel->first;
        reel->first = film->next;
        drop(film);
    }
    dp_lock_destroy(&reel->lock);
    dp_free(reel);
}

DpStatus dp_reel_outcome(DpReel* reel, bool wait, const char** path)
{
    return dp_writer_outcome(reel->writer, wait, path);
}

static bool are_tiles(long first, int count)
{
    const long far = LONG_MAX / DP_TILE;
    return count > 0 && count <= MAX_TILES && first >= -far && first <= far &&
           dp_terrain_has(first * DP_TILE, 0, (long)count * DP_TILE, 1);
}

#define FIELD_INFO(ID, name, number, unit, equation, meaning) \
    {DP_FIELD_##ID, #name, unit, equation, meaning},
static const DpFieldInfo fields[] = {DP_TERRAIN_FIELDS(FIELD_INFO, FIELD_INFO)
                                         DP_SIM_FIELDS(FIELD_INFO)};

const DpFieldInfo* dp_sim_fields(int* count)
{
    *count = (int)(sizeof fields / sizeof *fields);
    return fields;
}

bool dp_film_shows(const DpSim* sim, int field)
{
    if (field >= DP_FIELD_LEAN_X && field <= DP_FIELD_CRUSHED) return dp_sim_grass(sim) != NULL;
    return field == DP_FIELD_PRESSURE || dp_terrain_knows(sim->terrain, field) ||
           dp_sim_is_of_layers(sim, field);
}

static bool are_known(const DpSim* sim, const DpFilmOptions* options)
{
    if (!are_tiles(options->tile_x, options->tiles_x) ||
        !are_tiles(options->tile_y, options->tiles_y) ||
        options->tiles_x > MAX_TILES / options->tiles_y || options->fields < 1 ||
        options->fields > DP_FILM_FIELDS)
        return false;
    for (int f = 0; f < options->fields; ++f)
        if (!dp_film_shows(sim, options->field[f])) return false;
    return true;
}

static DpStatus begin(DpFilm* film, const DpFilmOptions* options)
{
    const DpReel* reel = film->reel;
    DpStatus      status = DP_OK;
    if (options->atlas) {
        film->atlas = dp_atlas_create(options, &status);
        if (!film->atlas) return status;
        film->columns = film->atlas->columns, film->rows = film->atlas->rows;
    }
    status = dp_frames_create(&film->frames, film->columns, film->rows, options->channel,
                              film->fields, options->notes, options->note_count);
    if (status != DP_OK) return status;
    const int tiles = film->columns * film->rows;
    film->changed = dp_alloc((size_t)tiles, 1);
    if (!film->changed) return DP_NO_MEMORY;
    bool shows = dp_sim_grass(reel->sim) || dp_terrain_tile_count(reel->sim->terrain) > 0;
    for (int f = 0; f < film->fields; ++f) shows |= film->field[f] == DP_FIELD_BASE_HEIGHT;
    if (shows) {
        Packing packing = {film, DP_OK};
        dp_parallel_for(tiles, reel->workers, pack_start, &packing);
        status = (DpStatus)atomic_load(&packing.failed);
    }
    return status;
}

DpStatus dp_film_open(DpReel* reel, const DpFilmOptions* options, DpFilm** film)
{
    if (!are_known(reel->sim, options)) return DP_BAD_ARGUMENT;
    DpFilm* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    created->reel = reel;
    created->tile_x = options->tile_x, created->tile_y = options->tile_y;
    created->columns = created->tiles_x = options->tiles_x;
    created->rows = created->tiles_y = options->tiles_y;
    created->fields = options->fields;
    for (int f = 0; f < options->fields; ++f) {
        const int field = created->field[f] = options->field[f];
        created->of_soles = created->of_soles || field == DP_FIELD_PRESSURE;
        const bool of_terrain =
            dp_terrain_knows(reel->sim->terrain, field) || field >= DP_FIELD_LAYER;
        created->of_grass = created->of_grass || (!of_terrain && field != DP_FIELD_PRESSURE);
        created->of_ground = created->of_ground || (of_terrain && field != DP_FIELD_PLANT_STRENGTH);
    }
    const DpStatus status = begin(created, options);
    if (status != DP_OK) {
        drop(created);
        return status;
    }
    if (created->of_soles) dp_sim_soles(reel->sim, mark_sole, created);
    dp_lock_take(&reel->lock);
    created->next = reel->first;
    reel->first = created;
    dp_lock_give(&reel->lock);
    *film = created;
    return DP_OK;
}

DpStatus dp_film_open_playback(DpReel* reel, const DpFilmOptions* options, DpPlayback shows,
                               const char* software, DpFilm** film)
{
    static const char* const channel[4] = {"R", "G", "B", "A"};
    static const int         field[2][4] = {
                {DP_FIELD_HEIGHT_CHANGE, DP_FIELD_PLANT_STRENGTH, DP_FIELD_COMPRESSION,
                 DP_FIELD_PRESSURE_TIME},
                {DP_FIELD_LEAN_X, DP_FIELD_LEAN_Y, DP_FIELD_CRUSHED, DP_FIELD_PLANT_STRENGTH}};
    static const char* const name[2][4] = {
        {"height change [m]", "plant strength [-]", "compression [m]", "pressure_time [Pa s]"},
        {"lean_x [-]", "lean_y [-]", "crushed [-]", "plant strength [-]"}};
    const DpSim* sim = reel->sim;
    const double tile = sim->grid.cell * DP_TILE;
    const DpNote notes[] = {
        {"software", software, 0.0},
        {"cell", NULL, sim->grid.cell},
        {"originX", NULL, sim->grid.x0 + tile * (double)options->tile_x},
        {"originY", NULL, sim->grid.y0 + tile * (double)options->tile_y},
        {"channelR", name[shows][0], 0.0},
        {"channelG", name[shows][1], 0.0},
        {"channelB", name[shows][2], 0.0},
        {"channelA", name[shows][3], 0.0},
    };
    DpFilmOptions all = *options;
    all.notes = notes, all.note_count = (int)(sizeof notes / sizeof *notes);
    all.fields = 4;
    for (int f = 0; f < 4; ++f) all.field[f] = field[shows][f], all.channel[f] = channel[f];
    return dp_film_open(reel, &all, film);
}

void dp_film_close(DpFilm* film)
{
    if (!film) return;
    DpReel* reel = film->reel;
    dp_lock_take(&reel->lock);
    DpFilm** at = &reel->first;
    while (*at != film) at = &(*at)->next;
    *at = film->next;
    dp_lock_give(&reel->lock);
    dp_writer_wait(reel->writer);
    drop(film);
}
