// soil/soil_heap_rest.c - displaced soil laid at once in the shape in which it rests. Ours; MODEL 6.3
//
//   cones on the border cells, T sqrt(omega) high --(upper envelope)--> fill --> T until volume fits
//
// A straight heap against a wall with cross-section A is a triangle of height sqrt(2 A tan
// gamma_r), so a border cell with share omega carries a cone of height T sqrt(omega) over its firm
// ground and slope tan gamma_r. Soil fills the ground up to the envelope of the cones. Distances
// are chamfer distances with 1 and sqrt(2), the metric in which soil_stabilize.c compares
// neighbours: what is laid here is at rest there. They lead around the sole, not through it. A cone is
// lower the farther its cell lies from the edge of the sole, which runs through cells that are covered in
// part and past the corners of others: else rims would be lower the larger the cells, most of all where the
// edge runs aslant.
//
// A sole that rolls leaves a hollow behind. No cone stands in it or reaches into it: what is pushed aside
// now piles up at its edge, and soil_stabilize.c lets slide in what does not stay. Else every step
// of the roll would lay a ridge across the print.
//
// Heights are whole numbers of a small step (a power of two, some nanometres), so that neither the
// order of a sweep nor that of a sum can change a bit: with equal shares, mirrored or
// turned ground gets exactly mirrored or turned heaps. With a push the shares come from
// coordinates; they are rounded to 2^-30 and agree but for ties (soil_accumulate.c).
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_heaps.h"

#define NOTHING (-(1 << 30))  // no cone reaches this cell
#define WALL (1 << 29)        // surface of cells that take no soil: under the sole, no ground
#define MAX_STEPS (1 << 28)   // heights stay below this, so that no sum can overflow
#define HOLLOW 0.5    // cells pressed to this share of the deepest under the sole are hollow
#define MATCH 0.0002  // a volume this close is right; the rest is a common factor
#define MAX_ROUNDS 40

// The part of the patch that is worked on, with a frame of one wall cell around it.
typedef struct Window
{
    int      i0, j0, nx, ny;  // patch cells i0 <= i < i0 + nx, j0 <= j < j0 + ny
    int      row;             // nx + 2, and what makes rows start evenly
    int32_t* surface;         // present surface h, WALL where no soil can go [steps] (ny + 2, row)
    int32_t* fill;            // envelope of the cones                        [steps] (ny + 2, row)
    int32_t* turn;            // where a run of cells begins: its end; of walls: minus that
    int32_t* spare;           // one row
} Window;

// A border cell with a share.
typedef struct Apex
{
    int    i, j;    // of the patch
    double ground;  // firm ground [m]
    double root;    // sqrt(omega) [-]
    double away;    // from the sole's edge, beyond half a cell [cells]
} Apex;

typedef struct Heap
{
    DpSoilPatch*     patch;
    const DpImprint* imprint;
    Window           window;
    Apex*            apex;
    int              apex_count;
    float            hollow;    // untouched cells pressed this deep take no soil [m]
    double           step;      // height of one step    [m]
    double           level;     // height of step 0      [m]
    int32_t          straight;  // what a cone falls per cell                [steps]
    int32_t          diagonal;  // .. per diagonal cell, sqrt(2) times that  [steps]
} Heap;

// neither under the sole, nor off the ground, nor in the hollow that the sole has left
static bool takes_soil(const Heap* heap, size_t p)
{
    return soil_is_ground(heap->patch->base_height[p]) && heap->imprint->ring[p] != 0 &&
           heap->patch->compression[p] < heap->hollow;
}

// how deep a cell must be pressed to count as hollow
static float hollow_under(const DpSoilPatch* patch, const DpImprint* imprint)
{
    float deepest = 0.0f;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (imprint->ring[p] == 0 && patch->compression[p] > deepest)
                deepest = patch->compression[p];
        }
    return deepest > 0.0f ? (float)HOLLOW * deepest : INFINITY;
}

