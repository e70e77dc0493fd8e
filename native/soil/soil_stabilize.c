// soil/soil_stabilize.c - loose soil slides until it rests. TRAIL (14)-(16), MODEL 6.4
//
//   slopes to 8 neighbours --(first stencil)--> share given away --(second stencil)--> new heaps
//
// A sweep never depends on the order of its cells: the first stencil only reads heights, the second only
// adds up what the first one decided (soil_slide_rows.c).
//
// Departures
//   TRAIL (14): eight neighbours on the grid (diagonals at sqrt(2) cells), not the next ring outward, so
//     soil also slides back into a print that the foot has left. test_soil_stabilize.c, comes_to_rest.
//   TRAIL (15)(16): as printed h_step leaves a cell once but arrives once per neighbour, and ring by ring
//     the result depends on the order. Here a cell gives each lower neighbour a share of its own excess over
//     gamma_r. test_soil_stabilize.c, keeps_volume.
//   A cell gives only while it stands steeper than gamma_r + half the tolerance: then it gives what is above
//     gamma_r itself. Without that, slopes that are at rest creep on for as long as another part of the
//     print slides. test_soil_stabilize.c, comes_to_rest.
//   An excess counts as less than one neighbour while it is smaller than a tenth of the tolerance: heaps laid
//     at rest stand at gamma_r to the last bit, and what rounding does there must not decide among how many a
//     cell shares. test_soil_stabilize.c, rounding_does_not_matter.
//   Only the heap moves, never firm ground. A film thinner than a tenth of what the tolerance lets stand over
//     one cell counts as at rest wherever it lies: soil that creeps down a steep wall of firm ground would
//     otherwise never be done. test_soil_stabilize.c, comes_to_rest.
#include "base/wide.h"  // first: it says how loops may be widened

#include <string.h>

#include "base/alloc.h"
#include "soil/soil_slide.h"

#define MAX_FALLS 0.5f  // of a cell, in a sweep: high walls do not jump, nor what takes time
#define FRAME 3         // cells around the window that only stand as walls
#define FIRST_MARGIN 8  // cells the window is larger than what is looked at

// A copy of the part of the patch in which soil moves. All grids (ny + 2 FRAME, row).
typedef struct Window
{
    DpCellRect box;  // patch cells it holds
    size_t     row;
    float      cell;    // side of a cell                                   [m]
    float      most;    // a heap gives at most so much in a sweep            [m]
    float*     firm;    // firm ground, BARRIER where no soil can be          [m]
    float*     height;  // firm + heap                                        [m]
    double*    sum;     // b, kept finer than a float: small flows add up      [m]
    float*     heap;    // b                                                  [m]
    float*     fall;    // tan(gamma_r) cell: what may stand over one cell     [m]
    float*     slack;   // what may stand above that and still count as rest   [m]
    float*     share;   // a, share of the excess that is given               [-]
    float*     give;    // a * sum of excess                                  [m]

    bool    slides;  // firm walls can fall: the rest is there         MODEL 6.8
    Walls   walls;
    bool*   falls;       // does a wall of a row? (ny + 2 FRAME)
    double* floor;       // firm ground, kept finer than a float             [m]
    float*  wall_share;  // share of the excess that falls                   [-]
    float*  wall_give;   // .. times the sum of excess                       [m]
} Window;

#define GRIDS 7       // of floats
#define WALL_GRIDS 5  // .. and more, where walls slide

static size_t cell_of(const Window* window, long i, long j)
{
    return (size_t)(j - window->box.j0 + FRAME) * window->row +
           (size_t)(i - window->box.i0 + FRAME);
}

// ---- window ----------------------------------------------------------------------------------

// firm ground of a cell of the patch
static double floor_of(const DpSoilPatch* patch, size_t p, double level)
{
    return (double)patch->base_height[p] - (double)patch->compression[p] - level;
}

static Walls walls_at(const Window* window, size_t cell)
{
    const Walls* walls = &window->walls;
    return (Walls){walls->base + cell, walls->steep + cell, walls->slack + cell};
}

