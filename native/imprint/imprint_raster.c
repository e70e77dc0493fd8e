// Scan rows: where a row of samples crosses a triangle, its span is known from two edges, and the
// lowest height is kept along the span. Bigger values of v are further along +y.
//
// Spans are closed at both ends. An edge's crossing is computed from the edge alone, so two
// neighbours end and begin at the same number and no sample falls between them; a sample on their
// edge belongs to both, which a minimum does not mind. A sample on the sole's outline counts.
//
// No sample depends on the order of the triangles, so the likely underside goes first, and a
// triangle of the other side is left out when all samples about it are lower already.
#include "imprint/imprint_raster.h"

#include <string.h>

#include "base/wide.h"

#define LANES 8       // samples at a time; two registers where one holds four
#define ASKED 64      // triangles that are asked which side is up
#define STEEPEST 1e4  // m per half sample: a needle seen edge-on, its lowest corner stands for it

typedef float   Wide __attribute__((vector_size(LANES * sizeof(float))));
typedef int32_t WideMask __attribute__((vector_size(LANES * sizeof(int32_t))));

typedef struct Corner
{
    double u, v, z;
} Corner;

// where an edge crosses rows between its ends: from its middle, so that up and down are alike
typedef struct Edge
{
    double u, v;  // middle
    double lean;  // du/dv
} Edge;

DP_INLINE double held(double x, double limit)
{
    return x < -limit ? -limit : x > limit ? limit : x;
}

// x is held, so that it fits an int and the shifted sums below stay positive
DP_INLINE int first_at(double x, int past)
{
    const int cut = (int)x;
    const int up = cut + ((double)cut < x);
    return ((up + past + 3) >> 1) - 1;
}

DP_INLINE int last_at(double x, int past)
{
    const int cut = (int)x;
    const int down = cut - ((double)cut > x);
    return ((down + past + 2) >> 1) - 1;
}

int dp_samples_first(double x, int past)
{
    return first_at(held(x, (double)past + 2.0), past);
}

int dp_samples_last(double x, int past)
{
    return last_at(held(x, (double)past + 2.0), past);
}

DP_INLINE Edge edge_between(const Corner* a, const Corner* b)
{
    const double rise = b->v - a->v;
    const Edge   edge = {0.5 * (a->u + b->u), 0.5 * (a->v + b->v),
                         (b->u - a->u) / (rise > 0.0 ? rise : 1.0)};
    return edge;
}

DP_INLINE double crossing(const Edge* edge, double v)
{
    return edge->u + (v - edge->v) * edge->lean;
}

