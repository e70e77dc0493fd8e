// soil/soil_heap_envelope.c - the upper envelope of cones, as distances along rows and across them.
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_heap_inside.h"

#define SIDE 0.5  // the share of its height a pushed heap has at its sides [-]; MODEL 6.11

// What a row got from the row before, as bits.
#define ROW_RAISED 1  // a cell is higher than it was
#define ROW_CONES 2   // a cone reaches it

// fill[i] = max(fill[i], what comes from the row before), NOTHING on walls
DP_CLONES
static int from_row(int32_t* restrict fill, const int32_t* restrict before,
                    const int32_t* restrict surface, int count, int32_t straight, int32_t diagonal)
{
    int raised = 0, cones = 0;
    for (int i = 0; i < count; ++i) {
        const int32_t side = before[i - 1] > before[i + 1] ? before[i - 1] : before[i + 1];
        const int32_t up = before[i] - straight, across = side - diagonal;
        const int32_t come = up > across ? up : across;
        const int32_t highest = come > fill[i] ? come : fill[i];
        const int32_t now = surface[i] == WALL ? NOTHING : highest;
        raised |= now > fill[i];
        cones |= now > NOTHING / 2;
        fill[i] = now;
    }
    return (raised ? ROW_RAISED : 0) | (cones ? ROW_CONES : 0);
}

// fill[i] = max(fill[i], what comes from the cells beside it), between walls; where cones are as high
// as their distance along the row, the highest so far is all one has to know. Both ways at once.
static void along_row(int32_t* restrict fill, int32_t* restrict spare, const int32_t* restrict turn,
                      int count, int32_t straight)
{
    for (int from = turn[0] < 0 ? -turn[0] : 0; from < count;) {
        const int to = turn[from];
        int32_t   ahead = NOTHING, back = NOTHING, rise = 0;
        for (int i = from, k = to - 1; i < to; ++i, --k, rise += straight) {
            const int32_t here = fill[i] + rise, there = fill[k] + rise;
            ahead = here > ahead ? here : ahead;
            back = there > back ? there : back;
            fill[i] = ahead - rise;
            spare[k] = back - rise;
        }
        for (int i = from; i < to; ++i) fill[i] = fill[i] > spare[i] ? fill[i] : spare[i];
        from = to < count ? -turn[to] : count;
    }
}

// does any cell of the row still get more from its neighbours?
DP_CLONES
static int wants_more(const int32_t* fill, const int32_t* below, const int32_t* above,
                      const int32_t* surface, int count, int32_t straight, int32_t diagonal)
{
    int more = 0;
    for (int i = 0; i < count; ++i) {
        const int32_t side = fill[i - 1] > fill[i + 1] ? fill[i - 1] : fill[i + 1];
        const int32_t next = below[i] > above[i] ? below[i] : above[i];
        const int32_t low = below[i - 1] > below[i + 1] ? below[i - 1] : below[i + 1];
        const int32_t high = above[i - 1] > above[i + 1] ? above[i - 1] : above[i + 1];
        const int32_t up = (side > next ? side : next) - straight;
        const int32_t across = (low > high ? low : high) - diagonal;
        const int32_t come = up > across ? up : across;
        more |= (come > fill[i]) & (surface[i] != WALL) & (come > NOTHING / 2);
    }
    return more;
}

// row j learns from row j + from, and its cells from each other if it got any of `when`; returns
// what it got
static int spread_row(const Heap* heap, int j, int from, int when)
{
    const Window* window = &heap->window;
    int32_t*      fill = row_of(window, window->fill, j);
    const int     got =
        from_row(fill, row_of(window, window->fill, j + from), row_of(window, window->surface, j),
                 window->nx, heap->straight, heap->diagonal);
    if (got & when)
        along_row(fill, window->spare, row_of(window, window->turn, j), window->nx, heap->straight);
    return got;
}

// first row that still gets more from its neighbours; the number of rows: none
static int wanting_row(const Heap* heap)
{
    const Window* window = &heap->window;
    int           j = 0;
    while (j < window->ny &&
           !wants_more(row_of(window, window->fill, j), row_of(window, window->fill, j - 1),
                       row_of(window, window->fill, j + 1), row_of(window, window->surface, j),
                       window->nx, heap->straight, heap->diagonal))
        ++j;
    return j;
}

// envelope of the cones: two chamfer passes, and again from the first row that still wants more
// while distances lead around the sole. Once a row's cells have learnt from each other, they do so
// again only when the row is raised.
static void spread(const Heap* heap)
{
    const int ny = heap->window.ny;
    int       when = ROW_CONES;
    for (int first = 0; first < ny; first = wanting_row(heap), when = ROW_RAISED) {
        for (int j = first; j < ny; ++j) (void)spread_row(heap, j, -1, when);
        for (int j = ny - 1; j >= 0; --j)
            if (!(spread_row(heap, j, 1, ROW_RAISED) & ROW_RAISED) && j < first) break;
    }
}

DP_CLONES
static void measure_row(const int32_t* restrict fill, const int32_t* restrict surface, int count,
                        Laid* laid)
{
    int64_t volume = 0;
    int32_t cells = 0;
    for (int i = 0; i < count; ++i) {
        const int32_t over = fill[i] - surface[i];
        volume += over > 0 ? over : 0;
        cells += over > 0 ? 1 : 0;
    }
    laid->volume += volume;
    laid->cells += cells;
}

// How high the cone of a border cell is, the highest being `height` [m].
static double top_of(const Apex* apex, double height)
{
    const double lower = soil_max(SIDE * height - apex->climbs, 0.0);
    return apex->root * (height - apex->spills * lower);
}

DP_CLONES
static void put_cones(const Heap* heap, double height)
{
    const Window* window = &heap->window;
    const double  steps = 1.0 / heap->step;  // a power of two: exact
    for (int k = 0; k < heap->apex_count; ++k) {
        const Apex*  apex = &heap->apex[k];
        const double top = (apex->ground - heap->level + top_of(apex, height)) * steps -
                           apex->away * (double)heap->straight;
        row_of(window, window->fill, apex->j - window->j0)[apex->i - window->i0] =
            (int32_t)floor(top + 0.5);
    }
}

Laid dp_heap_fill(const Heap* heap, double height)
{
    const Window* window = &heap->window;
    const size_t  cells = (size_t)window->row * (size_t)(window->ny + 2);
    dp_heap_flat(window->fill, cells, NOTHING);
    put_cones(heap, height);
    spread(heap);
    Laid laid = {0, 0};
    for (int j = 0; j < window->ny; ++j)
        measure_row(row_of(window, window->fill, j), row_of(window, window->surface, j), window->nx,
                    &laid);
    return laid;
}
