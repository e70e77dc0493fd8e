// python/py_motion.c - what walkers did, on its way into a simulation.
#include "base/alloc.h"
#include "python/py_inside.h"

// Cut concatenated sole arrays into one mesh a part.
static DpMesh* cut_soles(const float* vertex, Py_ssize_t vertices, const int32_t* vertex_count,
                         const int32_t* triangle, Py_ssize_t triangles,
                         const int32_t* triangle_count, int parts)
{
    DpMesh* sole = dp_alloc((size_t)parts, sizeof *sole);
    if (!sole) {
        PyErr_NoMemory();
        return NULL;
    }
    for (int p = 0; p < parts; ++p) {
        if (vertex_count[p] < 0 || triangle_count[p] < 0 || vertex_count[p] > vertices ||
            triangle_count[p] > triangles) {
            PyErr_Format(PyExc_ValueError, "soles: the counts of part %d go past the arrays", p);
            dp_free(sole);
            return NULL;
        }
        sole[p] = (DpMesh){vertex_count[p], triangle_count[p], vertex, triangle};
        vertex += 3 * vertex_count[p], vertices -= vertex_count[p];
        triangle += 3 * triangle_count[p], triangles -= triangle_count[p];
    }
    return sole;
}

PyObject* dp_py_load(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  o_time, *o_mass, *o_pose, *o_limb_walker, *o_part_limb, *o_vertex, *o_vertex_count,
        *o_triangle, *o_triangle_count, *o_touching, *o_force, *o_point;
    if (!PyArg_ParseTuple(args, "OOOOOOOOOOOO:load", &o_time, &o_mass, &o_pose, &o_limb_walker,
                          &o_part_limb, &o_vertex, &o_vertex_count, &o_triangle, &o_triangle_count,
                          &o_touching, &o_force, &o_point))
        return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   times = {1, {-1}}, walkers = {1, {-1}}, limbs = {1, {-1}}, parts = {1, {-1}};
    DpShape   vertices = {2, {-1, 3}}, triangles = {2, {-1, 3}};
    DpMesh*   sole = NULL;
    PyObject* result = NULL;

    double*  time = dp_buffers_open(&buffers, o_time, "time", 'd', &times, false);
    double*  mass = time ? dp_buffers_open(&buffers, o_mass, "mass", 'd', &walkers, false) : NULL;
    int32_t* limb_walker =
        mass ? dp_buffers_open(&buffers, o_limb_walker, "limb_walker", 'i', &limbs, false) : NULL;
    int32_t* part_limb =
        limb_walker ? dp_buffers_open(&buffers, o_part_limb, "part_limb", 'i', &parts, false)
                    : NULL;
    if (!part_limb) goto done;
    const Py_ssize_t T = times.n[0], P = parts.n[0];
    if (T > INT32_MAX / 8 || P > 100000 || limbs.n[0] > P || walkers.n[0] > 100000) {
        PyErr_SetString(PyExc_ValueError, "load: too many samples, parts or walkers");
        goto done;
    }
    double* pose = dp_buffers_open(&buffers, o_pose, "pose", 'd', DP_SHAPE3(P, T, 7), false);
    if (!pose) goto done;
    float* vertex = dp_buffers_open(&buffers, o_vertex, "sole_vertex", 'f', &vertices, false);
    if (!vertex) goto done;
    int32_t* vertex_count =
        dp_buffers_open(&buffers, o_vertex_count, "sole_vertex_count", 'i', DP_SHAPE1(P), false);
    if (!vertex_count) goto done;
    int32_t* triangle =
        dp_buffers_open(&buffers, o_triangle, "sole_triangle", 'i', &triangles, false);
    if (!triangle) goto done;
    int32_t* triangle_count = dp_buffers_open(&buffers, o_triangle_count, "sole_triangle_count",
                                              'i', DP_SHAPE1(P), false);
    if (!triangle_count) goto done;
    if (vertices.n[0] > INT32_MAX / 3 || triangles.n[0] > INT32_MAX / 3) {
        PyErr_SetString(PyExc_ValueError, "load: too many vertices or triangles in the soles");
        goto done;
    }
    uint8_t* touching =
        dp_buffers_open(&buffers, o_touching, "touching", 'B', DP_SHAPE2(P, T), false);
    if (!touching) goto done;
    double* force = dp_buffers_open(&buffers, o_force, "force", 'd', DP_SHAPE3(P, T, 3), false);
    if (!force) goto done;
    double* point = dp_buffers_open(&buffers, o_point, "point", 'd', DP_SHAPE3(P, T, 3), false);
    if (!point) goto done;
    sole = cut_soles(vertex, vertices.n[0], vertex_count, triangle, triangles.n[0], triangle_count,
                     (int)P);
    if (!sole || !dp_py_enter(self)) goto done;
    const DpGait gait = {.times = (int)T,
                         .walkers = (int)walkers.n[0],
                         .limbs = (int)limbs.n[0],
                         .parts = (int)P,
                         .time = time,
                         .mass = mass,
                         .pose = pose,
                         .limb_walker = limb_walker,
                         .part_limb = part_limb,
                         .sole = sole};
    DpStatus     status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_load(self->sim, &gait, touching, force, point);
    Py_END_ALLOW_THREADS
    self->busy = false;
    result = dp_py_result(status, "loading the recording");
done:
    dp_free(sole);
    dp_buffers_close(&buffers);
    return result;
}
