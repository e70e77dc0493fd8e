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

// Who walks, and when, as Python tells it.
typedef struct Cast
{
    DpGait     gait;  // but for poses
    DpMesh*    sole;  // to be freed
    Py_ssize_t times, parts;
} Cast;

// The first nine arguments of load and load_tracks; false with an exception.
static bool open_cast(DpBuffers* buffers, PyObject* const object[8], Cast* cast)
{
    DpShape  times = {1, {-1}}, walkers = {1, {-1}}, limbs = {1, {-1}}, parts = {1, {-1}};
    DpShape  vertices = {2, {-1, 3}}, triangles = {2, {-1, 3}};
    DpGait*  gait = &cast->gait;
    float*   vertex;
    int32_t *vertex_count, *triangle, *triangle_count;
    if (!(gait->time = dp_buffers_open(buffers, object[0], "time", 'd', &times, false)) ||
        !(gait->mass = dp_buffers_open(buffers, object[1], "mass", 'd', &walkers, false)) ||
        !(gait->limb_walker =
              dp_buffers_open(buffers, object[2], "limb_walker", 'i', &limbs, false)) ||
        !(gait->part_limb = dp_buffers_open(buffers, object[3], "part_limb", 'i', &parts, false)))
        return false;
    const Py_ssize_t T = cast->times = times.n[0], P = cast->parts = parts.n[0];
    if (T > INT32_MAX / 8 || P > 1000000 || limbs.n[0] > P || walkers.n[0] > 1000000) {
        PyErr_SetString(PyExc_ValueError, "load: too many samples, parts or walkers");
        return false;
    }
    if (!(vertex = dp_buffers_open(buffers, object[4], "sole_vertex", 'f', &vertices, false)) ||
        !(vertex_count =
              dp_buffers_open(buffers, object[5], "sole_vertex_count", 'i', DP_SHAPE1(P), false)) ||
        !(triangle =
              dp_buffers_open(buffers, object[6], "sole_triangle", 'i', &triangles, false)) ||
        !(triangle_count =
              dp_buffers_open(buffers, object[7], "sole_triangle_count", 'i', DP_SHAPE1(P), false)))
        return false;
    if (vertices.n[0] > INT32_MAX / 3 || triangles.n[0] > INT32_MAX / 3) {
        PyErr_SetString(PyExc_ValueError, "load: too many vertices or triangles in the soles");
        return false;
    }
    gait->times = (int)T, gait->walkers = (int)walkers.n[0];
    gait->limbs = (int)limbs.n[0], gait->parts = (int)P;
    gait->sole = cast->sole = cut_soles(vertex, vertices.n[0], vertex_count, triangle,
                                        triangles.n[0], triangle_count, (int)P);
    return cast->sole != NULL;
}

// Laws of the walkers, None: those of the simulation; false with an exception.
static bool open_laws(DpBuffers* buffers, PyObject* object, Cast* cast)
{
    if (object == Py_None) return true;
    const uint8_t* laws =
        dp_buffers_open(buffers, object, "contact_law", 'B', DP_SHAPE1(cast->gait.walkers), false);
    cast->gait.contact_law = laws;
    return laws != NULL;
}

static PyObject* loaded(DpStatus status)
{
    return dp_py_because(
        status, "loading the recording",
        "times must rise, poses be turns, forces finite, and parts, limbs and walkers be there");
}

