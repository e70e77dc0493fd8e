// python/py_soil.c - the three kernels of the soil, for tests and for those who bring their own
// ground.
//
//   soil_compress(patch, imprint, foot, law, dt)                          -> dict of DpPressed
//   soil_accumulate(patch, imprint, foot, volume, law, rim_width, threshold, height) -> height
//   soil_stabilize(patch, imprint | None, within | None, tolerance, most)  -> dict of DpSettled
//   soil_rebound(patch, imprint | None) -> volume that came back [m^3]
//   soil_noise(cell, x0, y0, i0, j0, longest, shortest, seed, out)
//   soil_anisotropy((x, y, z), threshold) -> beta;   soil_numbers() -> the table of base/soil_numbers.h
//
// patch   = (cell, x0, y0, rest, compression, heap, pressure_time, modulus, rest_slope, kind,
// soils[, wall_slope[, uneven[, spring[, plate]]]])
// imprint = (bottom, cover, ring); foot = (3, 3) float64: force, point, normal. Grids are
// float32 (ny, nx), kind uint8, ring int32, soils a list of dicts of numbers by name.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/noise.h"
#include "python/numbers.h"
#include "python/py_inside.h"
#include "soil/soil.h"

// What a call works with; zero it, open it, close it.
typedef struct Call
{
    DpBuffers      buffers;
    DpSoilPatch    patch;
    DpImprint      imprint;
    DpFootForce    foot;
    DpSoil*        soils;
    DpSoilScratch* scratch;
} Call;

static void close_call(Call* call)
{
    dp_buffers_close(&call->buffers);
    dp_free(call->soils);
    dp_soil_scratch_destroy(call->scratch);
}

static int open_soils(Call* call, PyObject* object)
{
    call->soils = dp_py_soils(object, 255, &call->patch.soil_count);
    call->patch.soils = call->soils;
    return call->soils ? 0 : -1;
}

// numbers the kernels count on: no NaN but in `rest`, nothing below its range, soils that are there
static int check_grids(const DpSoilPatch* patch)
{
    const size_t cells = (size_t)patch->nx * (size_t)patch->ny;
    for (size_t k = 0; k < cells; ++k) {
        const char* bad = NULL;
        if (isinf(patch->base_height[k])) bad = "rest";
        if (!(patch->compression[k] >= 0.0f) || isinf(patch->compression[k])) bad = "compression";
        if (!(patch->heap[k] >= 0.0f) || isinf(patch->heap[k])) bad = "heap";
        if (!isfinite(patch->pressure_time[k])) bad = "pressure_time";
        if (!(patch->modulus[k] > 0.0f) || isinf(patch->modulus[k])) bad = "modulus";
        if (!(patch->rest_slope[k] > 0.0f) || isinf(patch->rest_slope[k])) bad = "rest_slope";
        if (patch->kind[k] >= patch->soil_count) bad = "kind";
        if (patch->wall_slope && !(patch->wall_slope[k] > 0.0f)) bad = "wall_slope";
        if (patch->uneven && !isfinite(patch->uneven[k])) bad = "uneven";
        if (patch->spring && !isfinite(patch->spring[k])) bad = "spring";
        if (!bad) continue;
        PyErr_Format(PyExc_ValueError, "%s: element %zu is out of its range", bad, k);
        return -1;
    }
    return 0;
}

