// python/py_plants.c - the plants' kernels, one by one, for tests and for fitting kinds.
//
//   plants_place(x0, y0, x1, y1, density, weight | None, seed, root, given) -> count
//   plants_step(kind, seed, root, heading, position, velocity, strength, ground | None,
//               colliders, dt, steps, workers) -> dict of DpPlantsReport
//   plants_cover(kind, root, strength, (x0, y0, cell), law, alpha, modulus)
//
// kind: as in py_kind.c. Stands are float32 (n, particles, 3), strength float64
// (n, bends). ground = (x0, y0, cell, height); a collider is (x0, y0, cell, bottom, thickness,
// velocity, friction) or (from, to, radius, velocity, friction); grids are float32 (ny, nx).
#include <math.h>

#include "base/alloc.h"
#include "python/py_inside.h"

#define MAX_COLLIDERS 16
#define MAX_STEPS 1000000  // of one call, which nothing can stop

static PyObject* plants_place(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *         weights, *roots, *answer = NULL;
    double             x0, y0, x1, y1, density;
    unsigned long long seed;
    DpBuffers          buffers = {0};
    DpShape            grid = {2, {-1, -1}}, list = {2, {-1, 2}};
    const float*       weight = NULL;
    float*             root;
    int                count = 0;
    if (!PyArg_ParseTuple(arguments, "dddddOKO|i:plants_place", &x0, &y0, &x1, &y1, &density,
                          &weights, &seed, &roots, &count))
        return NULL;
    if (weights != Py_None &&
        !(weight = dp_buffers_open(&buffers, weights, "weight", 'f', &grid, false)))
        goto done;
    if (!(root = dp_buffers_open(&buffers, roots, "root", 'f', &list, true))) goto done;
    if (list.n[0] > INT32_MAX || grid.n[0] > 1 << 20 || grid.n[1] > 1 << 20) {
        answer = dp_py_because(DP_BAD_ARGUMENT, "placing plants",
                               "x0 < x1 and y0 < y1 within 1e7 m, a density above 0 and below 1e9, "
                               "weights of 0 or more and 0 to len(root) given roots are needed");
        goto done;
    }
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_plants_place(x0, y0, x1, y1, density, weight, (int)grid.n[1], (int)grid.n[0], seed,
                             root, (int)list.n[0], &count);
    Py_END_ALLOW_THREADS
    answer =
        status == DP_OK
            ? PyLong_FromLong(count)
            : dp_py_because(status, "placing plants",
                            "x0 < x1 and y0 < y1 within 1e7 m, a density above 0 and below 1e9, "
                            "weights of 0 or more and 0 to len(root) given roots are needed");
done:
    dp_buffers_close(&buffers);
    return answer;
}

// ---- a stand for the length of a call -----------------------------------------------------------

typedef struct Stand
{
    DpBuffers       buffers;
    DpPlantKind     kind;
    DpPlantShape    shape;
    DpPlants*       plants;
    int             count;
    float *         position, *velocity;
    double*         strength;
    DpPlantGround   ground;
    DpPlantCollider collider[MAX_COLLIDERS];
    int             colliders;
} Stand;

static void close_stand(Stand* stand)
{
    dp_plants_destroy(stand->plants);
    dp_buffers_close(&stand->buffers);
}

static int open_stand(Stand* stand, PyObject* kind, unsigned long long seed, PyObject* roots,
                      PyObject* headings)
{
    DpShape      list = {2, {-1, 3}}, row = {1, {-1}};
    const float *root, *heading = NULL;
    if (dp_py_kind(kind, &stand->kind) < 0) return -1;
    stand->shape = dp_plant_shape(&stand->kind);
    if (!(root = dp_buffers_open(&stand->buffers, roots, "root", 'f', &list, false))) return -1;
    row.n[0] = list.n[0];
    if (headings && headings != Py_None &&
        !(heading = dp_buffers_open(&stand->buffers, headings, "heading", 'f', &row, false)))
        return -1;
    int name;
    stand->count = list.n[0] <= 1 << 24 ? (int)list.n[0] : 0;
    stand->plants = dp_plants_create(seed);
    const DpStatus status = stand->plants ? dp_plants_add(stand->plants, &stand->kind, root,
                                                          heading, stand->count, &name)
                                          : DP_NO_MEMORY;
    if (status == DP_OK) return 0;
    DpReason reason;
    if (dp_plants_check(&stand->kind, root, heading, stand->count, &reason) != DP_OK)
        PyErr_Format(PyExc_ValueError, "planting: %s", reason.text);
    else
        dp_py_result(status, "planting");
    return -1;
}

