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

// Copy a tile that changed since the last frame, so that the ground may go on changing.
static void take_tile(void* context, long tx, long ty)
{
    Simulation* self = context;
    Frame*      frame = &self->frame[self->fresh];
    const bool  inside = tx >= self->tile_x && tx < self->tile_x + self->tiles_x &&
                        ty >= self->tile_y && ty < self->tile_y + self->tiles_y;
    if (!inside || frame->status != DP_OK) return;
    if (!make_room(frame)) {
        frame->status = DP_NO_MEMORY;
        return;
    }
    dp_terrain_tile_rgba(self->terrain, tx, ty, frame->rgba + (size_t)frame->count * TILE_FLOATS);
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
DpStatus dp_py_finish_frame(Simulation* self)
{
    Frame* frame = &self->frame[!self->fresh];
    if (!frame->running) return DP_OK;
    if (frame->threaded) pthread_join(frame->thread, NULL);
    frame->running = false;
    return frame->status;
}

void dp_py_drop_frames(Simulation* self)
{
    (void)dp_py_finish_frame(self);
    for (int f = 0; f < 2; ++f) {
        dp_free(self->frame[f].tile);
        dp_free(self->frame[f].rgba);
        dp_free(self->frame[f].path);
    }
    dp_frames_destroy(self->frames);
}

// Take in what changed, wait for the frame before, and start on this one.
static DpStatus start_frame(Simulation* self, char* path, double time)
{
    Frame* frame = &self->frame[self->fresh];
    frame->count = 0;
    frame->status = DP_OK;
    dp_terrain_changed(self->terrain, take_tile, self);
    const DpStatus before = dp_py_finish_frame(self);
    if (before != DP_OK || frame->status != DP_OK) {
        dp_free(path);
        return before != DP_OK ? before : frame->status;
    }
    dp_free(frame->path);
    frame->path = path;
    frame->time = time;
    frame->frames = self->frames;
    frame->workers = self->workers;
    atomic_store(&frame->failed, DP_OK);
    frame->running = true;
    frame->threaded = pthread_create(&frame->thread, NULL, write_out, frame) == 0;
    if (!frame->threaded) write_out(frame);
    self->fresh = !self->fresh;
    return DP_OK;
}

// The exception or None for a frame; the one that was waited for lies opposite the fresh one.
static PyObject* frame_result(Simulation* self, DpStatus status)
{
    const char* path = self->frame[!self->fresh].path;
    return dp_door_result(status, path ? path : "encoding a frame");
}

PyObject* dp_py_write_frame(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    const char* path;  // None: take the changes in, write nothing
    double      time;
    if (!PyArg_ParseTuple(args, "zd:write_frame", &path, &time)) return NULL;
    if (!self->frames) {
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
    status = start_frame(self, own, time);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return frame_result(self, status);
}

PyObject* dp_py_flush(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_py_finish_frame(self);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return frame_result(self, status);
}

// Planted ground shows before anybody walks on it: frames begin with every tile.
typedef struct Rest
{
    const Simulation* self;
    DpFrames*         frames;
    atomic_int        failed;
} Rest;

static void pack_rest(void* context, int index, int worker)
{
    Rest*             rest = context;
    const Simulation* self = rest->self;
    const int         tx = index % self->tiles_x, ty = index / self->tiles_x;
    float*            rgba = dp_alloc(TILE_FLOATS, sizeof *rgba);
    bool              any = false;
    DpStatus          status = rgba ? DP_OK : DP_NO_MEMORY;
    if (rgba) dp_terrain_tile_rgba(self->terrain, self->tile_x + tx, self->tile_y + ty, rgba);
    for (size_t k = 0; rgba && !any && k < TILE_FLOATS; ++k) any = rgba[k] > 0.0f || rgba[k] < 0.0f;
    if (any) status = dp_frames_set_tile(rest->frames, tx, ty, rgba, worker);
    if (status != DP_OK) atomic_store(&rest->failed, (int)status);
    dp_free(rgba);
}

static DpStatus pack_all(Simulation* self)
{
    Rest rest = {self, self->frames, DP_OK};
    dp_parallel_for(self->tiles_x * self->tiles_y, self->workers, pack_rest, &rest);
    return (DpStatus)atomic_load(&rest.failed);
}

PyObject* dp_py_open_frames(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    long        tx, ty;
    int         nx, ny;
    const char* version;
    if (!PyArg_ParseTuple(args, "lliis:open_frames", &tx, &ty, &nx, &ny, &version) ||
        !dp_py_enter(self))
        return NULL;
    double origin[2];
    dp_terrain_origin(self->terrain, origin);
    const double cell = dp_terrain_cell(self->terrain);
    const DpNote notes[] = {
        {"software", version, 0.0},
        {"cell", NULL, cell},
        {"originX", NULL, origin[0] + cell * DP_TILE * (double)tx},
        {"originY", NULL, origin[1] + cell * DP_TILE * (double)ty},
        {"channelR", "height change [m]", 0.0},
        {"channelG", "plant strength [-]", 0.0},
        {"channelB", "compression [m]", 0.0},
        {"channelA", "pressure_time [Pa s]", 0.0},
    };
    DpFrames* frames = NULL;
    (void)dp_py_finish_frame(self);
    DpStatus status = dp_frames_create(&frames, nx, ny, notes, (int)(sizeof notes / sizeof *notes));
    if (status == DP_OK) {
        dp_frames_destroy(self->frames);
        self->frames = frames;
        self->tile_x = tx, self->tile_y = ty;
        self->tiles_x = nx, self->tiles_y = ny;
        Py_BEGIN_ALLOW_THREADS
        if (self->plants) status = pack_all(self);
        Py_END_ALLOW_THREADS
    }
    self->busy = false;
    return dp_door_result(status, "opening the frames");
}
