// paths/paths_arrival.c - when a wave arrives that starts at the goals: fast marching of second order. MODEL 12.1
//
// Cells are known in the order of their times. Whenever one becomes known, its neighbours are told anew from all that is
// known around them: what they are told in the end does not depend on who came first among equals.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "paths/paths.h"
#include "paths/paths_queue.h"

#define RIM 2                // cells of nothing around the field, as far as a neighbour's neighbour
#define NOWHERE 0x7F800000u  // the bits of +inf
#define TENTATIVE 0x80000000u  // the sign of a time that may change yet

// Cells lie in blocks of 4 x 4, so that those beside each other are near in memory, too. What is known of a cell is
// one number, the bits of its time: below NOWHERE it stands, with the sign it is only told.
typedef struct March
{
    size_t    across, count;  // blocks side by side, cells
    double    cell;
    float*    cost;  // < 0: of a goal whose start holds; +inf: an obstacle
    uint32_t* time;  // bits
    ptrdiff_t
        beside[4][4];  // from a cell to those at -1, 1, -2, 2 along x, by its column in the block
    ptrdiff_t above[4][4];  // along y, by its row
    DpQueue   queue;
} March;

static inline float as_time(uint32_t bits)
{
    float time;
    memcpy(&time, &bits, sizeof time);
    return time;
}

static inline uint32_t bits_of(float time)
{
    uint32_t bits;
    memcpy(&bits, &time, sizeof bits);
    return bits;
}

