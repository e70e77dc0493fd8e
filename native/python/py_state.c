// python/py_state.c - what a simulation has become, as bytes.
#include "base/alloc.h"
#include "python/py_inside.h"

PyObject* dp_py_save_state(PyObject* object, PyObject* unused)
{
    Simulation*   self = (Simulation*)object;
    DpStateWriter writer = {0};
    DpStatus      status;
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_save_state(self->sim, &writer);
    Py_END_ALLOW_THREADS
    self->busy = false;
    PyObject* module = PyType_GetModule(Py_TYPE(object));
    if (status == DP_OK && module) return dp_py_block(module, writer.bytes, writer.size);
    dp_write_drop(&writer);
    return module ? dp_py_result(status, "saving the state") : NULL;
}

PyObject* dp_py_load_state(PyObject* object, PyObject* bytes)
{
    Simulation* self = (Simulation*)object;
    Py_buffer   view;
    DpStatus    status;
    if (PyObject_GetBuffer(bytes, &view, PyBUF_C_CONTIGUOUS) < 0) return NULL;
    PyObject* result = NULL;
    if (dp_py_enter(self)) {
        Py_BEGIN_ALLOW_THREADS
        status = dp_sim_load_state(self->sim, view.len ? view.buf : "", (size_t)view.len);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_result(status, "loading the state");
    }
    PyBuffer_Release(&view);
    return result;
}

PyObject* dp_py_join_state(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  o_bytes, *o_tiles, *o_walkers;
    Py_buffer   view;
    if (!PyArg_ParseTuple(args, "OOO:join_state", &o_bytes, &o_tiles, &o_walkers) ||
        PyObject_GetBuffer(o_bytes, &view, PyBUF_C_CONTIGUOUS) < 0)
        return NULL;
    DpBuffers   buffers = {.count = 0};
    DpShape     tiles = {2, {-1, 2}};
    DpStatePart part = {0};
    PyObject*   result = NULL;
    if ((part.tile = dp_buffers_open(&buffers, o_tiles, "tiles", 'i', &tiles, false)) &&
        (part.walkers = dp_buffers_open(&buffers, o_walkers, "walkers", 'B',
                                        DP_SHAPE1(dp_sim_walkers(self->sim)), false)) &&
        dp_py_enter(self)) {
        DpStatus status;
        part.tiles = (size_t)tiles.n[0];
        Py_BEGIN_ALLOW_THREADS
        status = dp_sim_join_state(self->sim, view.len ? view.buf : "", (size_t)view.len, &part);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_because(status, "joining a state",
                               "tiles must be in the state and not on the ground, which is bare, "
                               "before the first step");
    }
    dp_buffers_close(&buffers);
    PyBuffer_Release(&view);
    return result;
}

PyObject* dp_py_begin_at(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    int         sample;
    if (!PyArg_ParseTuple(args, "i:begin_at", &sample) || !dp_py_enter(self)) return NULL;
    const DpStatus status = dp_sim_begin_at(self->sim, sample);
    self->busy = false;
    return dp_py_because(status, "beginning",
                         "sample must be one of a recording, before the first step");
}

PyObject* dp_py_list_tiles(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject*   o_out;
    if (!PyArg_ParseTuple(args, "O:list_tiles", &o_out)) return NULL;
    DpBuffers buffers = {.count = 0};
    PyObject* result = NULL;
    int32_t*  out =
        dp_buffers_open(&buffers, o_out, "out", 'i',
                        DP_SHAPE2((Py_ssize_t)dp_terrain_tile_count(self->terrain), 2), true);
    if (out && dp_py_enter(self)) {
        dp_terrain_list(self->terrain, out);
        self->busy = false;
        result = dp_py_result(DP_OK, "");
    }
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_reach_tiles(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    long        tile_x, tile_y;
    PyObject*   o_out;
    if (!PyArg_ParseTuple(args, "llO:reach_tiles", &tile_x, &tile_y, &o_out)) return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   shape = {2, {-1, -1}};
    PyObject* result = NULL;
    uint8_t*  out = dp_buffers_open(&buffers, o_out, "out", 'B', &shape, true);
    if (out && (shape.n[0] > INT32_MAX || shape.n[1] > INT32_MAX)) {
        dp_py_because(DP_BAD_ARGUMENT, "finding tiles", "out is too large");
    } else if (out && dp_py_enter(self)) {
        Py_BEGIN_ALLOW_THREADS
        dp_sim_reach(self->sim, tile_x, tile_y, (int)shape.n[1], (int)shape.n[0], out);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_result(DP_OK, "");
    }
    dp_buffers_close(&buffers);
    return result;
}
