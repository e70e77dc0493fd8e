// python/py_walker.c - the walker's functions for Python. Arrays come in and are filled; shapes and
// types are checked here, meaning in walker/walker.h.
#include <math.h>

#include "python/numbers.h"
#include "walker/walker.h"

int dp_py_gait(DpBuffers* buffers, PyObject* tuple, DpGait* gait)
{
    if (!PyTuple_Check(tuple) || PyTuple_Size(tuple) != 9) {
        PyErr_SetString(PyExc_TypeError,
                        "gait: expected (time, com, mass, pose, limb_walker, part_limb, point, "
                        "point_part, point_role)");
        return -1;
    }
    PyObject* item[9];
    for (int k = 0; k < 9; ++k) item[k] = PyTuple_GetItem(tuple, k);
    DpShape time = {1, {-1}}, mass = {1, {-1}}, limb = {1, {-1}}, part = {1, {-1}},
            point = {1, {-1}};
    if (!(gait->time = dp_buffers_open(buffers, item[0], "time", 'd', &time, false))) return -1;
    if (!(gait->mass = dp_buffers_open(buffers, item[2], "mass", 'd', &mass, false))) return -1;
    if (!(gait->limb_walker = dp_buffers_open(buffers, item[4], "limb_walker", 'i', &limb, false)))
        return -1;
    if (!(gait->part_limb = dp_buffers_open(buffers, item[5], "part_limb", 'i', &part, false)))
        return -1;
    if (!(gait->point_part = dp_buffers_open(buffers, item[7], "point_part", 'i', &point, false)))
        return -1;
    const Py_ssize_t T = time.n[0], W = mass.n[0], P = part.n[0], K = point.n[0];
    if (!(gait->com = dp_buffers_open(buffers, item[1], "com", 'd', DP_SHAPE3(W, T, 3), false)))
        return -1;
    if (!(gait->pose = dp_buffers_open(buffers, item[3], "pose", 'd', DP_SHAPE3(P, T, 7), false)))
        return -1;
    if (!(gait->point = dp_buffers_open(buffers, item[6], "point", 'd', DP_SHAPE2(K, 3), false)))
        return -1;
    if (!(gait->point_role =
              dp_buffers_open(buffers, item[8], "point_role", 'i', DP_SHAPE1(K), false)))
        return -1;
    if (T > 100000000 || W > 100000 || limb.n[0] > 1000000 || P > 1000000 || K > 1000000) {
        PyErr_SetString(PyExc_ValueError, "gait: too many samples or parts");
        return -1;
    }
    gait->times = (int)T, gait->walkers = (int)W, gait->limbs = (int)limb.n[0];
    gait->parts = (int)P, gait->points = (int)K;
    if (dp_buffers_finite(gait->time, T, "time") < 0) return -1;
    if (dp_buffers_finite(gait->mass, W, "mass") < 0) return -1;
    if (dp_buffers_finite(gait->com, 3 * W * T, "com") < 0) return -1;
    if (dp_buffers_finite(gait->pose, 7 * P * T, "pose") < 0) return -1;
    return dp_buffers_finite(gait->point, 3 * K, "point");
}

static PyObject* resample_count(PyObject* self, PyObject* args)
{
    (void)self;
    double first, last, rate;
    if (!PyArg_ParseTuple(args, "ddd", &first, &last, &rate)) return NULL;
    const int count = isfinite(first) && isfinite(last) && isfinite(rate)
                          ? dp_gait_resample_count(first, last, rate)
                          : 0;
    if (count > 0) return PyLong_FromLong(count);
    PyErr_SetString(PyExc_ValueError, "resampling: the rate or the times cannot be used");
    return NULL;
}