// `sole` tells where one stands (0, or DP_RING_HELD), as imprint->ring does
static void read_row(const Window* window, const DpSoilPatch* patch, const int32_t* sole, long j,
                     double level, double tan_slack)
{
    const size_t p = soil_at(patch, window->box.i0, j), w = cell_of(window, window->box.i0, j);
    const Row    row = {window->firm + w, window->height + w, window->heap + w,
                        window->fall + w, window->slack + w,  window->sum + w};
    dp_slide_fill(&row, patch->base_height + p, patch->compression + p, patch->heap + p,
                  patch->rest_slope + p, sole, (int)(window->box.i1 - window->box.i0), patch->cell,
                  level, tan_slack);
    if (!window->slides) return;
    const Walls walls = walls_at(window, w);
    dp_walls_fill(&walls, patch->base_height + p, patch->wall_slope + p, sole,
                  (int)(window->box.i1 - window->box.i0), patch->cell, level, tan_slack);
    for (size_t i = 0; i < (size_t)(window->box.i1 - window->box.i0); ++i)
        window->floor[w + i] =
            window->firm[w + i] < BARRIER ? floor_of(patch, p + i, level) : (double)BARRIER;
}

// where no soil can be: `count` cells of the frame from `at` on
static void wall_in(const Window* window, size_t at, size_t count)
{
    for (size_t k = at; k < at + count; ++k) {
        window->firm[k] = window->height[k] = BARRIER;
        window->heap[k] = window->fall[k] = window->slack[k] = 0.0f;
        window->sum[k] = 0.0;
    }
    for (size_t k = at; window->slides && k < at + count; ++k) {
        window->walls.steep[k] = BARRIER;
        window->walls.base[k] = 0.0f;
    }
}

static bool open_window(Window* window, const DpSoilPatch* patch, const DpImprint* imprint,
                        DpCellRect box, double level, double tan_slack, DpSoilScratch* scratch)
{
    const size_t nx = (size_t)(box.i1 - box.i0), ny = (size_t)(box.j1 - box.j0);
    window->box = box;
    window->row = (nx + 2 * FRAME + 15) / 16 * 16;
    const size_t cells = window->row * (ny + 2 * FRAME);
    window->slides = patch->wall_slope != NULL;
    window->cell = (float)patch->cell;
    window->most = soil_takes_time(patch) ? MAX_FALLS * window->cell : BARRIER;
    const size_t floats = window->slides ? GRIDS + WALL_GRIDS : GRIDS;
    const size_t fine = window->slides ? 2 : 1;
    double*      doubles =
        dp_soil_scratch_block(scratch, cells * (fine * sizeof(double) + floats * sizeof(float)) +
                                           (ny + 2 * FRAME) * sizeof(bool));
    if (!doubles) return false;
    window->sum = doubles;
    window->floor = doubles + cells;
    float*        block = (float*)(void*)(doubles + fine * cells);
    float** const grid[GRIDS + WALL_GRIDS] = {
        &window->firm,        &window->height,      &window->heap,       &window->fall,
        &window->slack,       &window->share,       &window->give,       &window->walls.base,
        &window->walls.steep, &window->walls.slack, &window->wall_share, &window->wall_give};
    for (size_t g = 0; g < floats; ++g) *grid[g] = block + g * cells;
    window->falls = (bool*)(void*)(block + floats * cells);
    wall_in(window, 0, FRAME * window->row);
    wall_in(window, cells - FRAME * window->row, FRAME * window->row);
    int32_t* nobody = (int32_t*)(void*)window->share;  // a row of cells where no sole stands
    for (size_t i = 0; !imprint && i < nx; ++i) nobody[i] = DP_RING_FAR;
    for (long j = box.j0; j < box.j1; ++j) {
        const size_t   at = cell_of(window, box.i0, j);
        const int32_t* sole = imprint ? imprint->ring + soil_at(patch, box.i0, j) : nobody;
        wall_in(window, at - FRAME, FRAME);
        read_row(window, patch, sole, j, level, tan_slack);
        wall_in(window, at + nx, window->row - FRAME - nx);
    }
    return true;
}

// returns how much firm ground has come loose [m * cells]
static double write_back(const Window* window, DpSoilPatch* patch, const DpImprint* imprint,
                         DpCellRect box, double level)
{
    double loosened = 0.0;
    for (long j = box.j0; j < box.j1; ++j)
        for (long i = box.i0; i < box.i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (!soil_is_ground(patch->base_height[p]) || (imprint && imprint->ring[p] <= 0))
                continue;
            patch->heap[p] = window->heap[cell_of(window, i, j)];
            if (!window->slides) continue;
            const double fell = floor_of(patch, p, level) - window->floor[cell_of(window, i, j)];
            if (!(fell > 0.0)) continue;
            const float was = patch->compression[p];
            patch->compression[p] = (float)((double)was + fell);
            if (patch->spring) dp_soil_spring_fell(patch, p, fell);
            loosened += (double)patch->compression[p] - (double)was;
        }
    return loosened;
}

