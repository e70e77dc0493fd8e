// python/py_maps.c - maps_write and maps_read: named float32 planes to and from OpenEXR files.
#include <string.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "maps/maps.h"
#include "python/buffers.h"
#include "python/py_inside.h"

// A sequence's items as a tuple that holds them; NULL with a TypeError naming it.
static PyObject* items_of(PyObject* object, const char* name)
{
    PyObject* items = PySequence_Tuple(object);
    if (!items) PyErr_Format(PyExc_TypeError, "%s: expected a list", name);
    return items;
}

// A str's UTF-8 text, without a zero inside; NULL with an exception naming it.
static const char* text_of(PyObject* object, const char* name)
{
    if (!object || !PyUnicode_Check(object)) {
        PyErr_Format(PyExc_TypeError, "%s: expected a str", name);
        return NULL;
    }
    Py_ssize_t  length;
    const char* text = PyUnicode_AsUTF8AndSize(object, &length);
    if (text && strlen(text) != (size_t)length) {
        PyErr_Format(PyExc_ValueError, "%s: holds a zero character", name);
        return NULL;
    }
    return text;
}

// ---- writing ------------------------------------------------------------------------------------

static int fill_notes(PyObject* items, DpNote* notes)
{
    const Py_ssize_t count = PyTuple_Size(items);
    for (Py_ssize_t k = 0; k < count; ++k) {
        PyObject* pair = PyTuple_GetItem(items, k);
        if (!PyTuple_Check(pair) || PyTuple_Size(pair) != 2) {
            PyErr_Format(PyExc_TypeError, "notes: element %zd is not a tuple (name, value)", k);
            return -1;
        }
        PyObject* value = PyTuple_GetItem(pair, 1);
        notes[k].name = text_of(PyTuple_GetItem(pair, 0), "a note's name");
        if (!notes[k].name) return -1;
        if (PyUnicode_Check(value)) {
            notes[k].text = text_of(value, notes[k].name);
            if (!notes[k].text) return -1;
        } else {
            notes[k].number = PyFloat_AsDouble(value);
            if (PyErr_Occurred()) return -1;
        }
    }
    return 0;
}

DpNote* dp_py_notes(PyObject* items)
{
    DpNote* notes = dp_alloc((size_t)PyTuple_Size(items) + 1, sizeof *notes);
    if (!notes) {
        PyErr_NoMemory();
    } else if (fill_notes(items, notes) < 0) {
        dp_free(notes);
        notes = NULL;
    }
    return notes;
}

static int fill_channels(PyObject* names, PyObject* planes, DpBuffers* buffers,
                         DpMapChannel* channels, DpShape* shape)
{
    const Py_ssize_t count = PyTuple_Size(names);
    for (Py_ssize_t k = 0; k < count; ++k) {
        channels[k].name = text_of(PyTuple_GetItem(names, k), "a plane's name");
        if (!channels[k].name) return -1;
        channels[k].value = dp_buffers_open(buffers, PyTuple_GetItem(planes, k), channels[k].name,
                                            'f', shape, false);
        if (!channels[k].value) return -1;
    }
    return 0;
}

static bool call(void* context, int j)
{
    PyObject* found = PyObject_CallFunction((PyObject*)context, "i", j);
    Py_XDECREF(found);
    return found != NULL;
}

// Files of planes that hold some rows at a time, which a function of Python's fills; NULL: they hold all.
static DpStatus write_rows(const char* file, const DpShape* shape, PyObject* fill, int ny,
                           const DpMapChannel* channel, int count, const DpNote* note, int notes)
{
    const DpMapRows rows = {call, fill};
    DpStatus        status;
    const int       nx = (int)shape->n[1];
    if (fill) {
        if (shape->n[0] != DP_TILE) return DP_BAD_ARGUMENT;
        return dp_maps_write_rows(file, nx, ny, channel, count, note, notes, &rows);
    }
    Py_BEGIN_ALLOW_THREADS
    status = dp_maps_write(file, nx, (int)shape->n[0], channel, count, note, notes);
    Py_END_ALLOW_THREADS
    return status;
}

