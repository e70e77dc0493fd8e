// python/py_sim.h - the simulation as Python holds it; for py_sim.c, py_ground.c, py_frames.c
// and py_meadow.c only.
#pragma once
#include <pthread.h>
#include <stdatomic.h>

#include "maps/maps.h"
#include "python/door.h"
#include "sim/sim.h"

// A frame on its way to the disk: the tiles that changed, copied, and the thread that packs them.
typedef struct Frame
{
    DpFrames*  frames;  // of its film
    long*      tile;    // place in the frame (room, 2)
    float*     rgba;    // (room, DP_TILE, DP_TILE, 4)
    int        count, room, workers;
    char*      path;  // NULL: packed only
    double     time;
    DpStatus   status;
    atomic_int failed;  // DpStatus of a tile that could not be packed
    bool       running, threaded;
    pthread_t  thread;
} Frame;

// Frames of one kind.
typedef struct Film
{
    DpFrames* frames;
    Frame     frame[2];  // one is filled while the other is written
    int       fresh;     // which one is filled next
} Film;

enum
{
    DP_FILM_TRAIL = 0,
    DP_FILM_LEAN = 1,
    DP_FILMS = 2
};  // lean: on planted ground only

typedef struct Simulation
{
    PyObject_HEAD
    DpTerrain* terrain;
    DpSim*     sim;
    DpPlants*  plants;  // NULL: bare ground
    Film       film[DP_FILMS];
    long       tile_x, tile_y;    // lowest tile of the frames
    int        tiles_x, tiles_y;  // 0 = no frames opened
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

// py_ground.c: what arrays and tuples say; NULL or false with an exception.
// Soils are rows of six floats in the order of DpSoil; the caller frees them. A ground is
// ("flat", z) | ("heights", array, spacing, x0, y0, kinds) | ("mesh", vertices, triangles, kinds).
DpSoil* dp_py_soils(DpDoor* door, PyObject* object, int* count);
bool    dp_py_ground(DpDoor* door, PyObject* tuple, DpGround* ground);

// py_plants.c: 21 numbers of DpPlantKind; 0 or -1 with an exception.
int dp_py_kind(DpDoor* door, PyObject* object, DpPlantKind* kind);

// py_meadow.c
PyObject* dp_py_open_plants(PyObject* object, PyObject* args);
PyObject* dp_py_plant(PyObject* object, PyObject* args);
PyObject* dp_py_rest_plants(PyObject* object, PyObject* args);
PyObject* dp_py_read_plants(PyObject* object, PyObject* args);
PyObject* dp_py_read_lean(PyObject* object, PyObject* args);

// py_frames.c
DpStatus  dp_py_finish_frame(Film* film);  // waits for the frame that is being written
void      dp_py_drop_frames(Simulation* self);
PyObject* dp_py_open_frames(PyObject* object, PyObject* args);
PyObject* dp_py_write_frame(PyObject* object, PyObject* args);
PyObject* dp_py_flush(PyObject* object, PyObject* unused);

// py_place.c
PyObject* dp_py_place(PyObject* object, PyObject* args);
