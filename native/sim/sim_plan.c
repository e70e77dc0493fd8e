// sim/sim_plan.c - what every limb does in a step, on which cells, and which limbs meet.
#include <stdlib.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define HEAP_MARGIN 0.10  // [m] of ground around a sole that a step may change, at least ..
#define HEAP_SHARE 0.4    // .. or this share of its length
#define SPILL_GROWTH \
    1.5  // .. so many times more, after a step whose loose soil wanted to go farther
#define BULGE_REACH 4.0  // widths of a bulge, beyond which it is level
#define HEAP_OF_DEPTH \
    0.7                   // a body so deep leaves at once a heap no higher than this share of it ..
#define HIGHEST_HEAP 1.0  // .. nor than this [m]
#define CARVED_MARGIN 0.7  // what is cut may be pushed so much farther than what is pressed [m]
#define HEAP_SPARE 4       // cells beyond the foot of the heap

// Ground around a limb's soles that a step may change, at least [m]: where they are shorter than
// people's it is as much less, so that an insect's heaps meet its other feet as a person's do.
static double least_margin(const Limb* limb)
{
    return fmin(HEAP_MARGIN, HEAP_SHARE * limb->length);
}

// how far soles may slip on any of the soils [m]
static double slips(const DpSim* sim)
{
    for (int s = 0; s < dp_terrain_soil_count(sim->terrain); ++s)
        if (dp_terrain_soils(sim->terrain)[s].shear_modulus > 0.0f) return DP_MAX_SLIP;
    return 0.0;
}

// how far around a sole the ground bulges on any of the soils [m]
static double bulges(const DpSim* sim)
{
    double widest = 0.0;
    for (int s = 0; s < dp_terrain_soil_count(sim->terrain); ++s)
        widest = fmax(widest, (double)dp_terrain_soils(sim->terrain)[s].heave);
    return fmin(BULGE_REACH * widest, 1.0);
}

// how far pieces of a crust reach that a sole breaks, on any of the soils [m]
static double breaks(const DpSim* sim)
{
    double widest = 0.0;
    for (int s = 0; s < dp_terrain_soil_count(sim->terrain); ++s)
        widest = fmax(widest, dp_soil_crust_margin(&dp_terrain_soils(sim->terrain)[s]));
    return widest;
}

// Who is there at both ends of an interval presses all the way if it touches at either.
static bool presses_from(const DpSim* sim, const Limb* limb, int sample)
{
    return dp_limb_there(sim, limb, sample) && dp_limb_there(sim, limb, sample + 1) &&
           (dp_limb_touches(sim, limb, sample) || dp_limb_touches(sim, limb, sample + 1));
}

// What a limb does in the interval from `sample` to the next, and on which cells.
static void plan_limb(DpSim* sim, Limb* limb, int sample)
{
    const bool   carves = limb->law == DP_CONTACT_CARVE;
    bool         presses = presses_from(sim, limb, sample);
    const double depth = presses && carves ? dp_carve_depth(sim, limb, sample) : 0.0;
    if (carves && !(depth > 0.0)) presses = false;
    limb->lifts = (limb->stands || limb->flows) && !presses;
    limb->left = limb->lifts && !limb->stands;
    limb->active = presses || limb->lifts;
    const bool spilled = limb->spills;
    limb->spills = limb->off_ground = false;
    limb->firm = limb->loose = limb->laid = limb->deepest = 0.0;
    limb->loosened = limb->rebounded = 0.0;
    limb->begins = presses && !limb->stands;
    if (limb->begins) {
        limb->heap_height = limb->owed = 0.0;
        limb->ploughs = false;
        limb->slip = limb->sheared = dp_vec3(0.0, 0.0, 0.0);
        limb->shear = (Shear){.field = {0.0}};
        limb->margin = carves ? HEAP_MARGIN : least_margin(limb);
        if (!limb->flows) limb->trodden = (DpCellRect){0, 0, 0, 0};  // else it slides on afterwards
        limb->met_at = (DpCellRect){0, 0, 0, 0};
        ++sim->report.contacts;
    }
    limb->stands = presses;
    if (presses) {
        double slope = INFINITY;  // the flattest heap reaches farthest
        for (int s = 0; s < dp_terrain_soil_count(sim->terrain); ++s)
            slope = fmin(slope, tan((double)dp_terrain_soils(sim->terrain)[s].rest_angle));
        const bool   paper = sim->options.heap_law == DP_HEAP_PAPER;
        const double rim = paper ? sim->options.rim_width : 0.0;
        const double heap =
            fmax(1.25 * limb->heap_height, fmin(HEAP_OF_DEPTH * depth, HIGHEST_HEAP)) / slope;
        const double spread =
            fmax(heap, fmax(rim, fmax(bulges(sim), breaks(sim)))) + HEAP_SPARE * sim->grid.cell;
        if (spilled && paper) limb->margin *= SPILL_GROWTH;  // laid at rest it waits for lift-off
        const double margin = fmax(limb->margin, spread) + slips(sim);
        limb->patch =
            carves ? dp_carve_cells(sim, limb, margin) : dp_limb_cells(sim, limb, sample, margin);
    } else {
        limb->patch = limb->trodden;
    }
}

