// soil/soil_heap_rest.c - displaced soil laid at once in the shape in which it rests. Ours; MODEL 6.3
//
//   cones on the border cells, T sqrt(omega) high --(upper envelope)--> fill --> T until volume fits
//
// A straight heap against a wall with cross-section A is a triangle of height sqrt(2 A tan gamma_r), so a
// border cell with share omega carries a cone of height T sqrt(omega) over its firm ground and slope
// tan gamma_r. Soil fills the ground up to the envelope of the cones. Distances are chamfer distances with
// 1 and sqrt(2), the metric in which soil_stabilize.c compares neighbours: what is laid here is at rest
// there. They lead around the sole, not through it. A cone is lower the farther its cell lies from the
// edge of the sole, which runs through cells that are covered in part and past the corners of others: else
// rims would be lower the larger the cells, most of all where the edge runs aslant.
//
// A sole that rolls leaves a hollow behind. No cone stands in it or reaches into it: what is pushed aside
// now piles up at its edge, and soil_stabilize.c lets slide in what does not stay. Else every step of the
// roll would lay a ridge across the print.
//
// What is pushed ahead flows off at the sides of the face that pushes it, where nothing holds it, and so is lower
// there: along the face, too, it is no steeper than it rests. While a body goes on, its heap grows by q a metre and
// loses e^2 / (2 tan gamma_r) at either side, e its height there; both balance at e = 0.4 to 0.55 of the height in the
// middle of a wide face, for heaps of 1.5 to 7 times the depth of the cut.
//
// Heights are whole numbers of a small step (a power of two, some nanometres), so that neither the order of
// a sweep nor that of a sum can change a bit: with equal shares, mirrored or turned ground gets exactly
// mirrored or turned heaps. With a push the shares come from coordinates; they are rounded to 2^-30 and
// agree but for ties (soil_heap_share.c).
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_heap_inside.h"
#include "soil/soil_heaps.h"

#define HOLLOW 0.5    // cells pressed to this share of the deepest under the sole are hollow
#define LEVEL 0.1     // where no more of what lies ahead is level, the hollow is filled
#define MATCH 0.0002  // a volume this close is right; the rest is a common factor
#define MAX_ROUNDS 40

// neither under a sole, nor off the ground, nor in the hollow that the sole has left
static bool takes_soil(const Heap* heap, size_t p)
{
    return soil_is_ground(heap->patch->base_height[p]) && heap->imprint->ring[p] > 0 &&
           heap->patch->compression[p] < heap->hollow;
}

float dp_soil_hollow(const DpSoilPatch* patch, const DpImprint* imprint)
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
        const Laid laid = dp_heap_fill(heap, t);
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
    return (double)dp_heap_fill(heap, high).volume;
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

// ---- border ----------------------------------------------------------------------------------

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
static size_t even_row(long nx)
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

// Border cells with a share; *width = sum of omega * cell, the border's length; box is theirs. The share of that which
// does not lie in the hollow.
static double find_apexes(Heap* heap, const HeapShares* shares, double slope, double* width,
                          DpCellRect* box)
{
    const DpSoilPatch* patch = heap->patch;
    const DpImprint*   imprint = heap->imprint;
    const int          i0 = imprint->i0 > 0 ? imprint->i0 - 1 : 0;
    const int          j0 = imprint->j0 > 0 ? imprint->j0 - 1 : 0;
    int                count = 0;
    double             sum = 0.0, hollow = 0.0;
    *box = (DpCellRect){0};
    for (int j = j0; j < patch->ny && j <= imprint->j1; ++j)
        for (int i = i0; i < patch->nx && i <= imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (imprint->ring[p] != 1 || !soil_is_ground(patch->base_height[p])) continue;
            const double share = dp_soil_heap_share(shares, patch, i, j);
            if (!takes_soil(heap, p)) hollow += share;
            if (!(share > 0.0) || !takes_soil(heap, p)) continue;
            const double firm = (double)patch->base_height[p] - (double)patch->compression[p];
            const bool   spills = shares->cut > 0.0 && !shares->even;
            const double within = spills ? dp_soil_heap_within(shares, i, j) : 0.0;
            heap->apex[count++] = (Apex){.i = i,
                                         .j = j,
                                         .ground = firm,
                                         .root = sqrt(share),
                                         .away = edge_of(patch, imprint, i, j),
                                         .spills = spills ? shares->cut : 0.0,
                                         .climbs = within * patch->cell * slope};
            sum += share;
            *box = dp_cells_with(*box, i, j);
        }
    *width = sum * patch->cell;
    heap->apex_count = count;
    return count ? sum / (sum + hollow) : 0.0;
}

