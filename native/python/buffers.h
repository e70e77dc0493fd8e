// python/buffers.h - buffers and errors at the seam between Python and the core.
#pragma once
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <stdbool.h>

#include "base/status.h"
#include "base/types.h"

// Arrays opened from Python objects. Zero it, open into it, close it: everything is released.
#define DP_MAX_BUFFERS 64
typedef struct DpBuffers
{
    Py_buffer view[DP_MAX_BUFFERS];
    int       count;
} DpBuffers;

// What an array must be. Shape entries < 0 match any length and are filled in with what is there.
typedef struct DpShape
{
    int        ndim;
    Py_ssize_t n[4];
} DpShape;

#define DP_SHAPE1(a) (&(DpShape){1, {a}})
#define DP_SHAPE2(a, b) (&(DpShape){2, {a, b}})
#define DP_SHAPE3(a, b, c) (&(DpShape){3, {a, b, c}})

// Pointer to the array's first element, or NULL with a TypeError or ValueError set that names it.
// @param type   'f' float32, 'd' float64, 'i' int32, 'B' uint8
// @param write  the core changes it
// C order always. Keep `shape` to read the lengths; the macros above are for lengths known before.
void* dp_buffers_open(DpBuffers* buffers, PyObject* object, const char* name, char type,
                      DpShape* shape, bool write);
void  dp_buffers_close(DpBuffers* buffers);

// 0 if every double is finite, else -1 with a ValueError naming `name` and the first bad index.
int dp_buffers_finite(const double* value, Py_ssize_t count, const char* name);

// Set the Python exception for a status (`what` is a lower-case clause: "writing maps") and return
// NULL. DP_OK: return None.
PyObject* dp_py_result(DpStatus status, const char* what);

// The same; where it is a bad argument, `why` says which of them and what it must be, as a lower-case clause.
PyObject* dp_py_because(DpStatus status, const char* what, const char* why);

// Open a gait given as the tuple (time, com, mass, pose, limb_walker, part_limb, point, point_part,
// point_role); 0, or -1 with an exception. It is valid until the buffers is closed.
int dp_py_gait(DpBuffers* buffers, PyObject* tuple, DpGait* gait);

// Memory of dp_alloc as an object of the type `_native.Block`, which frees it: a buffer of bytes, for
// numpy.frombuffer. NULL with an exception, and the memory freed, when there is none.
PyObject* dp_py_block(PyObject* module, void* memory, size_t size);
int       dp_py_block_type(PyObject* module);  // adds the type to the module; 0 or -1

// Each py_<room>.c has one of these tables; module.c adds them all.
extern PyMethodDef dp_py_walker_methods[];
extern PyMethodDef dp_py_imprint_methods[];
extern PyMethodDef dp_py_soil_methods[];
extern PyMethodDef dp_py_kind_methods[];
extern PyMethodDef dp_py_plants_methods[];
extern PyMethodDef dp_py_terrain_methods[];
extern PyMethodDef dp_py_maps_methods[];
extern PyMethodDef dp_py_refine_methods[];
extern PyMethodDef dp_py_paths_methods[];
extern PyMethodDef dp_py_base_methods[];
extern PyMethodDef dp_py_spray_methods[];

// py_sim.c, py_frames.c: add a type to the module; 0 or -1 with an exception.
int dp_py_sim_type(PyObject* module);
int dp_py_film_type(PyObject* module);
