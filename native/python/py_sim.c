// python/py_sim.c - desire_path._native.Simulation: a terrain, what presses it, and its frames.
#include "base/alloc.h"
#include "base/parallel.h"
#include "python/py_inside.h"

#include <math.h>

static void simulation_dealloc(PyObject* object)
{
    Simulation*   self = (Simulation*)object;
    PyTypeObject* type = Py_TYPE(object);
    dp_reel_destroy(self->reel);
    dp_sim_destroy(self->sim);
    dp_plants_destroy(self->plants);
    dp_terrain_destroy(self->terrain);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

#define MAX_ROWS (1 << 24)  // soils at all times

// times of soils that change [s], increasing or twice the same; None: they do not
static bool read_times(DpBuffers* buffers, PyObject* object, DpShape* shape, double** time)
{
    if (object == Py_None) return true;
    shape->n[0] = -1;
    *time = dp_buffers_open(buffers, object, "times", 'd', shape, false);
    if (!*time) return false;
    if (shape->n[0] >= 1 && shape->n[0] <= MAX_ROWS) return true;
    PyErr_SetString(PyExc_ValueError, "times: give at least one");
    return false;
}

static PyObject* simulation_new(PyTypeObject* type, PyObject* args, PyObject* kwargs)
{
    static char* words[] = {"ground", "soils",     "cell",       "origin",        "law",
                            "heap",   "rim_width", "max_sweeps", "normal_radius", "workers",
                            "times",  "layers",    NULL};
    PyObject *   ground_tuple, *soils_object, *times_object = Py_None, *layers_object = Py_None;
    DpSimOptions options = dp_sim_options_default();
    double       cell, origin[2] = {0.0, 0.0};
    int          law = 0, heap = 0;
    if (!PyArg_ParseTupleAndKeywords(args, kwargs, "O!Od|(dd)iididiOO:Simulation", words,
                                     &PyTuple_Type, &ground_tuple, &soils_object, &cell, &origin[0],
                                     &origin[1], &law, &heap, &options.rim_width,
                                     &options.max_sweeps, &options.normal_radius, &options.workers,
                                     &times_object, &layers_object))
        return NULL;
    if (law < 0 || law >= DP_LAW_COUNT || heap < 0 || heap > 1)
        return PyErr_Format(PyExc_ValueError,
                            "law, heap: expected 0 to 2 and 0 or 1, got %d and %d", law, heap);
    options.law = (DpContactLaw)law;
    options.heap_law = heap ? DP_HEAP_PAPER : DP_HEAP_REST;
    if (options.workers == 0) options.workers = dp_parallel_width();

    allocfunc   allocate = (allocfunc)PyType_GetSlot(type, Py_tp_alloc);
    Simulation* self = (Simulation*)allocate(type, 0);
    if (!self) return NULL;
    self->workers = options.workers;

    DpBuffers buffers = {.count = 0};
    DpGround  ground;
    int       soil_count = 0;
    PyObject* result = NULL;
    DpShape   times = {1, {0}};
    DpSoil*   soils = NULL;
    double*   time = NULL;
    DpLayer*  layers = NULL;
    int*      layer_start = NULL;
    if (read_times(&buffers, times_object, &times, &time))
        soils = dp_py_soils(soils_object, time ? MAX_ROWS : 255, &soil_count);
    if (soils && time && soil_count % times.n[0] != 0)
        PyErr_SetString(PyExc_ValueError, "soils: give as many for each of the times");
    else if (soils && dp_py_layers(layers_object, soil_count, &layers, &layer_start) &&
             dp_py_ground(&buffers, ground_tuple, &ground)) {
        if (time) soil_count /= (int)times.n[0];
        const DpTerrainOptions terrain = {.grid = {cell, origin[0], origin[1]},
                                          .soils = soils,
                                          .soil_count = soil_count,
                                          .workers = options.workers,
                                          .times = (int)times.n[0],
                                          .time = time};
        DpStatus               status;
        Py_BEGIN_ALLOW_THREADS
        status = dp_terrain_create(&self->terrain, &terrain, &ground);
        if (status == DP_OK && layers)
            status = dp_terrain_set_layers(self->terrain, layers, layer_start);
        if (status == DP_OK) status = dp_sim_create(&self->sim, self->terrain, &options);
        Py_END_ALLOW_THREADS
        result = dp_py_result(status, "making the ground");
    }
    dp_free(soils), dp_free(layers), dp_free(layer_start);
    dp_buffers_close(&buffers);
    if (!result) {
        Py_DECREF(self);
        return NULL;
    }
    Py_DECREF(result);
    return (PyObject*)self;
}

static PyObject* simulation_base_height(Simulation* self, PyObject* args)
{
    PyObject *xy_object, *out_object;
    if (!PyArg_ParseTuple(args, "OO:rest", &xy_object, &out_object)) return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   shape = {2, {-1, 2}};
    PyObject* result = NULL;
    double*   xy = dp_buffers_open(&buffers, xy_object, "xy", 'd', &shape, false);
    double*   out =
        xy ? dp_buffers_open(&buffers, out_object, "out", 'd', DP_SHAPE1(shape.n[0]), true) : NULL;
    if (out && shape.n[0] > INT32_MAX)
        dp_py_because(DP_BAD_ARGUMENT, "asking for heights",
                      "xy holds too many points for one call");
    else if (out && dp_buffers_finite(xy, 2 * shape.n[0], "xy") == 0 && dp_py_enter(self)) {
        Py_BEGIN_ALLOW_THREADS
        dp_terrain_base_height(self->terrain, (int)shape.n[0], xy, out);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_result(DP_OK, "");
    }
    dp_buffers_close(&buffers);
    return result;
}

static PyObject* simulation_normal(Simulation* self, PyObject* args)
{
    double x, y, radius;
    if (!PyArg_ParseTuple(args, "ddd:normal", &x, &y, &radius)) return NULL;
    if (!isfinite(x) || !isfinite(y) || !(radius > 0.0) || !isfinite(radius)) {
        PyErr_SetString(PyExc_ValueError, "normal: expected a finite point and a radius > 0");
        return NULL;
    }
    if (!dp_py_enter(self)) return NULL;
    const DpVec3 n = dp_terrain_normal(self->terrain, x, y, radius);
    self->busy = false;
    return Py_BuildValue("(ddd)", n.x, n.y, n.z);
}

static PyObject* simulation_bounds(Simulation* self, PyObject* unused)
{
    (void)unused;
    double b[4];
    dp_terrain_bounds(self->terrain, b);
    return Py_BuildValue("(dddd)", b[0], b[1], b[2], b[3]);
}

static PyObject* simulation_reach(Simulation* self, PyObject* unused)
{
    (void)unused;
    long box[4];
    if (!dp_py_enter(self)) return NULL;
    dp_sim_bounds(self->sim, box);
    self->busy = false;
    return Py_BuildValue("(llll)", box[0], box[1], box[2], box[3]);
}

static PyObject* simulation_run(Simulation* self, PyObject* args)
{
    int sample;
    if (!PyArg_ParseTuple(args, "i:run", &sample) || !dp_py_enter(self)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_run(self->sim, sample);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return dp_py_result(status, "stepping the ground");
}

static PyObject* simulation_settle(Simulation* self, PyObject* unused)
{
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_settle(self->sim);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return dp_py_result(status, "letting the ground settle");
}

static PyObject* simulation_report(Simulation* self, PyObject* unused)
{
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    const DpSimReport r = dp_sim_report(self->sim);
    self->busy = false;
    PyObject* report =
        Py_BuildValue("{s:i,s:i,s:d,s:d,s:d,s:d,s:d,s:d,s:d,s:n,s:i,s:i,s:l}", "contacts",
                      r.contacts, "off_ground", r.off_ground, "deepest_m", r.deepest, "pressed_m3",
                      r.pressed, "pressed_heap_m3", r.pressed_heap, "displaced_m3", r.displaced,
                      "heaped_m3", r.heaped, "loosened_m3", r.loosened, "rebounded_m3", r.rebounded,
                      "tiles", (Py_ssize_t)dp_terrain_tile_count(self->terrain), "plants",
                      dp_plants_count(self->plants, -1), "awake", r.awake, "broke", r.broke);
    if (report && dp_sim_sprays(self->sim) && dp_py_add_spray(report, &r) < 0) Py_CLEAR(report);
    return report;
}

static PyObject* simulation_carried(Simulation* self, PyObject* unused)
{
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    const int* soil = NULL;
    const int  count = dp_terrain_coats(self->terrain, &soil);
    PyObject*  all = PyTuple_New(count);
    for (int k = 0; all && k < count; ++k) {
        const DpSimCarried c = dp_sim_carried(self->sim, k);
        PyObject*          one = Py_BuildValue("(iddd)", soil[k], c.taken, c.carried, c.left);
        if (one && PyTuple_SetItem(all, k, one) == 0) continue;
        Py_DECREF(all);
        all = NULL;
    }
    self->busy = false;
    return all;
}

static PyObject* simulation_read(Simulation* self, PyObject* args)
{
    int       field;
    long      i0, j0;
    PyObject* out_object;
    if (!PyArg_ParseTuple(args, "illO:read", &field, &i0, &j0, &out_object)) return NULL;
    const bool pressure = field == DP_FIELD_PRESSURE;
    const bool layered = dp_sim_is_of_layers(self->sim, field);
    if (!pressure && !layered && !dp_terrain_knows(self->terrain, field)) {
        PyErr_Format(PyExc_ValueError, "read: there is no field %d", field);
        return NULL;
    }
    DpBuffers buffers = {.count = 0};
    DpShape   shape = {2, {-1, -1}};
    PyObject* result = NULL;
    float*    out = dp_buffers_open(&buffers, out_object, "out", 'f', &shape, true);
    if (out && (shape.n[0] > INT32_MAX || shape.n[1] > INT32_MAX)) {
        dp_py_because(DP_BAD_ARGUMENT, "reading a map",
                      "out must hold a cell at least, and none so far out, from i0 and j0 on, that "
                      "its place is not exact");
    } else if (out && dp_py_enter(self)) {
        DpStatus status = DP_OK;
        Py_BEGIN_ALLOW_THREADS
        if (pressure)
            dp_sim_pressure(self->sim, i0, j0, (int)shape.n[1], (int)shape.n[0], out);
        else if (layered) {
            const DpCellRect at = {i0, i0 + (long)shape.n[1], j0, j0 + (long)shape.n[0]};
            status = dp_sim_layers(self->sim, field, &at, out);
        } else
            status = dp_terrain_read(self->terrain, field, i0, j0, (int)shape.n[1], (int)shape.n[0],
                                     out);
        Py_END_ALLOW_THREADS
        self->busy = false;
        result = dp_py_because(status, "reading a map",
                               "out must hold a cell at least, and none so far out, from i0 and j0 "
                               "on, that its place is not exact");
    }
    dp_buffers_close(&buffers);
    return result;
}

static PyMethodDef methods[] = {
    {"rest", (PyCFunction)simulation_base_height, METH_VARARGS,
     "rest(xy (n, 2) f8, out (n,) f8): height of the base ground [m], NaN where there is none."},
    {"normal", (PyCFunction)simulation_normal, METH_VARARGS,
     "normal(x, y, radius) -> (x, y, z): normal of the base ground, smoothed over radius [m]."},
    {"bounds", (PyCFunction)simulation_bounds, METH_NOARGS,
     "bounds() -> (x0, y0, x1, y1): world box of the ground [m]; infinite for flat ground."},
    {"place", dp_py_place, METH_VARARGS,
     "place(gait, walker, flat, carry, numbers by name, clearance (K,) f8, pose, com): turn a"
     " walker's feet to the base ground, changing pose and com. TRAIL (1) (2)"},
    {"load", dp_py_load, METH_VARARGS,
     "load(time, mass, pose, limb_walker, part_limb, sole_vertex, sole_vertex_count, sole_triangle,"
     " sole_triangle_count, touching, force, point): take an evenly sampled recording with loads."},
    {"load_tracks", dp_py_load_tracks, METH_VARARGS,
     "load_tracks(time, mass, limb_walker, part_limb, sole_vertex, sole_vertex_count, "
     "sole_triangle,"
     " sole_triangle_count, track (n, 3) i4, pose (N, 7), touching (N,), force (N, 3), point (N, "
     "3))"
     ": the same of walkers who are there from sample track[.., 1] on for track[.., 2] samples;"
     " poses are those of the parts of walker track[.., 0], track by track."},
    {"load_live", dp_py_load_live, METH_VARARGS,
     "load_live(time (0,), mass, limb_walker, part_limb, sole_vertex, sole_vertex_count, "
     "sole_triangle, sole_triangle_count): the same walkers, of whom poses are pushed."},
    {"push", dp_py_push, METH_VARARGS,
     "push(time, present (W,) u1 or None, pose (P, 7), touching (P,), force (P, 3), point (P, 3)): "
     "the next sample of a live motion."},
    {"reach", (PyCFunction)simulation_reach, METH_NOARGS,
     "reach() -> (i0, i1, j0, j1): cells the recording can change."},
    {"run", (PyCFunction)simulation_run, METH_VARARGS,
     "run(sample): step up to the state at this sample."},
    {"spray", dp_py_spray, METH_O,
     "spray(numbers by name): soil sticks to soles from now on and flies off them; once, before "
     "the "
     "first step."},
    {"grains", dp_py_grains, METH_NOARGS, "grains() -> int: how many fly."},
    {"read_grains", dp_py_read_grains, METH_VARARGS,
     "read_grains(position (n, 3) f8, velocity (n, 3) f8, soil (n,) i4, name (n,) i4): all that "
     "fly."},
    {"save_state", dp_py_save_state, METH_NOARGS,
     "save_state() -> Block: what the simulation has become, as bytes for load_state."},
    {"load_state", dp_py_load_state, METH_O,
     "load_state(bytes): go on from there, in a simulation made alike, before its first step."},
    {"join_state", dp_py_join_state, METH_VARARGS,
     "join_state(bytes, tiles (n, 2) i4, walkers (W,) u1): take some tiles and the limbs of some "
     "walkers of a state of the same ground, pressed in parts."},
    {"begin_at", dp_py_begin_at, METH_VARARGS,
     "begin_at(sample): go on from there, before the first step."},
    {"list_tiles", dp_py_list_tiles, METH_VARARGS,
     "list_tiles(out (n, 2) i4): x and y of all tiles, rising by (y, x)."},
    {"reach_tiles", dp_py_reach_tiles, METH_VARARGS,
     "reach_tiles(tile_x, tile_y, out (ny, nx) u1): 1 for tiles the recording can change."},
    {"settle", (PyCFunction)simulation_settle, METH_NOARGS,
     "settle(): let everything that is loose come to rest."},
    {"report", (PyCFunction)simulation_report, METH_NOARGS,
     "report() -> dict: contacts, depths [m] and volumes [m^3] so far."},
    {"carried", (PyCFunction)simulation_carried, METH_NOARGS,
     "carried() -> ((soil, taken, carried, left), ..): of each soil that sticks [m^3]."},
    {"read", (PyCFunction)simulation_read, METH_VARARGS,
     "read(field, i0, j0, out (ny, nx) f4): copy a field of the ground from cell (i0, j0) on."},
    {"lay", dp_py_lay, METH_VARARGS,
     "lay(i0, j0, compression, heap, pressure_time): a trail as somebody left it, (ny, nx) f4 "
     "each, "
     "from cell\n(i0, j0) on; before anybody walks."},
    {"open_plants", dp_py_open_plants, METH_VARARGS,
     "open_plants(seed): something may grow here; before anything is loaded or read."},
    {"plant", dp_py_plant, METH_VARARGS,
     "plant(kind, root (n, 2) f4) -> (stand, plants): its name from now on, and how many "
     "came"
     " up: those on the ground; (-1, 0) if none."},
    {"vary_plants", dp_py_vary_plants, METH_VARARGS,
     "vary_plants(stand, vigour (n,) f4): reserves are exp(spread * vigour); before anybody "
     "treads."},
    {"rest_plants", dp_py_rest_plants, METH_VARARGS,
     "rest_plants(seconds): time passes without walkers; plants recover and grow again."},
    {"read_plants", dp_py_read_plants, METH_VARARGS,
     "read_plants(stand, first, position (n, particles, 3) f4 or None, strength (n, bends) f8 or"
     " None, alpha (n,) f8 or None): plants of a stand from `first` on, as they are."},
    {"lay_plants", dp_py_lay_plants, METH_NOARGS,
     "lay_plants(): from now on remember how stems are laid, for read_shown."},
    {"read_shown", dp_py_read_shown, METH_VARARGS,
     "read_shown(stand, first, position (n, particles, 3) f4): plants of a stand from `first` on, "
     "trodden ones down for as long as the grass lies."},
    {"read_lean", dp_py_read_lean, METH_VARARGS,
     "read_lean(axis, i0, j0, out (ny, nx) f4): how grass lies; axis 0 lean_x, 1 lean_y, 2 "
     "crushed."},
    {"open_frames", dp_py_open_frames, METH_VARARGS,
     "open_frames(tile_x, tile_y, tiles_x, tiles_y, software, columns=0, rows=0, pages (n, 2) i4 "
     "or "
     "None) -> Film of these tiles, whose frames show pages of them alone where some are given; "
     "several may be open."},
    {"flush", dp_py_flush, METH_NOARGS,
     "flush(): wait until all frames and maps are written; tells how it went."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot type_slots[] = {
    {Py_tp_new, (void*)simulation_new},
    {Py_tp_dealloc, (void*)simulation_dealloc},
    {Py_tp_methods, methods},
    {Py_tp_doc, "Ground that walkers press: see desire_path.sim.Simulation."},
    {0, NULL}};

static PyType_Spec type_spec = {.name = "desire_path._native.Simulation",
                                .basicsize = sizeof(Simulation),
                                .flags = Py_TPFLAGS_DEFAULT,
                                .slots = type_slots};

int dp_py_sim_type(PyObject* module)
{
    PyObject* type = PyType_FromModuleAndSpec(module, &type_spec, NULL);
    if (!type) return -1;
    const int added = PyModule_AddObjectRef(module, "Simulation", type);
    Py_DECREF(type);
    return added;
}