static int root(const int* group, int l)
{
    while (group[l] != l) l = group[l];
    return l;
}

static int by_first_column(const void* a, const void* b)
{
    const LimbSpan *x = a, *y = b;
    return (x->i0 > y->i0) - (x->i0 < y->i0);
}

// Active limbs whose patches meet get one root, the lowest of their numbers: in the order of their
// first columns each is held against those that begin before it ends.
static void join_limbs(DpSim* sim)
{
    int count = 0;
    for (int l = 0; l < sim->cast.limbs; ++l) {
        sim->group[l] = l;
        if (!sim->limb[l].active) continue;
        const DpCellRect at = sim->limb[l].patch;
        sim->span[count++] = (LimbSpan){at.i0, at.i1, l};
    }
    qsort(sim->span, (size_t)count, sizeof *sim->span, by_first_column);
    for (int a = 0; a < count; ++a) {
        const LimbSpan one = sim->span[a];
        for (int b = a + 1; b < count && sim->span[b].i0 < one.i1; ++b) {
            const LimbSpan other = sim->span[b];
            if (!dp_cells_meet(sim->limb[one.limb].patch, sim->limb[other.limb].patch)) continue;
            const int ra = root(sim->group, one.limb), rb = root(sim->group, other.limb);
            sim->group[ra > rb ? ra : rb] = ra > rb ? rb : ra;
        }
    }
}

// Limbs that meet get one group: start[k] .. start[k + 1] are the places of group k in `order`.
static int make_groups(DpSim* sim)
{
    const int limbs = sim->cast.limbs;
    int       groups = 0;
    join_limbs(sim);
    for (int l = 0; l < limbs; ++l) {
        if (!sim->limb[l].active) continue;
        if (sim->group[l] == l) sim->start[groups] = 0, sim->number[l] = groups++;
        ++sim->start[sim->number[root(sim->group, l)]];
    }
    int placed = 0;
    for (int k = 0; k <= groups; ++k) {
        const int members = k < groups ? sim->start[k] : 0;
        sim->start[k] = placed;
        placed += members;
    }
    for (int l = 0; l < limbs; ++l) {  // moves every start to the next group's
        if (!sim->limb[l].active) continue;
        sim->limb[l].group = sim->number[root(sim->group, l)];
        sim->order[sim->start[sim->limb[l].group]++] = l;
    }
    for (int k = groups; k > 0; --k) sim->start[k] = sim->start[k - 1];
    sim->start[0] = 0;
    return groups;
}

// Remember the ground under a patch as this stance met it: what the stance has covered all along is known, the rest is met
// now, by a sole that has pushed soil ahead of itself without what is loose on it.
static DpStatus meet(DpSim* sim, Limb* limb)
{
    const DpCellRect at = limb->patch, was = limb->met_at;
    const int        nx = (int)(at.i1 - at.i0), ny = (int)(at.j1 - at.j0);
    float* const     met = dp_alloc((size_t)nx * (size_t)ny, sizeof *met);
    if (!met) return DP_NO_MEMORY;
    const DpField  field = limb->ploughs ? DP_FIELD_COMPRESSION : DP_FIELD_HEIGHT_CHANGE;
    const DpStatus status = dp_terrain_read(sim->terrain, field, at.i0, at.j0, nx, ny, met);
    for (int k = 0; limb->ploughs && k < nx * ny; ++k) met[k] = -met[k];
    const long i0 = at.i0 > was.i0 ? at.i0 : was.i0, i1 = at.i1 < was.i1 ? at.i1 : was.i1;
    for (long j = at.j0; limb->met && j < at.j1; ++j)
        for (long i = i0; i < i1 && j >= was.j0 && j < was.j1; ++i)
            met[(j - at.j0) * nx + (i - at.i0)] =
                limb->met[(j - was.j0) * (was.i1 - was.i0) + (i - was.i0)];
    dp_free(limb->met);
    limb->met = met;
    limb->met_at = at;
    return status;
}

