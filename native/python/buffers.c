#include "python/buffers.h"

#include "base/alloc.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

static const char* type_name(char type)
{
    return type == 'f' ? "float32" : type == 'd' ? "float64" : type == 'i' ? "int32" : "uint8";
}

static bool is_type(const Py_buffer* view, char type)
{
    const char* format = view->format ? view->format : "B";
    if (*format == '<' || *format == '=' || *format == '@') ++format;
    if (strlen(format) != 1) return false;
    if (type == 'i') return view->itemsize == 4 && (*format == 'i' || *format == 'l');
    if (type == 'B') return view->itemsize == 1 && (*format == 'B' || *format == '?');
    return *format == type;
}

void* dp_buffers_open(DpBuffers* buffers, PyObject* object, const char* name, char type,
                      DpShape* shape, bool write)
{
    if (buffers->count == DP_MAX_BUFFERS) {
        PyErr_SetString(PyExc_SystemError, "too many arrays in one call");
        return NULL;
    }
    Py_buffer* view = &buffers->view[buffers->count];
    const int  flags = PyBUF_ND | PyBUF_FORMAT | PyBUF_C_CONTIGUOUS | (write ? PyBUF_WRITABLE : 0);
    if (PyObject_GetBuffer(object, view, flags) < 0) {
        PyErr_Format(PyExc_TypeError, "%s: expected %s%s array in C order", name,
                     write ? "a writable " : "a ", type_name(type));
        return NULL;
    }
    ++buffers->count;
    if (!is_type(view, type)) {
        PyErr_Format(PyExc_TypeError, "%s: expected %s, got format '%s'", name, type_name(type),
                     view->format ? view->format : "B");
        return NULL;
    }
    if (view->ndim != shape->ndim) {
        PyErr_Format(PyExc_ValueError, "%s: expected %d dimensions, got %d", name, shape->ndim,
                     view->ndim);
        return NULL;
    }
    for (int d = 0; d < shape->ndim; ++d) {
        if (shape->n[d] >= 0 && shape->n[d] != view->shape[d]) {
            PyErr_Format(PyExc_ValueError, "%s: expected %zd along dimension %d, got %zd", name,
                         shape->n[d], d, view->shape[d]);
            return NULL;
        }
        shape->n[d] = view->shape[d];
    }
    return view->buf ? view->buf : (void*)"";
}

void dp_buffers_close(DpBuffers* buffers)
{
    while (buffers->count > 0) PyBuffer_Release(&buffers->view[--buffers->count]);
}

int dp_buffers_finite(const double* value, Py_ssize_t count, const char* name)
{
    for (Py_ssize_t k = 0; k < count; ++k) {
        if (isfinite(value[k])) continue;
        PyErr_Format(PyExc_ValueError, "%s: element %zd is not a finite number", name, k);
        return -1;
    }
    return 0;
}

PyObject* dp_py_result(DpStatus status, const char* what)
{
    PyObject*      kind = PyExc_ValueError;
    const DpStatus trouble = status == DP_NO_MEMORY ? dp_memory_trouble() : DP_OK;
    if (trouble != DP_OK) status = trouble;  // the disk has no room for what shall leave memory
    switch (status) {
        case DP_OK:
            Py_RETURN_NONE;
        case DP_NO_MEMORY:
            kind = PyExc_MemoryError;
            break;
        case DP_CANNOT_OPEN:
        case DP_CANNOT_WRITE:
        case DP_DISK_FULL:
            kind = PyExc_OSError;
            break;
        case DP_BAD_ARGUMENT:
        case DP_NO_GROUND:
        case DP_BAD_FILE:
        case DP_BAD_PACKING:
            break;
    }
    PyErr_Format(kind, "%s: %s", what, dp_status_text(status));
    return NULL;
}

PyObject* dp_py_because(DpStatus status, const char* what, const char* why)
{
    if (status != DP_BAD_ARGUMENT) return dp_py_result(status, what);
    return PyErr_Format(PyExc_ValueError, "%s: %s", what, why);
}

// ---- memory of the core, lent to Python ---------------------------------------------------------

typedef struct Block
{
    PyObject_HEAD
    void*      memory;
    Py_ssize_t size;
} Block;

static int block_lend(PyObject* object, Py_buffer* view, int flags)
{
    const Block* block = (const Block*)object;
    return PyBuffer_FillInfo(view, object, block->memory, block->size, 0, flags);
}

static void block_dealloc(PyObject* object)
{
    PyTypeObject* type = Py_TYPE(object);
    dp_free(((Block*)object)->memory);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

PyObject* dp_py_block(PyObject* module, void* memory, size_t size)
{
    PyObject* type = PyObject_GetAttrString(module, "Block");
    allocfunc allocate = type ? (allocfunc)PyType_GetSlot((PyTypeObject*)type, Py_tp_alloc) : NULL;
    Block*    block = allocate ? (Block*)allocate((PyTypeObject*)type, 0) : NULL;
    Py_XDECREF(type);
    if (!block) {
        dp_free(memory);
        return NULL;
    }
    block->memory = memory;
    block->size = (Py_ssize_t)size;
    return (PyObject*)block;
}

static PyType_Slot block_slots[] = {{Py_tp_dealloc, (void*)block_dealloc},
                                    {Py_bf_getbuffer, (void*)block_lend},
                                    {Py_tp_doc, "Memory the core filled, as a buffer of bytes."},
                                    {0, NULL}};

static PyType_Spec block_spec = {.name = "desire_path._native.Block",
                                 .basicsize = sizeof(Block),
                                 .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
                                 .slots = block_slots};

int dp_py_block_type(PyObject* module)
{
    PyObject* type = PyType_FromModuleAndSpec(module, &block_spec, NULL);
    if (!type) return -1;
    const int added = PyModule_AddObjectRef(module, "Block", type);
    Py_DECREF(type);
    return added;
}
