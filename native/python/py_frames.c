// python/py_frames.c - frames of a simulation: one is packed and written while the next is simulated.
#include "base/alloc.h"
#include "base/parallel.h"
#include "python/py_sim.h"

#include <string.h>

#define TILE_FLOATS ((size_t)DP_TILE * DP_TILE * 4)
#define MANY_TILES 16  // changed at once: worth every core

// Room for one more tile; false when there is no memory.
static bool make_room(Frame* frame)
{
    if (frame->count < frame->room) return true;
    const int room = frame->room ? 2 * frame->room : 16;
    long*     tile = dp_realloc(frame->tile, 2 * (size_t)room, sizeof *tile);
    if (tile) frame->tile = tile;
    float* rgba = tile ? dp_realloc(frame->rgba, (size_t)room * TILE_FLOATS, sizeof *rgba) : NULL;
    if (!rgba) return false;
    frame->rgba = rgba;
    frame->room = room;
    return true;
}

// What a film shows of a tile: the ground, or how its grass lies (R lean_x, G lean_y, B crushed,
// A plant strength).
static void tile_rgba(const Simulation* self, bool lean, long tx, long ty, float* rgba)
{
    dp_terrain_tile_rgba(self->terrain, tx, ty, rgba);
    if (!lean) return;
    float lies[3][DP_TILE * DP_TILE];
    dp_lean_read(dp_sim_lean(self->sim), tx * DP_TILE, ty * DP_TILE, DP_TILE, DP_TILE, lies[0],
                 lies[1], lies[2]);
    for (int n = 0; n < DP_TILE * DP_TILE; ++n) {
        rgba[4 * n + 3] = rgba[4 * n + 1];
        for (int c = 0; c < 3; ++c) rgba[4 * n + c] = lies[c][n];
    }
}

typedef struct Taking
{
    Simulation* self;
    Film*       film;
} Taking;

// Copy a tile that changed since the last frame, so that the ground may go on changing.
static void take_tile(void* context, long tx, long ty)
{
    const Taking* taking = context;
    Simulation*   self = taking->self;
    Film*         film = taking->film;
    Frame*        frame = &film->frame[film->fresh];
    const bool    inside = tx >= self->tile_x && tx < self->tile_x + self->tiles_x &&
                        ty >= self->tile_y && ty < self->tile_y + self->tiles_y;
    if (!inside || frame->status != DP_OK) return;
    if (!make_room(frame)) {
        frame->status = DP_NO_MEMORY;
        return;
    }
    tile_rgba(self, film == &self->film[DP_FILM_LEAN], tx, ty,
              frame->rgba + (size_t)frame->count * TILE_FLOATS);
    frame->tile[2 * frame->count] = tx - self->tile_x;
    frame->tile[2 * frame->count + 1] = ty - self->tile_y;
    ++frame->count;
}

static void pack_tile(void* context, int index, int worker)
{
    Frame*         frame = context;
    const DpStatus status = dp_frames_set_tile(frame->frames, (int)frame->tile[2 * index],
                                               (int)frame->tile[2 * index + 1],
                                               frame->rgba + (size_t)index * TILE_FLOATS, worker);
    if (status != DP_OK) atomic_store(&frame->failed, (int)status);
}

static void* write_out(void* context)
{
    Frame* frame = context;
    // the other cores simulate; only a flood of tiles is worth taking them
    dp_parallel_for(frame->count, frame->count < MANY_TILES ? 1 : frame->workers, pack_tile, frame);
    frame->status = (DpStatus)atomic_load(&frame->failed);
    if (frame->status == DP_OK && frame->path)
        frame->status = dp_frames_write(frame->frames, frame->path, frame->time);
    return NULL;
}

// Wait for the frame that is being written; how that went.
DpStatus dp_py_finish_frame(Film* film)
{
    Frame* frame = &film->frame[!film->fresh];
    if (!frame->running) return DP_OK;
    if (frame->threaded) pthread_join(frame->thread, NULL);
    frame->running = false;
    return frame->status;
}

void dp_py_drop_frames(Simulation* self)
{
    for (int k = 0; k < DP_FILMS; ++k) {
        Film* film = &self->film[k];
        (void)dp_py_finish_frame(film);
        for (int f = 0; f < 2; ++f) {
            dp_free(film->frame[f].tile);
            dp_free(film->frame[f].rgba);
            dp_free(film->frame[f].path);
        }
        dp_frames_destroy(film->frames);
    }
}

// Take in what changed, wait for the frame before, and start on this one.
static DpStatus start_frame(Simulation* self, Film* film, char* path, double time)
{
    Taking taking = {self, film};
    Frame* frame = &film->frame[film->fresh];
    frame->count = 0;
    frame->status = DP_OK;
    if (film == &self->film[DP_FILM_LEAN])
        dp_lean_changed(dp_sim_lean(self->sim), take_tile, &taking);
    else
        dp_terrain_changed(self->terrain, take_tile, &taking);
    const DpStatus before = dp_py_finish_frame(film);
    if (before != DP_OK || frame->status != DP_OK) {
        dp_free(path);
        return before != DP_OK ? before : frame->status;
    }
    dp_free(frame->path);
    frame->path = path;
    frame->time = time;
    frame->frames = film->frames;
    frame->workers = self->workers;
    atomic_store(&frame->failed, DP_OK);
    frame->running = true;
    frame->threaded = pthread_create(&frame->thread, NULL, write_out, frame) == 0;
    if (!frame->threaded) write_out(frame);
    film->fresh = !film->fresh;
    return DP_OK;
}

