// python/py_frames.c - pictures of a simulation: frames for playback and maps, written in the
// background while the ground goes on.
#include "base/alloc.h"
#include "base/parallel.h"
#include "python/py_sim.h"

#include <stdatomic.h>
#include <string.h>

#define TILE_CELLS (DP_TILE * DP_TILE)

// ---- a film ------------------------------------------------------------------------------------

static void close_film(Film* film)
{
    dp_frames_destroy(film->frames);
    dp_free(film->changed);
    memset(film, 0, sizeof *film);
}

// What a film shows of a tile, by its place in the frames; value (DP_TILE, DP_TILE, fields).
static void fill_tile(const Simulation* self, const Film* film, int index, float* value)
{
    const long tx = self->tile_x + index % self->tiles_x;
    const long ty = self->tile_y + index / self->tiles_x;
    for (int f = 0; f < film->fields; ++f) {
        const int axis = film->field[f] - DP_FIELD_LEAN;
        if (axis < 0) {
            dp_terrain_tile(self->terrain, tx, ty, (DpField)film->field[f], value + f,
                            film->fields);
            continue;
        }
        float lies[TILE_CELLS];
        dp_lean_read(dp_sim_lean(self->sim), tx * DP_TILE, ty * DP_TILE, DP_TILE, DP_TILE,
                     axis == 0 ? lies : NULL, axis == 1 ? lies : NULL, axis == 2 ? lies : NULL);
        for (int n = 0; n < TILE_CELLS; ++n) value[n * film->fields + f] = lies[n];
    }
}

// Planted ground shows before anybody walks on it, and so do trodden ground and its height:
// pictures of these begin with every tile.
typedef struct Rest
{
    const Simulation* self;
    const Film*       film;
    atomic_int        failed;
} Rest;

static void pack_rest(void* context, int index, int worker)
{
    Rest*             rest = context;
    const Simulation* self = rest->self;
    const size_t      size = (size_t)TILE_CELLS * (size_t)rest->film->fields;
    float*            value = dp_alloc(size, sizeof *value);
    bool              any = false;
    DpStatus          status = value ? DP_OK : DP_NO_MEMORY;
    if (value) fill_tile(self, rest->film, index, value);
    for (size_t k = 0; value && !any && k < size; ++k) any = !(value[k] >= 0.0f && value[k] <= 0.0f);
    if (any)
        status = dp_frames_set_tile(rest->film->frames, index % self->tiles_x,
                                    index / self->tiles_x, value, worker);
    if (status != DP_OK) atomic_store(&rest->failed, (int)status);
    dp_free(value);
}

// Begin a film of the frames' tiles with the ground as it is now.
static DpStatus open_film(Simulation* self, Film* film, const char* const* channel,
                          const int* field, int fields, const DpNote* notes, int note_count)
{
    const int tiles = self->tiles_x * self->tiles_y;
    Film      fresh = {.fields = fields};
    memcpy(fresh.field, field, (size_t)fields * sizeof *field);
    DpStatus status = dp_frames_create(&fresh.frames, self->tiles_x, self->tiles_y, channel, fields,
                                       notes, note_count);
    if (status != DP_OK) return status;
    fresh.changed = dp_alloc((size_t)tiles, 1);
    if (!fresh.changed) status = DP_NO_MEMORY;
    bool shows = self->plants || dp_terrain_tile_count(self->terrain) > 0;
    for (int f = 0; f < fields; ++f) shows |= field[f] == DP_FIELD_REST;
    if (status == DP_OK && shows) {
        Rest rest = {self, &fresh, DP_OK};
        dp_parallel_for(tiles, self->workers, pack_rest, &rest);
        status = (DpStatus)atomic_load(&rest.failed);
    }
    if (status == DP_OK && !self->writer) status = dp_writer_create(&self->writer, self->workers);
    if (status != DP_OK) {
        close_film(&fresh);
        return status;
    }
    close_film(film);
    *film = fresh;
    return DP_OK;
}

static void mark_tile(const Simulation* self, const Film* film, long tx, long ty)
{
    const long i = tx - self->tile_x, j = ty - self->tile_y;
    const bool inside = i >= 0 && j >= 0 && i < self->tiles_x && j < self->tiles_y;
    if (film->changed && inside) film->changed[j * self->tiles_x + i] = 1;
}