static int open_state(Stand* stand, PyObject* position, PyObject* velocity, PyObject* strength)
{
    DpShape*   places = DP_SHAPE3(stand->count, stand->shape.particles, 3);
    DpShape*   bends = DP_SHAPE2(stand->count, stand->shape.bends);
    DpBuffers* buffers = &stand->buffers;
    if (position &&
        !(stand->position = dp_buffers_open(buffers, position, "position", 'f', places, true)))
        return -1;
    if (velocity &&
        !(stand->velocity = dp_buffers_open(buffers, velocity, "velocity", 'f', places, true)))
        return -1;
    if (!(stand->strength = dp_buffers_open(buffers, strength, "strength", 'd', bends, true)))
        return -1;
    for (int k = 0; k < stand->count; ++k) {
        const size_t   p = 3 * (size_t)k * (size_t)stand->shape.particles;
        const size_t   b = (size_t)k * (size_t)stand->shape.bends;
        const DpStatus status =
            dp_plants_write(stand->plants, 0, k, position ? stand->position + p : NULL,
                            velocity ? stand->velocity + p : NULL, stand->strength + b);
        if (status == DP_OK) continue;
        dp_py_because(status, "position, velocity or strength",
                      "a place or speed is no number, or a strength lies beyond 0 to the reserve");
        return -1;
    }
    return 0;
}

static int open_ground(Stand* stand, PyObject* object)
{
    DpPlantGround* g = &stand->ground;
    DpShape        grid = {2, {-1, -1}};
    PyObject*      height;
    if (!PyTuple_Check(object)) {
        PyErr_SetString(PyExc_TypeError, "ground: expected a tuple");
        return -1;
    }
    if (!PyArg_ParseTuple(object, "dddO:ground", &g->x0, &g->y0, &g->cell, &height)) return -1;
    if (!(g->height = dp_buffers_open(&stand->buffers, height, "height", 'f', &grid, false)))
        return -1;
    g->ny = (int)grid.n[0], g->nx = g->row = (int)grid.n[1];
    return 0;
}

static int open_collider(Stand* stand, PyObject* object)
{
    DpPlantCollider* c = &stand->collider[stand->colliders];
    DpShape          grid = {2, {-1, -1}};
    PyObject*        bottom;
    DpVec3*          v = &c->velocity;
    if (!PyTuple_Check(object)) {
        PyErr_SetString(PyExc_TypeError, "colliders: expected tuples");
        return -1;
    }
    if (PyTuple_Size(object) == 5) {
        if (!PyArg_ParseTuple(object, "(ddd)(ddd)d(ddd)d:collider", &c->from.x, &c->from.y,
                              &c->from.z, &c->to.x, &c->to.y, &c->to.z, &c->radius, &v->x, &v->y,
                              &v->z, &c->friction))
            return -1;
    } else {
        if (!PyArg_ParseTuple(object, "dddOd(ddd)d:collider", &c->x0, &c->y0, &c->cell, &bottom,
                              &c->thickness, &v->x, &v->y, &v->z, &c->friction))
            return -1;
        if (!(c->bottom = dp_buffers_open(&stand->buffers, bottom, "bottom", 'f', &grid, false)))
            return -1;
        c->ny = (int)grid.n[0], c->nx = c->row = (int)grid.n[1];
    }
    ++stand->colliders;
    return 0;
}

static int open_colliders(Stand* stand, PyObject* objects)
{
    PyObject* items = PySequence_Tuple(objects);
    int       fine = items ? 0 : -1;
    if (items && PyTuple_Size(items) > MAX_COLLIDERS) {
        PyErr_SetString(PyExc_ValueError, "colliders: at most 16");
        fine = -1;
    }
    for (Py_ssize_t k = 0; fine == 0 && k < PyTuple_Size(items); ++k)
        fine = open_collider(stand, PyTuple_GetItem(items, k));
    Py_XDECREF(items);
    return fine;
}

static PyObject* plants_step(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *         kind, *root, *heading, *position, *velocity, *strength, *ground, *colliders;
    PyObject*          answer = NULL;
    unsigned long long seed;
    double             dt;
    int                steps, workers;
    Stand              stand = {0};
    if (!PyArg_ParseTuple(arguments, "OKOOOOOOOdii:plants_step", &kind, &seed, &root, &heading,
                          &position, &velocity, &strength, &ground, &colliders, &dt, &steps,
                          &workers))
        return NULL;
    if (steps < 0 || steps > MAX_STEPS)
        return PyErr_Format(PyExc_ValueError, "steps: expected 0 to %d", MAX_STEPS);
    if (open_stand(&stand, kind, seed, root, heading) < 0 ||
        (ground != Py_None && open_ground(&stand, ground) < 0) ||
        open_colliders(&stand, colliders) < 0)
        goto done;
    const DpPlantGround* below = ground != Py_None ? &stand.ground : NULL;
    if (below && dp_plants_follow(stand.plants, below) != DP_OK) {
        answer = dp_py_because(DP_BAD_ARGUMENT, "ground",
                               "its cells need a side above 0 and below 1e6 m, within 1e9 m");
        goto done;
    }
    if (open_state(&stand, position, velocity, strength) < 0) goto done;
    DpPlantsReport report = {0};
    DpStatus       status = DP_OK;
    int            broke = 0;
    Py_BEGIN_ALLOW_THREADS
    for (int k = 0; k < steps && status == DP_OK; ++k) {
        status = dp_plants_step(stand.plants, below, stand.collider, stand.colliders, dt, workers,
                                &report);
        broke += report.broke;
    }
    for (int k = 0; k < stand.count; ++k)
        dp_plants_read(stand.plants, 0, k,
                       stand.position + 3 * (size_t)k * (size_t)stand.shape.particles,
                       stand.velocity + 3 * (size_t)k * (size_t)stand.shape.particles,
                       stand.strength + (size_t)k * (size_t)stand.shape.bends);
    Py_END_ALLOW_THREADS
    answer = status == DP_OK
                 ? Py_BuildValue("{s:i,s:i}", "awake", report.awake, "broke", broke)
                 : dp_py_because(status, "moving plants",
                                 "dt must be above 0 and below 1e6 s, numbers of ground and "
                                 "colliders finite and their cells above 0 m");
done:
    close_stand(&stand);
    return answer;
}

