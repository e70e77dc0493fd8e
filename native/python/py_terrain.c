// python/py_terrain.c - ground meshes: what of them lies near a walk, their base heights, and laying a trail on them.
#include "base/alloc.h"
#include "base/parallel.h"
#include "python/py_inside.h"
#include "soil/soil.h"
#include "terrain/terrain.h"

static PyObject* terrain_base_height(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *vertices, *triangles, *xy, *height;
    if (!PyArg_ParseTuple(arguments, "OOOO:terrain_base_height", &vertices, &triangles, &xy,
                          &height))
        return NULL;
    DpBuffers      buffers = {0};
    PyObject*      answer = NULL;
    DpShape        corners = {2, {-1, 3}}, faces = {2, {-1, 3}}, points = {2, {-1, 2}};
    const double*  vertex = dp_buffers_open(&buffers, vertices, "vertices", 'd', &corners, false);
    const int32_t* triangle =
        vertex ? dp_buffers_open(&buffers, triangles, "triangles", 'i', &faces, false) : NULL;
    const double* at = triangle ? dp_buffers_open(&buffers, xy, "xy", 'd', &points, false) : NULL;
    DpShape       heights = {1, {points.n[0]}};
    double* out = at ? dp_buffers_open(&buffers, height, "height", 'd', &heights, true) : NULL;
    if (!out) goto done;
    if (corners.n[0] > INT32_MAX || faces.n[0] > INT32_MAX || points.n[0] > INT32_MAX) {
        answer = dp_py_result(DP_BAD_ARGUMENT, "asking for heights");
        goto done;
    }
    DpGround ground = {0};
    ground.kind = DP_GROUND_MESH;
    ground.vertex_count = (int)corners.n[0], ground.triangle_count = (int)faces.n[0];
    ground.vertex = vertex, ground.triangle = triangle;
    const DpSoil           soil = dp_soil_default();  // does not matter
    const DpTerrainOptions options = {{1.0, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    DpTerrain*             terrain = NULL;
    DpStatus               status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_terrain_create(&terrain, &options, &ground);
    if (status == DP_OK) dp_terrain_base_height(terrain, (int)points.n[0], at, out);
    dp_terrain_destroy(terrain);
    Py_END_ALLOW_THREADS
    answer = dp_py_result(status, "asking for heights");
done:
    dp_buffers_close(&buffers);
    return answer;
}

// (low (3), high (3), bad, vertices, triangles, of) with Blocks, None where a point is bad
static PyObject* cut_result(PyObject* module, DpCut* cut)
{
    PyObject* parts[3] = {NULL, NULL, NULL};
    if (cut->bad < 0) {
        const size_t points = (size_t)cut->point_count, triangles = (size_t)cut->triangle_count;
        parts[0] = dp_py_block(module, cut->vertex, points * 3 * sizeof *cut->vertex);
        parts[1] = dp_py_block(module, cut->triangle, triangles * 3 * sizeof *cut->triangle);
        parts[2] = dp_py_block(module, cut->of, points * sizeof *cut->of);
    } else {
        for (int k = 0; k < 3; ++k) parts[k] = Py_NewRef(Py_None);
    }
    PyObject* result = NULL;
    if (parts[0] && parts[1] && parts[2])
        result = Py_BuildValue("(fff)(fff)iOOO", (double)cut->low[0], (double)cut->low[1],
                               (double)cut->low[2], (double)cut->high[0], (double)cut->high[1],
                               (double)cut->high[2], cut->bad, parts[0], parts[1], parts[2]);
    for (int k = 0; k < 3; ++k) Py_XDECREF(parts[k]);
    return result;
}

static PyObject* mesh_cut(PyObject* module, PyObject* arguments)
{
    PyObject *points, *corners, *starts, *place, *box;
    int       sides;
    if (!PyArg_ParseTuple(arguments, "OOOiOO:mesh_cut", &points, &corners, &starts, &sides, &place,
                          &box))
        return NULL;
    DpBuffers      buffers = {0};
    PyObject*      answer = NULL;
    DpShape        point_shape = {2, {-1, 3}}, corner_shape = {1, {-1}}, start_shape = {1, {-1}};
    const float*   point = dp_buffers_open(&buffers, points, "points", 'f', &point_shape, false);
    const int32_t* corner =
        point ? dp_buffers_open(&buffers, corners, "corners", 'i', &corner_shape, false) : NULL;
    const double* at =
        corner ? dp_buffers_open(&buffers, place, "place", 'd', DP_SHAPE2(3, 4), false) : NULL;
    const int32_t* start = NULL;
    const double*  around = NULL;
    if (!at ||
        (starts != Py_None &&
         !(start = dp_buffers_open(&buffers, starts, "starts", 'i', &start_shape, false))) ||
        (box != Py_None &&
         !(around = dp_buffers_open(&buffers, box, "box", 'd', DP_SHAPE1(4), false))))
        goto done;
    const Py_ssize_t faces = start       ? start_shape.n[0] - 1
                             : sides > 0 ? corner_shape.n[0] / sides
                                         : 0;
    if (point_shape.n[0] > INT32_MAX || corner_shape.n[0] > INT32_MAX || faces < 0 ||
        faces > INT32_MAX) {
        answer = dp_py_result(DP_BAD_ARGUMENT, "cutting a mesh");
        goto done;
    }
    const DpFaces of = {
        (int)point_shape.n[0], (int)faces, (int)corner_shape.n[0], point, corner, start, sides};
    DpCut    cut;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_mesh_cut(&of, at, around, dp_parallel_width(), &cut);
    Py_END_ALLOW_THREADS
    answer = status == DP_OK ? cut_result(module, &cut) : dp_py_result(status, "cutting a mesh");
done:
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* are_quads(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *corners, *corner_edges, *edges;
    if (!PyArg_ParseTuple(arguments, "OOO:are_quads", &corners, &corner_edges, &edges)) return NULL;
    DpBuffers      buffers = {0};
    DpShape        corner_shape = {1, {-1}}, edge_shape = {2, {-1, 2}};
    const int32_t* corner =
        dp_buffers_open(&buffers, corners, "corners", 'i', &corner_shape, false);
    const int32_t* corner_edge = corner ? dp_buffers_open(&buffers, corner_edges, "corner_edges",
                                                          'i', DP_SHAPE1(corner_shape.n[0]), false)
                                        : NULL;
    const int32_t* edge =
        corner_edge ? dp_buffers_open(&buffers, edges, "edges", 'i', &edge_shape, false) : NULL;
    PyObject* answer = NULL;
    if (edge && (corner_shape.n[0] > INT32_MAX || edge_shape.n[0] > INT32_MAX)) {
        dp_py_result(DP_BAD_ARGUMENT, "looking at edges");
    } else if (edge) {
        bool quads;
        Py_BEGIN_ALLOW_THREADS
        quads = dp_are_quads((int)corner_shape.n[0], corner, corner_edge, (int)edge_shape.n[0],
                             edge, dp_parallel_width());
        Py_END_ALLOW_THREADS
        answer = PyBool_FromLong(quads);
    }
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* are_centres(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject* vertices;
    double    cell, origin[2], most;
    if (!PyArg_ParseTuple(arguments, "Odddd:are_centres", &vertices, &cell, &origin[0], &origin[1],
                          &most))
        return NULL;
    DpBuffers     buffers = {0};
    DpShape       shape = {2, {-1, 3}};
    PyObject*     answer = NULL;
    const double* vertex = dp_buffers_open(&buffers, vertices, "vertices", 'd', &shape, false);
    if (vertex && (shape.n[0] > INT32_MAX - 65536 || !(cell > 0.0))) {
        dp_py_result(DP_BAD_ARGUMENT, "looking for cells");
    } else if (vertex) {
        bool all;
        Py_BEGIN_ALLOW_THREADS
        all = dp_are_centres((int)shape.n[0], vertex, cell, origin, most, dp_parallel_width());
        Py_END_ALLOW_THREADS
        answer = PyBool_FromLong(all);
    }
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* fields(PyObject* module, PyObject* none)
{
    (void)module, (void)none;
    int                count;
    const DpFieldInfo* field = dp_sim_fields(&count);
    PyObject*          rows = PyTuple_New(count);
    for (int k = 0; rows && k < count; ++k, ++field) {
        PyObject* row = Py_BuildValue("(sisss)", field->name, field->field, field->unit,
                                      field->equation, field->meaning);
        if (!row || PyTuple_SetItem(rows, k, row) < 0) Py_CLEAR(rows);
    }
    return rows;
}

static PyObject* soil_fields(PyObject* module, PyObject* none)
{
    (void)module, (void)none;
    return Py_BuildValue("(iii)", DP_FIELD_SURFACE, DP_FIELD_COAT, DP_FIELD_LAYER);
}

PyMethodDef dp_py_terrain_methods[] = {
    {"soil_fields", soil_fields, METH_NOARGS,
     "soil_fields() -> (surface, carried, layer): numbers of the fields of soil or layer 0, from "
     "which others count."},
    {"fields", fields, METH_NOARGS,
     "fields() -> ((name, number, unit, equation, meaning), ..): what a simulation can be read "
     "by."},
    {"mesh_cut", mesh_cut, METH_VARARGS,
     "mesh_cut(points, corners, starts or None, sides, place, box or None)\n\n"
     "Faces near a walk as triangles of the world: points float32 (n, 3), corners int32 (c,), "
     "starts\n"
     "int32 (f + 1,) (None: `sides` corners a face), place float64 (3, 4), box float64 (4,)\n"
     "-> (low, high, bad, vertices, triangles, of); the last three are Blocks of float64 (k, 3),\n"
     "int32 (m, 3) and int32 (k,), None if point `bad` >= 0 is not finite."},
    {"are_quads", are_quads, METH_VARARGS,
     "are_quads(corners, corner_edges, edges (e, 2))\n\n"
     "Whether the faces of these corners are quads alone."},
    {"are_centres", are_centres, METH_VARARGS,
     "are_centres(vertices float64 (n, 3), cell, x0, y0, most)\n\n"
     "Whether all points lie within `most` cells of the centres of their cells."},
    {"terrain_base_height", terrain_base_height, METH_VARARGS,
     "terrain_base_height(vertices, triangles, xy, height)\n\n"
     "Height of the upper envelope of a mesh at points: vertices float64 (n, 3) [m], triangles\n"
     "int32 (m, 3), xy float64 (k, 2) [m]; fills height float64 (k,) [m], NaN without ground."},
    {NULL, NULL, 0, NULL}};

PyObject* dp_py_lay(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject*   grid[3];
    DpTrail     trail = {.as_left = dp_soil_spring_trodden};
    if (!PyArg_ParseTuple(args, "llOOO:lay", &trail.i0, &trail.j0, &grid[0], &grid[1], &grid[2]))
        return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   shape = {2, {-1, -1}};
    PyObject* result = NULL;
    trail.compression = dp_buffers_open(&buffers, grid[0], "compression", 'f', &shape, false);
    if (trail.compression)
        trail.heap = dp_buffers_open(&buffers, grid[1], "heap", 'f', &shape, false);
    if (trail.heap)
        trail.pressure_time =
            dp_buffers_open(&buffers, grid[2], "pressure_time", 'f', &shape, false);
    if (trail.pressure_time && (shape.n[0] > INT32_MAX || shape.n[1] > INT32_MAX)) {
        dp_py_because(
            DP_BAD_ARGUMENT, "laying a trail",
            "compression, heap and pressure_time must be numbers of 0 or more, on cells from i0 "
            "and j0 on that are not too far out for exact places, before anybody walks");
    } else if (trail.pressure_time && dp_py_enter(self)) {
        DpStatus status;
        trail.ny = (int)shape.n[0], trail.nx = (int)shape.n[1];
        Py_BEGIN_ALLOW_THREADS
        status = dp_terrain_lay(self->terrain, &trail);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_because(
            status, "laying a trail",
            "compression, heap and pressure_time must be numbers of 0 or more, on cells from i0 "
            "and j0 on that are not too far out for exact places, before anybody walks");
    }
    dp_buffers_close(&buffers);
    return result;
}