PyObject* dp_py_load(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  item[8], *o_pose, *o_touching, *o_force, *o_point, *o_law = Py_None;
    if (!PyArg_ParseTuple(args, "OOOOOOOOOOOO|O:load", &item[0], &item[1], &o_pose, &item[2],
                          &item[3], &item[4], &item[5], &item[6], &item[7], &o_touching, &o_force,
                          &o_point, &o_law))
        return NULL;
    DpBuffers     buffers = {.count = 0};
    Cast          cast = {.sole = NULL};
    DpLoadedPoses poses;
    PyObject*     result = NULL;
    if (!open_cast(&buffers, item, &cast) || !open_laws(&buffers, o_law, &cast)) goto done;
    const Py_ssize_t T = cast.times, P = cast.parts;
    if (!(poses.pose = dp_buffers_open(&buffers, o_pose, "pose", 'd', DP_SHAPE3(P, T, 7), false)) ||
        !(poses.touching =
              dp_buffers_open(&buffers, o_touching, "touching", 'B', DP_SHAPE2(P, T), false)) ||
        !(poses.force =
              dp_buffers_open(&buffers, o_force, "force", 'd', DP_SHAPE3(P, T, 3), false)) ||
        !(poses.pressure_point =
              dp_buffers_open(&buffers, o_point, "point", 'd', DP_SHAPE3(P, T, 3), false)) ||
        !dp_py_enter(self))
        goto done;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    cast.gait.pose = poses.pose;
    status = dp_sim_load(self->sim, &cast.gait, poses.touching, poses.force, poses.pressure_point);
    Py_END_ALLOW_THREADS
    if (status == DP_OK) self->live_parts = self->live_walkers = 0;
    self->busy = false;
    result = loaded(status);
done:
    dp_free(cast.sole);
    dp_buffers_close(&buffers);
    return result;
}

// How many parts each walker has (walkers), for dp_free; NULL: no memory.
static int* count_parts(const DpGait* cast)
{
    int* count = dp_alloc((size_t)cast->walkers + 1, sizeof *count);
    for (int p = 0; count && p < cast->parts; ++p) {
        const int limb = cast->part_limb[p];
        const int walker = limb >= 0 && limb < cast->limbs ? cast->limb_walker[limb] : -1;
        if (walker >= 0 && walker < cast->walkers) ++count[walker];
    }
    return count;
}

// Tracks from rows (walker, first, count) and poses one after the other; NULL with an exception.
static DpTrack* cut_tracks(const DpGait* cast, const int32_t* row, Py_ssize_t rows,
                           DpLoadedPoses poses, Py_ssize_t count)
{
    int*     parts = count_parts(cast);
    DpTrack* track = parts ? dp_alloc((size_t)rows + 1, sizeof *track) : NULL;
    bool     fits = track != NULL;
    if (!track) PyErr_NoMemory();
    for (Py_ssize_t n = 0; fits && n < rows; ++n) {
        const int32_t* at = row + 3 * n;
        fits = at[0] >= 0 && at[0] < cast->walkers && at[2] >= 0 &&
               (Py_ssize_t)parts[at[0]] * at[2] <= count;
        if (!fits) {
            PyErr_Format(PyExc_ValueError, "load_tracks: track %zd goes past the arrays", n);
            break;
        }
        const Py_ssize_t size = (Py_ssize_t)parts[at[0]] * at[2];
        track[n] = (DpTrack){at[0], at[1], at[2], poses};
        poses.pose += 7 * size, poses.touching += size, count -= size;
        poses.force += 3 * size, poses.pressure_point += 3 * size;
    }
    dp_free(parts);
    if (fits) return track;
    dp_free(track);
    return NULL;
}