static int32_t* row_of(const Window* window, int32_t* grid, int j)
{
    return grid + (size_t)(j + 1) * (size_t)window->row + 1;
}

// ---- envelope --------------------------------------------------------------------------------

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

// What lies over the present surface.
typedef struct Laid
{
    int64_t volume;  // [steps * cells]
    int64_t cells;   // how many cells that is
} Laid;

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

// lay cones of height T sqrt(omega), and measure what lies over the present surface
static Laid fill_to(const Heap* heap, double height)
{
    const Window* window = &heap->window;
    const size_t  cells = (size_t)window->row * (size_t)(window->ny + 2);
    for (size_t k = 0; k < cells; ++k) window->fill[k] = NOTHING;
    for (int k = 0; k < heap->apex_count; ++k) {
        const Apex*  apex = &heap->apex[k];
        const double top = (apex->ground - heap->level + height * apex->root) / heap->step -
                           apex->away * (double)heap->straight;
        row_of(window, window->fill, apex->j - window->j0)[apex->i - window->i0] =
            (int32_t)floor(top + 0.5);
    }
    spread(heap);
    Laid laid = {0, 0};
    for (int j = 0; j < window->ny; ++j)
        measure_row(row_of(window, window->fill, j), row_of(window, window->surface, j), window->nx,
                    &laid);
    return laid;
}

// ---- window ----------------------------------------------------------------------------------

#define LANES 8  // lowest and highest of so many columns at once

// lowest firm ground and highest surface of one row; ground that is not there is NaN and not less
DP_CLONES
static void range_of_row(const float* restrict base_height, const float* restrict compression,
                         const float* restrict heap, int count, double* restrict low,
                         double* restrict high)
{
    for (int i = 0; i < count; i += LANES) {
        const int lanes = count - i < LANES ? count - i : LANES;
        for (int k = 0; k < lanes; ++k) {
            const double firm = (double)base_height[i + k] - (double)compression[i + k];
            const double top = firm + (double)heap[i + k];
            low[k] = firm < low[k] ? firm : low[k];
            high[k] = top > high[k] ? top : high[k];
        }
    }
}

// the surface in steps above `low`; WALL where takes_soil() says no
DP_CLONES
static void surface_of_row(int32_t* restrict surface, const float* restrict base_height,
                           const float* restrict compression, const float* restrict heap,
                           const int32_t* restrict ring, int count, float hollow, double low,
                           double steps)
{
    for (int i = 0; i < count; ++i) {
        const int takes =
            (base_height[i] == base_height[i]) & (ring[i] != 0) & (compression[i] < hollow);
        const double at = (double)base_height[i] - (double)compression[i] - low;
        const double top = (at + (double)heap[i]) * steps + 0.5;
        surface[i] = takes ? (int32_t)(takes ? top : 0.0) : WALL;
    }
}

static void find_turns(int32_t* turn, const int32_t* surface, int count)
{
    for (int from = 0, to = 0; from < count; from = to) {
        const bool wall = surface[from] == WALL;
        while (to < count && (surface[to] == WALL) == wall) ++to;
        turn[from] = wall ? -to : to;
    }
}

