// python/py_planting.c - the plants of a simulation: planting, resting, and reading them one by one.
#include "base/alloc.h"
#include "python/py_inside.h"

PyObject* dp_py_open_plants(PyObject* object, PyObject* args)
{
    Simulation*        self = (Simulation*)object;
    unsigned long long seed;
    if (!PyArg_ParseTuple(args, "K:open_plants", &seed)) return NULL;
    if (self->plants) {
        PyErr_SetString(PyExc_ValueError, "open_plants: plants grow here already");
        return NULL;
    }
    if (!dp_py_enter(self)) return NULL;
    DpPlants* plants = dp_plants_create(seed);
    DpStatus  status = plants ? dp_sim_plant(self->sim, plants) : DP_NO_MEMORY;
    if (status == DP_OK)
        self->plants = plants;
    else
        dp_plants_destroy(plants);
    self->busy = false;
    return dp_py_result(status, "open_plants after a recording was loaded or ground was trodden");
}

// Plants are there to be talked about, and nobody else is at them.
static bool enter(Simulation* self)
{
    if (self->plants) return dp_py_enter(self);
    PyErr_SetString(PyExc_ValueError, "nothing grows here: call open_plants first");
    return false;
}

PyObject* dp_py_plant(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  o_kind, *o_root;
    if (!PyArg_ParseTuple(args, "OO:plant", &o_kind, &o_root)) return NULL;
    DpBuffers    buffers = {.count = 0};
    DpShape      list = {2, {-1, 2}};
    DpPlantKind  kind;
    const float* root = NULL;
    PyObject*    result = NULL;
    if (dp_py_kind(o_kind, &kind) == 0)
        root = dp_buffers_open(&buffers, o_root, "root", 'f', &list, false);
    if (root && enter(self)) {
        int      stand = -1, grown = 0;
        DpStatus status = DP_BAD_ARGUMENT;
        Py_BEGIN_ALLOW_THREADS
        if (list.n[0] < 1 << 26)
            status = dp_sim_grow(self->sim, &kind, root, (int)list.n[0], &stand, &grown);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = status == DP_OK ? Py_BuildValue("(ii)", stand, grown)
                                 : dp_py_result(status, "planting");
    }
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_vary_plants(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    int         stand;
    PyObject*   o_vigour;
    if (!PyArg_ParseTuple(args, "iO:vary_plants", &stand, &o_vigour)) return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   list = {1, {-1}};
    PyObject* result = NULL;
    float*    vigour = dp_buffers_open(&buffers, o_vigour, "vigour", 'f', &list, false);
    if (vigour && enter(self)) {
        const bool fits = stand >= 0 && dp_plants_count(self->plants, stand) == list.n[0];
        result = dp_py_because(
            fits ? dp_plants_vary(self->plants, stand, vigour) : DP_BAD_ARGUMENT, "varying plants",
            "vigour needs a number for each plant of a stand that is there and was not trodden");
        self->busy = false;
    }
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_rest_plants(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    double      seconds;
    if (!PyArg_ParseTuple(args, "d:rest_plants", &seconds) || !enter(self)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_pass_time(self->sim, seconds);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return dp_py_because(status, "letting plants rest", "seconds must be 0 or more and below 1e12");
}

PyObject* dp_py_read_plants(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    int         stand, first;
    PyObject *  o_position, *o_strength, *o_alpha;
    if (!PyArg_ParseTuple(args, "iiOOO:read_plants", &stand, &first, &o_position, &o_strength,
                          &o_alpha))
        return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   places = {3, {-1, -1, 3}}, bends = {2, {-1, -1}}, list = {1, {-1}};
    float*    position = NULL;
    double *  strength = NULL, *alpha = NULL;
    PyObject* result = NULL;
    bool      ready = true;
    if (o_position != Py_None)
        ready = (position = dp_buffers_open(&buffers, o_position, "position", 'f', &places, true));
    if (ready && o_strength != Py_None)
        ready = (strength = dp_buffers_open(&buffers, o_strength, "strength", 'd', &bends, true));
    if (ready && o_alpha != Py_None)
        ready = (alpha = dp_buffers_open(&buffers, o_alpha, "alpha", 'd', &list, true));
    if (!ready || !enter(self)) goto done;
    const DpPlantShape shape = dp_plants_shape(self->plants, stand);
    const Py_ssize_t   count = position ? places.n[0] : strength ? bends.n[0] : list.n[0];
    const bool         fits = first >= 0 && count <= dp_plants_count(self->plants, stand) - first &&
                      (!position || places.n[1] == shape.particles) &&
                      (!strength || (bends.n[0] == count && bends.n[1] == shape.bends)) &&
                      (!alpha || list.n[0] == count);
    if (fits) {
        Py_BEGIN_ALLOW_THREADS
        for (int k = 0; k < (int)count; ++k) {
            float*  at = position ? position + 3 * (size_t)k * (size_t)shape.particles : NULL;
            double* of = strength ? strength + (size_t)k * (size_t)shape.bends : NULL;
            if (at) dp_sim_stands(self->sim, stand, first + k, at);
            if (of) dp_plants_read(self->plants, stand, first + k, NULL, NULL, of);
            if (alpha) alpha[k] = dp_plants_alpha(self->plants, stand, first + k);
        }
        Py_END_ALLOW_THREADS
    }
    self->busy = false;
    result = dp_py_because(
        fits ? DP_OK : DP_BAD_ARGUMENT, "reading plants",
        "first and the shapes of position, strength and alpha must fit a stand that is there");
done:
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_lay_plants(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    (void)unused;
    if (!enter(self)) return NULL;
    const DpStatus status = dp_sim_lay(self->sim);
    self->busy = false;
    return dp_py_result(status, "laying plants");
}

PyObject* dp_py_read_shown(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    int         stand, first;
    PyObject*   o_position;
    if (!PyArg_ParseTuple(args, "iiO:read_shown", &stand, &first, &o_position)) return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   places = {3, {-1, -1, 3}};
    PyObject* result = NULL;
    float*    position = dp_buffers_open(&buffers, o_position, "position", 'f', &places, true);
    if (position && enter(self)) {
        const int  particles = dp_plants_shape(self->plants, stand).particles;
        const bool fits = first >= 0 && places.n[1] == particles &&
                          places.n[0] <= dp_plants_count(self->plants, stand) - first;
        DpStatus status = fits ? DP_OK : DP_BAD_ARGUMENT;
        Py_BEGIN_ALLOW_THREADS
        for (int k = 0; k < (int)places.n[0] && status == DP_OK; ++k)
            status = dp_sim_shown(self->sim, stand, first + k,
                                  position + 3 * (size_t)k * (size_t)particles);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_because(status, "reading plants",
                               "first and the shape of position must fit a stand that is there, "
                               "and lay_plants() come before");
    }
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_read_lean(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    int         axis;
    long        i0, j0;
    PyObject*   o_out;
    if (!PyArg_ParseTuple(args, "illO:read_lean", &axis, &i0, &j0, &o_out)) return NULL;
    DpBuffers  buffers = {.count = 0};
    DpShape    shape = {2, {-1, -1}};
    PyObject*  result = NULL;
    float*     out = dp_buffers_open(&buffers, o_out, "out", 'f', &shape, true);
    const bool fits = axis >= 0 && axis < 3 && shape.n[0] <= INT32_MAX && shape.n[1] <= INT32_MAX &&
                      dp_terrain_has(i0, j0, (long)shape.n[1], (long)shape.n[0]);
    if (out && !fits)
        dp_py_because(
            DP_BAD_ARGUMENT, "reading how grass lies",
            "axis must be 0 to 2, and out hold cells that are not too far out for exact places");
    if (out && fits && enter(self)) {
        Py_BEGIN_ALLOW_THREADS
        dp_grass_read(dp_sim_grass(self->sim), i0, j0, (int)shape.n[1], (int)shape.n[0],
                      axis == 0 ? out : NULL, axis == 1 ? out : NULL, axis == 2 ? out : NULL);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_result(DP_OK, "");
    }
    dp_buffers_close(&buffers);
    return result;
}
