// carry/carry_step.c - what a sole leaves on the cells it presses, and takes from those it lets go. MODEL 6.16
//
// Departures
//   PEYRAT11 3.4: what sticks is left as heaps. Here it is a coat of its own that lies still: a film of a few millimetres on
//     a road does not slide, and what soil it is of stays known.
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "carry/carry_inside.h"

#define YIELDS 0.95  // share of a layer that can be gone; what is below is rigid

// ---- where cells lie on the sole ---------------------------------------------------------------

// The part's pose whose origin is nearest to a place, seen from above: for a wheel that with which it stood there.
static int pose_over(const DpCarrying* by, double x, double y)
{
    int    nearest = 0;
    double least = INFINITY;
    for (int k = 0; k < by->count; ++k) {
        const double u = by->pose[k].at.x - x, v = by->pose[k].at.y - y, away = u * u + v * v;
        if (away < least) nearest = k, least = away;
    }
    return nearest;
}

static Block block_over(const DpCarry* carry, const DpCarrying* by, DpVec3 point)
{
    const int    k = pose_over(by, point.x, point.y);
    const DpVec3 at = dp_turn(dp_quat_back(by->pose[k].turn), dp_sub(point, by->pose[k].at));
    const double far = 1e9;
    return (Block){k % by->parts, (int32_t)rint(dp_clamp(at.x / carry->side, -far, far)),
                   (int32_t)rint(dp_clamp(at.y / carry->side, -far, far)),
                   (int32_t)rint(dp_clamp(at.z / carry->side, -far, far))};
}

static bool is_touched(const DpImprint* imprint, size_t p)
{
    return imprint->ring[p] == 0 && imprint->cover[p] > 0.0f;
}

// The cells that are touched now; false without memory.
static bool find_touched(DpCarry* carry, const DpSoilPatch* patch, const DpImprint* imprint,
                         const DpCarrying* by, int* found)
{
    const int wide = imprint->i1 > imprint->i0 ? imprint->i1 - imprint->i0 : 0;
    const int high = imprint->j1 > imprint->j0 ? imprint->j1 - imprint->j0 : 0;
    // together with those that are touched since before and lie elsewhere
    const size_t room = (size_t)wide * (size_t)high + (size_t)carry->touches + 1;
    if (!dp_make_room(&carry->next, room, sizeof *carry->next) ||
        !dp_make_room(&carry->gone, (size_t)carry->touches + 1, sizeof *carry->gone))
        return false;
    *found = 0;
    for (int j = imprint->j0; j < imprint->j0 + high; ++j)
        for (int i = imprint->i0; i < imprint->i0 + wide; ++i) {
            const size_t p = (size_t)j * (size_t)patch->row + (size_t)i;
            if (!is_touched(imprint, p)) continue;
            const DpVec3 point = dp_vec3(patch->x0 + i * patch->cell, patch->y0 + j * patch->cell,
                                         (double)imprint->bottom[p]);
            const int    block = dp_carry_block(carry, block_over(carry, by, point));
            if (block < 0) return false;
            carry->next[(*found)++] = (Touch){by->i0 + i,
                                              by->j0 + j,
                                              block,
                                              imprint->cover[p],
                                              patch->pressure ? (double)patch->pressure[p] : 0.0,
                                              0.0};
        }
    return true;
}

// ---- one cell ----------------------------------------------------------------------------------

static const DpSoil* soil_at(const DpSoilPatch* patch, size_t p)
{
    return &patch->soils[patch->kind[p]];
}

// A block comes to the ground, or stays there: what it has brought counts until no cell touches it any more.
static void hold(DpCarry* carry, int block)
{
    const int at = block * carry->coats;
    for (int k = 0; k < carry->coats && carry->held[block] == 0; ++k)
        carry->brought[at + k] = carry->amount[at + k];
    ++carry->held[block];
}

// an amount, in steps of the store's grid [m^3]
static double on_grid(const DpCarry* carry, double amount)
{
    return (amount + carry->grid) - carry->grid;
}

// what of a block's face a touched cell is
static double of_block(const DpCarry* carry, const DpSoilPatch* patch, const Touch* touch)
{
    return (double)touch->share * patch->cell * patch->cell / (carry->side * carry->side);
}

