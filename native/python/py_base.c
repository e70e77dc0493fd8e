// python/py_base.c - digests, the memory the core holds, and its limit.
#include "base/alloc.h"
#include "base/digest.h"
#include "base/memory.h"
#include "base/os.h"
#include "python/buffers.h"

static PyObject* digest(PyObject* module, PyObject* object)
{
    (void)module;
    Py_buffer view;
    uint64_t  words[DP_DIGEST_WORDS];
    if (PyObject_GetBuffer(object, &view, PyBUF_C_CONTIGUOUS) < 0) return NULL;
    Py_BEGIN_ALLOW_THREADS
    dp_digest(view.buf, (size_t)view.len, words);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    return PyBytes_FromStringAndSize((const char*)words, sizeof words);
}

static PyObject* bytes_live(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    return PyLong_FromSize_t(dp_bytes_live());
}

static PyObject* bytes_peak(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    const size_t peak = dp_bytes_peak();
    dp_bytes_peak_reset();
    return PyLong_FromSize_t(peak);
}

static PyObject* memory_hold(PyObject* module, PyObject* args)
{
    const char*        path;
    unsigned long long limit;
    (void)module;
    if (!PyArg_ParseTuple(args, "sK:memory_hold", &path, &limit)) return NULL;
    const DpStatus status = dp_memory_hold(path, limit < SIZE_MAX ? (size_t)limit : SIZE_MAX);
    return dp_py_because(status, path, "the system does not say what a process takes");
}

static PyObject* memory_release(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    dp_memory_release();
    Py_RETURN_NONE;
}

static PyObject* memory_ease(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    Py_BEGIN_ALLOW_THREADS
    dp_memory_ease(DP_EASE_NOW);
    Py_END_ALLOW_THREADS
    Py_RETURN_NONE;
}

static PyObject* memory_leave(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    Py_BEGIN_ALLOW_THREADS
    dp_memory_leave();
    Py_END_ALLOW_THREADS
    Py_RETURN_NONE;
}

static PyObject* memory_needs(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    return PyLong_FromSize_t(dp_memory_needs());
}

static PyObject* memory_resident(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    return PyLong_FromSize_t(dp_os_resident());
}

static PyObject* block(PyObject* module, PyObject* number)
{
    const size_t size = PyLong_AsSize_t(number);
    if (size == (size_t)-1 && PyErr_Occurred()) return NULL;
    void* memory = dp_alloc(size ? size : 1, 1);
    return memory ? dp_py_block(module, memory, size) : dp_py_result(DP_NO_MEMORY, "a block");
}

PyMethodDef dp_py_base_methods[] = {
    {"digest", digest, METH_O,
     "digest(buffer) -> bytes: 64 of them, which differ when the buffer's bytes do."},
    {"bytes_live", bytes_live, METH_NOARGS, "bytes_live() -> int: memory the core holds now [B]."},
    {"bytes_peak", bytes_peak, METH_NOARGS,
     "bytes_peak() -> int: the most the core held since the last call [B]."},
    {"memory_hold", memory_hold, METH_VARARGS,
     "memory_hold(path, limit): what the core takes from now on lies in a nameless file, and "
     "leaves memory where the "
     "process comes near the limit [B]. Within another hold the smaller limit counts."},
    {"memory_release", memory_release, METH_NOARGS,
     "memory_release(): the end of one memory_hold()."},
    {"memory_ease", memory_ease, METH_NOARGS,
     "memory_ease(): much was touched; let memory leave if it comes near the limit."},
    {"memory_leave", memory_leave, METH_NOARGS,
     "memory_leave(): all that may leave memory leaves now."},
    {"memory_needs", memory_needs, METH_NOARGS,
     "memory_needs() -> int: what the process took when all that may leave had left [B]; 0: it "
     "never had to."},
    {"memory_resident", memory_resident, METH_NOARGS,
     "memory_resident() -> int: memory this process takes now [B]; 0: the system does not say."},
    {"block", block, METH_O, "block(size) -> Block: so many bytes of the core's memory, all 0."},
    {NULL, NULL, 0, NULL}};