// read the surface into the window; false if its heights do not fit the steps
static bool open_window(Heap* heap, double height, double slope, const int box[4])
{
    DpSoilPatch* patch = heap->patch;
    Window*      window = &heap->window;
    window->i0 = box[0], window->j0 = box[2];
    window->nx = box[1] - box[0], window->ny = box[3] - box[2];
    double low = INFINITY, high = -INFINITY, lows[LANES], highs[LANES];
    for (int k = 0; k < LANES; ++k) lows[k] = INFINITY, highs[k] = -INFINITY;
    for (int j = box[2]; j < box[3]; ++j) {
        const size_t p = soil_at(patch, box[0], j);
        range_of_row(patch->base_height + p, patch->compression + p, patch->heap + p, window->nx,
                     lows, highs);
    }
    for (int k = 0; k < LANES; ++k) {
        low = soil_min(low, lows[k]);
        high = soil_max(high, highs[k]);
    }
    const double fall = slope * patch->cell * (double)(window->nx + window->ny);
    const double range = high - low + height + fall;
    int          exponent = 0;
    (void)frexp(range, &exponent);
    if (!isfinite(range) || exponent > 40) return false;
    heap->step = ldexp(1.0, exponent - 28);  // range / step <= MAX_STEPS
    heap->level = low;
    heap->straight = (int32_t)floor(slope * patch->cell / heap->step + 0.5);
    heap->diagonal = (int32_t)floor(slope * patch->cell * sqrt(2.0) / heap->step + 0.5);

    const size_t cells = (size_t)window->row * (size_t)(window->ny + 2);
    for (size_t k = 0; k < cells; ++k) window->surface[k] = WALL;
    const double steps = 1.0 / heap->step;  // a power of two: exact
    for (int j = 0; j < window->ny; ++j) {
        const size_t p = soil_at(patch, window->i0, window->j0 + j);
        int32_t*     surface = row_of(window, window->surface, j);
        surface_of_row(surface, patch->base_height + p, patch->compression + p, patch->heap + p,
                       heap->imprint->ring + p, window->nx, heap->hollow, low, steps);
        find_turns(row_of(window, window->turn, j), surface, window->nx);
    }
    return true;
}

// does soil lie on a side of the window beyond which the patch goes on?
static bool reaches_out(const Heap* heap)
{
    const Window* window = &heap->window;
    const int     nx = window->nx, ny = window->ny;
    const bool    left = window->i0 > 0, right = window->i0 + nx < heap->patch->nx;
    const bool    under = window->j0 > 0, over = window->j0 + ny < heap->patch->ny;
    for (int j = 0; j < ny; ++j) {
        const int32_t* fill = row_of(window, window->fill, j);
        const int32_t* surface = row_of(window, window->surface, j);
        if (left && fill[0] > surface[0]) return true;
        if (right && fill[nx - 1] > surface[nx - 1]) return true;
        if (!(under && j == 0) && !(over && j == ny - 1)) continue;
        for (int i = 0; i < nx; ++i)
            if (fill[i] > surface[i]) return true;
    }
    return false;
}

// ---- height ----------------------------------------------------------------------------------

// Find T so that the fill holds `goal` [steps * cells]: Newton, kept inside a bracket. The volume
// is convex in T and grows by sqrt(omega) of its cone on every cell that is raised; the mean of
// those roots is learnt from the steps already made. Returns the volume of the fill left in the
// window.
static double find_height(const Heap* heap, double goal, double width, double slope, double* height)
{
    // on level ground a bare border would need T^2 = 2 slope volume/width on top of what lies there
    const double area = heap->patch->cell * heap->patch->cell;
    const double guess = 2.0 * slope * goal * heap->step * area / width;
    const double limit = 0.25 * (double)MAX_STEPS * heap->step;
    const double share = width / (heap->patch->cell * (double)heap->apex_count);
    double       low = -1.0, high = INFINITY, root = sqrt(share);  // low < 0: T = 0 not tried yet
    double       t = soil_min(sqrt(*height * *height + guess), limit), step = sqrt(guess);
    double       last_t = 0.0, last_volume = 0.0, last_cells = 0.0, volume = 0.0;
    for (int round = 0; round < MAX_ROUNDS; ++round) {
        const Laid laid = fill_to(heap, t);
        volume = (double)laid.volume;
        *height = t;
        if (fabs(volume - goal) <= MATCH * goal) break;
        if (volume > goal) {
            high = t;
            if (t <= 0.0) break;  // even flat cones hold more: they are laid thinner
        } else {
            low = t;
            if (t >= limit) break;  // the patch is full: it is laid thicker
        }
        if (low >= 0.0 && !isinf(high) && high - low <= 1e-9 * high) break;

        const double cells = (double)laid.cells;
        if (round > 0) {
            const double raised = 0.5 * (cells + last_cells) * (t - last_t) / heap->step;
            const double learnt =
                raised > 0.0 || raised < 0.0 ? (volume - last_volume) / raised : root;
            root = soil_min(soil_max(learnt, 0.05), 1.0);
        }
        last_t = t, last_volume = volume, last_cells = cells;
        double next = volume > 0.0 ? t + (goal - volume) / (root * cells) * heap->step : t + step;
        if (isinf(high))
            next = soil_min(soil_max(next, low + 1e-3 * step), low + 4.0 * step);
        else if (low < 0.0)
            next = round > 8 ? 0.0 : soil_max(next, 0.0);
        else if (!(next > low && next < high) || round > 8)
            next = 0.5 * (low + high);
        t = soil_min(next, limit);
        step *= 2.0;
    }
    if (volume > 0.0 || isinf(high)) return volume;
    *height = high;
    return (double)fill_to(heap, high).volume;
}

