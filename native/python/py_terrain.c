// python/py_terrain.c - rest heights of a ground mesh, for tests and for placing walkers.
#include "python/door.h"
#include "terrain/terrain.h"

static PyObject* terrain_rest(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *vertices, *triangles, *xy, *height;
    if (!PyArg_ParseTuple(arguments, "OOOO:terrain_rest", &vertices, &triangles, &xy, &height))
        return NULL;
    DpDoor         door = {0};
    PyObject*      answer = NULL;
    DpShape        corners = {2, {-1, 3}}, faces = {2, {-1, 3}}, points = {2, {-1, 2}};
    const double*  vertex = dp_door_open(&door, vertices, "vertices", 'd', &corners, false);
    const int32_t* triangle =
        vertex ? dp_door_open(&door, triangles, "triangles", 'i', &faces, false) : NULL;
    const double* at = triangle ? dp_door_open(&door, xy, "xy", 'd', &points, false) : NULL;
    DpShape       heights = {1, {points.n[0]}};
    double*       out = at ? dp_door_open(&door, height, "height", 'd', &heights, true) : NULL;
    if (!out) goto done;
    if (corners.n[0] > INT32_MAX || faces.n[0] > INT32_MAX || points.n[0] > INT32_MAX) {
        answer = dp_door_result(DP_BAD_ARGUMENT, "asking for heights");
        goto done;
    }
    DpGround ground = {0};
    ground.kind = DP_GROUND_MESH;
    ground.vertex_count = (int)corners.n[0], ground.triangle_count = (int)faces.n[0];
    ground.vertex = vertex, ground.triangle = triangle;
    const DpSoil           soil = {0.3f, 1e6f, 0.1f, 0.2f, 0.5f, 0.0f};  // does not matter
    const DpTerrainOptions options = {1.0, 0.0, 0.0, &soil, 1, 1};
    DpTerrain*             terrain = NULL;
    DpStatus               status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_terrain_create(&terrain, &options, &ground);
    if (status == DP_OK) dp_terrain_rest(terrain, (int)points.n[0], at, out);
    dp_terrain_destroy(terrain);
    Py_END_ALLOW_THREADS
    answer = dp_door_result(status, "asking for heights");
done:
    dp_door_close(&door);
    return answer;
}

PyMethodDef dp_py_terrain_methods[] = {
    {"terrain_rest", terrain_rest, METH_VARARGS,
     "terrain_rest(vertices, triangles, xy, height)\n\n"
     "Height of the upper envelope of a mesh at points: vertices float64 (n, 3) [m], triangles\n"
     "int32 (m, 3), xy float64 (k, 2) [m]; fills height float64 (k,) [m], NaN without ground."},
    {NULL, NULL, 0, NULL}};
