// python/py_sim.h - the simulation as Python holds it; for py_sim.c and py_frames.c only.
#pragma once
#include <pthread.h>
#include <stdatomic.h>

#include "maps/maps.h"
#include "python/door.h"
#include "sim/sim.h"

// A frame on its way to the disk: the tiles that changed, copied, and the thread that packs them.
typedef struct Frame
{
    DpFrames*  frames;
    long*      tile;  // place in the frame (room, 2)
    float*     rgba;  // (room, DP_TILE, DP_TILE, 4)
    int        count, room, workers;
    char*      path;  // NULL: packed only
    double     time;
    DpStatus   status;
    atomic_int failed;  // DpStatus of a tile that could not be packed
    bool       running, threaded;
    pthread_t  thread;
} Frame;

typedef struct Simulation
{
    PyObject_HEAD
    DpTerrain* terrain;
    DpSim*     sim;
    DpFrames*  frames;
    long       tile_x, tile_y;    // lowest tile of the frames
    int        tiles_x, tiles_y;  // 0 = no frames opened
    Frame      frame[2];          // one is filled while the other is written
    int        fresh;             // which one is filled next
    int        workers;
    bool       busy;  // a call without the GIL is under way
} Simulation;

// One call at a time: others get a sentence, not a crash.
static inline bool dp_py_enter(Simulation* self)
{
    if (self->busy) {
        PyErr_SetString(PyExc_RuntimeError, "this simulation is already running in another thread");
        return false;
    }
    self->busy = true;
    return true;
}

// py_frames.c
DpStatus  dp_py_finish_frame(Simulation* self);  // waits for the frame that is being written
void      dp_py_drop_frames(Simulation* self);
PyObject* dp_py_open_frames(PyObject* object, PyObject* args);
PyObject* dp_py_write_frame(PyObject* object, PyObject* args);
PyObject* dp_py_flush(PyObject* object, PyObject* unused);

// py_place.c
PyObject* dp_py_place(PyObject* object, PyObject* args);