static int open_patch(Call* call, PyObject* object, DpShape* shape)
{
    DpSoilPatch* patch = &call->patch;
    DpBuffers*   buffers = &call->buffers;
    PyObject *   rest, *compression, *heap, *pressure_time, *modulus, *rest_slope, *kind, *soils;
    PyObject *   walls = NULL, *uneven = NULL, *spring = NULL, *plate = NULL;
    if (!PyTuple_Check(object)) {
        PyErr_SetString(PyExc_TypeError, "patch: expected a tuple");
        return -1;
    }
    if (!PyArg_ParseTuple(object, "dddOOOOOOOO|OOOO:patch", &patch->cell, &patch->x0, &patch->y0,
                          &rest, &compression, &heap, &pressure_time, &modulus, &rest_slope, &kind,
                          &soils, &walls, &uneven, &spring, &plate))
        return -1;
    if (!(patch->cell > 0.0) || !isfinite(patch->cell) || !isfinite(patch->x0) ||
        !isfinite(patch->y0)) {
        PyErr_SetString(PyExc_ValueError, "patch: cell must be > 0, x0 and y0 finite");
        return -1;
    }
    if (!(patch->base_height = dp_buffers_open(buffers, rest, "rest", 'f', shape, false)) ||
        !(patch->compression =
              dp_buffers_open(buffers, compression, "compression", 'f', shape, true)) ||
        !(patch->heap = dp_buffers_open(buffers, heap, "heap", 'f', shape, true)) ||
        !(patch->pressure_time =
              dp_buffers_open(buffers, pressure_time, "pressure_time", 'f', shape, true)) ||
        !(patch->modulus = dp_buffers_open(buffers, modulus, "modulus", 'f', shape, false)) ||
        !(patch->rest_slope =
              dp_buffers_open(buffers, rest_slope, "rest_slope", 'f', shape, false)) ||
        !(patch->kind = dp_buffers_open(buffers, kind, "kind", 'B', shape, false)) ||
        (walls &&
         !(patch->wall_slope = dp_buffers_open(buffers, walls, "wall_slope", 'f', shape, false))) ||
        (uneven &&
         !(patch->uneven = dp_buffers_open(buffers, uneven, "uneven", 'f', shape, false))) ||
        (spring &&
         !(patch->spring = dp_buffers_open(buffers, spring, "spring", 'f', shape, true))) ||
        (plate && !(patch->plate = dp_buffers_open(buffers, plate, "plate", 'i', shape, false))))
        return -1;
    if (shape->n[0] < 1 || shape->n[1] < 1 || shape->n[0] > 32768 || shape->n[1] > 32768) {
        PyErr_SetString(PyExc_ValueError, "rest: expected 1 to 32768 cells a side");
        return -1;
    }
    patch->ny = (int)shape->n[0];
    patch->nx = patch->row = (int)shape->n[1];
    if (open_soils(call, soils) < 0) return -1;
    return check_grids(patch);
}

static int open_imprint(Call* call, PyObject* object, DpShape* shape)
{
    DpImprint* imprint = &call->imprint;
    PyObject * bottom, *cover, *ring;
    if (!PyTuple_Check(object)) {
        PyErr_SetString(PyExc_TypeError, "imprint: expected a tuple");
        return -1;
    }
    if (!PyArg_ParseTuple(object, "OOO:imprint", &bottom, &cover, &ring)) return -1;
    if (!(imprint->bottom = dp_buffers_open(&call->buffers, bottom, "bottom", 'f', shape, false)) ||
        !(imprint->cover = dp_buffers_open(&call->buffers, cover, "cover", 'f', shape, false)) ||
        !(imprint->ring = dp_buffers_open(&call->buffers, ring, "ring", 'i', shape, true)))
        return -1;
    const int nx = call->patch.nx, ny = call->patch.ny;
    imprint->i0 = nx, imprint->i1 = 0, imprint->j0 = ny, imprint->j1 = 0;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const size_t p = (size_t)j * (size_t)nx + (size_t)i;
            const float  cover_here = imprint->cover[p];
            if (!(cover_here >= 0.0f && cover_here <= 1.0f) ||
                (cover_here > 0.0f && !isfinite(imprint->bottom[p]))) {
                PyErr_Format(PyExc_ValueError, "cover, bottom: element %zu is out of its range", p);
                return -1;
            }
            if (!(cover_here > 0.0f)) continue;
            imprint->i0 = i < imprint->i0 ? i : imprint->i0;
            imprint->i1 = i >= imprint->i1 ? i + 1 : imprint->i1;
            imprint->j0 = j < imprint->j0 ? j : imprint->j0;
            imprint->j1 = j + 1;
        }
    return 0;
}

