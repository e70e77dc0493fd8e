// python/py_inside.h - the simulation as Python holds it, and what the files of this room share of it.
#pragma once
#include "python/buffers.h"
#include "sim/sim.h"

typedef struct Simulation
{
    PyObject_HEAD
    DpTerrain* terrain;
    DpSim*     sim;
    DpPlants*  plants;  // NULL: bare ground
    DpReel*    reel;    // NULL: nothing is filmed yet
    int        workers;
    int        live_walkers, live_parts;  // of the live motion that is followed
    bool       busy;                      // a call without the GIL is under way
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
// Soils are dicts of numbers by name, or rows of all; the caller frees them. A ground is
// ("flat", z) | ("heights", array, spacing, x0, y0, height, kinds) | ("mesh", vertices, triangles, kinds).
DpSoil* dp_py_soils(PyObject* object, int max_count, int* count);
// Layers are for each soil a sequence of (soil, thickness), from the top down, or None: there are none.
bool dp_py_layers(PyObject* object, int soil_count, DpLayer** layers, int** start);
bool dp_py_ground(DpBuffers* buffers, PyObject* tuple, DpGround* ground);

// py_kind.c: a kind by its numbers' names; 0 or -1 with an exception.
int dp_py_kind(PyObject* object, DpPlantKind* kind);

// py_planting.c
PyObject* dp_py_open_plants(PyObject* object, PyObject* args);
PyObject* dp_py_plant(PyObject* object, PyObject* args);
PyObject* dp_py_vary_plants(PyObject* object, PyObject* args);
PyObject* dp_py_rest_plants(PyObject* object, PyObject* args);
PyObject* dp_py_read_plants(PyObject* object, PyObject* args);
PyObject* dp_py_lay_plants(PyObject* object, PyObject* unused);
PyObject* dp_py_read_shown(PyObject* object, PyObject* args);
PyObject* dp_py_read_lean(PyObject* object, PyObject* args);

// py_motion.c
PyObject* dp_py_load(PyObject* object, PyObject* args);
PyObject* dp_py_load_tracks(PyObject* object, PyObject* args);
PyObject* dp_py_load_live(PyObject* object, PyObject* args);
PyObject* dp_py_push(PyObject* object, PyObject* args);

// py_spray.c
PyObject* dp_py_spray(PyObject* object, PyObject* numbers);
PyObject* dp_py_grains(PyObject* object, PyObject* unused);
PyObject* dp_py_read_grains(PyObject* object, PyObject* args);
int       dp_py_add_spray(PyObject* numbers, const DpSimReport* report);  // to a dict; 0 or -1

// py_state.c
PyObject* dp_py_save_state(PyObject* object, PyObject* unused);
PyObject* dp_py_load_state(PyObject* object, PyObject* bytes);
PyObject* dp_py_join_state(PyObject* object, PyObject* args);
PyObject* dp_py_begin_at(PyObject* object, PyObject* args);
PyObject* dp_py_list_tiles(PyObject* object, PyObject* args);
PyObject* dp_py_reach_tiles(PyObject* object, PyObject* args);

// py_frames.c
PyObject* dp_py_open_frames(PyObject* object, PyObject* args);
PyObject* dp_py_flush(PyObject* object, PyObject* unused);

// py_maps.c: notes[k] from a tuple of (name, str or number), or NULL with an exception. The caller
// frees the array; what it points to lives as long as `items`.
DpNote* dp_py_notes(PyObject* items);

// py_terrain.c: a trail that another bake has left
PyObject* dp_py_lay(PyObject* object, PyObject* args);

// py_place.c
PyObject* dp_py_place(PyObject* object, PyObject* args);