// heights of a row as its sums and floors say
static void raise_row(const Window* window, size_t at, int count)
{
    if (window->slides) dp_walls_lower(window->firm + at, window->floor + at, count);
    dp_slide_raise(window->height + at, window->heap + at, window->firm + at, window->sum + at,
                   count);
}

// a larger window around `box`, which holds the old one; fine sums move along
static bool move_window(Window* window, const DpSoilPatch* patch, const DpImprint* imprint,
                        DpCellRect box, double level, double tan_slack, DpSoilScratch* scratch)
{
    const Window old = *window;
    const size_t cells = old.row * (size_t)(old.box.j1 - old.box.j0 + 2 * FRAME);
    const size_t fine = old.slides ? 2 : 1;  // sums, and floors after them
    double*      kept = dp_alloc(fine * cells, sizeof(double));
    if (!kept) return false;
    memcpy(kept, old.sum, fine * cells * sizeof(double));
    const bool open = open_window(window, patch, imprint, box, level, tan_slack, scratch);
    for (long j = old.box.j0; open && j < old.box.j1; ++j) {
        const size_t  at = cell_of(window, old.box.i0, j);
        const int     count = (int)(old.box.i1 - old.box.i0);
        const double* from = kept + cell_of(&old, old.box.i0, j);
        memcpy(window->sum + at, from, (size_t)count * sizeof(double));
        if (old.slides) memcpy(window->floor + at, from + cells, (size_t)count * sizeof(double));
        raise_row(window, at, count);
    }
    dp_free(kept);
    if (!open) *window = old;
    return open;
}

// ---- sweeps ----------------------------------------------------------------------------------

static void clear_sides(float* at, int count)
{
    memset(at - 2, 0, 2 * sizeof(float));
    memset(at + count, 0, 2 * sizeof(float));
}

// nothing is given from `count` cells, nor from two beside them
static void give_nothing(float* share, float* give, int count)
{
    memset(share - 2, 0, (size_t)(count + 4) * sizeof(float));
    memset(give - 2, 0, (size_t)(count + 4) * sizeof(float));
}

// the same for the walls of a row; returns ROW_ bits
static int decide_walls(const Window* window, size_t at, int count, float film)
{
    const Walls  walls = walls_at(window, at);
    float *const share = window->wall_share + at, *const give = window->wall_give + at;
    if (!dp_walls_fall(&walls, window->firm + at, window->height + at, (ptrdiff_t)window->row,
                       count)) {
        give_nothing(share, give, count);
        return 0;
    }
    const int wish = dp_walls_decide(&walls, share, give, window->firm + at, window->height + at,
                                     (ptrdiff_t)window->row, count, film, MAX_FALLS * window->cell);
    clear_sides(share, count);
    clear_sides(give, count);
    return wish;
}

// what the cells of a row that give reach from and to
static DpCellRect with_givers(DpCellRect movers, const float* give, long i0, int count, long j)
{
    int first = 0, last = count - 1;
    while (!(give[first] > 0.0f)) ++first;
    while (!(give[last] > 0.0f)) --last;
    movers.i0 = movers.i0 < i0 + first ? movers.i0 : i0 + first;
    movers.i1 = movers.i1 > i0 + last ? movers.i1 : i0 + last + 1;
    movers.j0 = movers.j0 < j ? movers.j0 : j;
    movers.j1 = j + 1;
    return movers;
}

// first stencil over `look`; returns the cells that give, and whether one of them must
static DpCellRect decide(const Window* window, DpCellRect look, float film, bool* restless)
{
    DpCellRect movers = {LONG_MAX, LONG_MIN, LONG_MAX, LONG_MIN};
    *restless = false;
    const int count = (int)(look.i1 - look.i0);
    for (long j = look.j0 - 2; j < look.j1 + 2; ++j) {
        const size_t at = cell_of(window, look.i0, j);
        bool* const  fall = &window->falls[j - window->box.j0 + FRAME];
        *fall = false;
        if (j < look.j0 || j >= look.j1) {  // nothing is given from outside
            give_nothing(window->share + at, window->give + at, count);
            if (window->slides)
                give_nothing(window->wall_share + at, window->wall_give + at, count);
            continue;
        }
        const int wish = dp_slide_decide(window->share + at, window->give + at, window->height + at,
                                         window->heap + at, window->fall + at, window->slack + at,
                                         (ptrdiff_t)window->row, count, film, window->most);
        clear_sides(window->share + at, count);
        clear_sides(window->give + at, count);
        const int falls = window->slides ? decide_walls(window, at, count, film) : 0;
        *restless = *restless || ((wish | falls) & ROW_RESTLESS);
        if (wish & ROW_MOVES) movers = with_givers(movers, window->give + at, look.i0, count, j);
        if (!(falls & ROW_MOVES)) continue;
        movers = with_givers(movers, window->wall_give + at, look.i0, count, j);
        *fall = true;
    }
    return movers;
}