static void mark_ground(void* context, long tx, long ty)
{
    const Simulation* self = context;
    mark_tile(self, &self->film[DP_FILM_TRAIL], tx, ty);
    mark_tile(self, &self->film[DP_FILM_MAPS], tx, ty);
}

static void mark_grass(void* context, long tx, long ty)
{
    const Simulation* self = context;
    mark_tile(self, &self->film[DP_FILM_LEAN], tx, ty);
    mark_tile(self, &self->film[DP_FILM_MAPS], tx, ty);
}

// Copy the tiles that changed since the film's last file and have them packed and written.
static DpStatus write_film(Simulation* self, Film* film, const char* path, double time,
                           const char** failed)
{
    const DpStatus status = dp_writer_told(self->writer, false, failed);
    if (status != DP_OK) return status;
    dp_terrain_changed(self->terrain, mark_ground, self);
    if (self->plants) dp_lean_changed(dp_sim_lean(self->sim), mark_grass, self);
    DpTiles* tiles = dp_writer_tiles(self->writer, film->frames);
    if (!tiles) return DP_NO_MEMORY;
    const int count = self->tiles_x * self->tiles_y;
    for (int k = 0; k < count; ++k) {
        if (!film->changed[k]) continue;
        float* value = dp_tiles_add(tiles, k % self->tiles_x, k / self->tiles_x);
        if (!value) {
            dp_writer_drop(self->writer, tiles);
            return DP_NO_MEMORY;
        }
        fill_tile(self, film, k, value);
    }
    memset(film->changed, 0, (size_t)count);
    return dp_writer_give(self->writer, tiles, path, time);
}

void dp_py_drop_frames(Simulation* self)
{
    dp_writer_destroy(self->writer);
    for (int k = 0; k < DP_FILMS; ++k) close_film(&self->film[k]);
}

// ---- the door ----------------------------------------------------------------------------------

static PyObject* told(DpStatus status, const char* path)
{
    return dp_door_result(status, *path ? path : "encoding a frame");
}