static inline uint32_t earlier(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// where the first cell of row j of the field would lie, were there no rim beside it
static inline size_t row_of(const March* m, int j)
{
    const size_t y = (size_t)j + RIM;
    return 16 * (y / 4 * m->across) + 4 * (y % 4);
}

// how far from there the cell in column i lies
static inline size_t column_of(int i)
{
    const size_t x = (size_t)i + RIM;
    return 16 * (x / 4) + x % 4;
}

static void lay_neighbours(March* m)
{
    static const int to[4] = {-1, 1, -2, 2};
    for (int k = 0; k < 4; ++k)
        for (int n = 0; n < 4; ++n) {
            const int at = k + to[n], block = at < 0 ? -1 : at / 4, inside = at - 4 * block;
            m->beside[k][n] = 16 * block + inside - k;
            m->above[k][n] = 16 * (ptrdiff_t)m->across * block + 4 * (inside - k);
        }
}

// What one axis knows: the earlier neighbour, its time when the cell behind it is used, too, and how much that weighs.
typedef struct Upwind
{
    uint32_t bits;     // of the earlier neighbour; NOWHERE and more: none
    double   first;    // of first order
    double   at;       // (4 T1 - T2) / 3 of second order, else T1
    double   weight;   // 9 / 4 or 1
    double   inverse;  // 1 / sqrt(weight)
} Upwind;

static inline Upwind upwind(const uint32_t* time, const ptrdiff_t* to)
{
    const uint32_t low = time[to[0]], high = time[to[1]], low2 = time[to[2]], high2 = time[to[3]];
    const uint32_t bits = earlier(low, high);
    const uint32_t behind = low < high ? low2 : high < low ? high2 : earlier(low2, high2);
    const double   t1 = (double)as_time(bits);
    if (behind < bits) {
        const double at = (4.0 * t1 - (double)as_time(behind)) * (1.0 / 3.0);  // MODEL 12.1
        return (Upwind){bits, t1, at, 2.25, 2.0 / 3.0};
    }
    return (Upwind){bits, t1, t1, 1.0, 1.0};
}

// T of w (T - u)^2 + q (T - v)^2 = f^2, not before either; +inf where there is none
static inline double meet(double u, double w, double v, double q, double f)
{
    const double sum = w + q, apart = u - v, root = sum * f * f - w * q * (apart * apart);
    if (!(root >= 0.0)) return INFINITY;
    const double time = (w * u + q * v + sqrt(root)) / sum;  // MODEL 12.1
    return time >= u && time >= v ? time : INFINITY;
}

static inline double alone(const Upwind* side, double f)
{
    return side->at + f * side->inverse;
}

static inline double arrive(const Upwind* x, const Upwind* y, double f)
{
    if (y->bits >= NOWHERE) return alone(x, f);
    if (x->bits >= NOWHERE) return alone(y, f);
    double time = meet(x->at, x->weight, y->at, y->weight, f);
    if (!(time < (double)INFINITY)) time = meet(x->first, 1.0, y->first, 1.0, f);
    if (time < (double)INFINITY) return time;
    const double one = alone(x, f), other = alone(y, f);
    return one < other ? one : other;
}

// tell a cell anew; false when there is no memory
static inline bool tell(March* m, size_t at, float now)
{
    const uint32_t was = m->time[at];
    if (was < NOWHERE) return true;
    const float cost = m->cost[at];
    if (!(cost < INFINITY)) return true;
    const Upwind x = upwind(m->time + at, m->beside[at % 4]);
    const Upwind y = upwind(m->time + at, m->above[at / 4 % 4]);
    const double f = fabs((double)cost) * m->cell;
    const float  least = as_time(earlier(x.bits, y.bits));
    float        time = (float)arrive(&x, &y, f);
    if (time < now) time = now;
    if (time <= least)
        time = nextafterf(least, INFINITY);  // each cell has one before it, however long the way
    const uint32_t tentative = bits_of(time) | TENTATIVE;
    if (tentative == was) return true;
    if (cost < 0.0f) {  // a start is more exact than what comes from beside it
        if ((double)time + f >= (double)as_time(was & ~TENTATIVE)) return true;
        m->cost[at] = -cost;
    }
    m->time[at] = tentative;
    return dp_queue_push(&m->queue, time, (uint32_t)at);
}

// whether a cell is still told the time of a key
static inline bool still_waits(const void* times, uint64_t key)
{
    return ((const uint32_t*)times)[key & UINT32_MAX] == ((uint32_t)(key >> 32) | TENTATIVE);
}

static DpStatus march(March* m)
{
    uint64_t key;
    int      more;
    while ((more = dp_queue_pop(&m->queue, &key, still_waits, m->time)) > 0) {
        const size_t    at = (size_t)(key & UINT32_MAX);
        const uint32_t  bits = (uint32_t)(key >> 32);
        const ptrdiff_t here = (ptrdiff_t)at, *x = m->beside[at % 4], *y = m->above[at / 4 % 4];
        if (m->time[at] != (bits | TENTATIVE)) continue;  // it stands, or has changed since
        m->time[at] = bits;
        const float now = as_time(bits);
        if (!tell(m, (size_t)(here + x[0]), now) || !tell(m, (size_t)(here + x[1]), now) ||
            !tell(m, (size_t)(here + y[0]), now) || !tell(m, (size_t)(here + y[1]), now))
            return DP_NO_MEMORY;
    }
    return more < 0 ? DP_NO_MEMORY : DP_OK;
}

static bool good_size(const DpPathField* field)
{
    return field->value && field->nx >= 1 && field->ny >= 1 && field->cell >= 1e-6 &&
           field->cell <= 1e6 && ((int64_t)field->nx + 8) * ((int64_t)field->ny + 8) < INT32_MAX;
}

// costs with a rim of obstacles, and how wide buckets are
static DpStatus lay_costs(March* m, const DpPathField* cost)
{
    double sum = 0.0;
    size_t free = 0;
    for (size_t k = 0; k < m->count; ++k) m->cost[k] = INFINITY, m->time[k] = NOWHERE;
    for (int j = 0; j < cost->ny; ++j) {
        const float* from = cost->value + (size_t)j * (size_t)cost->nx;
        float* const row = m->cost + row_of(m, j);
        for (int i = 0; i < cost->nx; ++i) {
            if (isnan(from[i]) || from[i] == INFINITY) continue;
            if (!(from[i] >= 1.0f / DP_MAX_COST && from[i] <= DP_MAX_COST)) return DP_BAD_ARGUMENT;
            row[column_of(i)] = from[i];
            sum += (double)from[i];
            free += 1;
        }
    }
    m->queue.buckets = free ? 1024.0 / (sum / (double)free * m->cell) : 1.0;
    return DP_OK;
}

static DpStatus lay_goals(March* m, const DpPathField* cost, const DpGoals* goals)
{
    for (int k = 0; k < goals->count; ++k) {
        const float   start = goals->start ? goals->start[k] : 0.0f;
        const int32_t cell = goals->cell[k];
        if (cell < 0 || cell / cost->nx >= cost->ny) return DP_BAD_ARGUMENT;
        const size_t at = row_of(m, cell / cost->nx) + column_of(cell % cost->nx);
        if (!(m->cost[at] < INFINITY) || !(start >= 0.0f && start <= 1e30f)) return DP_BAD_ARGUMENT;
        m->cost[at] = -fabsf(m->cost[at]);
        const uint32_t tentative = bits_of(start) | TENTATIVE;
        if (m->time[at] != NOWHERE && m->time[at] <= tentative) continue;
        m->time[at] = tentative;
        if (!dp_queue_push(&m->queue, fabsf(start), (uint32_t)at)) return DP_NO_MEMORY;
    }
    return DP_OK;
}

DpStatus dp_paths_arrival(float* time, const DpPathField* cost, const DpGoals* goals)
{
    if (!good_size(cost) || goals->count < 1 || !goals->cell) return DP_BAD_ARGUMENT;
    March m = {.across = ((size_t)cost->nx + 2 * RIM + 3) / 4, .cell = cost->cell};
    m.count = 16 * m.across * (((size_t)cost->ny + 2 * RIM + 3) / 4);
    m.cost = dp_alloc(m.count, sizeof *m.cost);
    m.time = dp_alloc(m.count, sizeof *m.time);
    lay_neighbours(&m);
    DpStatus status = m.cost && m.time ? lay_costs(&m, cost) : DP_NO_MEMORY;
    if (status == DP_OK) status = lay_goals(&m, cost, goals);
    if (status == DP_OK) status = march(&m);
    for (int j = 0; status == DP_OK && j < cost->ny; ++j) {
        const uint32_t* const row = m.time + row_of(&m, j);
        for (int i = 0; i < cost->nx; ++i) *time++ = as_time(row[column_of(i)]);
    }
    dp_free(m.cost), dp_free(m.time);
    dp_queue_free(&m.queue);
    return status;
}