// what walls in a row and beside it let fall, if one does
static void take_walls(const Window* window, size_t at, int count, long j)
{
    const bool* fall = &window->falls[j - window->box.j0 + FRAME];
    if (!window->slides || !(fall[-1] || fall[0] || fall[1])) return;
    const Walls walls = walls_at(window, at);
    dp_walls_take(&walls, window->sum + at, window->floor + at, window->wall_share + at,
                  window->wall_give + at, window->firm + at, window->height + at,
                  (ptrdiff_t)window->row, count);
}

// second stencil over the cells that give and their neighbours
static void take(const Window* window, DpCellRect change)
{
    const int count = (int)(change.i1 - change.i0);
    for (long j = change.j0; j < change.j1; ++j) {
        const size_t at = cell_of(window, change.i0, j);
        dp_slide_take(window->sum + at, window->give + at, window->height + at, window->share + at,
                      window->fall + at, (ptrdiff_t)window->row, count);
        take_walls(window, at, count, j);
    }
    for (long j = change.j0; j < change.j1; ++j) {
        const size_t at = cell_of(window, change.i0, j);
        raise_row(window, at, count);
    }
}

// has loose soil come to the edge of the patch?
static bool at_edge(const DpSoilPatch* patch, DpCellRect box, float film)
{
    const DpCellRect inner = {1, patch->nx - 1, 1, patch->ny - 1};
    if (dp_cells_hold(inner, box)) return false;
    for (long j = box.j0; j < box.j1; ++j)
        for (long i = box.i0; i < box.i1; ++i) {
            const bool edge = i < inner.i0 || i >= inner.i1 || j < inner.j0 || j >= inner.j1;
            if (edge && patch->heap[soil_at(patch, i, j)] > film) return true;
        }
    return false;
}

DpStatus dp_soil_stabilize(DpSoilPatch* patch, const DpImprint* imprint, const DpCellRect* within,
                           double tolerance, int max_sweeps, DpSoilScratch* scratch,
                           DpSettled* settled)
{
    if (!soil_patch_ok(patch) || !scratch || !settled) return DP_BAD_ARGUMENT;
    if (!(tolerance > 0.0) || !(tolerance < 1.0) || max_sweeps < 0) return DP_BAD_ARGUMENT;
    DpCellRect look = dp_cells(0, 0, patch->nx, patch->ny);
    if (within) look = dp_cells_common(look, *within);
    memset(settled, 0, sizeof *settled);
    settled->at_rest = true;
    if (dp_cells_empty(look)) return DP_OK;

    const DpCellRect asked = look;
    look = dp_slide_movable(patch, look);
    if (look.i0 >= look.i1) return DP_OK;
    const double tan_slack = tan(tolerance), level = dp_slide_level(patch, asked);
    const float  film = (float)(0.1 * tan_slack * patch->cell);
    int          margin = FIRST_MARGIN;
    DpStatus     status = DP_OK;
    Window       window;
    DpCellRect   changed = {0, 0, 0, 0};
    if (!open_window(&window, patch, imprint, soil_grown(look, margin, patch), level, tan_slack,
                     scratch))
        return DP_NO_MEMORY;

    for (;;) {
        bool             restless;
        const DpCellRect movers = decide(&window, look, film, &restless);
        settled->at_rest = !restless;
        if (!restless || settled->sweeps == max_sweeps) break;
        const DpCellRect change = soil_grown(movers, 1, patch);
        look = soil_grown(movers, 2, patch);
        take(&window, change);
        changed = dp_cells_join(changed, change);
        ++settled->sweeps;
        if (dp_cells_hold(window.box, soil_grown(look, 1, patch))) continue;

        margin *= 2;  // soil comes near the window's side: a larger one
        const DpCellRect wider = soil_grown(dp_cells_join(window.box, look), margin, patch);
        if (!move_window(&window, patch, imprint, wider, level, tan_slack, scratch)) {
            status = DP_NO_MEMORY;
            break;
        }
    }
    if (changed.i0 < changed.i1) {
        settled->loosened =
            write_back(&window, patch, imprint, changed, level) * patch->cell * patch->cell;
        settled->changed = changed;
        settled->at_edge = at_edge(patch, changed, film);
    }
    return status;
}