// What a cell asks for of a soil on the block over it: a share of what it has brought; the pressure has risen to the
// touch's peak [m^3].
static double asks(const DpCarry* carry, const DpSoilPatch* patch, size_t p, const Touch* touch,
                   int k)
{
    const DpSoil* own = &patch->soils[patch->coat_soil[k]];
    const double  p0 = (double)own->release_pressure;
    if (!(soil_at(patch, p)->adhesion < own->adhesion)) return 0.0;
    return on_grid(carry, of_block(carry, patch, touch) *
                              (exp(-touch->since / p0) - exp(-touch->peak / p0)) *  // MODEL 6.16
                              carry->brought[touch->block * carry->coats + k]);
}

static void leave(DpCarry* carry, DpSoilPatch* patch, size_t p, const Touch* touch,
                  DpCarried* carried)
{
    const double area = patch->cell * patch->cell;
    for (int k = 0; k < carry->coats; ++k) {
        const int    at = touch->block * carry->coats + k;
        const double wanted = asks(carry, patch, p, touch, k);
        if (!(wanted > 0.0)) continue;
        const double fits = fmin(wanted, wanted / carry->asked[at] * carry->had[at]);
        float*       coat = patch->coat + (size_t)k * patch->coat_stride + p;
        const float  was = *coat;
        *coat = (float)((double)was + fits / area);
        const double left = on_grid(carry, ((double)*coat - (double)was) * area);  // what it holds
        carry->amount[at] -= left;
        carried->left += left;
    }
}

// of the topmost layer of a kind [m]
static double thickness_of(const DpSoilPatch* patch, int kind)
{
    const int first = patch->layer_start[kind];
    return patch->layer_start[kind + 1] > first ? patch->layers[first].thickness
                                                : (double)patch->soils[kind].layer_depth;
}

// Take what sticks of the soil of a cell that lets go, `share` of as much as could.
static void take(DpCarry* carry, DpSoilPatch* patch, size_t p, const Touch* touch, double share,
                 DpCarried* carried)
{
    const DpSoil* soil = soil_at(patch, p);
    const int     coat = patch->coat_of_soil[patch->kind[p]];
    const double  area = patch->cell * patch->cell;
    const double  want = share * (double)soil->adhesion * (double)touch->share;
    if (coat < 0 || !(want > 0.0)) return;
    const float  b = patch->heap[p], c = patch->compression[p];
    const double loose = fmin(want, (double)b);
    const double top =
        patch->layers ? thickness_of(patch, patch->kind[p]) : (double)soil->layer_depth;
    const double deep = fmax(YIELDS * top - (double)c, 0.0);
    const double firm = fmin(fmin(want - loose, (double)c), deep);  // only what was pressed
    patch->heap[p] = (float)((double)b - loose);
    patch->compression[p] = (float)((double)c + firm);
    const double out_of_heap = on_grid(carry, ((double)b - (double)patch->heap[p]) * area);
    const double out_of_firm = on_grid(carry, ((double)patch->compression[p] - (double)c) * area);
    if (patch->spring && patch->spring[p] < 0.0f)  // its deepest, too
        patch->spring[p] -= patch->compression[p] - c;
    carry->amount[touch->block * carry->coats + coat] += out_of_heap + out_of_firm;
    carry->taken[coat] += out_of_heap + out_of_firm;
    carried->loose += out_of_heap;
    carried->firm += out_of_firm;
}

// ---- a step ------------------------------------------------------------------------------------

// Whether a cell of the world lies in a patch; then where.
static bool is_on(const DpSoilPatch* patch, long i0, long j0, const Touch* touch, size_t* p)
{
    const long i = touch->i - i0, j = touch->j - j0;
    *p = (size_t)j * (size_t)patch->row + (size_t)i;
    return i >= 0 && j >= 0 && i < patch->nx && j < patch->ny;
}

static bool comes_before(const Touch* a, const Touch* b)
{
    return a->j != b->j ? a->j < b->j : a->i < b->i;
}

// Touches that lie beyond the patch stay: they are merged into those found, from the back.
static int keep_beyond(DpCarry* carry, int found, int kept)
{
    Touch* next = carry->next;
    for (int to = found + kept, a = found, b = kept; b > 0;) {
        const bool last = a > 0 && comes_before(&carry->touch[b - 1], &next[a - 1]);
        next[--to] = last ? next[--a] : carry->touch[--b];
    }
    return found + kept;
}

// What a block has before a step's cells take or leave; asked is 0 again.
static void note(DpCarry* carry, int block)
{
    const int at = block * carry->coats;
    for (int k = 0; k < carry->coats; ++k)
        carry->had[at + k] = carry->amount[at + k], carry->asked[at + k] = 0.0;
}

