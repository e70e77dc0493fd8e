// soil/soil_columns.c - the ground under a sole is read column by column, and kept if it is small enough.
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_columns.h"

// how far below h0 the ground stood when the sole met it
static double met_at(const DpSoilPatch* patch, const DpImprint* imprint, size_t p)
{
    if (imprint->met) return -(double)imprint->met[p];
    return (double)patch->compression[p] - (double)patch->heap[p];
}

static void put_column(Columns* columns, const Sole* sole, size_t p)
{
    const DpSoilPatch* patch = sole->patch;
    const Beyond*      beyond = &sole->beyond;
    const int          k = columns->count++;
    const bool         ground = soil_is_ground(patch->base_height[p]);
    double             depth = beyond->depth, met = beyond->met, stiffness = beyond->stiffness;
    double base_height = beyond->base_height + beyond->slope_i * ((double)sole->i - beyond->i) +
                         beyond->slope_j * ((double)sole->j - beyond->j);
    if (ground) {
        depth = (double)patch->soils[patch->kind[p]].layer_depth;
        stiffness = (double)patch->modulus[p] / depth;
        met = met_at(patch, sole->imprint, p);
        base_height = (double)patch->base_height[p];
    }
    columns->gap[k] = base_height - (double)sole->imprint->bottom[p];
    columns->pressed[k] = met;
    columns->rigid[k] = SOIL_RIGID * depth;
    columns->share[k] = (double)sole->imprint->cover[p];
    columns->spring[k] = columns->share[k] * (stiffness * (patch->cell * patch->cell));
    columns->cell[k] = ground ? p : NOWHERE;
}

static void fill_up(Columns* columns)
{
    for (int k = columns->count; k < LANES; ++k) {
        columns->gap[k] = columns->pressed[k] = 0.0;
        columns->share[k] = columns->spring[k] = 0.0;
        columns->rigid[k] = 1.0;
    }
}

void dp_columns_begin(Sole* sole, const DpSoilPatch* patch, const DpImprint* imprint, DpVec3 normal)
{
    sole->patch = patch;
    sole->imprint = imprint;
    sole->complete = false;
    Beyond sum = {0};
    double share = 0.0;
    bool   needed = false;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            const double a = (double)imprint->cover[p];
            if (!(a > 0.0)) continue;
            if (!soil_is_ground(patch->base_height[p])) {
                needed = true;
                continue;
            }
            const double depth = (double)patch->soils[patch->kind[p]].layer_depth;
            share += a;
            sum.base_height += a * (double)patch->base_height[p];
            sum.met += a * met_at(patch, imprint, p);
            sum.i += a * i, sum.j += a * j;
            sum.stiffness += a * ((double)patch->modulus[p] / depth);
            sum.depth += a * depth;
        }
    sole->beyond = (Beyond){.is_there = share > 0.0};
    if (!needed || !sole->beyond.is_there) return;
    const double level = normal.z > 0.0 ? patch->cell / normal.z : 0.0;
    sole->beyond = (Beyond){.base_height = sum.base_height / share,
                            .met = sum.met / share,
                            .i = sum.i / share,
                            .j = sum.j / share,
                            .slope_i = -normal.x * level,
                            .slope_j = -normal.y * level,
                            .stiffness = sum.stiffness / share,
                            .depth = sum.depth / share,
                            .is_there = true};
}

void dp_columns_rewind(Sole* sole)
{
    sole->shown = false;
    if (sole->complete) return;
    sole->i = sole->imprint->i0;
    sole->j = sole->imprint->j0;
}

// the next chunk with room for a column; NULL when all are full
static Columns* with_room(Sole* sole)
{
    if (sole->filled > 0 && sole->chunk[sole->filled - 1].count < LANES)
        return &sole->chunk[sole->filled - 1];
    if (sole->filled == CHUNKS) return NULL;
    sole->chunk[sole->filled].count = 0;
    return &sole->chunk[sole->filled++];
}

// read columns from where the last reading stopped; true when the sole's end is reached
static bool read_columns(Sole* sole)
{
    const DpImprint* imprint = sole->imprint;
    for (; sole->j < imprint->j1; ++sole->j, sole->i = imprint->i0)
        for (; sole->i < imprint->i1; ++sole->i) {
            const size_t p = soil_at(sole->patch, sole->i, sole->j);
            if (!(imprint->cover[p] > 0.0f)) continue;
            Columns* columns = with_room(sole);
            if (!columns) return false;
            put_column(columns, sole, p);
        }
    return true;
}

bool dp_columns_next(Sole* sole)
{
    if (sole->complete) {
        const bool more = !sole->shown && sole->filled > 0;
        sole->shown = true;
        return more;
    }
    const bool first = sole->i == sole->imprint->i0 && sole->j == sole->imprint->j0;
    sole->filled = 0;
    const bool end = read_columns(sole);
    sole->complete = sole->shown = first && end;
    if (sole->filled > 0) fill_up(&sole->chunk[sole->filled - 1]);
    return sole->filled > 0;
}
