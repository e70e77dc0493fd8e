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