static PyObject* maps_write(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *   path = NULL, *names, *planes, *notes, *fill = NULL, *done = NULL;
    int          ny = 0;
    DpNote*      note = NULL;
    DpBuffers    buffers = {.count = 0};
    DpMapChannel channel[DP_MAX_BUFFERS];
    DpShape      shape = {2, {-1, -1}};
    if (!PyArg_ParseTuple(arguments, "O&OOO|Oi:maps_write", PyUnicode_FSConverter, &path, &names,
                          &planes, &notes, &fill, &ny))
        return NULL;
    names = items_of(names, "names");
    planes = names ? items_of(planes, "planes") : NULL;
    notes = planes ? items_of(notes, "notes") : NULL;
    if (!notes) goto leave;
    const Py_ssize_t count = PyTuple_Size(names), note_count = PyTuple_Size(notes);
    if (count < 1 || count > DP_MAX_BUFFERS || count != PyTuple_Size(planes)) {
        PyErr_Format(PyExc_ValueError, "expected 1 to %d names and as many planes", DP_MAX_BUFFERS);
        goto leave;
    }
    note = dp_py_notes(notes);
    if (!note || fill_channels(names, planes, &buffers, channel, &shape)) goto leave;
    if (shape.n[0] > INT32_MAX || shape.n[1] > INT32_MAX || note_count > INT32_MAX) {
        dp_py_result(DP_BAD_ARGUMENT, "writing maps");
        goto leave;
    }
    const DpStatus status = write_rows(PyBytes_AsString(path), &shape, fill, ny, channel,
                                       (int)count, note, (int)note_count);
    if (!PyErr_Occurred()) done = dp_py_result(status, "writing maps");
leave:
    dp_buffers_close(&buffers);
    dp_free(note);
    Py_XDECREF(notes);
    Py_XDECREF(planes);
    Py_XDECREF(names);
    Py_XDECREF(path);
    return done;
}

// ---- reading ------------------------------------------------------------------------------------

static PyObject* str_of(const char* text)
{
    return PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "replace");
}

static PyObject* names_of(const DpMapFile* map)
{
    PyObject* names = PyTuple_New(map->channel_count);
    for (int c = 0; names && c < map->channel_count; ++c) {
        PyObject* name = str_of(map->channel[c]);
        if (!name || PyTuple_SetItem(names, c, name) < 0) Py_CLEAR(names);
    }
    return names;
}

static PyObject* notes_of(const DpMapFile* map)
{
    PyObject* notes = PyTuple_New(map->note_count);
    for (int k = 0; notes && k < map->note_count; ++k) {
        PyObject* name = str_of(map->note_name[k]);
        PyObject* value =
            map->note_text[k] ? str_of(map->note_text[k]) : PyFloat_FromDouble(map->note_number[k]);
        PyObject* pair = name && value ? PyTuple_Pack(2, name, value) : NULL;
        Py_XDECREF(name);
        Py_XDECREF(value);
        if (!pair || PyTuple_SetItem(notes, k, pair) < 0) Py_CLEAR(notes);
    }
    return notes;
}

static PyObject* maps_read(PyObject* module, PyObject* path)
{
    (void)module;
    PyObject* name = NULL;
    if (!PyUnicode_FSConverter(path, &name)) return NULL;
    const char* file = PyBytes_AsString(name);
    DpMapFile*  map = NULL;
    DpStatus    status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_maps_read(file, &map);
    Py_END_ALLOW_THREADS
    Py_DECREF(name);
    if (status != DP_OK) return dp_py_result(status, "reading maps");

    const size_t size = (size_t)map->channel_count * (size_t)map->ny * (size_t)map->nx * 4;
    PyObject*    names = names_of(map);
    PyObject*    notes = names ? notes_of(map) : NULL;
    PyObject*    data =
        notes ? PyByteArray_FromStringAndSize((const char*)map->value, (Py_ssize_t)size) : NULL;
    PyObject* all = data ? Py_BuildValue("(iiOOO)", map->nx, map->ny, names, data, notes) : NULL;
    Py_XDECREF(names);
    Py_XDECREF(notes);
    Py_XDECREF(data);
    dp_map_file_destroy(map);
    return all;
}