static PyObject* write_file(Simulation* self, Film* film, const char* path, double time)
{
    const char* failed = "";
    if (!film->frames) {
        PyErr_SetString(PyExc_ValueError, "writing before the frames or maps are open");
        return NULL;
    }
    if (!dp_py_enter(self)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = write_film(self, film, path, time, &failed);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return told(status, failed);
}

PyObject* dp_py_write_frame(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    const char* path;  // None: take the changes in, write nothing
    double      time;
    int         lean = 0;
    if (!PyArg_ParseTuple(args, "zd|p:write_frame", &path, &time, &lean)) return NULL;
    return write_file(self, &self->film[lean ? DP_FILM_LEAN : DP_FILM_TRAIL], path, time);
}

PyObject* dp_py_write_maps(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    const char* path;
    double      time;
    if (!PyArg_ParseTuple(args, "sd:write_maps", &path, &time)) return NULL;
    return write_file(self, &self->film[DP_FILM_MAPS], path, time);
}

PyObject* dp_py_flush(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    const char* failed = "";
    DpStatus    status = DP_OK;
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    if (self->writer) status = dp_writer_told(self->writer, true, &failed);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return told(status, failed);
}

// A film for playback, with what its channels hold.
static DpStatus open_playback(Simulation* self, bool lean, const char* software)
{
    static const char* const channel[4] = {"R", "G", "B", "A"};
    static const int         trail_field[4] = {DP_FIELD_HEIGHT_CHANGE, DP_FIELD_PLANT_STRENGTH,
                                               DP_FIELD_COMPRESSION, DP_FIELD_PRESSURE_TIME};
    static const int         lean_field[4] = {DP_FIELD_LEAN, DP_FIELD_LEAN + 1, DP_FIELD_LEAN + 2,
                                              DP_FIELD_PLANT_STRENGTH};
    static const char* const trail_names[4] = {"height change [m]", "plant strength [-]",
                                               "compression [m]", "pressure_time [Pa s]"};
    static const char* const lean_names[4] = {"lean_x [-]", "lean_y [-]", "crushed [-]",
                                              "plant strength [-]"};
    const char* const*       names = lean ? lean_names : trail_names;
    double                   origin[2];
    dp_terrain_origin(self->terrain, origin);
    const double cell = dp_terrain_cell(self->terrain);
    const DpNote notes[] = {
        {"software", software, 0.0},
        {"cell", NULL, cell},
        {"originX", NULL, origin[0] + cell * DP_TILE * (double)self->tile_x},
        {"originY", NULL, origin[1] + cell * DP_TILE * (double)self->tile_y},
        {"channelR", names[0], 0.0},
        {"channelG", names[1], 0.0},
        {"channelB", names[2], 0.0},
        {"channelA", names[3], 0.0},
    };
    return open_film(self, &self->film[lean ? DP_FILM_LEAN : DP_FILM_TRAIL], channel,
                     lean ? lean_field : trail_field, 4, notes,
                     (int)(sizeof notes / sizeof *notes));
}

PyObject* dp_py_open_frames(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    long        tx, ty;
    int         nx, ny;
    const char *software, *failed;
    if (!PyArg_ParseTuple(args, "lliis:open_frames", &tx, &ty, &nx, &ny, &software)) return NULL;
    if (nx < 1 || ny < 1 || nx > INT32_MAX / ny) {
        PyErr_SetString(PyExc_ValueError, "open_frames: expected at least one tile");
        return NULL;
    }
    if (!dp_py_enter(self)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    if (self->writer) (void)dp_writer_told(self->writer, true, &failed);
    for (int k = 0; k < DP_FILMS; ++k) close_film(&self->film[k]);
    self->tile_x = tx, self->tile_y = ty;
    self->tiles_x = nx, self->tiles_y = ny;
    status = open_playback(self, false, software);
    if (status == DP_OK && self->plants) status = open_playback(self, true, software);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return dp_door_result(status, "opening the frames");
}

// Channel names and fields from a tuple of (name, number of the field); their count, or -1.
static int read_fields(const Simulation* self, PyObject* items, const char** channel, int* field)
{
    const Py_ssize_t count = PyTuple_Size(items);
    const int        last = self->plants ? DP_FIELD_LEAN + 2 : DP_FIELD_HEIGHT_CHANGE;
    if (count < 1 || count > MOST_FIELDS) {
        PyErr_Format(PyExc_ValueError, "open_maps: expected 1 to %d fields", MOST_FIELDS);
        return -1;
    }
    for (Py_ssize_t k = 0; k < count; ++k) {
        if (!PyArg_ParseTuple(PyTuple_GetItem(items, k), "si:open_maps", &channel[k], &field[k]))
            return -1;
        if (field[k] < 0 || field[k] > last ||
            (field[k] > DP_FIELD_HEIGHT_CHANGE && field[k] < DP_FIELD_LEAN)) {
            PyErr_Format(PyExc_ValueError, "open_maps: there is no field %d", field[k]);
            return -1;
        }
    }
    return (int)count;
}

PyObject* dp_py_open_maps(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  fields, *items;
    const char* channel[MOST_FIELDS];
    int         field[MOST_FIELDS];
    if (!PyArg_ParseTuple(args, "O!O!:open_maps", &PyTuple_Type, &fields, &PyTuple_Type, &items))
        return NULL;
    if (!self->film[DP_FILM_TRAIL].frames) {
        PyErr_SetString(PyExc_ValueError, "open_maps: open_frames comes first");
        return NULL;
    }
    const int count = read_fields(self, fields, channel, field);
    DpNote*   notes = count > 0 ? dp_py_notes(items) : NULL;
    if (!notes || !dp_py_enter(self)) {
        dp_free(notes);
        return NULL;
    }
    const int   note_count = (int)PyTuple_Size(items);
    const char* failed;
    DpStatus    status;
    Py_BEGIN_ALLOW_THREADS(void)
    dp_writer_told(self->writer, true, &failed);
    status = open_film(self, &self->film[DP_FILM_MAPS], channel, field, count, notes, note_count);
    Py_END_ALLOW_THREADS
    self->busy = false;
    dp_free(notes);
    return dp_door_result(status, "opening the maps");
}