// Cells let go: each gives what sticks of it, as far as there is room on its block for all of them.
static void let_go(DpCarry* carry, DpSoilPatch* patch, long i0, long j0, int count,
                   DpCarried* carried)
{
    const double face = carry->side * carry->side;
    size_t       p;
    for (int t = 0; t < count; ++t) note(carry, carry->gone[t].block);
    for (int t = 0; t < count; ++t) {
        const Touch* gone = &carry->gone[t];
        is_on(patch, i0, j0, gone, &p);
        const double wants = (double)soil_at(patch, p)->adhesion * (double)gone->share;
        carry->asked[gone->block * carry->coats] +=
            on_grid(carry, wants * patch->cell * patch->cell);
        --carry->held[gone->block];
    }
    for (int t = 0; t < count; ++t) {
        const Touch* gone = &carry->gone[t];
        const int    at = gone->block * carry->coats;
        double       full = 0.0;
        for (int k = 0; k < carry->coats; ++k) full += carry->had[at + k];
        is_on(patch, i0, j0, gone, &p);
        const double room = (double)soil_at(patch, p)->adhesion * face - full;
        if (!(room > 0.0 && carry->asked[at] > 0.0)) continue;
        take(carry, patch, p, gone, fmin(room / carry->asked[at], 1.0), carried);
    }
}

// Cells are touched: each gets what it asks for, as far as its block has that for all of them.
static void touch_down(DpCarry* carry, DpSoilPatch* patch, const DpCarrying* by, int count,
                       DpCarried* carried)
{
    size_t p;
    for (int t = 0; t < count; ++t) note(carry, carry->next[t].block);
    for (int t = 0; t < count; ++t) {
        const Touch* now = &carry->next[t];
        is_on(patch, by->i0, by->j0, now, &p);
        for (int k = 0; k < carry->coats; ++k)
            carry->asked[now->block * carry->coats + k] += asks(carry, patch, p, now, k);
    }
    for (int t = 0; t < count; ++t) {
        is_on(patch, by->i0, by->j0, &carry->next[t], &p);
        leave(carry, patch, p, &carry->next[t], carried);
    }
}

// What is known of the cells that are touched now, and those that let go; returns how many stay touched beyond the patch.
static int sort_out(DpCarry* carry, const DpSoilPatch* patch, const DpCarrying* by, int found,
                    int* gone)
{
    int    old = 0, kept = 0;
    size_t p;
    *gone = 0;
    for (int n = 0; n <= found; ++n) {
        Touch* now = n < found ? &carry->next[n] : NULL;
        for (; old < carry->touches && (!now || comes_before(&carry->touch[old], now)); ++old) {
            const Touch before = carry->touch[old];
            if (is_on(patch, by->i0, by->j0, &before, &p))
                carry->gone[(*gone)++] = before;
            else
                carry->touch[kept++] = before;
        }
        if (!now) break;
        const bool since = old < carry->touches && !comes_before(now, &carry->touch[old]);
        now->since = since ? carry->touch[old].peak : 0.0;
        now->peak = fmax(now->peak, now->since);
        hold(carry, now->block);
        if (since) --carry->held[carry->touch[old++].block];
    }
    return kept;
}

DpStatus dp_carry_step(DpCarry* carry, DpSoilPatch* patch, const DpImprint* imprint,
                       const DpCarrying* by, DpCarried* carried)
{
    int found = 0, gone = 0;
    if (!patch->coat) return DP_BAD_ARGUMENT;
    if (!find_touched(carry, patch, imprint, by, &found)) return DP_NO_MEMORY;
    const int kept = sort_out(carry, patch, by, found, &gone);
    let_go(carry, patch, by->i0, by->j0, gone, carried);
    touch_down(carry, patch, by, found, carried);
    carry->touches = keep_beyond(carry, found, kept);
    Touch* const spare = carry->touch;
    carry->touch = carry->next, carry->next = spare;
    return DP_OK;
}

DpStatus dp_carry_lift(DpCarry* carry, DpSoilPatch* patch, long i0, long j0, DpCarried* carried)
{
    int    gone = 0, kept = 0;
    size_t p;
    if (!dp_make_room(&carry->gone, (size_t)carry->touches + 1, sizeof *carry->gone))
        return DP_NO_MEMORY;
    for (int t = 0; t < carry->touches; ++t) {
        const Touch before = carry->touch[t];
        if (is_on(patch, i0, j0, &before, &p))
            carry->gone[gone++] = before;
        else
            carry->touch[kept++] = before;
    }
    carry->touches = kept;
    let_go(carry, patch, i0, j0, gone, carried);
    return DP_OK;
}