// ---- planes at points ---------------------------------------------------------------------------

static PyObject* planes_at(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *o_planes, *o_points, *o_place, *o_out;
    DpPlanes  planes;
    DpPoints  points = {0};
    if (!PyArg_ParseTuple(arguments, "OddddOOO:planes_at", &o_planes, &planes.x0, &planes.y0,
                          &planes.cell, &planes.still, &o_points, &o_place, &o_out))
        return NULL;
    PyObject* items = items_of(o_planes, "planes");
    if (!items) return NULL;
    DpBuffers        buffers = {.count = 0};
    DpShape          cells = {2, {-1, -1}}, shape = {2, {-1, 3}};
    PyObject*        done = NULL;
    const float*     plane[DP_MAX_BUFFERS];
    const Py_ssize_t count = PyTuple_Size(items);
    if (count < 1 || count > DP_MAX_BUFFERS - 3) {
        PyErr_SetString(PyExc_ValueError, "planes_at: too few or too many planes");
        goto leave;
    }
    for (Py_ssize_t p = 0; p < count; ++p) {
        plane[p] =
            dp_buffers_open(&buffers, PyTuple_GetItem(items, p), "a plane", 'f', &cells, false);
        if (!plane[p]) goto leave;
    }
    if (o_place == Py_None) {
        points.world = dp_buffers_open(&buffers, o_points, "points", 'd', &shape, false);
        if (!points.world) goto leave;
    } else {
        points.local = dp_buffers_open(&buffers, o_points, "points", 'f', &shape, false);
        if (!points.local) goto leave;
        points.place = dp_buffers_open(&buffers, o_place, "place", 'd', DP_SHAPE2(3, 4), false);
        if (!points.place) goto leave;
    }
    float* out = dp_buffers_open(&buffers, o_out, "out", 'f', DP_SHAPE2(count, shape.n[0]), true);
    if (!out) goto leave;
    if (cells.n[0] > INT32_MAX || cells.n[1] > INT32_MAX || shape.n[0] > INT32_MAX - 65536 ||
        !(planes.cell > 0.0)) {
        dp_py_result(DP_BAD_ARGUMENT, "looking at planes");
        goto leave;
    }
    planes.nx = (int)cells.n[1], planes.ny = (int)cells.n[0], planes.count = (int)count;
    planes.plane = plane;
    points.count = (int)shape.n[0];
    Py_BEGIN_ALLOW_THREADS
    dp_planes_at(&planes, &points, dp_parallel_width(), out);
    Py_END_ALLOW_THREADS
    done = Py_NewRef(Py_None);
leave:
    dp_buffers_close(&buffers);
    Py_DECREF(items);
    return done;
}

PyMethodDef dp_py_maps_methods[] = {
    {"planes_at", planes_at, METH_VARARGS,
     "planes_at(planes, x0, y0, cell, still, points, place, out)\n\nAdd to out float32 (planes, n) "
     "what planes, float32 (ny, nx), say at points: float64 (n, 3) of the world with place None, "
     "or "
     "float32 (n, 3) of an object's own space with place float64 (3, 4). Points nearer than "
     "`still` "
     "cells to a centre lie on it."},
    {"maps_write", maps_write, METH_VARARGS,
     "maps_write(path, names, planes, notes)\n\nWrite float32 (ny, nx) planes, row 0 = lowest y, "
     "as "
     "channels of one OpenEXR file; notes is a list of (name, str or float) for its header."},
    {"maps_read", maps_read, METH_O,
     "maps_read(path) -> (nx, ny, names, data, notes)\n\ndata is a bytearray of float32 "
     "(len(names), ny, nx), row 0 = lowest y."},
    {NULL, NULL, 0, NULL}};
