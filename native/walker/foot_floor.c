// walker/foot_floor.c - a recorded floor that slopes a little against the given ground.
//
// Capture volumes are rarely level: over a few metres their floor leaves the ground by centimetres,
// more than a contact may hover. Where the feet's resting places lie on one line along the path, the
// line is the floor; where they do not (stairs, blocks), the ground as given is.
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "walker/walker_inside.h"

#define MIN_REST_TIME 0.05  // a point rests when it is slow for this long              [s]
#define APART 0.5           // resting places closer than this tell nothing of a slope  [m]
#define PARTNERS 16         // later rests of the same point that each one is held against
#define MAX_SLOPE 0.12      // what slopes more was not meant to be level               [-]
#define MIN_RISE 0.01       // over the whole path, less than this is not worth it       [m]
#define MAX_OFF 0.01        // rests lie this close to the line, in the middle of all   [m]

typedef struct Footing
{
    int    point;
    double along, height;  // mean place on the path and mean height  [m]
} Footing;

static DpVec3 place(const DpGait* gait, int k, int t)
{
    return dp_place(dp_walker_pose(gait, gait->point_part[k], t), dp_walker_point(gait, k));
}

// the horizontal direction from the mass centre's first place to its last; zero for a walker that stays
static DpVec3 direction_of(const DpGait* gait, int walker)
{
    DpVec3 direction =
        dp_sub(dp_walker_com(gait, walker, gait->times - 1), dp_walker_com(gait, walker, 0));
    direction.z = 0.0;
    return dp_length(direction) > APART ? dp_unit(direction) : dp_vec3(0.0, 0.0, 0.0);
}

static int find_footings(const DpGait* gait, int walker, const double* height, const double* speed,
                         double slow, double rate, DpVec3 direction, Footing* footing, int room)
{
    const int shortest = (int)ceil(MIN_REST_TIME * rate);
    int       count = 0;
    for (int k = 0; k < gait->points; ++k) {
        if (gait->limb_walker[gait->part_limb[gait->point_part[k]]] != walker) continue;
        const size_t row = (size_t)k * (size_t)gait->times;
        for (int t = 0; t < gait->times;) {
            int    end = t;
            double along = 0.0, high = 0.0;
            for (; end < gait->times && speed[row + (size_t)end] < slow &&
                   isfinite(height[row + (size_t)end]);
                 ++end) {
                along += dp_dot(place(gait, k, end), direction);
                high += height[row + (size_t)end];
            }
            const double n = (double)(end - t);
            if (end - t >= shortest && count < room)
                footing[count++] = (Footing){.point = k, .along = along / n, .height = high / n};
            t = end > t ? end : t + 1;
        }
    }
    return count;
}

// median slope between rests of the same point, Theil and Sen; 0 where they lie on no line
static double slope_of(const Footing* footing, int count, double* scratch)
{
    int    pairs = 0;
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < count; ++i) {
        low = fmin(low, footing[i].along), high = fmax(high, footing[i].along);
        for (int j = i + 1; j < count && j <= i + PARTNERS && footing[j].point == footing[i].point;
             ++j) {
            const double run = footing[j].along - footing[i].along;
            if (fabs(run) > APART) scratch[pairs++] = (footing[j].height - footing[i].height) / run;
        }
    }
    if (pairs < 3) return 0.0;
    const double slope = dp_walker_median(scratch, (size_t)pairs);
    if (fabs(slope) > MAX_SLOPE || fabs(slope) * (high - low) < MIN_RISE) return 0.0;
    // every point has a height of its own; what is left over tells whether this is one floor
    int left = 0;
    for (int i = 0; i < count;) {
        int n = 0, end = i;
        for (; end < count && footing[end].point == footing[i].point; ++end)
            scratch[left + n++] = footing[end].height - slope * footing[end].along;
        const double own = dp_walker_median(scratch + left, (size_t)n);
        for (int m = 0; m < n; ++m) scratch[left + m] = fabs(scratch[left + m] - own);
        left += n;
        i = end;
    }
    dp_walker_sort(scratch, (size_t)left);
    return scratch[left * 3 / 4] < MAX_OFF ? slope : 0.0;
}

DpStatus dp_walker_level_floor(const DpGait* gait, int walker, double* height, const double* speed,
                               double slow, double rate)
{
    const DpVec3 direction = direction_of(gait, walker);
    if (dp_length(direction) < 0.5) return DP_OK;
    const size_t room =
        (size_t)gait->points * ((size_t)((double)gait->times / (MIN_REST_TIME * rate)) + 2);
    Footing* footing = dp_alloc(room, sizeof(Footing));
    double*  scratch = dp_alloc(room * PARTNERS, sizeof(double));
    if (!footing || !scratch) {
        dp_free(footing), dp_free(scratch);
        return DP_NO_MEMORY;
    }
    const int    count = find_footings(gait, walker, height, speed, slow, rate, direction, footing,
                                    room < 1000000 ? (int)room : 1000000);
    const double slope = slope_of(footing, count, scratch);
    dp_free(footing), dp_free(scratch);
    if (slope == 0.0) return DP_OK;
    const double middle = dp_dot(dp_walker_com(gait, walker, gait->times / 2), direction);
    for (int k = 0; k < gait->points; ++k) {
        if (gait->limb_walker[gait->part_limb[gait->point_part[k]]] != walker) continue;
        for (int t = 0; t < gait->times; ++t)
            height[(size_t)k * (size_t)gait->times + (size_t)t] -=
                slope * (dp_dot(place(gait, k, t), direction) - middle);
    }
    return DP_OK;
}
