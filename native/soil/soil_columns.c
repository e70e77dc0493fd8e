// soil/soil_columns.c - the ground under a sole is read column by column, and kept if it is small enough.
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_columns.h"

// how far below h0 the ground stood when the sole met it
static double met_at(const DpSoilPatch* patch, const DpImprint* imprint, size_t p)
{
    if (imprint->met) return -(double)imprint->met[p];
    return (double)patch->compression[p] - (double)patch->heap[p];
}

// a column beyond the ground
static void put_beyond(Columns* columns, const Sole* sole, size_t p)
{
    const double  cell = sole->patch->cell;
    const Beyond* beyond = &sole->beyond;
    const int     k = columns->count++;
    const double  base_height = beyond->base_height +
                               beyond->slope_i * ((double)sole->i - beyond->i) +
                               beyond->slope_j * ((double)sole->j - beyond->j);
    columns->gap[k] = base_height - (double)sole->imprint->bottom[p];
    columns->pressed[k] = beyond->met;
    columns->rigid[k] = SOIL_RIGID * beyond->depth;
    columns->share[k] = (double)sole->imprint->cover[p];
    columns->spring[k] = columns->share[k] * (beyond->stiffness * (cell * cell));
    columns->cell[k] = NOWHERE;
}

// how many cells from p on the sole covers that are ground of one kind
static int alike(const Sole* sole, size_t p, int most)
{
    const DpSoilPatch* patch = sole->patch;
    int                count = 0;
    while (count < most && sole->imprint->cover[p + (size_t)count] > 0.0f &&
           soil_is_ground(patch->base_height[p + (size_t)count]) &&
           patch->kind[p + (size_t)count] == patch->kind[p])
        ++count;
    return count;
}

// so many columns of ground of one kind, side by side
DP_CLONES
static void put_ground(Columns* columns, const Sole* sole, size_t p, int count)
{
    const DpSoilPatch* patch = sole->patch;
    const float* restrict base_height = patch->base_height + p;
    const float* restrict bottom = sole->imprint->bottom + p;
    const float* restrict cover = sole->imprint->cover + p;
    const float* restrict modulus = patch->modulus + p;
    const int    k = columns->count;
    const double depth = (double)patch->soils[patch->kind[p]].layer_depth;
    const double area = patch->cell * patch->cell;
    double* restrict gap = columns->gap + k, * restrict rigid = columns->rigid + k;
    double* restrict share = columns->share + k, * restrict spring = columns->spring + k;
    for (int n = 0; n < count; ++n) {
        gap[n] = (double)base_height[n] - (double)bottom[n];
        rigid[n] = SOIL_RIGID * depth;
        share[n] = (double)cover[n];
        spring[n] = (double)cover[n] * ((double)modulus[n] / depth * area);
    }
    for (int n = 0; n < count; ++n) columns->cell[k + n] = p + (size_t)n;
    for (int n = 0; n < count; ++n)
        columns->pressed[k + n] = met_at(patch, sole->imprint, p + (size_t)n);
    columns->count += count;
}

static void fill_up(Columns* columns)
{
    for (int k = columns->count; k < LANES; ++k) {
        columns->gap[k] = columns->pressed[k] = 0.0;
        columns->share[k] = columns->spring[k] = 0.0;
        columns->rigid[k] = 1.0;
    }
}

// What of a row the sole covers, as bits.
#define GROUND 1
#define NO_GROUND 2

DP_CLONES
static int look_under(const float* restrict base_height, const float* restrict cover, int count)
{
    int ground = 0, none = 0;
    for (int i = 0; i < count; ++i) {
        ground |= (cover[i] > 0.0f) & (base_height[i] == base_height[i]);
        none |= (cover[i] > 0.0f) & (base_height[i] != base_height[i]);
    }
    return (ground ? GROUND : 0) | (none ? NO_GROUND : 0);
}

void dp_columns_begin(Sole* sole, const DpSoilPatch* patch, const DpImprint* imprint, DpVec3 normal)
{
    sole->patch = patch;
    sole->imprint = imprint;
    sole->complete = false;
    int under = 0;
    for (int j = imprint->j0; j < imprint->j1; ++j) {
        const size_t p = soil_at(patch, imprint->i0, j);
        under |= look_under(patch->base_height + p, imprint->cover + p, imprint->i1 - imprint->i0);
    }
    sole->beyond = (Beyond){.is_there = under & GROUND};
    if (under != (GROUND | NO_GROUND)) return;
    Beyond sum = {0};
    double share = 0.0;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            const double a = (double)imprint->cover[p];
            if (!(a > 0.0) || !soil_is_ground(patch->base_height[p])) continue;
            const double depth = (double)patch->soils[patch->kind[p]].layer_depth;
            share += a;
            sum.base_height += a * (double)patch->base_height[p];
            sum.met += a * met_at(patch, imprint, p);
            sum.i += a * i, sum.j += a * j;
            sum.stiffness += a * ((double)patch->modulus[p] / depth);
            sum.depth += a * depth;
        }
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
        for (int count = 1; sole->i < imprint->i1; sole->i += count, count = 1) {
            const size_t p = soil_at(sole->patch, sole->i, sole->j);
            if (!(imprint->cover[p] > 0.0f)) continue;
            Columns* columns = with_room(sole);
            if (!columns) return false;
            const int left = imprint->i1 - sole->i, room = LANES - columns->count;
            count = alike(sole, p, left < room ? left : room);
            if (count > 0)
                put_ground(columns, sole, p, count);
            else
                put_beyond(columns, sole, p), count = 1;
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