static int open_foot(Call* call, PyObject* object)
{
    const double* v = dp_buffers_open(&call->buffers, object, "foot", 'd', DP_SHAPE2(3, 3), false);
    if (!v || dp_buffers_finite(v, 9, "foot") < 0) return -1;
    call->foot = (DpFootForce){{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
    return 0;
}

static int open_call(Call* call, PyObject* patch, PyObject* imprint, PyObject* foot)
{
    DpShape shape = {2, {-1, -1}};
    memset(call, 0, sizeof *call);
    if (open_patch(call, patch, &shape) < 0) return -1;
    if (imprint && open_imprint(call, imprint, &shape) < 0) return -1;
    if (foot && open_foot(call, foot) < 0) return -1;
    call->scratch = dp_soil_scratch_create();
    if (call->scratch) return 0;
    PyErr_NoMemory();
    return -1;
}

static PyObject* soil_compress(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *patch, *imprint, *foot, *result = NULL;
    int       law;
    double    dt;
    Call      call;
    if (!PyArg_ParseTuple(arguments, "OOOid:soil_compress", &patch, &imprint, &foot, &law, &dt))
        return NULL;
    if (law != DP_CONTACT_SOLE && law != DP_CONTACT_UNIFORM)
        return PyErr_Format(PyExc_ValueError, "law: expected 0 (sole) or 1 (uniform), got %d", law);
    if (open_call(&call, patch, imprint, foot) == 0) {
        DpPressed p;
        DpStatus  status;
        Py_BEGIN_ALLOW_THREADS
        status =
            dp_soil_compress(&call.patch, &call.imprint, &call.foot, (DpContactLaw)law, dt, &p);
        Py_END_ALLOW_THREADS
        result =
            status != DP_OK
                ? dp_py_because(
                      status, "pressing soil",
                      "dt must be above 0 s and finite, and force and normal make a finite load")
                : Py_BuildValue("{s:d,s:d,s:d,s:d,s:d,s:d,s:d}", "firm", p.firm, "elastic",
                                p.elastic, "loose", p.loose, "displaced", p.displaced, "area",
                                p.area, "sink", p.sink, "deepest", p.deepest);
    }
    close_call(&call);
    return result;
}

static PyObject* soil_carve(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *patch, *imprint, *result = NULL;
    DpDescent d;
    double    dt;
    Call      call;
    if (!PyArg_ParseTuple(arguments, "OO(dddd)d:soil_carve", &patch, &imprint, &d.at, &d.along_x,
                          &d.along_y, &d.along_z, &dt))
        return NULL;
    if (open_call(&call, patch, imprint, NULL) == 0) {
        DpCarved       c;
        const DpStatus status = dp_soil_carve(&call.patch, &call.imprint, &d, dt, &c);
        result =
            status != DP_OK
                ? dp_py_because(status, "carving soil", "dt must be above 0 s and finite")
                : Py_BuildValue("{s:d,s:d,s:d,s:d,s:d,s:d}", "firm", c.pressed.firm, "loose",
                                c.pressed.loose, "displaced", c.pressed.displaced, "area",
                                c.pressed.area, "cut_firm", c.cut_firm, "cut_loose", c.cut_loose);
    }
    close_call(&call);
    return result;
}

static PyObject* soil_accumulate(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *    patch, *imprint, *foot, *result = NULL;
    int           law;
    double        volume, height;
    DpHeapOptions options;
    Call          call;
    if (!PyArg_ParseTuple(arguments, "OOOdiddd:soil_accumulate", &patch, &imprint, &foot, &volume,
                          &law, &options.rim_width, &options.threshold, &height))
        return NULL;
    if (law != DP_HEAP_REST && law != DP_HEAP_PAPER)
        return PyErr_Format(PyExc_ValueError, "law: expected 0 (rest) or 1 (paper), got %d", law);
    options.law = (DpHeapLaw)law;
    options.cut = (DpVec3){0.0, 0.0, 0.0};
    if (open_call(&call, patch, imprint, foot) == 0) {
        DpStatus status;
        Py_BEGIN_ALLOW_THREADS
        status = dp_soil_accumulate(&call.patch, &call.imprint, &call.foot, volume, &options,
                                    &height, call.scratch);
        Py_END_ALLOW_THREADS
        result = status != DP_OK
                     ? dp_py_because(
                           status, "laying soil",
                           "volume and height must be 0 or more, rim_width and threshold above 0")
                     : PyFloat_FromDouble(height);
    }
    close_call(&call);
    return result;
}

static PyObject* soil_stabilize(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject * patch, *imprint, *within, *result = NULL;
    int        most;
    DpCellRect box = {0};
    double     tolerance;
    Call       call;
    if (!PyArg_ParseTuple(arguments, "OOOdi:soil_stabilize", &patch, &imprint, &within, &tolerance,
                          &most))
        return NULL;
    if (within != Py_None &&
        (!PyTuple_Check(within) ||
         !PyArg_ParseTuple(within, "llll:within", &box.i0, &box.i1, &box.j0, &box.j1))) {
        if (!PyErr_Occurred())
            PyErr_SetString(PyExc_TypeError, "within: expected (i0, i1, j0, j1)");
        return NULL;
    }
    const bool stands = imprint != Py_None;
    if (open_call(&call, patch, stands ? imprint : NULL, NULL) == 0) {
        DpSettled s;
        DpStatus  status;
        Py_BEGIN_ALLOW_THREADS
        status =
            dp_soil_stabilize(&call.patch, stands ? &call.imprint : NULL,
                              within == Py_None ? NULL : &box, tolerance, most, call.scratch, &s);
        Py_END_ALLOW_THREADS
        result =
            status != DP_OK
                ? dp_py_because(status, "letting soil come to rest",
                                "tolerance must be above 0 and below 1 rad, max_sweeps 0 or more")
                : Py_BuildValue("{s:i,s:N,s:N,s:d,s:(llll)}", "sweeps", s.sweeps, "at_rest",
                                PyBool_FromLong(s.at_rest), "at_edge", PyBool_FromLong(s.at_edge),
                                "loosened", s.loosened, "changed", s.changed.i0, s.changed.i1,
                                s.changed.j0, s.changed.j1);
    }
    close_call(&call);
    return result;
}

static PyObject* soil_anisotropy(PyObject* module, PyObject* arguments)
{
    (void)module;
    DpVec3 push;
    double threshold;
    if (!PyArg_ParseTuple(arguments, "(ddd)d:soil_anisotropy", &push.x, &push.y, &push.z,
                          &threshold))
        return NULL;
    return PyFloat_FromDouble(dp_soil_anisotropy(push, threshold));
}

static PyObject* soil_rebound(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *patch, *imprint, *result = NULL;
    Call      call;
    if (!PyArg_ParseTuple(arguments, "OO:soil_rebound", &patch, &imprint)) return NULL;
    const bool stands = imprint != Py_None;
    if (open_call(&call, patch, stands ? imprint : NULL, NULL) == 0)
        result = PyFloat_FromDouble(dp_soil_rebound(&call.patch, stands ? &call.imprint : NULL));
    close_call(&call);
    return result;
}

static PyObject* soil_noise(PyObject* module, PyObject* arguments)
{
    (void)module;
    DpGrid    grid;
    long      i0, j0;
    double    longest, shortest;
    int       seed;
    PyObject* object;
    if (!PyArg_ParseTuple(arguments, "dddllddiO:soil_noise", &grid.cell, &grid.x0, &grid.y0, &i0,
                          &j0, &longest, &shortest, &seed, &object))
        return NULL;
    const bool bounded = fabs(grid.x0) < 1e9 && fabs(grid.y0) < 1e9 && labs(i0) < 1000000000 &&
                         labs(j0) < 1000000000 && grid.cell <= 100.0 && longest <= 1e4;
    if (!(grid.cell >= 1e-4 && longest >= 1e-4 && shortest >= 0.0) || !bounded)
        return PyErr_Format(PyExc_ValueError,
                            "soil_noise: cells or lengths are out of their range");
    DpBuffers buffers = {.count = 0};
    DpShape   shape = {2, {-1, -1}};
    float*    out = dp_buffers_open(&buffers, object, "out", 'f', &shape, true);
    if (out) {
        const DpCellRect cells = dp_cells(i0, j0, (long)shape.n[1], (long)shape.n[0]);
        if (shortest > 0.0)
            dp_noise_waves(&grid, cells, longest, fmax(shortest, 1e-4), (uint32_t)seed, out);
        else
            dp_noise_pieces(&grid, cells, longest, (uint32_t)seed, out);
    }
    dp_buffers_close(&buffers);
    if (!out) return NULL;
    Py_RETURN_NONE;
}

static PyObject* soil_default(PyObject* module, PyObject* arguments)
{
    (void)module, (void)arguments;
    int             count;
    const DpNumber* number = dp_soil_numbers(&count);
    PyObject*       row = PyTuple_New(count);
    for (int k = 0; row && k < count; ++k) {
        PyObject* value = PyFloat_FromDouble(number[k].usual);
        if (!value || PyTuple_SetItem(row, k, value) < 0) Py_CLEAR(row);
    }
    return row;
}

static PyObject* soil_numbers(PyObject* module, PyObject* arguments)
{
    (void)module, (void)arguments;
    int             count;
    const DpNumber* table = dp_soil_numbers(&count);
    return dp_py_numbers(table, count);
}

PyMethodDef dp_py_soil_methods[] = {
    {"soil_compress", soil_compress, METH_VARARGS, "Press a sole into a patch for dt seconds."},
    {"soil_carve", soil_carve, METH_VARARGS, "Push the surface of a patch down to a body."},
    {"soil_accumulate", soil_accumulate, METH_VARARGS, "Lay displaced soil around a sole."},
    {"soil_stabilize", soil_stabilize, METH_VARARGS, "Let loose soil slide until it rests."},
    {"soil_anisotropy", soil_anisotropy, METH_VARARGS, "How one-sided the heap is, TRAIL (13)."},
    {"soil_rebound", soil_rebound, METH_VARARGS,
     "Let ground from which soles have gone come back; the volume that did [m^3]."},
    {"soil_noise", soil_noise, METH_VARARGS,
     "soil_noise(cell, x0, y0, i0, j0, longest, shortest, seed, out): waves of a place's chance on "
     "cells (ny, nx) from (i0, j0) on, or of pieces `longest` wide where shortest is 0."},
    {"soil_default", soil_default, METH_NOARGS,
     "soil_default() -> the numbers of a soil as they are if not told, in the order of "
     "soil_numbers()."},
    {"soil_numbers", soil_numbers, METH_NOARGS,
     "soil_numbers() -> ((name, unit, low, high, default, meaning), ..) of a soil, in order."},
    {NULL, NULL, 0, NULL}};
