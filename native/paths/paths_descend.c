// paths/paths_descend.c - down a field of times, pulled aside by what is worn. MODEL 12.2, MODEL 12.3, MODEL 12.5
#include <math.h>

#include "base/alloc.h"
#include "paths/paths.h"

#define MIN_FALL \
    0.02  // of what a step straight to the best neighbour falls, for a step that counts

typedef struct Place
{
    double x, y;
} Place;

static bool good_size(const DpPathField* time)
{
    return time->value && time->nx >= 1 && time->ny >= 1 && time->cell >= 1e-6 &&
           time->cell <= 1e6 && (int64_t)time->nx * time->ny < INT32_MAX;
}

// the time of a cell, +inf outside
static double time_at(const DpPathField* time, int i, int j)
{
    if (i < 0 || j < 0 || i >= time->nx || j >= time->ny) return INFINITY;
    return (double)time->value[(size_t)j * (size_t)time->nx + (size_t)i];
}

// how fast times rise along an axis from one neighbour to the other, as far as they are known
static double rise(double before, double here, double behind)
{
    if (before < (double)INFINITY && behind < (double)INFINITY) return 0.5 * (behind - before);
    if (behind < (double)INFINITY) return behind - here;
    return before < (double)INFINITY ? here - before : 0.0;
}

static Place unit(double x, double y)
{
    const double length = sqrt(x * x + y * y);
    return length > 0.0 ? (Place){x / length, y / length} : (Place){0.0, 0.0};
}

static Place down(const DpPathField* time, int i, int j)
{
    const double here = time_at(time, i, j);
    if (!(here < (double)INFINITY)) return (Place){0.0, 0.0};
    return unit(-rise(time_at(time, i - 1, j), here, time_at(time, i + 1, j)),
                -rise(time_at(time, i, j - 1), here, time_at(time, i, j + 1)));  // MODEL 12.2
}

DpStatus dp_paths_direction(float* direction, const DpPathField* time)
{
    if (!good_size(time)) return DP_BAD_ARGUMENT;
    for (int j = 0; j < time->ny; ++j)
        for (int i = 0; i < time->nx; ++i, direction += 2) {
            const Place e = down(time, i, j);
            direction[0] = (float)e.x, direction[1] = (float)e.y;
        }
    return DP_OK;
}

// ---- a path -----------------------------------------------------------------------------------------

// What is known at a place, between the middles of four cells; those where no path leads do not count.
typedef struct Here
{
    double time;
    Place  down, pull;
} Here;

static Here look(const DpPathField* time, const float* pull, Place at)
{
    const double x = at.x / time->cell - 0.5, y = at.y / time->cell - 0.5;
    const int    i0 = (int)floor(x), j0 = (int)floor(y);
    double       all = 0.0, sum = 0.0;
    Place        e = {0.0, 0.0}, v = {0.0, 0.0};
    for (int k = 0; k < 4; ++k) {
        const int    i = i0 + (k & 1), j = j0 + (k >> 1);
        const double t = time_at(time, i, j);
        const double share = (1.0 - fabs(x - i)) * (1.0 - fabs(y - j));
        if (!(t < (double)INFINITY) || !(share > 0.0)) continue;
        const Place d = down(time, i, j);
        all += share, sum += share * t;
        e.x += share * d.x, e.y += share * d.y;
        if (!pull) continue;
        const float* p = pull + 2 * ((size_t)j * (size_t)time->nx + (size_t)i);
        v.x += share * (double)p[0], v.y += share * (double)p[1];
    }
    if (!(all > 0.0)) return (Here){INFINITY, {0.0, 0.0}, {0.0, 0.0}};
    return (Here){sum / all, unit(e.x, e.y), {v.x / all, v.y / all}};
}

static double cell_time(const DpPathField* time, Place at)
{
    const double x = floor(at.x / time->cell), y = floor(at.y / time->cell);
    if (!(x >= 0.0 && y >= 0.0 && x < time->nx && y < time->ny)) return INFINITY;
    return time_at(time, (int)x, (int)y);
}