// three numbers in rising order, by the three comparisons of them; of equals the first comes first
static const uint8_t rising[8][3] = {{2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {0, 1, 2},
                                     {0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}};

DP_INLINE const uint8_t* order_of(double a, double b, double c)
{
    return rising[(a <= b) | (b <= c) << 1 | (a <= c) << 2];
}

// Height over (u, v): from one corner, with slopes. Which corner is told by heights alone, and the
// slopes are quotients of two determinants: no order of the corners changes a bit.
typedef struct Plane
{
    double u, v, z;
    double du, dv;  // slopes [m per half sample]
} Plane;

DP_INLINE int plane_through(Plane* plane, const Corner* const* corner)
{
    const uint8_t* by_z = order_of(corner[0]->z, corner[1]->z, corner[2]->z);
    const Corner*  lowest = corner[by_z[0]];
    const Corner*  one = corner[by_z[1]];
    const Corner*  highest = corner[by_z[2]];
    const int      alone = lowest->z < one->z;  // the lowest, or else the highest
    const Corner*  from = alone ? lowest : highest;
    const Corner*  two = alone ? highest : lowest;
    const double   u1 = one->u - from->u, v1 = one->v - from->v, z1 = one->z - from->z;
    const double   u2 = two->u - from->u, v2 = two->v - from->v, z2 = two->z - from->z;
    const double   twice = u1 * v2 - u2 * v1;
    if (twice == 0.0) return 0;
    const double per_area = 1.0 / twice;
    const double du = (z1 * v2 - z2 * v1) * per_area;
    const double dv = (u1 * z2 - u2 * z1) * per_area;
    const int    fair = (du < STEEPEST) & (du > -STEEPEST) & (dv < STEEPEST) & (dv > -STEEPEST);
    plane->u = from->u, plane->v = from->v;
    plane->z = fair ? from->z : lowest->z;
    plane->du = fair ? du : 0.0;
    plane->dv = fair ? dv : 0.0;
    return 1;
}

// a where the mask says so, else b
#define PICK(mask, a, b) ((Wide)(((WideMask)(a) & (mask)) | ((WideMask)(b) & ~(mask))))

// which samples a triangle can cover; 0 where there are none
DP_INLINE int rect_of(DpSampleRect* rect, const DpSamples* samples, const Corner* const* corner)
{
    const double u0 = corner[0]->u, u1 = corner[1]->u, u2 = corner[2]->u;
    const double v0 = corner[0]->v, v1 = corner[1]->v, v2 = corner[2]->v;
    double       u_min = u0 < u1 ? u0 : u1, u_max = u0 > u1 ? u0 : u1;
    double       v_min = v0 < v1 ? v0 : v1, v_max = v0 > v1 ? v0 : v1;
    u_min = u2 < u_min ? u2 : u_min, u_max = u2 > u_max ? u2 : u_max;
    v_min = v2 < v_min ? v2 : v_min, v_max = v2 > v_max ? v2 : v_max;
    const double u_end = (double)samples->past_u + 2.0, v_end = (double)samples->past_v + 2.0;
    const int    p0 = first_at(held(u_min, u_end), samples->past_u);
    const int    p1 = last_at(held(u_max, u_end), samples->past_u);
    const int    q0 = first_at(held(v_min, v_end), samples->past_v);
    const int    q1 = last_at(held(v_max, v_end), samples->past_v);
    rect->p0 = p0 > samples->p0 ? p0 : samples->p0;
    rect->p1 = p1 < samples->p1 ? p1 : samples->p1 - 1;
    rect->q0 = q0 > samples->q0 ? q0 : samples->q0;
    rect->q1 = q1 < samples->q1 ? q1 : samples->q1 - 1;
    return (rect->p0 <= rect->p1) & (rect->q0 <= rect->q1);
}

// keep the lowest along one row between two crossings, LANES at a time
DP_INLINE void lower_span(const DpSamples* samples, int q, double v, double one, double two,
                          const Plane* plane)
{
    double       left = one < two ? one : two, right = one < two ? two : one;
    const double u0 = (double)(2 * samples->p0 - samples->past_u);
    const double u1 = (double)(2 * samples->p1 - 2 - samples->past_u);
    left = left > u0 ? left : u0;
    right = right < u1 ? right : u1;
    if (!(left <= right)) return;
    const int first = first_at(left, samples->past_u), last = last_at(right, samples->past_u);
    if (first > last) return;

    // heights go out from the span's middle: short distances, small rounding, no side preferred
    const int   middle = first + last - samples->past_u;
    const float z0 =
        (float)(plane->z + (v - plane->v) * plane->dv + ((double)middle - plane->u) * plane->du);
    const float slope = (float)plane->du, half_width = (float)(last - first);
    const Wide  lanes = {0.0f, 2.0f, 4.0f, 6.0f, 8.0f, 10.0f, 12.0f, 14.0f};

    const int begin = (first - samples->p0) & ~(LANES - 1);
    float*    low = samples->low + (size_t)(q - samples->q0) * (size_t)samples->row;
    Wide      d = lanes + (float)(2 * (begin + samples->p0) - samples->past_u - middle);
    for (int p = begin; p <= last - samples->p0; p += LANES, d += 2.0f * LANES) {
        Wide was;
        memcpy(&was, low + p, sizeof was);
        const Wide z = z0 + d * slope;
        const Wide now = PICK((d >= -half_width) & (d <= half_width) & (z < was), z, was);
        memcpy(low + p, &now, sizeof now);
    }
}

// Rows that meet a corner end in it exactly, so that all triangles about a corner meet there.
DP_INLINE void lower_triangle(const DpSamples* samples, const DpSampleRect* rect,
                              const Corner* const* corner)
{
    Plane plane;
    if (!plane_through(&plane, corner)) return;  // upright or without area: others share its edges
    const uint8_t* by_v = order_of(corner[0]->v, corner[1]->v, corner[2]->v);
    const Corner*  low = corner[by_v[0]];
    const Corner*  mid = corner[by_v[1]];
    const Corner*  top = corner[by_v[2]];
    const Edge     long_side = edge_between(low, top);
    const double   v0 = (double)(2 * rect->q0 - samples->past_v);
    const double   v1 = (double)(2 * rect->q1 - samples->past_v);
    Edge lower = long_side, upper = long_side;  // many triangles have no row in one of them
    if (v0 < mid->v) lower = edge_between(low, mid);
    if (v1 > mid->v) upper = edge_between(mid, top);
    for (int q = rect->q0; q <= rect->q1; ++q) {
        const double v = (double)(2 * q - samples->past_v);
        double       one = crossing(&long_side, v);
        double       two = crossing(v < mid->v ? &lower : &upper, v);
        if (v <= low->v || v >= top->v || v == mid->v) {
            one = v <= low->v ? low->u : v >= top->v ? top->u : one;
            two = v == mid->v ? mid->u : one;
        }
        lower_span(samples, q, v, one, two, &plane);
    }
}

// ---- the side that cannot be seen from below --------------------------------------------------

DP_INLINE double seen_from_above(const Corner* const* corner)  // twice the area, < 0 clockwise
{
    return (corner[1]->u - corner[0]->u) * (corner[2]->v - corner[0]->v) -
           (corner[2]->u - corner[0]->u) * (corner[1]->v - corner[0]->v);
}

#define CORNERS(at, triangle, t)                                                    \
    {                                                                               \
        &(at)[(triangle)[3 * (size_t)(t)]], &(at)[(triangle)[3 * (size_t)(t) + 1]], \
            &(at)[(triangle)[3 * (size_t)(t) + 2]]                                  \
    }

// +1 if triangles that run clockwise are more likely below, -1 if above: a guess from some of them
static double guess_below(const Corner* at, const int32_t* triangle, int count)
{
    double volume = 0.0;
    for (int t = 0; t < count; t += 1 + count / ASKED) {
        const Corner* const corner[3] = CORNERS(at, triangle, t);
        volume += seen_from_above(corner) * (corner[0]->z + corner[1]->z + corner[2]->z);
    }
    return volume < 0.0 ? -1.0 : 1.0;
}

// no sample of the triangle can be lower than what is there: rows from its first sample on, what is
// beyond its last does not count
DP_INLINE int is_hidden(const DpSamples* samples, const DpSampleRect* rect,
                        const Corner* const* corner)
{
    const double z0 = corner[0]->z, z1 = corner[1]->z, z2 = corner[2]->z;
    double       lowest = z0 < z1 ? z0 : z1, highest = z0 < z1 ? z1 : z0;
    lowest = z2 < lowest ? z2 : lowest, highest = z2 > highest ? z2 : highest;
    const float bottom = (float)(lowest - 1e-6 * highest);  // no rounding of a sample goes so far
    const WideMask lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    WideMask       open = {0, 0, 0, 0, 0, 0, 0, 0};
    for (int q = rect->q0; q <= rect->q1; ++q) {
        const float* low = samples->low + (size_t)(q - samples->q0) * (size_t)samples->row;
        for (int p = rect->p0; p <= rect->p1; p += LANES) {
            Wide was;
            memcpy(&was, low + (p - samples->p0), sizeof was);
            open |= (was > bottom) & (lanes <= rect->p1 - p);
        }
    }
    int64_t any[LANES / 2];
    memcpy(any, &open, sizeof any);
    return (any[0] | any[1] | any[2] | any[3]) == 0;
}

DP_CLONES static void lower_triangles(const DpSamples* samples, const Corner* at,
                                      const int32_t* triangle, int count, DpSampleRect* due)
{
    // who is due: first those that are likely below from the front, then the others from the back
    const double below = guess_below(at, triangle, count);
    int          front = 0, back = count;
    for (int t = 0; t < count; ++t) {
        const Corner* const corner[3] = CORNERS(at, triangle, t);
        DpSampleRect        rect;
        const int           meets = rect_of(&rect, samples, corner);
        const int           above = seen_from_above(corner) * below > 0.0;
        rect.triangle = t;
        due[front] = rect;
        due[back - 1] = rect;
        front += meets & !above;
        back -= meets & above;
    }
    for (int n = 0; n < front; ++n) {
        const Corner* const corner[3] = CORNERS(at, triangle, due[n].triangle);
        lower_triangle(samples, &due[n], corner);
    }
    for (int n = back; n < count; ++n) {
        const Corner* const corner[3] = CORNERS(at, triangle, due[n].triangle);
        if (!is_hidden(samples, &due[n], corner)) lower_triangle(samples, &due[n], corner);
    }
}

void dp_samples_lower(const DpSamples* samples, const double* corner, const int32_t* triangle,
                      int count, DpSampleRect* due)
{
    lower_triangles(samples, (const Corner*)(const void*)corner, triangle, count, due);
}