PyObject* dp_py_load_tracks(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  item[8], *o_track, *o_pose, *o_touching, *o_force, *o_point, *o_law = Py_None;
    if (!PyArg_ParseTuple(args, "OOOOOOOOOOOOO|O:load_tracks", &item[0], &item[1], &item[2],
                          &item[3], &item[4], &item[5], &item[6], &item[7], &o_track, &o_pose,
                          &o_touching, &o_force, &o_point, &o_law))
        return NULL;
    DpBuffers     buffers = {.count = 0};
    Cast          cast = {.sole = NULL};
    DpLoadedPoses poses;
    DpShape       rows = {2, {-1, 3}}, places = {2, {-1, 7}};
    DpTrack*      track = NULL;
    int32_t*      row;
    PyObject*     result = NULL;
    if (!open_cast(&buffers, item, &cast) || !open_laws(&buffers, o_law, &cast) ||
        !(row = dp_buffers_open(&buffers, o_track, "track", 'i', &rows, false)) ||
        !(poses.pose = dp_buffers_open(&buffers, o_pose, "pose", 'd', &places, false)))
        goto done;
    const Py_ssize_t N = places.n[0];
    if (!(poses.touching =
              dp_buffers_open(&buffers, o_touching, "touching", 'B', DP_SHAPE1(N), false)) ||
        !(poses.force = dp_buffers_open(&buffers, o_force, "force", 'd', DP_SHAPE2(N, 3), false)) ||
        !(poses.pressure_point =
              dp_buffers_open(&buffers, o_point, "point", 'd', DP_SHAPE2(N, 3), false)) ||
        !(track = cut_tracks(&cast.gait, row, rows.n[0], poses, N)) || !dp_py_enter(self))
        goto done;
    DpStatus  status;
    DpMotion* motion = NULL;
    Py_BEGIN_ALLOW_THREADS
    status = rows.n[0] > INT32_MAX ? DP_BAD_ARGUMENT
                                   : dp_motion_tracks(&motion, &cast.gait, track, (int)rows.n[0]);
    if (status == DP_OK) status = dp_sim_follow(self->sim, motion);
    if (status != DP_OK) dp_motion_destroy(motion);
    Py_END_ALLOW_THREADS
    if (status == DP_OK) self->live_parts = self->live_walkers = 0;
    self->busy = false;
    result = loaded(status);
done:
    dp_free(track), dp_free(cast.sole);
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_load_live(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  item[8], *o_law = Py_None;
    if (!PyArg_ParseTuple(args, "OOOOOOOO|O:load_live", &item[0], &item[1], &item[2], &item[3],
                          &item[4], &item[5], &item[6], &item[7], &o_law))
        return NULL;
    DpBuffers buffers = {.count = 0};
    Cast      cast = {.sole = NULL};
    PyObject* result = NULL;
    if (open_cast(&buffers, item, &cast) && open_laws(&buffers, o_law, &cast) &&
        dp_py_enter(self)) {
        DpMotion* motion = NULL;
        DpStatus  status = dp_motion_live(&motion, &cast.gait);
        if (status == DP_OK) status = dp_sim_follow(self->sim, motion);
        if (status != DP_OK) dp_motion_destroy(motion);
        self->live_parts = status == DP_OK ? cast.gait.parts : self->live_parts;
        self->live_walkers = status == DP_OK ? cast.gait.walkers : self->live_walkers;
        self->busy = false;
        result = dp_py_result(status, "beginning a live motion");
    }
    dp_free(cast.sole);
    dp_buffers_close(&buffers);
    return result;
}

PyObject* dp_py_push(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    double      time;
    PyObject *  o_present, *o_pose, *o_touching, *o_force, *o_point;
    if (!PyArg_ParseTuple(args, "dOOOOO:push", &time, &o_present, &o_pose, &o_touching, &o_force,
                          &o_point))
        return NULL;
    if (self->live_parts == 0) {
        PyErr_SetString(PyExc_ValueError, "push: nobody is followed live: call load_live first");
        return NULL;
    }
    DpBuffers      buffers = {.count = 0};
    const int      P = self->live_parts;
    const uint8_t* present = NULL;
    DpLoadedPoses  poses;
    PyObject*      result = NULL;
    if ((o_present == Py_None ||
         (present = dp_buffers_open(&buffers, o_present, "present", 'B',
                                    DP_SHAPE1(self->live_walkers), false))) &&
        (poses.pose = dp_buffers_open(&buffers, o_pose, "pose", 'd', DP_SHAPE2(P, 7), false)) &&
        (poses.touching =
             dp_buffers_open(&buffers, o_touching, "touching", 'B', DP_SHAPE1(P), false)) &&
        (poses.force = dp_buffers_open(&buffers, o_force, "force", 'd', DP_SHAPE2(P, 3), false)) &&
        (poses.pressure_point =
             dp_buffers_open(&buffers, o_point, "point", 'd', DP_SHAPE2(P, 3), false)) &&
        dp_py_enter(self)) {
        const DpStatus status = dp_sim_push(self->sim, time, present, &poses);
        self->busy = false;
        result = dp_py_because(status, "pushing poses",
                               "time must be later than the last sample, and poses, forces and "
                               "points of who is there be numbers");
    }
    dp_buffers_close(&buffers);
    return result;
}
