// python/py_base.c - digests, and the memory the core holds.
#include "base/alloc.h"
#include "base/digest.h"
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

PyMethodDef dp_py_base_methods[] = {
    {"digest", digest, METH_O,
     "digest(buffer) -> bytes: 64 of them, which differ when the buffer's bytes do."},
    {"bytes_live", bytes_live, METH_NOARGS, "bytes_live() -> int: memory the core holds now [B]."},
    {"bytes_peak", bytes_peak, METH_NOARGS,
     "bytes_peak() -> int: the most the core held since the last call [B]."},
    {NULL, NULL, 0, NULL}};