// the middle of the best of four neighbours, and how much earlier it is; <= 0: none is
static double best(const DpPathField* time, Place at, Place* middle)
{
    static const int to[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const int        i = (int)floor(at.x / time->cell), j = (int)floor(at.y / time->cell);
    double           fall = 0.0;
    for (int k = 0; k < 4; ++k) {
        const double gain = time_at(time, i, j) - time_at(time, i + to[k][0], j + to[k][1]);
        if (!(gain > fall)) continue;
        fall = gain;
        *middle = (Place){(i + to[k][0] + 0.5) * time->cell, (j + to[k][1] + 0.5) * time->cell};
    }
    return fall;
}

static bool add(DpPath* path, Place at)
{
    if (path->count == INT32_MAX / 2 ||
        !dp_make_room(&path->point, 2 * ((size_t)path->count + 1), sizeof *path->point))
        return false;
    path->point[2 * path->count] = at.x, path->point[2 * path->count + 1] = at.y;
    path->count += 1;
    return true;
}

// where a step leads; false: into an obstacle, or not down enough
static bool step_to(Place* at, const DpPathField* time, Place e, double step, double highest)
{
    const Place next = {at->x + step * e.x, at->y + step * e.y};
    if (!(cell_time(time, next) < (double)INFINITY)) return false;
    if (!(look(time, NULL, next).time <= highest)) return false;
    *at = next;
    return true;
}

// How a walker goes: the length of a step, how much of a heading it keeps, and where it errs.
typedef struct Manner
{
    double         step, kept;
    const DpStray* stray;
} Manner;

// where the n-th step goes that is meant to go along `to`; heading: of the step before, 0 = there is none
static Place err(const Manner* manner, Place* heading, Place to, int n)
{
    const DpStray* stray = manner->stray;
    const double   kept = fabs(heading->x) + fabs(heading->y) > 0.0 ? manner->kept : 0.0;
    *heading = kept > 0.0 ? unit(kept * heading->x + (1.0 - kept) * to.x,
                                 kept * heading->y + (1.0 - kept) * to.y)  // MODEL 12.5
                          : to;
    if (!stray || stray->count < 1) return *heading;
    const double turn = (double)stray->turn[n % stray->count], c = cos(turn), s = sin(turn);
    return (Place){c * heading->x - s * heading->y, s * heading->x + c * heading->y};  // MODEL 12.5
}

// Steps fall by a least amount each, or else go from cell to cell until they have fallen below where that began: no path
// goes in a circle.
static DpStatus go(DpPath* path, const DpPathField* time, const float* pull, Place at,
                   const Manner* manner)
{
    const double step = manner->step;
    double       stuck = INFINITY;  // above it: from cell to cell
    Place        middle = at, heading = {0.0, 0.0};
    if (!add(path, at)) return DP_NO_MEMORY;
    for (;;) {
        const double fall = best(time, at, &middle);
        if (!(fall > 0.0)) return DP_OK;
        const Here   here = look(time, pull, at);
        const double highest = here.time - MIN_FALL * fall * step / time->cell;
        const Place  to = unit(here.down.x + here.pull.x, here.down.y + here.pull.y);  // MODEL 12.3
        const Place  e = err(manner, &heading, to, path->count - 1);
        const bool   free = here.time < stuck;
        if (!free || !step_to(&at, time, e, step, highest)) {
            heading = here.down;
            if (!free || !step_to(&at, time, here.down, step, highest)) {
                if (free) stuck = here.time;
                at = middle;
            }
        }
        if (!add(path, at)) return DP_NO_MEMORY;
    }
}

DpStatus dp_paths_descend(DpPath* path, const DpPathField* time, const float* pull, double x,
                          double y, double step, const DpStray* stray)
{
    const Place at = {x, y};
    Manner      manner = {.step = step, .stray = stray};
    if (!good_size(time) || !(step > 0.01 * time->cell && step <= time->cell))
        return DP_BAD_ARGUMENT;
    if (stray && !(stray->inertia >= 0.0 && stray->inertia <= 1e6)) return DP_BAD_ARGUMENT;
    if (stray && stray->inertia > 0.0) manner.kept = exp(-step / stray->inertia);
    if (!(cell_time(time, at) < (double)INFINITY)) return DP_NO_GROUND;
    const DpStatus status = go(path, time, pull, at, &manner);
    if (status != DP_OK) {
        dp_free(path->point);
        *path = (DpPath){NULL, 0};
    }
    return status;
}