// The exception or None for a frame; the one that was waited for lies opposite the fresh one.
static PyObject* frame_result(const Film* film, DpStatus status)
{
    const char* path = film->frame[!film->fresh].path;
    return dp_door_result(status, path ? path : "encoding a frame");
}

PyObject* dp_py_write_frame(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    const char* path;  // None: take the changes in, write nothing
    double      time;
    int         lean = 0;
    if (!PyArg_ParseTuple(args, "zd|p:write_frame", &path, &time, &lean)) return NULL;
    Film* film = &self->film[lean ? DP_FILM_LEAN : DP_FILM_TRAIL];
    if (!film->frames) {
        PyErr_SetString(PyExc_ValueError, "write_frame: call open_frames first");
        return NULL;
    }
    char* own = path ? dp_alloc(strlen(path) + 1, 1) : NULL;
    if (path && !own) return PyErr_NoMemory();
    if (own) memcpy(own, path, strlen(path) + 1);
    if (!dp_py_enter(self)) {
        dp_free(own);
        return NULL;
    }
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = start_frame(self, film, own, time);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return frame_result(film, status);
}

PyObject* dp_py_flush(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    DpStatus status = DP_OK;
    int      film = 0;
    Py_BEGIN_ALLOW_THREADS
    for (int k = 0; k < DP_FILMS; ++k) {
        const DpStatus done = dp_py_finish_frame(&self->film[k]);
        if (done != DP_OK) status = done, film = k;
    }
    Py_END_ALLOW_THREADS
    self->busy = false;
    return frame_result(&self->film[film], status);
}

// Planted ground shows before anybody walks on it: frames begin with every tile.
typedef struct Rest
{
    const Simulation* self;
    bool              lean;
    atomic_int        failed;
} Rest;

static void pack_rest(void* context, int index, int worker)
{
    Rest*             rest = context;
    const Simulation* self = rest->self;
    DpFrames*         frames = self->film[rest->lean ? DP_FILM_LEAN : DP_FILM_TRAIL].frames;
    const int         tx = index % self->tiles_x, ty = index / self->tiles_x;
    float*            rgba = dp_alloc(TILE_FLOATS, sizeof *rgba);
    bool              any = false;
    DpStatus          status = rgba ? DP_OK : DP_NO_MEMORY;
    if (rgba) tile_rgba(self, rest->lean, self->tile_x + tx, self->tile_y + ty, rgba);
    for (size_t k = 0; rgba && !any && k < TILE_FLOATS; ++k) any = rgba[k] > 0.0f || rgba[k] < 0.0f;
    if (any) status = dp_frames_set_tile(frames, tx, ty, rgba, worker);
    if (status != DP_OK) atomic_store(&rest->failed, (int)status);
    dp_free(rgba);
}

static DpStatus pack_all(const Simulation* self, bool lean)
{
    Rest rest = {self, lean, DP_OK};
    dp_parallel_for(self->tiles_x * self->tiles_y, self->workers, pack_rest, &rest);
    return (DpStatus)atomic_load(&rest.failed);
}

// A writer for one film, with what its channels hold.
static DpStatus open_film(Simulation* self, bool lean, const char* software)
{
    static const char* const trail_names[4] = {"height change [m]", "plant strength [-]",
                                               "compression [m]", "pressure_time [Pa s]"};
    static const char* const lean_names[4] = {"lean_x [-]", "lean_y [-]", "crushed [-]",
                                              "plant strength [-]"};
    const char* const*       names = lean ? lean_names : trail_names;
    Film*                    film = &self->film[lean ? DP_FILM_LEAN : DP_FILM_TRAIL];
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
    DpFrames* frames = NULL;
    (void)dp_py_finish_frame(film);
    const DpStatus status = dp_frames_create(&frames, self->tiles_x, self->tiles_y, notes,
                                             (int)(sizeof notes / sizeof *notes));
    if (status != DP_OK) return status;
    dp_frames_destroy(film->frames);
    film->frames = frames;
    return self->plants ? pack_all(self, lean) : DP_OK;
}

PyObject* dp_py_open_frames(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    long        tx, ty;
    int         nx, ny;
    const char* software;
    if (!PyArg_ParseTuple(args, "lliis:open_frames", &tx, &ty, &nx, &ny, &software) ||
        !dp_py_enter(self))
        return NULL;
    DpStatus status;
    self->tile_x = tx, self->tile_y = ty;
    self->tiles_x = nx, self->tiles_y = ny;
    Py_BEGIN_ALLOW_THREADS
    status = open_film(self, false, software);
    if (status == DP_OK && self->plants) status = open_film(self, true, software);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return dp_door_result(status, "opening the frames");
}