static PyObject* resample(PyObject* self, PyObject* args)
{
    (void)self;
    PyObject *time, *com, *pose, *new_time, *new_com, *new_pose;
    double    rate;
    if (!PyArg_ParseTuple(args, "OOOdOOO", &time, &com, &pose, &rate, &new_time, &new_com,
                          &new_pose))
        return NULL;
    DpBuffers buffers = {0};
    DpGait    gait = {0};
    DpShape times = {1, {-1}}, count = {1, {-1}}, coms = {3, {-1, -1, 3}}, poses = {3, {-1, -1, 7}};
    PyObject* result = NULL;
    double *  out_time, *out_com, *out_pose;
    if (!(gait.time = dp_buffers_open(&buffers, time, "time", 'd', &times, false))) goto done;
    coms.n[1] = poses.n[1] = times.n[0];
    if (!(gait.com = dp_buffers_open(&buffers, com, "com", 'd', &coms, false))) goto done;
    if (!(gait.pose = dp_buffers_open(&buffers, pose, "pose", 'd', &poses, false))) goto done;
    if (!(out_time = dp_buffers_open(&buffers, new_time, "new time", 'd', &count, true))) goto done;
    const Py_ssize_t n = count.n[0];
    if (!(out_com =
              dp_buffers_open(&buffers, new_com, "new com", 'd', DP_SHAPE3(coms.n[0], n, 3), true)))
        goto done;
    if (!(out_pose = dp_buffers_open(&buffers, new_pose, "new pose", 'd',
                                     DP_SHAPE3(poses.n[0], n, 7), true)))
        goto done;
    if (times.n[0] > 100000000 || n > 100000000) {
        PyErr_SetString(PyExc_ValueError, "resampling: too many samples");
        goto done;
    }
    if (dp_buffers_finite(gait.time, times.n[0], "time") < 0) goto done;
    gait.times = (int)times.n[0], gait.walkers = (int)coms.n[0], gait.parts = (int)poses.n[0];
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_gait_resample(&gait, rate, (int)n, out_time, out_com, out_pose);
    Py_END_ALLOW_THREADS
    result =
        dp_py_because(status, "resampling",
                      "times must rise, and new time have as many samples as resample_count tells");
done:
    dp_buffers_close(&buffers);
    return result;
}

// numbers of a record by name, or its defaults where None stands
static int read_numbers(PyObject* object, const char* what, const DpNumber* table, int count,
                        void* record)
{
    return object == Py_None ? 0 : dp_py_read_numbers(object, what, table, count, record);
}

static int read_limits(PyObject* object, DpContactLimits* limits)
{
    int             count;
    DpReason        reason;
    const DpNumber* table = dp_contact_numbers(&count);
    *limits = dp_contact_limits_default();
    if (read_numbers(object, "limits", table, count, limits) < 0) return -1;
    if (dp_contact_limits_check(limits, &reason) == DP_OK) return 0;
    PyErr_Format(PyExc_ValueError, "limits: %s", reason.text);
    return -1;
}

// model, settle_time and half_sine are there
static int read_options(PyObject* object, DpLoadOptions* options)
{
    int             count;
    DpReason        reason;
    const DpNumber* table = dp_load_numbers(&count);
    if (read_numbers(object, "options", table, count, options) < 0) return -1;
    if (dp_load_options_check(options, &reason) == DP_OK) return 0;
    PyErr_Format(PyExc_ValueError, "options: %s", reason.text);
    return -1;
}

static PyObject* foot_contact(PyObject* self, PyObject* args)
{
    (void)self;
    PyObject *tuple, *ground, *touching, *clearance, *numbers = Py_None;
    if (!PyArg_ParseTuple(args, "OOOO|O", &tuple, &ground, &touching, &clearance, &numbers))
        return NULL;
    DpBuffers       buffers = {0};
    DpGait          gait = {0};
    DpContactLimits limits;
    PyObject*       result = NULL;
    if (dp_py_gait(&buffers, tuple, &gait) < 0) goto done;
    const double* below =
        dp_buffers_open(&buffers, ground, "ground", 'd', DP_SHAPE2(gait.points, gait.times), false);
    uint8_t* on = below ? dp_buffers_open(&buffers, touching, "touching", 'B',
                                          DP_SHAPE2(gait.parts, gait.times), true)
                        : NULL;
    double*  resting =
        on ? dp_buffers_open(&buffers, clearance, "clearance", 'd', DP_SHAPE1(gait.points), true)
            : NULL;
    if (!resting || read_limits(numbers, &limits) < 0) goto done;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_foot_contact(&gait, below, &limits, on, resting);
    Py_END_ALLOW_THREADS
    result = dp_py_because(status, "finding contacts",
                           "the gait must be sampled evenly, with poses that are turns, and parts, "
                           "limbs and walkers that are there");
done:
    dp_buffers_close(&buffers);
    return result;
}