// ---- laying ----------------------------------------------------------------------------------

// does soil lie on a side of the window beyond which the patch goes on?
static bool runs_over(const Heap* heap)
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

// a block for `apexes` and for a window as large as the patch; NULL when there is no memory
static void* block_for(const DpSoilPatch* patch, size_t apexes, DpSoilScratch* scratch)
{
    const size_t row = even_row(patch->nx), cells = row * ((size_t)patch->ny + 2);
    return dp_soil_scratch_block(scratch, apexes + (3 * cells + row) * sizeof(int32_t));
}

DpStatus dp_soil_heap_rest(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                           double volume, double slope, double* height, DpSoilScratch* scratch)
{
    Heap         heap = {.patch = patch, .imprint = imprint};
    DpCellRect   border;
    double       width = 0.0;
    const double area = patch->cell * patch->cell;
    heap.hollow = dp_soil_hollow(patch, imprint);
    const size_t apexes = (count_border(patch, imprint) * sizeof(Apex) + 63) / 64 * 64;
    char*        block = block_for(patch, apexes, scratch);
    if (!block) return DP_NO_MEMORY;
    heap.apex = (Apex*)(void*)block;
    if (!(find_apexes(&heap, shares, slope, &width, &border) > LEVEL)) {
        heap.hollow = INFINITY;
        (void)find_apexes(&heap, shares, slope, &width, &border);
    }
    if (heap.apex_count == 0) return DP_NO_GROUND;

    // how far a heap like the last one, and this volume, goes on level ground; more where it falls
    const double likely = sqrt(*height * *height + 2.0 * slope * volume / width);
    double       margin = soil_min(likely / (slope * patch->cell) + 3.0, 30000.0);
    double       found = *height;
    for (bool again = true; again; margin = soil_min(2.0 * margin, 30000.0)) {
        const DpCellRect box = soil_grown(border, (long)margin, patch);
        const size_t     row = even_row(box.i1 - box.i0);
        const size_t     cells = row * ((size_t)(box.j1 - box.j0) + 2);
        heap.window.row = (int)row;
        heap.window.surface = (int32_t*)(void*)(block + apexes);
        heap.window.fill = heap.window.surface + cells;
        heap.window.turn = heap.window.fill + cells;
        heap.window.spare = heap.window.turn + cells;
        if (!dp_heap_open(&heap, 16.0 * likely, slope, box)) return DP_BAD_ARGUMENT;

        found = *height;
        const double goal = volume / (area * heap.step);
        const double laid = find_height(&heap, goal, width, slope, &found);
        const bool   all = dp_cells_hold(box, dp_cells(0, 0, patch->nx, patch->ny));
        again = !all && margin < 30000.0 && (laid <= 0.0 || runs_over(&heap));
        if (again) continue;
        if (!(laid > 0.0)) return DP_NO_GROUND;

        // what is left of the difference goes into a common factor: the sum is right to rounding
        const double metres = heap.step * goal / laid;
        for (int j = 0; j < heap.window.ny; ++j)
            add_row(patch->heap + soil_at(patch, box.i0, box.j0 + j),
                    row_of(&heap.window, heap.window.fill, j),
                    row_of(&heap.window, heap.window.surface, j), heap.window.nx, metres);
        *height = found;
    }
    return DP_OK;
}