DP_CLONES
static void add_row(float* restrict heap, const int32_t* restrict fill,
                    const int32_t* restrict surface, int count, double metres)
{
    for (int i = 0; i < count; ++i) {
        const int32_t over = fill[i] - surface[i];
        const double  more = (double)(over > 0 ? over : 0) * metres;
        heap[i] = (float)((double)heap[i] + more);
    }
}

// how far the edge of the sole is from the middle of a border cell, beyond half a cell [cells]
static double edge_of(const DpSoilPatch* patch, const DpImprint* imprint, int i, int j)
{
    double away = sqrt(2.0);
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            if (i + di < 0 || i + di >= patch->nx || j + dj < 0 || j + dj >= patch->ny) continue;
            const size_t p = soil_at(patch, i + di, j + dj);
            if (imprint->ring[p] != 0) continue;
            const double far = di && dj ? sqrt(2.0) : 1.0;
            away = soil_min(away, far - (double)imprint->cover[p]);
        }
    return away;
}

// cells of a row with its frame, so many that rows start evenly
static size_t even_row(int nx)
{
    return ((size_t)nx + 2 + 15) / 16 * 16;
}

// most border cells there can be: those beside touched ones
static size_t count_border(const DpSoilPatch* patch, const DpImprint* imprint)
{
    size_t    count = 0;
    const int i0 = imprint->i0 > 0 ? imprint->i0 - 1 : 0;
    const int j0 = imprint->j0 > 0 ? imprint->j0 - 1 : 0;
    for (int j = j0; j < patch->ny && j <= imprint->j1; ++j)
        for (int i = i0; i < patch->nx && i <= imprint->i1; ++i)
            count += imprint->ring[soil_at(patch, i, j)] == 1;
    return count;
}

// border cells with a share; *width = sum of omega * cell, the border's length; box is theirs
static void find_apexes(Heap* heap, const HeapShares* shares, double* width, int box[4])
{
    const DpSoilPatch* patch = heap->patch;
    const DpImprint*   imprint = heap->imprint;
    const int          i0 = imprint->i0 > 0 ? imprint->i0 - 1 : 0;
    const int          j0 = imprint->j0 > 0 ? imprint->j0 - 1 : 0;
    int                count = 0;
    double             sum = 0.0;
    box[0] = patch->nx, box[1] = 0, box[2] = patch->ny, box[3] = 0;
    for (int j = j0; j < patch->ny && j <= imprint->j1; ++j)
        for (int i = i0; i < patch->nx && i <= imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (imprint->ring[p] != 1 || !takes_soil(heap, p)) continue;
            const double share = dp_soil_heap_share(shares, i, j);
            if (!(share > 0.0)) continue;
            const double firm = (double)patch->base_height[p] - (double)patch->compression[p];
            heap->apex[count++] = (Apex){i, j, firm, sqrt(share), edge_of(patch, imprint, i, j)};
            sum += share;
            if (i < box[0]) box[0] = i;
            if (i >= box[1]) box[1] = i + 1;
            if (j < box[2]) box[2] = j;
            if (j >= box[3]) box[3] = j + 1;
        }
    *width = sum * patch->cell;
    heap->apex_count = count;
}

