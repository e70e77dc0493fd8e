// python/py_imprint.c - the imprint's kernels, one by one, for tests and for the curious.
#include "imprint/imprint.h"
#include "python/buffers.h"

#define MAX_SOLES 16

static PyObject* no_soles(const char* words)
{
    PyErr_SetString(PyExc_ValueError, words);
    return NULL;
}

// soles: a list or tuple of (vertices, triangles)
static int open_soles(DpBuffers* buffers, PyObject* soles, DpMesh* mesh)
{
    PyObject* items = PySequence_Tuple(soles);
    if (!items) return -1;
    const Py_ssize_t count = PyTuple_Size(items);
    if (count > MAX_SOLES) {
        Py_DECREF(items);
        no_soles("soles: a limb has at most 16 parts");
        return -1;
    }
    for (Py_ssize_t s = 0; s < count; ++s) {
        PyObject* pair = PySequence_Tuple(PyTuple_GetItem(items, s));
        if (!pair || PyTuple_Size(pair) != 2) {
            if (pair) no_soles("soles: expected pairs of vertices and triangles");
            Py_XDECREF(pair);
            Py_DECREF(items);
            return -1;
        }
        DpShape vertices = {2, {-1, 3}}, triangles = {2, {-1, 3}};
        mesh[s].vertex =
            dp_buffers_open(buffers, PyTuple_GetItem(pair, 0), "vertices", 'f', &vertices, false);
        mesh[s].triangle = mesh[s].vertex ? dp_buffers_open(buffers, PyTuple_GetItem(pair, 1),
                                                            "triangles", 'i', &triangles, false)
                                          : NULL;
        Py_DECREF(pair);
        if (!mesh[s].triangle || vertices.n[0] > INT32_MAX || triangles.n[0] > INT32_MAX) {
            if (mesh[s].triangle) no_soles("soles: too many vertices or triangles");
            Py_DECREF(items);
            return -1;
        }
        mesh[s].vertex_count = (int)vertices.n[0];
        mesh[s].triangle_count = (int)triangles.n[0];
    }
    Py_DECREF(items);
    return (int)count;
}

static PyObject* imprint_foot(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *soles, *poses, *bottom, *cover;
    double    x0, y0, cell;
    int       samples;
    if (!PyArg_ParseTuple(arguments, "OOdddiOO:imprint_foot", &soles, &poses, &x0, &y0, &cell,
                          &samples, &bottom, &cover))
        return NULL;
    DpBuffers buffers = {0};
    DpMesh    mesh[MAX_SOLES];
    DpPose    pose[MAX_SOLES];
    PyObject* answer = NULL;
    const int count = open_soles(&buffers, soles, mesh);
    if (count < 0) goto done;
    DpShape       seven = {2, {count, 7}}, grid = {2, {-1, -1}};
    const double* at = dp_buffers_open(&buffers, poses, "poses", 'd', &seven, false);
    DpImprint     imprint = {0};
    if (!at) goto done;
    for (int s = 0; s < count; ++s, at += 7)
        pose[s] = (DpPose){{at[0], at[1], at[2]}, {at[3], at[4], at[5], at[6]}};
    imprint.bottom = dp_buffers_open(&buffers, bottom, "bottom", 'f', &grid, true);
    if (!imprint.bottom) goto done;
    imprint.cover = dp_buffers_open(&buffers, cover, "cover", 'f', &grid, true);
    if (!imprint.cover) goto done;
    DpSoilPatch patch = {0};
    if (grid.n[0] > 1 << 20 || grid.n[1] > 1 << 20) {
        answer = dp_py_result(DP_BAD_ARGUMENT, "pressing a sole");
        goto done;
    }
    patch.ny = (int)grid.n[0];
    patch.nx = patch.row = (int)grid.n[1];
    patch.x0 = x0, patch.y0 = y0, patch.cell = cell;

    DpStatus status = DP_NO_MEMORY;
    Py_BEGIN_ALLOW_THREADS
    DpImprintScratch* scratch = dp_imprint_scratch_create();
    if (scratch) status = dp_imprint_foot(&imprint, &patch, mesh, pose, count, samples, scratch);
    dp_imprint_scratch_destroy(scratch);
    Py_END_ALLOW_THREADS
    answer = status == DP_OK
                 ? Py_BuildValue("(iiii)", imprint.i0, imprint.i1, imprint.j0, imprint.j1)
                 : dp_py_result(status, "pressing a sole");
done:
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* imprint_rings(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject* ring;
    int       rings;
    if (!PyArg_ParseTuple(arguments, "Oi:imprint_rings", &ring, &rings)) return NULL;
    DpBuffers buffers = {0};
    DpShape   grid = {2, {-1, -1}};
    DpImprint imprint = {0};
    PyObject* answer = NULL;
    imprint.ring = dp_buffers_open(&buffers, ring, "ring", 'i', &grid, true);
    if (imprint.ring) {
        if (rings < 0 || rings >= DP_RING_FAR || grid.n[0] > 1 << 20 || grid.n[1] > 1 << 20) {
            answer = dp_py_result(DP_BAD_ARGUMENT, "numbering rings");
        } else {
            DpSoilPatch patch = {0};
            patch.ny = (int)grid.n[0];
            patch.nx = patch.row = (int)grid.n[1];
            if (patch.nx > 0 && patch.ny > 0) dp_imprint_rings(&imprint, &patch, rings);
            answer = dp_py_result(DP_OK, "numbering rings");
        }
    }
    dp_buffers_close(&buffers);
    return answer;
}

PyMethodDef dp_py_imprint_methods[] = {
    {"imprint_foot", imprint_foot, METH_VARARGS,
     "imprint_foot(soles, poses, x0, y0, cell, samples, bottom, cover) -> (i0, i1, j0, j1)\n\n"
     "Lower envelope of posed meshes, TRAIL 4.2.1. soles: pairs of vertices float32 (n, 3) [m]\n"
     "and triangles int32 (m, 3); poses float64 (count, 7) [x y z, w x y z]; (x0, y0): centre of "
     "cell\n"
     "(0, 0) [m]. Fills bottom [m] and cover [-], float32 (ny, nx)."},
    {"imprint_rings", imprint_rings, METH_VARARGS,
     "imprint_rings(ring, rings)\n\n"
     "Number the rings outward from the cells that are 0, in place: int32 (ny, nx). TRAIL 4.2.2."},
    {NULL, NULL, 0, NULL}};
