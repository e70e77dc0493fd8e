// Scan rows: where a row of samples crosses a triangle, its span is known from two edges, and the
// lowest height is kept along the span. Bigger values of v are further along +y.
//
// Spans are closed at both ends. An edge's crossing is computed from the edge alone, so two
// neighbours end and begin at the same number and no sample falls between them; a sample on their
// edge belongs to both, which a minimum does not mind. A sample exactly on the sole's outline counts.
#include "imprint/imprint_raster.h"

#include <string.h>

#include "base/wide.h"

#define LANES 8  // samples at a time; two registers where one holds four
#define STEEPEST 1e4  // m per half sample: a needle seen edge-on, its lowest corner stands for it

typedef float   Wide __attribute__((vector_size(LANES * sizeof(float))));
typedef int32_t WideMask __attribute__((vector_size(LANES * sizeof(int32_t))));

typedef struct Corner
{
    double u, v, z;
} Corner;

// where an edge crosses rows; from its middle, so that up and down are alike
typedef struct Edge
{
    Corner a, b;  // a.v <= b.v
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
    const double near = held(x, (double)past + 2.0);
    const int    whole = (int)near;
    const int    up = whole + ((double)whole < near);
    return ((up + past + 3) >> 1) - 1;
}

DP_INLINE int last_at(double x, int past)
{
    const double near = held(x, (double)past + 2.0);
    const int    whole = (int)near;
    const int    down = whole - ((double)whole > near);
    return ((down + past + 2) >> 1) - 1;
}

int dp_samples_first(double x, int past)
{
    return first_at(x, past);
}

int dp_samples_last(double x, int past)
{
    return last_at(x, past);
}

DP_INLINE Edge edge_between(Corner a, Corner b)
{
    Edge edge = {a, b, 0.5 * (a.u + b.u), 0.5 * (a.v + b.v), 0.0};
    if (b.v > a.v) edge.lean = (b.u - a.u) / (b.v - a.v);
    return edge;
}

// exact at both ends, so that all triangles about a corner meet in it
DP_INLINE double crossing(const Edge* edge, double v)
{
    const double u = edge->u + (v - edge->v) * edge->lean;
    return v <= edge->a.v ? edge->a.u : v >= edge->b.v ? edge->b.u : u;
}

DP_INLINE void order(Corner* a, Corner* b)
{
    const Corner was = *a;
    if (b->v < was.v) {
        *a = *b;
        *b = was;
    }
}

// height over (u, v): from one corner, with slopes. Which corner is told by heights alone, and the
// slopes are quotients of two determinants: no order of the corners changes a bit.
typedef struct Plane
{
    Corner from;
    double du, dv;  // slopes [m per half sample]
    double lowest;
} Plane;

DP_INLINE int plane_through(Plane* plane, Corner a, Corner b, Corner c)
{
    Corner from = a, one = b, two = c;
    if (b.z < from.z) from = b, one = a, two = c;
    if (c.z < from.z) from = c, one = a, two = b;
    plane->lowest = from.z;
    if (one.z == from.z || two.z == from.z) {  // the lowest is not alone: the highest is, or all are
        if (one.z > from.z) {
            const Corner was = from;
            from = one;
            one = was;
        } else if (two.z > from.z) {
            const Corner was = from;
            from = two;
            two = was;
        }
    }
    const double u1 = one.u - from.u, v1 = one.v - from.v, z1 = one.z - from.z;
    const double u2 = two.u - from.u, v2 = two.v - from.v, z2 = two.z - from.z;
    const double twice = u1 * v2 - u2 * v1;
    if (twice == 0.0) return 0;
    const double du = (z1 * v2 - z2 * v1) / twice;
    const double dv = (u1 * z2 - u2 * z1) / twice;
    plane->from = from;
    plane->du = du, plane->dv = dv;
    if (!(du < STEEPEST && du > -STEEPEST && dv < STEEPEST && dv > -STEEPEST)) {
        plane->from.z = plane->lowest;
        plane->du = plane->dv = 0.0;
    }
    return 1;
}

