// soil/soil_slide_walls.c - firm walls that are too steep come loose and slide, row by row. Ours; MODEL 6.8
//
// Opposite neighbours are added in pairs, as in soil_slide_rows.c.
#include "base/finite.h"
#include "base/wide.h"  // these two first: they say how loops may be widened
#include "base/inline.h"
#include "soil/soil_slide.h"

// How much higher firm ground stands over a neighbour's surface than it may: than its wall, or than
// the ground before any walker. A wall of soil that stands may be as high as it likes.
DP_INLINE float over(float firm, float base, float steep, float surface, float base_at)
{
    const float drop = base - base_at, may = steep > drop ? steep : drop;
    return above_zero((firm - surface) - may);
}

// what a cell stands too high over its neighbours: east, west, north, south, and between these
typedef struct
{
    float e, w, n, s, ne, sw, nw, se;
} Excess;

// h, z: surface and base at the cell itself, of rows `row` apart
DP_INLINE Excess excess_of(float at, float base_at, float steep, const float* h, const float* z,
                           ptrdiff_t row)
{
    const float diagonal = steep * ROOT2;
    return (Excess){over(at, base_at, steep, h[1], z[1]),  // MODEL 6.8
                    over(at, base_at, steep, h[-1], z[-1]),
                    over(at, base_at, steep, h[row], z[row]),
                    over(at, base_at, steep, h[-row], z[-row]),
                    over(at, base_at, diagonal, h[row + 1], z[row + 1]),
                    over(at, base_at, diagonal, h[-row - 1], z[-row - 1]),
                    over(at, base_at, diagonal, h[row - 1], z[row - 1]),
                    over(at, base_at, diagonal, h[-row + 1], z[-row + 1])};
}

// the steepest of them, by the way to the neighbour
DP_INLINE float worst_of(Excess x)
{
    const float ew = x.e > x.w ? x.e : x.w, ns = x.n > x.s ? x.n : x.s;
    const float up = x.ne > x.sw ? x.ne : x.sw, down = x.nw > x.se ? x.nw : x.se;
    const float side = ew > ns ? ew : ns, across = (up > down ? up : down) * (1.0f / ROOT2);
    return side > across ? side : across;
}

// Whether any of a row's cells may stand too high at all. What a wall may be higher is no less than `steep`, >= 0, to any
// of its neighbours, so the lowest of them tells of all eight; of most rows this is all that is asked.
DP_CLONES
static int may_fall(const Walls* walls, const float* restrict firm, const float* restrict height,
                    ptrdiff_t row, int count)
{
    const float* restrict steep = walls->steep, * restrict slack = walls->slack;
    int any = 0;
    for (int i = 0; i < count; ++i) {
        const float* h = height + i;
        float        low = h[1];
        low = h[-1] < low ? h[-1] : low;
        low = h[row] < low ? h[row] : low;
        low = h[-row] < low ? h[-row] : low;
        low = h[row + 1] < low ? h[row + 1] : low;
        low = h[-row - 1] < low ? h[-row - 1] : low;
        low = h[row - 1] < low ? h[row - 1] : low;
        low = h[-row + 1] < low ? h[-row + 1] : low;
        any |= (firm[i] - low) - steep[i] > HOLD * slack[i] ? 1 : 0;
    }
    return any;
}

DP_CLONES
static int fall(const Walls* walls, const float* restrict firm, const float* restrict height,
                ptrdiff_t row, int count)
{
    const float* restrict base = walls->base, * restrict steep = walls->steep;
    const float* restrict slack = walls->slack;
    int any = 0;
    for (int i = 0; i < count; ++i) {
        const Excess x = excess_of(firm[i], base[i], steep[i], height + i, base + i, row);
        any |= worst_of(x) > HOLD * slack[i] ? 1 : 0;
    }
    return any;
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
        const Excess x = excess_of(firm[i], base[i], steep[i], height + i, base + i, row);
        const float  sum = ((x.e + x.w) + (x.n + x.s)) + ((x.ne + x.sw) + (x.nw + x.se));
        const float  sides = (at_most_one(x.e * one) + at_most_one(x.w * one)) +
                            (at_most_one(x.n * one) + at_most_one(x.s * one));
        const float corners = (at_most_one(x.ne * one) + at_most_one(x.sw * one)) +
                              (at_most_one(x.nw * one) + at_most_one(x.se * one));
        const float worst = worst_of(x), hold = HOLD * slack[i];
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

// ---- the doors of those above ------------------------------------------------------------------

int dp_walls_fall(const Walls* walls, const float* restrict firm, const float* restrict height,
                  ptrdiff_t row, int count)
{
    return may_fall(walls, firm, height, row, count) && fall(walls, firm, height, row, count);
}

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

void dp_walls_lower(float* restrict firm, const double* restrict floor, int count)
{
    for (int i = 0; i < count; ++i) firm[i] = (float)floor[i];
}
