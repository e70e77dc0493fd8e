// python/py_refine.c - triangles cut along a trail until they show it.
#include "python/buffers.h"
#include "python/numbers.h"
#include "refine/refine.h"

// (valid, points, point_source, point_weight, triangles, source, weight, cut), Blocks after the first
static PyObject* refined_result(PyObject* module, DpRefined* refined, int given_triangles)
{
    const size_t fresh = (size_t)(refined->points - refined->given),
                 count = (size_t)refined->triangles;
    void**       part[] = {(void**)&refined->point,        (void**)&refined->point_source,
                           (void**)&refined->point_weight, (void**)&refined->triangle,
                           (void**)&refined->source,       (void**)&refined->weight,
                           (void**)&refined->cut};
    const size_t size[] = {3 * (size_t)refined->points * sizeof *refined->point,
                           fresh * sizeof *refined->point_source,
                           3 * fresh * sizeof *refined->point_weight,
                           3 * count * sizeof *refined->triangle,
                           count * sizeof *refined->source,
                           9 * count * sizeof *refined->weight,
                           (size_t)given_triangles};
    PyObject*    result = PyTuple_New(8);
    if (!result) return NULL;
    if (PyTuple_SetItem(result, 0, PyBool_FromLong(refined->valid)) < 0) goto failed;
    for (int k = 0; k < 7; ++k) {
        PyObject* block = dp_py_block(module, *part[k], size[k]);
        *part[k] = NULL;  // the block has it, or it is gone
        if (!block || PyTuple_SetItem(result, k + 1, block) < 0) goto failed;
    }
    return result;
failed:
    Py_DECREF(result);
    return NULL;
}

static PyObject* refine(PyObject* module, PyObject* arguments)
{
    PyObject *points, *triangles, *corners, *sizes;
    double    block;
    int       max_triangles;
    if (!PyArg_ParseTuple(arguments, "OOOOdi:refine", &points, &triangles, &corners, &sizes, &block,
                          &max_triangles))
        return NULL;
    DpBuffers      buffers = {0};
    PyObject*      answer = NULL;
    DpRefined      refined = {0};
    DpShape        point_shape = {2, {-1, 3}}, face_shape = {2, {-1, 3}}, wish_shape = {2, {-1, 2}};
    const double*  point = dp_buffers_open(&buffers, points, "points", 'd', &point_shape, false);
    const int32_t* triangle =
        point ? dp_buffers_open(&buffers, triangles, "triangles", 'i', &face_shape, false) : NULL;
    const double* corner =
        triangle ? dp_buffers_open(&buffers, corners, "corners", 'd', &wish_shape, false) : NULL;
    const double* size =
        corner ? dp_buffers_open(&buffers, sizes, "sizes", 'd', DP_SHAPE1(wish_shape.n[0]), false)
               : NULL;
    if (!size) goto done;
    DpStatus status = DP_BAD_ARGUMENT;
    if (point_shape.n[0] <= INT32_MAX && face_shape.n[0] <= INT32_MAX &&
        wish_shape.n[0] <= INT32_MAX) {
        const DpWishes wishes = {corner, size, (int)wish_shape.n[0], block};
        Py_BEGIN_ALLOW_THREADS
        status = dp_refine(point, (int)point_shape.n[0], triangle, (int)face_shape.n[0], &wishes,
                           max_triangles, &refined);
        Py_END_ALLOW_THREADS
    }
    answer = status == DP_OK ? refined_result(module, &refined, (int)face_shape.n[0])
                             : dp_py_result(status, "refining a mesh");
    dp_refined_free(&refined);
done:
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* refine_detail(PyObject* module, PyObject* arguments)
{
    PyObject *      points, *chosen, *shown;
    DpDetail        d = dp_detail_default();
    unsigned int    seed;
    int             count;
    const DpNumber* table = dp_detail_numbers(&count);
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OOIO:refine_detail", &points, &chosen, &seed, &shown) ||
        dp_py_read_numbers(chosen, "detail", table, count, &d) < 0)
        return NULL;
    DpBuffers     buffers = {0};
    PyObject*     answer = NULL;
    DpShape       shape = {2, {-1, 3}};
    const double* point = dp_buffers_open(&buffers, points, "points", 'd', &shape, false);
    float*        out =
        point ? dp_buffers_open(&buffers, shown, "shown", 'f', DP_SHAPE2(shape.n[0], 6), true)
                     : NULL;
    if (out) {
        DpStatus status = DP_BAD_ARGUMENT;
        if (shape.n[0] <= INT32_MAX / 2) {
            Py_BEGIN_ALLOW_THREADS
            status = dp_refine_detail(point, (int)shape.n[0], &d, seed, out);
            Py_END_ALLOW_THREADS
        }
        answer = dp_py_result(status, "details of a mesh");
    }
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* detail_numbers(PyObject* module, PyObject* unused)
{
    (void)module, (void)unused;
    int             count;
    const DpNumber* table = dp_detail_numbers(&count);
    return dp_py_numbers(table, count);
}

PyMethodDef dp_py_refine_methods[] = {
    {"refine", refine, METH_VARARGS,
     "refine(points, triangles, corners, sizes, block, max_triangles)\n--\n\n"
     "Cut triangles along a trail, see refine/refine.h: points float64 (n, 3) [m], triangles "
     "int32\n"
     "(t, 3), corners float64 (w, 2) and sizes float64 (w,) of squares of edge `block` [m].\n"
     "Returns (valid, points, point_source, point_weight, triangles, source, weight, cut)."},
    {"refine_detail", refine_detail, METH_VARARGS,
     "refine_detail(points, detail, seed, shown)\n--\n\n"
     "What points are like below a cell, see refine/refine.h: points float64 (n, 3) [m],\n"
     "detail a dict of detail_numbers() by name; written to shown float32 (n, 6)."},
    {"detail_numbers", detail_numbers, METH_NOARGS,
     "detail_numbers()\n--\n\nThe numbers of a detail: ((name, unit, low, high, usual, meaning), "
     "..)."},
    {NULL, NULL, 0, NULL}};