// what every limb does in a step, and room for it on the terrain
DpStatus dp_step_plan(DpSim* sim, int sample)
{
    sim->groups = 0;
    dp_terrain_set_time(sim->terrain, dp_motion_time(sim->motion, sample));
    bool any = false;
    for (int l = 0; l < sim->cast.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        plan_limb(sim, limb, sample);
        if (!limb->stands) sim->pressing[l].at = (DpCellRect){0, 0, 0, 0};
        any = any || limb->active;
        const DpStatus status = limb->begins && limb->flows ? dp_slide_leave(sim, limb) : DP_OK;
        if (status != DP_OK) return status;
    }
    if (any) sim->groups = make_groups(sim);
    for (int l = 0; any && l < sim->cast.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (!limb->active || dp_cells_empty(limb->patch)) continue;
        DpStatus status = dp_terrain_touch(sim->terrain, limb->patch);
        if (status == DP_OK && limb->law == DP_CONTACT_UNIFORM && !limb->lifts)
            status = meet(sim, limb);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}

// What a motion can change, sample by sample.
typedef void (*OnCells)(void* context, DpCellRect cells);
static void each_reach(const DpSim* sim, bool passing, OnCells visit, void* context)
{
    const double rim = sim->options.heap_law == DP_HEAP_PAPER ? sim->options.rim_width : 0.0;
    const double spread = fmax(rim, fmax(bulges(sim), breaks(sim)));
    const double around = slips(sim) + dp_stage_margin(sim);
    for (int l = 0; sim->limb && l < sim->cast.limbs; ++l) {
        const Limb*  limb = &sim->limb[l];
        const bool   carves = limb->law == DP_CONTACT_CARVE;
        const double least = carves ? HEAP_MARGIN : least_margin(limb);
        const double margin = 3 * fmax(least, spread) + around;
        const double more = carves ? CARVED_MARGIN : 0.0;
        int          first, end;
        for (int n = 0; dp_motion_stay(sim->motion, limb->walker, n, &first, &end); ++n)
            for (int k = first; k < end && k + 1 < dp_motion_samples(sim->motion); ++k) {
                const bool there =
                    passing && dp_limb_there(sim, limb, k) && dp_limb_there(sim, limb, k + 1);
                if (there || presses_from(sim, limb, k))
                    visit(context, dp_limb_cells(sim, limb, k, margin + more));
            }
    }
}

static void join_cells(void* context, DpCellRect cells)
{
    DpCellRect* all = context;
    *all = dp_cells_join(*all, cells);
}

void dp_sim_bounds(const DpSim* sim, long bounds[4])
{
    DpCellRect cells = {0, 0, 0, 0};
    each_reach(sim, false, join_cells, &cells);
    bounds[0] = cells.i0, bounds[1] = cells.i1, bounds[2] = cells.j0, bounds[3] = cells.j1;
}

typedef struct Reached
{
    long     tile_x, tile_y;
    int      nx, ny;
    uint8_t* tile;
} Reached;

static void mark_cells(void* context, DpCellRect cells)
{
    const Reached* reached = context;
    if (dp_cells_empty(cells)) return;
    long x0 = dp_tile_of(cells.i0) - reached->tile_x,
         x1 = dp_tile_of(cells.i1 - 1) - reached->tile_x;
    long y0 = dp_tile_of(cells.j0) - reached->tile_y,
         y1 = dp_tile_of(cells.j1 - 1) - reached->tile_y;
    x0 = x0 < 0 ? 0 : x0, y0 = y0 < 0 ? 0 : y0;
    for (long y = y0; y <= y1 && y < reached->ny; ++y)
        for (long x = x0; x <= x1 && x < reached->nx; ++x) reached->tile[y * reached->nx + x] = 1;
}

void dp_sim_reach(const DpSim* sim, long tile_x, long tile_y, int nx, int ny, uint8_t* tile)
{
    Reached reached = {tile_x, tile_y, nx, ny, tile};
    each_reach(sim, sim->stage.plants != NULL, mark_cells, &reached);
}
