// soil/soil_slide_walls.c - firm walls that are too steep come loose and slide, row by row. Ours; MODEL 6.8
//
// Opposite neighbours are added in pairs, as in soil_slide_rows.c.
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_slide.h"

// How much higher firm ground stands over a neighbour's surface than it may: than its wall, or than
// the ground before any walker. A wall of soil that stands may be as high as it likes.
static inline float over(float firm, float base, float steep, float surface, float base_at)
{
    const float drop = base - base_at, may = steep > drop ? steep : drop;
    return above_zero((firm - surface) - may);
}

DP_CLONES
static int decide_walls(const Walls* walls, float* restrict share, float* restrict give,
                        const float* restrict firm, const float* restrict height, ptrdiff_t row,
                        int count, float film, float most)
{
    const float* restrict base = walls->base, * restrict steep = walls->steep;
    const float* restrict slack = walls->slack;
    const float one = 1.0f / film;
    int         moves = 0, restless = 0;
    for (int i = 0; i < count; ++i) {
        const float *h = height + i, *z = base + i;
        const float  at = firm[i], base_at = *z, straight = steep[i], diagonal = steep[i] * ROOT2;
        const float  e = over(at, base_at, straight, h[1], z[1]);  // MODEL 6.8
        const float  w = over(at, base_at, straight, h[-1], z[-1]);
        const float  n = over(at, base_at, straight, h[row], z[row]);
        const float  s = over(at, base_at, straight, h[-row], z[-row]);
        const float  ne = over(at, base_at, diagonal, h[row + 1], z[row + 1]);
        const float  sw = over(at, base_at, diagonal, h[-row - 1], z[-row - 1]);
        const float  nw = over(at, base_at, diagonal, h[row - 1], z[row - 1]);
        const float  se = over(at, base_at, diagonal, h[-row + 1], z[-row + 1]);
        const float  sum = ((e + w) + (n + s)) + ((ne + sw) + (nw + se));
        const float  sides = (at_most_one(e * one) + at_most_one(w * one)) +
                            (at_most_one(n * one) + at_most_one(s * one));
        const float corners = (at_most_one(ne * one) + at_most_one(sw * one)) +
                              (at_most_one(nw * one) + at_most_one(se * one));
        const float ew = e > w ? e : w, ns = n > s ? n : s;
        const float up = ne > sw ? ne : sw, down = nw > se ? nw : se;
        const float side = ew > ns ? ew : ns, across = (up > down ? up : down) * (1.0f / ROOT2);
        const float worst = side > across ? side : across, hold = HOLD * slack[i];
        const float eager = at_most_one(above_zero(worst - hold) / (hold + 1e-35f));
        const float even = eager * 0.5f / ((sides + corners) + 1.0f);
        const float limit = most / (sum + 1e-35f), a = even < limit ? even : limit;
        share[i] = a;
        give[i] = a * sum;
        restless |= worst > slack[i] ? 1 : 0;
        moves |= a * sum > 0.0f ? 1 : 0;
    }
    return (moves ? ROW_MOVES : 0) | (restless ? ROW_RESTLESS : 0);
}

DP_CLONES
static void take_walls(const Walls* walls, double* restrict sum, double* restrict floor,
                       const float* restrict share, const float* restrict give,
                       const float* restrict firm, const float* restrict height, ptrdiff_t row,
                       int count)
{
    const float* restrict base = walls->base, * restrict steep = walls->steep;
    for (int i = 0; i < count; ++i) {
        const float *F = firm + i, *a = share + i, *t = steep + i, *z = base + i;
        const float  at = height[i], base_at = *z;
#define COMES(k) (a[k] * over(F[k], z[k], t[k], at, base_at))
#define ACROSS(k) (a[k] * over(F[k], z[k], t[k] * ROOT2, at, base_at))
        const float sides = (COMES(1) + COMES(-1)) + (COMES(row) + COMES(-row));
        const float corners =
            (ACROSS(row + 1) + ACROSS(-row - 1)) + (ACROSS(row - 1) + ACROSS(-row + 1));
        floor[i] -= (double)give[i];
        sum[i] += (double)(sides + corners);
    }
}

DP_CLONES
static void fill_walls(const Walls* to, const float* restrict base_height,
                       const float* restrict wall_slope, const int32_t* restrict ring, int count,
                       double cell, double level, double tan_slack)
{
    float* restrict base = to->base, * restrict steep = to->steep, * restrict slack = to->slack;
    for (int i = 0; i < count; ++i) {
        const int    open = (base_height[i] == base_height[i]) & (ring[i] > 0);
        const double slope = (double)wall_slope[i];
        const int    falls = open & (slope < 1e6);
        const double fall = falls ? slope : 0.0;
        base[i] = open ? (float)((double)base_height[i] - level) : 0.0f;
        steep[i] = falls ? (float)(fall * cell) : INFINITY;
        slack[i] = (float)(tan_slack * (1.0 + fall * fall) * cell);
    }
}

// ---- the doors of those above ------------------------------------------------------------------

int dp_walls_decide(const Walls* walls, float* restrict share, float* restrict give,
                    const float* restrict firm, const float* restrict height, ptrdiff_t row,
                    int count, float film, float most)
{
    return decide_walls(walls, share, give, firm, height, row, count, film, most);
}

void dp_walls_take(const Walls* walls, double* restrict sum, double* restrict floor,
                   const float* restrict share, const float* restrict give,
                   const float* restrict firm, const float* restrict height, ptrdiff_t row,
                   int count)
{
    take_walls(walls, sum, floor, share, give, firm, height, row, count);
}

void dp_walls_fill(const Walls* to, const float* restrict base_height,
                   const float* restrict wall_slope, const int32_t* restrict ring, int count,
                   double cell, double level, double tan_slack)
{
    fill_walls(to, base_height, wall_slope, ring, count, cell, level, tan_slack);
}

void dp_walls_lower(float* restrict firm, const double* restrict floor, int count)
{
    for (int i = 0; i < count; ++i) firm[i] = (float)floor[i];
}