static PyObject* plants_rest_shape(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *         kind, *root, *heading, *position, *answer = NULL;
    unsigned long long seed;
    Stand              stand = {0};
    if (!PyArg_ParseTuple(arguments, "OKOOO:plants_rest_shape", &kind, &seed, &root, &heading,
                          &position))
        return NULL;
    if (open_stand(&stand, kind, seed, root, heading) < 0) goto done;
    float* to = dp_buffers_open(&stand.buffers, position, "position", 'f',
                                DP_SHAPE3(stand.count, stand.shape.particles, 3), true);
    if (!to) goto done;
    for (int k = 0; k < stand.count; ++k)
        dp_plants_read(stand.plants, 0, k, to + 3 * (size_t)k * (size_t)stand.shape.particles, NULL,
                       NULL);
    answer = dp_py_result(DP_OK, "planting");
done:
    close_stand(&stand);
    return answer;
}

static PyObject* plants_cover(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *    kind, *root, *strength, *alphas, *moduli, *answer = NULL;
    DpPlantWindow window = {0};
    DpShape       grid = {2, {-1, -1}};
    int           law;
    Stand         stand = {0};
    if (!PyArg_ParseTuple(arguments, "OOO(ddd)iOO:plants_cover", &kind, &root, &strength,
                          &window.x0, &window.y0, &window.cell, &law, &alphas, &moduli))
        return NULL;
    if (law != DP_COVER_FULL && law != DP_COVER_PAPER)
        return PyErr_Format(PyExc_ValueError, "law: expected 0 or 1, got %d", law);
    float *alpha, *modulus;
    if (open_stand(&stand, kind, 0, root, NULL) < 0 || open_state(&stand, NULL, NULL, strength) < 0)
        goto done;
    if (!(alpha = dp_buffers_open(&stand.buffers, alphas, "alpha", 'f', &grid, true)) ||
        !(modulus = dp_buffers_open(&stand.buffers, moduli, "modulus", 'f', &grid, true)))
        goto done;
    window.ny = (int)grid.n[0], window.nx = window.row = (int)grid.n[1];
    answer = dp_py_because(
        dp_plants_cover(stand.plants, &window, (DpCoverLaw)law, alpha, modulus), "covering ground",
        "the window needs cells of a side above 0 and below 1e6 m, within 1e9 m");
done:
    close_stand(&stand);
    return answer;
}

PyMethodDef dp_py_plants_methods[] = {
    {"plants_place", plants_place, METH_VARARGS,
     "plants_place(x0, y0, x1, y1, density, weight | None, seed, root, given=0) -> count\n\n"
     "Poisson-disc: fills root, float32 (most, 2) [m], after the `given` ones it holds; weight "
     "float32 "
     "(wy, wx) thins."},
    {"plants_rest_shape", plants_rest_shape, METH_VARARGS,
     "plants_rest_shape(kind, seed, root, heading | None, position)\n\n"
     "Fill position, float32 (n, particles, 3) [m], with plants nobody walked on."},
    {"plants_step", plants_step, METH_VARARGS,
     "plants_step(kind, seed, root, heading | None, position, velocity, strength, ground | None,\n"
     "            colliders, dt, steps, workers) -> {awake, broke}\n\n"
     "Let a stand live; position, velocity and strength change in place. TRAIL (5), TRAIL (6)"},
    {"plants_cover", plants_cover, METH_VARARGS,
     "plants_cover(kind, root, strength, (x0, y0, cell), law, alpha, modulus)\n\n"
     "alpha_veg, TRAIL (7), and E_v, TRAIL (8) [Pa]; law 0 = relative to full cover, 1 = as "
     "printed."},
    {NULL, NULL, 0, NULL}};
