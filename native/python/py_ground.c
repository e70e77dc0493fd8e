// python/py_ground.c - the ground and its soils as Python gives them.
#include "base/alloc.h"
#include "python/numbers.h"
#include "python/py_inside.h"

#include <stdio.h>
#include <string.h>

// a dict of its numbers by name; those that are not given are as usual
static int read_soil(PyObject* object, Py_ssize_t place, DpSoil* soil)
{
    char            what[48];
    int             count;
    DpReason        reason;
    const DpNumber* table = dp_soil_numbers(&count);
    snprintf(what, sizeof what, "soils: soil %ld", (long)place);
    *soil = dp_soil_default();
    if (dp_py_read_numbers(object, what, table, count, soil) < 0) return -1;
    if (dp_soil_check(soil, &reason) == DP_OK) return 0;
    PyErr_Format(PyExc_ValueError, "%s: %s", what, reason.text);
    return -1;
}

// Soils, each a dict of numbers by name; 1 to `most`.
DpSoil* dp_py_soils(PyObject* object, int max_count, int* count)
{
    const Py_ssize_t size = PySequence_Size(object);
    if (size < 0) return NULL;
    if (size < 1 || size > max_count) {
        PyErr_Format(PyExc_ValueError, "soils: give 1 to %d soils", max_count);
        return NULL;
    }
    *count = (int)size;
    DpSoil* soils = dp_alloc((size_t)size, sizeof *soils);
    if (!soils) {
        PyErr_NoMemory();
        return NULL;
    }
    for (Py_ssize_t s = 0; s < size; ++s) {
        PyObject* one = PySequence_GetItem(object, s);
        const int read = one ? read_soil(one, s, &soils[s]) : -1;
        Py_XDECREF(one);
        if (read == 0) continue;
        dp_free(soils);
        return NULL;
    }
    return soils;
}

// (soil, thickness, name, place) of a layer
static int read_layer(PyObject* object, Py_ssize_t place, DpLayer* layer)
{
    PyObject* soil = NULL;
    if (!PyTuple_Check(object)) {
        PyErr_SetString(PyExc_TypeError, "layers: expected tuples (soil, thickness, name, place)");
        return -1;
    }
    if (!PyArg_ParseTuple(object, "Odii:layers", &soil, &layer->thickness, &layer->name,
                          &layer->place))
        return -1;
    return read_soil(soil, place, &layer->soil);
}

// Those of one soil, after `count` of others; false with an exception.
static bool read_stack(PyObject* stack, Py_ssize_t place, DpLayer** layers, int* count)
{
    const Py_ssize_t size = PySequence_Size(stack);
    if (size < 0) return false;
    if (size > 4) {
        PyErr_SetString(PyExc_ValueError, "layers: give a soil no more than 4");
        return false;
    }
    for (Py_ssize_t n = 0; n < size; ++n, ++*count) {
        if (!dp_make_room(layers, (size_t)*count + 1, sizeof **layers)) {
            PyErr_NoMemory();
            return false;
        }
        PyObject* one = PySequence_GetItem(stack, n);
        const int read = one ? read_layer(one, place, &(*layers)[*count]) : -1;
        Py_XDECREF(one);
        if (read < 0) return false;
    }
    return true;
}

bool dp_py_layers(PyObject* object, int soil_count, DpLayer** layers, int** start)
{
    if (object == Py_None) return true;
    if (PySequence_Size(object) != soil_count) {
        if (!PyErr_Occurred())
            PyErr_SetString(PyExc_ValueError, "layers: give them for each of the soils");
        return false;
    }
    *start = dp_alloc((size_t)soil_count + 1, sizeof **start);
    if (!*start) return PyErr_NoMemory(), false;
    for (int k = 0; k < soil_count; ++k) {
        int        count = (*start)[k];
        PyObject*  stack = PySequence_GetItem(object, k);
        const bool read = stack && read_stack(stack, k, layers, &count);
        Py_XDECREF(stack);
        if (!read) return false;
        (*start)[k + 1] = count;
    }
    return true;
}

// The weights of painted soils, (kinds, n); None = all of it is soil 0.
static bool read_kinds(DpBuffers* buffers, PyObject* object, Py_ssize_t n, DpGround* ground)
{
    if (object == Py_None) return true;
    DpShape shape = {2, {-1, n}};
    ground->kind_weight = dp_buffers_open(buffers, object, "kind_weight", 'f', &shape, false);
    ground->kind_count = ground->kind_weight ? (int)shape.n[0] : 0;
    return ground->kind_weight != NULL;
}

// ("flat", z) | ("heights", array, spacing, x0, y0, height, kinds) | ("mesh", vertices, triangles, kinds)
bool dp_py_ground(DpBuffers* buffers, PyObject* tuple, DpGround* ground)
{
    const char* kind = NULL;
    PyObject *  a = NULL, *b = NULL, *kinds = Py_None;
    memset(ground, 0, sizeof *ground);
    PyObject* first = PyTuple_Check(tuple) ? PyTuple_GetItem(tuple, 0) : NULL;
    kind = first ? PyUnicode_AsUTF8AndSize(first, NULL) : NULL;
    if (!kind) {
        PyErr_SetString(PyExc_TypeError, "ground: expected a tuple that begins with its kind");
        return false;
    }
    if (strcmp(kind, "flat") == 0) {
        ground->kind = DP_GROUND_FLAT;
        return PyArg_ParseTuple(tuple, "sd;ground", &kind, &ground->height);
    }
    if (strcmp(kind, "heights") == 0) {
        ground->kind = DP_GROUND_HEIGHTS;
        if (!PyArg_ParseTuple(tuple, "sOddddO;ground", &kind, &a, &ground->spacing, &ground->x0,
                              &ground->y0, &ground->height, &kinds))
            return false;
        DpShape shape = {2, {-1, -1}};
        ground->heights = dp_buffers_open(buffers, a, "heights", 'f', &shape, false);
        if (!ground->heights) return false;
        if (shape.n[0] > INT32_MAX || shape.n[1] > INT32_MAX) {
            PyErr_SetString(PyExc_ValueError, "heights: too many samples");
            return false;
        }
        ground->ny = (int)shape.n[0], ground->nx = (int)shape.n[1];
        return read_kinds(buffers, kinds, shape.n[0] * shape.n[1], ground);
    }
    if (strcmp(kind, "mesh") == 0) {
        ground->kind = DP_GROUND_MESH;
        if (!PyArg_ParseTuple(tuple, "sOOO;ground", &kind, &a, &b, &kinds)) return false;
        DpShape vertices = {2, {-1, 3}}, triangles = {2, {-1, 3}};
        ground->vertex = dp_buffers_open(buffers, a, "vertices", 'd', &vertices, false);
        if (!ground->vertex) return false;
        ground->triangle = dp_buffers_open(buffers, b, "triangles", 'i', &triangles, false);
        if (!ground->triangle) return false;
        if (vertices.n[0] > INT32_MAX / 3 || triangles.n[0] > INT32_MAX / 3) {
            PyErr_SetString(PyExc_ValueError, "ground: too many vertices or triangles");
            return false;
        }
        ground->vertex_count = (int)vertices.n[0];
        ground->triangle_count = (int)triangles.n[0];
        return read_kinds(buffers, kinds, vertices.n[0], ground);
    }
    PyErr_Format(PyExc_ValueError, "ground: '%s' is not flat, heights or mesh", kind);
    return false;
}