// room for `apexes` and for a window as large as the patch; NULL when there is none
static void* make_room(const DpSoilPatch* patch, size_t apexes, DpSoilScratch* scratch)
{
    const size_t row = even_row(patch->nx), cells = row * ((size_t)patch->ny + 2);
    return dp_soil_scratch_block(scratch, apexes + (3 * cells + row) * sizeof(int32_t));
}

static void grow(int box[4], const int around[4], int reach, const DpSoilPatch* patch)
{
    box[0] = around[0] > reach ? around[0] - reach : 0;
    box[1] = around[1] < patch->nx - reach ? around[1] + reach : patch->nx;
    box[2] = around[2] > reach ? around[2] - reach : 0;
    box[3] = around[3] < patch->ny - reach ? around[3] + reach : patch->ny;
}

DpStatus dp_soil_heap_rest(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                           double volume, double slope, double* height, DpSoilScratch* scratch)
{
    Heap         heap = {.patch = patch, .imprint = imprint};
    int          border[4], box[4];
    double       width = 0.0;
    const double area = patch->cell * patch->cell;
    heap.hollow = hollow_under(patch, imprint);
    const size_t apexes = (count_border(patch, imprint) * sizeof(Apex) + 63) / 64 * 64;
    char*        block = make_room(patch, apexes, scratch);
    if (!block) return DP_NO_MEMORY;
    heap.apex = (Apex*)(void*)block;
    find_apexes(&heap, shares, &width, border);
    if (heap.apex_count == 0) {  // all that lies ahead is hollow: then it is filled
        heap.hollow = INFINITY;
        find_apexes(&heap, shares, &width, border);
    }
    if (heap.apex_count == 0) return DP_NO_GROUND;

    // how far a heap like the last one, and this volume, goes on level ground; more where it falls
    const double likely = sqrt(*height * *height + 2.0 * slope * volume / width);
    double       reach = soil_min(likely / (slope * patch->cell) + 3.0, 30000.0);
    double       found = *height;
    for (bool again = true; again; reach = soil_min(2.0 * reach, 30000.0)) {
        grow(box, border, (int)reach, patch);
        const size_t row = even_row(box[1] - box[0]);
        const size_t cells = row * ((size_t)(box[3] - box[2]) + 2);
        heap.window.row = (int)row;
        heap.window.surface = (int32_t*)(void*)(block + apexes);
        heap.window.fill = heap.window.surface + cells;
        heap.window.turn = heap.window.fill + cells;
        heap.window.spare = heap.window.turn + cells;
        if (!open_window(&heap, 16.0 * likely, slope, box)) return DP_BAD_ARGUMENT;

        found = *height;
        const double goal = volume / (area * heap.step);
        const double laid = find_height(&heap, goal, width, slope, &found);
        const bool   all = box[0] == 0 && box[1] == patch->nx && box[2] == 0 && box[3] == patch->ny;
        again = !all && reach < 30000.0 && (laid <= 0.0 || reaches_out(&heap));
        if (again) continue;
        if (!(laid > 0.0)) return DP_NO_GROUND;

        // what is left of the difference goes into a common factor: the sum is right to rounding
        const double metres = heap.step * goal / laid;
        for (int j = 0; j < heap.window.ny; ++j)
            add_row(patch->heap + soil_at(patch, box[0], box[2] + j),
                    row_of(&heap.window, heap.window.fill, j),
                    row_of(&heap.window, heap.window.surface, j), heap.window.nx, metres);
        *height = found;
    }
    return DP_OK;
}