static PyObject* foot_force(PyObject* self, PyObject* args)
{
    (void)self;
    PyObject *tuple, *touching, *ground, *force, *point, *numbers = Py_None, *settle = Py_None;
    int       model, half_sine;
    double    settle_time;
    if (!PyArg_ParseTuple(args, "OOOidpOO|OO", &tuple, &touching, &ground, &model, &settle_time,
                          &half_sine, &force, &point, &numbers, &settle))
        return NULL;
    DpBuffers     buffers = {0};
    DpGait        gait = {0};
    DpLoadOptions options = dp_load_options_default();
    PyObject*     result = NULL;
    double *      out_force = NULL, *out_point = NULL;
    if (dp_py_gait(&buffers, tuple, &gait) < 0) goto done;
    const uint8_t* on = dp_buffers_open(&buffers, touching, "touching", 'B',
                                        DP_SHAPE2(gait.parts, gait.times), false);
    if (!on) goto done;
    const double* below =
        dp_buffers_open(&buffers, ground, "ground", 'd', DP_SHAPE2(gait.points, gait.times), false);
    if (!below) goto done;
    DpShape shape = {3, {gait.parts, gait.times, 3}};
    if (!(out_force = dp_buffers_open(&buffers, force, "force", 'd', &shape, true))) goto done;
    if (!(out_point = dp_buffers_open(&buffers, point, "point", 'd', &shape, true))) goto done;
    const double* taus = NULL;
    if (settle != Py_None) {
        const size_t count = (size_t)gait.points * (size_t)gait.times;
        taus = dp_buffers_open(&buffers, settle, "settle", 'd', DP_SHAPE2(gait.points, gait.times),
                               false);
        if (!taus || dp_buffers_finite(taus, (Py_ssize_t)count, "settle") < 0) goto done;
    }
    options.model = (DpLoadModel)model, options.settle_time = settle_time;
    options.settle = taus, options.half_sine = half_sine != 0;
    if (read_options(numbers, &options) < 0) goto done;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_foot_force(&gait, on, below, &options, out_force, out_point);
    Py_END_ALLOW_THREADS
    result = dp_py_because(status, "finding loads",
                           "the gait must be sampled evenly, with poses that are turns, and parts, "
                           "limbs and walkers that are there");
done:
    dp_buffers_close(&buffers);
    return result;
}

static PyObject* foot_share(PyObject* self, PyObject* args)
{
    (void)self;
    DpVec3 c, l, r;
    if (!PyArg_ParseTuple(args, "(ddd)(ddd)(ddd)", &c.x, &c.y, &c.z, &l.x, &l.y, &l.z, &r.x, &r.y,
                          &r.z))
        return NULL;
    return PyFloat_FromDouble(dp_foot_share(c, l, r));
}

static PyObject* place_numbers(PyObject* self, PyObject* unused)
{
    (void)self, (void)unused;
    int             count;
    const DpNumber* table = dp_place_numbers(&count);
    return dp_py_numbers(table, count);
}

static PyObject* contact_numbers(PyObject* self, PyObject* unused)
{
    (void)self, (void)unused;
    int             count;
    const DpNumber* table = dp_contact_numbers(&count);
    return dp_py_numbers(table, count);
}

static PyObject* load_numbers(PyObject* self, PyObject* unused)
{
    (void)self, (void)unused;
    int             count;
    const DpNumber* table = dp_load_numbers(&count);
    return dp_py_numbers(table, count);
}

PyMethodDef dp_py_walker_methods[] = {
    {"place_numbers", place_numbers, METH_NOARGS,
     "place_numbers() -> ((name, unit, low, high, default, meaning), ..): of Simulation.place."},
    {"contact_numbers", contact_numbers, METH_NOARGS,
     "contact_numbers() -> the same of foot_contact's limits."},
    {"load_numbers", load_numbers, METH_NOARGS,
     "load_numbers() -> the same of foot_force's options."},
    {"resample_count", resample_count, METH_VARARGS,
     "resample_count(first, last, rate): samples an even recording of that span has"},
    {"resample", resample, METH_VARARGS,
     "resample(time, com, pose, rate, new_time, new_com, new_pose): fill the last three"},
    {"foot_contact", foot_contact, METH_VARARGS,
     "foot_contact(gait, ground, touching, clearance, limits=None): fill touching and clearance. "
     "TRAIL (4)"},
    {"foot_force", foot_force, METH_VARARGS,
     "foot_force(gait, touching, ground, model, settle_time, half_sine, force, point, "
     "options=None, settle=None): fill force and point. TRAIL (3)"},
    {"foot_share", foot_share, METH_VARARGS,
     "foot_share(com, left, right): weight share of the right foot. SOFT22 (5)"},
    {NULL, NULL, 0, NULL}};
