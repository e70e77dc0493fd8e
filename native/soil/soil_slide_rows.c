// soil/soil_slide_rows.c - soil slides row by row. TRAIL (14)-(16).
//
// Opposite neighbours are added in pairs, so a mirrored or turned print stays mirrored or turned to the bit.
#include "base/finite.h"
#include "base/wide.h"  // these two first: they say how loops may be widened
#include "soil/soil_slide.h"

DP_CLONES
static int decide(float* restrict share, float* restrict give, const float* restrict h,
                  const float* restrict heap, const float* restrict fall,
                  const float* restrict slack, ptrdiff_t row, int count, float film, float most)
{
    const float one = 1.0f / film;  // an excess as large as a film counts as one neighbour
    int         moves = 0, restless = 0;
    for (int i = 0; i < count; ++i) {
        const float* c = h + i;
        const float  at = *c, straight = fall[i], diagonal = fall[i] * ROOT2;
        const float  e = above_zero((at - c[1]) - straight);  // TRAIL (14)
        const float  w = above_zero((at - c[-1]) - straight);
        const float  n = above_zero((at - c[row]) - straight);
        const float  s = above_zero((at - c[-row]) - straight);
        const float  ne = above_zero((at - c[row + 1]) - diagonal);
        const float  sw = above_zero((at - c[-row - 1]) - diagonal);
        const float  nw = above_zero((at - c[row - 1]) - diagonal);
        const float  se = above_zero((at - c[-row + 1]) - diagonal);
        const float  sides = (e + w) + (n + s), corners = (ne + sw) + (nw + se);
        const float  by_sides = (at_most_one(e * one) + at_most_one(w * one)) +
                               (at_most_one(n * one) + at_most_one(s * one));
        const float by_corners = (at_most_one(ne * one) + at_most_one(sw * one)) +
                                 (at_most_one(nw * one) + at_most_one(se * one));
        const float sum = sides + corners, part = 1.0f / ((by_sides + by_corners) + 1.0f);
        const float has = (heap[i] < most ? heap[i] : most) / (sum * part + 1e-35f);
        const float ew = e > w ? e : w, ns = n > s ? n : s;
        const float up = ne > sw ? ne : sw, down = nw > se ? nw : se;
        const float steep = ew > ns ? ew : ns, across = (up > down ? up : down) * (1.0f / ROOT2);
        const float over = steep > across ? steep : across, hold = HOLD * slack[i];
        const float eager = at_most_one(above_zero(over - hold) / (hold + 1e-35f));
        const float a =
            at_most_one(has) * part * (eager * at_most_one(heap[i] * one));  // TRAIL (15)
        share[i] = a;
        give[i] = a * sum;
        restless |= (heap[i] > film ? over : 0.0f) > slack[i] ? 1 : 0;
        moves |= a * sum > 0.0f ? 1 : 0;
    }
    return (moves ? ROW_MOVES : 0) | (restless ? ROW_RESTLESS : 0);
}

// what cell h[k] gives to the cell at height `at`
static inline float comes(const float* h, const float* share, const float* fall, ptrdiff_t k,
                          float at, float far)
{
    return share[k] * above_zero((h[k] - at) - fall[k] * far);
}

DP_CLONES
static void take(double* restrict sum, const float* restrict give, const float* restrict h,
                 const float* restrict share, const float* restrict fall, ptrdiff_t row, int count)
{
    for (int i = 0; i < count; ++i) {
        const float *H = h + i, *a = share + i, *f = fall + i;
        const float  at = *H;
        const float  sides = (comes(H, a, f, 1, at, 1.0f) + comes(H, a, f, -1, at, 1.0f)) +
                            (comes(H, a, f, row, at, 1.0f) + comes(H, a, f, -row, at, 1.0f));
        const float edges =
            (comes(H, a, f, row + 1, at, ROOT2) + comes(H, a, f, -row - 1, at, ROOT2)) +
            (comes(H, a, f, row - 1, at, ROOT2) + comes(H, a, f, -row + 1, at, ROOT2));
        const double left = sum[i] - (double)give[i];
        sum[i] = (left > 0.0 ? left : 0.0) + (double)(sides + edges);  // TRAIL (16)
    }
}

DP_CLONES
static void raise_row(float* restrict height, float* restrict heap, const float* restrict firm,
                      const double* restrict sum, int count)
{
    for (int i = 0; i < count; ++i) {
        heap[i] = (float)sum[i];
        height[i] = firm[i] + heap[i];
    }
}

// ---- the doors of those above ------------------------------------------------------------------

int dp_slide_decide(float* restrict share, float* restrict give, const float* restrict h,
                    const float* restrict heap, const float* restrict fall,
                    const float* restrict slack, ptrdiff_t row, int count, float film, float most)
{
    return decide(share, give, h, heap, fall, slack, row, count, film, most);
}

void dp_slide_take(double* restrict sum, const float* restrict give, const float* restrict h,
                   const float* restrict share, const float* restrict fall, ptrdiff_t row,
                   int count)
{
    take(sum, give, h, share, fall, row, count);
}

void dp_slide_raise(float* restrict height, float* restrict heap, const float* restrict firm,
                    const double* restrict sum, int count)
{
    raise_row(height, heap, firm, sum, count);
}