// a where the mask says so, else b
#define PICK(mask, a, b) ((Wide)(((WideMask)(a) & (mask)) | ((WideMask)(b) & ~(mask))))

// keep the lowest along samples first..last of one row, `LANES` at a time
DP_INLINE void lower_span(const DpSamples* samples, int first, int last, int q, double v,
                          const Plane* plane)
{
    // heights are measured from the span's middle: short distances, small rounding, no side preferred
    const int   middle = first + last - samples->past_u;
    const float z0 = (float)(plane->from.z + (v - plane->from.v) * plane->dv +
                             ((double)middle - plane->from.u) * plane->du);
    const float slope = (float)plane->du;
    const float d0 = (float)(2 * first - samples->past_u - middle);
    const float d1 = (float)(2 * last - samples->past_u - middle);
    const Wide  floor = (Wide){0.0f} + (float)plane->lowest;
    const Wide  lanes = {0.0f, 2.0f, 4.0f, 6.0f, 8.0f, 10.0f, 12.0f, 14.0f};

    const int begin = (first - samples->p0) & ~(LANES - 1);
    float*    low = samples->low + (size_t)(q - samples->q0) * (size_t)samples->row;
    Wide      d = lanes + (float)(2 * (begin + samples->p0) - samples->past_u - middle);
    for (int p = begin; p <= last - samples->p0; p += LANES, d += 2.0f * LANES) {
        Wide was;
        memcpy(&was, low + p, sizeof was);
        const Wide plain = z0 + d * slope;
        const Wide z = PICK(plain > floor, plain, floor);
        const Wide now = PICK((d >= d0) & (d <= d1) & (z < was), z, was);
        memcpy(low + p, &now, sizeof now);
    }
}

DP_INLINE void lower_triangle(const DpSamples* samples, Corner a, Corner b, Corner c)
{
    const double u_min = a.u < b.u ? (a.u < c.u ? a.u : c.u) : (b.u < c.u ? b.u : c.u);
    const double u_max = a.u > b.u ? (a.u > c.u ? a.u : c.u) : (b.u > c.u ? b.u : c.u);
    int          p_min = first_at(u_min, samples->past_u);
    int          p_max = last_at(u_max, samples->past_u);
    if (p_min < samples->p0) p_min = samples->p0;
    if (p_max >= samples->p1) p_max = samples->p1 - 1;
    if (p_min > p_max) return;

    Corner low = a, mid = b, top = c;
    order(&low, &mid);
    order(&mid, &top);
    order(&low, &mid);
    int q_min = first_at(low.v, samples->past_v);
    int q_max = last_at(top.v, samples->past_v);
    if (q_min < samples->q0) q_min = samples->q0;
    if (q_max >= samples->q1) q_max = samples->q1 - 1;
    if (q_min > q_max) return;

    Plane plane;
    if (!plane_through(&plane, a, b, c)) return;  // upright or without area: others share its edges

    const Edge whole = edge_between(low, top);
    const Edge lower = edge_between(low, mid), upper = edge_between(mid, top);
    for (int q = q_min; q <= q_max; ++q) {
        const double v = (double)(2 * q - samples->past_v);
        const double one = crossing(&whole, v);
        const double two = v < mid.v ? crossing(&lower, v) : v > mid.v ? crossing(&upper, v) : mid.u;
        int          first = first_at(one < two ? one : two, samples->past_u);
        int          last = last_at(one < two ? two : one, samples->past_u);
        if (first < p_min) first = p_min;
        if (last > p_max) last = p_max;
        if (first <= last) lower_span(samples, first, last, q, v, &plane);
    }
}

DP_CLONES static void lower_triangles(const DpSamples* samples, const Corner* at,
                                      const int32_t* triangle, int count)
{
    for (int t = 0; t < count; ++t) {
        const int32_t* of = triangle + 3 * (size_t)t;
        lower_triangle(samples, at[of[0]], at[of[1]], at[of[2]]);
    }
}

void dp_samples_lower(const DpSamples* samples, const double* corner, const int32_t* triangle,
                      int count)
{
    lower_triangles(samples, (const Corner*)(const void*)corner, triangle, count);
}
