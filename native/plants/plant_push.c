// plants/plant_push.c - soles and legs push stems aside, down and nowhere else.
//
// A particle under a sole stays between it and the ground; one that a sole has run into leaves by
// the shorter way, down or to the side. Afterwards each stem is gone through from its foot upward:
// whoever is too far from the particle below comes closer, and since that one is clear of every
// sole, there is always a place that is.
//
// Most particles near a sole are in nobody's way. A row of all lanes is looked at before any of its
// particles is: who is within what no sole goes through, near the one below and beside, stays. The
// ground is asked for in the last sub-step; until then the one of the step before holds.
#include "base/wide.h"

#include "plants/plant_collide.h"

#define ROW_PASSES 4
#define MAX_SWEPT 16     // soles; where more are near, every particle is looked at
#define LAST_WORD 1.04f  // of the rest length, when a stem is gone through

static DpVec3 world(const PlantBlock* block, double x, double y, double z)
{
    return dp_vec3(block->origin[0] + x, block->origin[1] + y, block->origin[2] + z);
}

static DpVec3 get(const PlantBlock* block, int k)
{
    float* const* at = block->state->at;
    return world(block, (double)at[0][k], (double)at[1][k], (double)at[2][k]);
}

static void put(const PlantBlock* block, int k, DpVec3 p)
{
    float* const* at = block->state->at;
    at[0][k] = (float)(p.x - block->origin[0]), at[1][k] = (float)(p.y - block->origin[1]);
    at[2][k] = (float)(p.z - block->origin[2]);
}

// soles take along what they press, as far as they press it
static void rub(const DpPlantCollider* c, DpVec3* p, DpVec3 before, double pushed, double h)
{
    const DpVec3 slip = dp_sub(dp_sub(*p, before), dp_scale(c->velocity, h));
    const double far = sqrt(slip.x * slip.x + slip.y * slip.y);
    if (!(far > 0.0)) return;
    const double share = fmin(1.0, c->friction * pushed / far);
    p->x -= share * slip.x, p->y -= share * slip.y;
}

// a place no farther than `max` from the particle below, clear of everything
static DpVec3 settle(const PlantProbe* probe, DpVec3 p, DpVec3 below, double max)
{
    const DpPlantCollider* by = NULL;
    for (int pass = 0; pass < 4; ++pass) {
        const DpVec3 arm = dp_sub(p, below);
        const double length = dp_length(arm);
        if (length > max) p = dp_add(below, dp_scale(arm, max / length));
        const DpVec3 was = p;
        dp_plant_clear(probe, &p, &by);
        if (dp_length(dp_sub(p, was)) <= 0.0) return p;
        if (dp_length(dp_sub(p, below)) <= max * (double)(DP_MAX_STRETCH / LAST_WORD)) return p;
    }
    // halfway, and again: beside the particle below there is room
    for (double share = 0.5; share > 0.01; share *= 0.5) {
        DpVec3 q = dp_add(below, dp_scale(dp_sub(p, below), share));
        dp_plant_clear(probe, &q, &by);
        if (dp_length(dp_sub(q, below)) <= max) return q;
    }
    return below;
}

// one particle out of everything, taken along, near the one below
static void push_one(const PlantProbe* probe, int k, DpVec3 before, DpVec3 below, double max,
                     double h)
{
    const DpPlantCollider* by = NULL;
    DpVec3                 p = get(probe->block, k);
    const double           pushed = dp_plant_clear(probe, &p, &by);
    if (by) {
        PlantProbe down = *probe;
        down.only_down = true;
        rub(by, &p, before, pushed, h);
        dp_plant_clear(&down, &p, &by);  // where it was taken to, the sole may be lower
    }
    const DpVec3 arm = dp_sub(p, below);
    if (dp_dot(arm, arm) > max * max) p = settle(probe, p, below, max);
    put(probe->block, k, p);
}

// a particle goes with its neighbour in the row when it would be torn from it: the more it leans
// like that one, the nearer they are
static bool keep_up(const PlantProbe* probe, int own, int other, double apart, double max)
{
    const PlantBlock* block = probe->block;
    const DpVec3      p = get(block, own), to = get(block, other), gap = dp_sub(p, to);
    if (dp_dot(gap, gap) <= apart * apart) return false;
    const DpVec3 below = get(block, own - DP_LANES);
    const DpVec3 like = dp_add(below, dp_sub(to, get(block, other - DP_LANES)));
    double       low = 0.0, high = 1.0;
    for (int pass = 0; pass < 8; ++pass) {
        const double t = 0.5 * (low + high);
        const DpVec3 q = dp_add(dp_scale(p, 1.0 - t), dp_scale(like, t));
        if (dp_length(dp_sub(q, to)) <= apart)
            high = t;
        else
            low = t;
    }
    const DpVec3 q = dp_add(dp_scale(p, 1.0 - high), dp_scale(like, high));
    PlantProbe   down = *probe;
    down.only_down = true;
    put(block, own, settle(&down, q, below, max));
    return dp_length(dp_sub(get(block, own), to)) > apart * (double)(DP_MAX_STRETCH / LAST_WORD);
}

// rest distance of two particles of a row, where their feet stand
static double rest_apart(const PlantStand* stand, const PlantBlock* block, int a, int b, int l)
{
    const int    rows = stand->shape.rows;
    const float *ra = stand->rest + 3 * a, *rb = stand->rest + 3 * b;
    const float* z = block->state->at[2] + l;
    const float  lift = z[(b - b % rows) * DP_LANES] - z[(a - a % rows) * DP_LANES];
    const float  dx = rb[0] - ra[0], dy = rb[1] - ra[1], dz = rb[2] - ra[2] + lift;
    return sqrt((double)(dx * dx + dy * dy + dz * dz));
}

// a row of a sheet: from the stem that lies lowest to both sides; true if it is still torn
static bool keep_row(const PlantStand* stand, const PlantProbe* probe, int first, double max)
{
    const int    rows = stand->shape.rows, columns = stand->shape.stems_a_sheet, l = probe->lane;
    const float* z = probe->block->state->at[2];
    int          lowest = 0;
    bool         torn = false;
    for (int c = 1; c < columns; ++c)
        if (z[(first + c * rows) * DP_LANES + l] < z[(first + lowest * rows) * DP_LANES + l])
            lowest = c;
    for (int side = -1; side <= 1; side += 2)
        for (int c = lowest + side; c >= 0 && c < columns; c += side) {
            const int own = first + c * rows, other = own - side * rows;
            const int k = own * DP_LANES + l, n = other * DP_LANES + l;
            if (probe->block->state->limp[k] + probe->block->state->limp[n] > 0.0f) continue;
            const DpVec3 gap = dp_sub(get(probe->block, k), get(probe->block, n));
            const double near = (double)(LAST_WORD * stand->near);
            if (dp_dot(gap, gap) <= near * near) continue;
            const double apart = (double)LAST_WORD * rest_apart(stand, probe->block, own, other, l);
            torn = keep_up(probe, k, n, apart, max) || torn;
        }
    return torn;
}

// are two neighbours of a row too far apart?
static bool row_is_torn(const PlantStand* stand, const PlantProbe* probe, int first)
{
    const int rows = stand->shape.rows, l = probe->lane;
    for (int c = 0; c + 1 < stand->shape.stems_a_sheet; ++c) {
        const int    a = first + c * rows, b = a + rows;
        const float* limp = probe->block->state->limp + l;
        const DpVec3 gap =
            dp_sub(get(probe->block, a * DP_LANES + l), get(probe->block, b * DP_LANES + l));
        if (limp[a * DP_LANES] + limp[b * DP_LANES] > 0.0f) continue;
        if (dp_length(gap) > (double)DP_MAX_STRETCH * rest_apart(stand, probe->block, a, b, l))
            return true;
    }
    return false;
}

// nowhere to go together: the row stays close to the row below, which holds together and is clear
static void shrink_row(const PlantStand* stand, const PlantProbe* probe, int first)
{
    const int              rows = stand->shape.rows, l = probe->lane;
    const DpPlantCollider* by = NULL;
    for (double share = 0.5; row_is_torn(stand, probe, first);
         share = share > 0.1 ? 0.5 * share : 0) {
        for (int c = 0; c < stand->shape.stems_a_sheet; ++c) {
            const int    k = (first + c * rows) * DP_LANES + l;
            const DpVec3 below = get(probe->block, k - DP_LANES);
            const DpVec3 arm = dp_sub(get(probe->block, k), below);
            DpVec3       p = dp_add(below, dp_scale(arm, share));
            if (share > 0.0) dp_plant_clear(probe, &p, &by);
            put(probe->block, k, p);
        }
        if (!(share > 0.0)) return;
    }
}

// ---- who has to be looked at -----------------------------------------------------------------

// What a sole goes through in this step, from the block's origin, a bit wide [m].
typedef struct Swept
{
    float x0, y0, x1, y1, z1;
} Swept;

// of those that a block's plants can meet; how many they are
static int sweep_block(const PlantStand* stand, const PlantBlock* block, const PlantPush* push,
                       int count, Swept* swept)
{
    const double* o = block->origin;
    const double  wide = (double)stand->kind.radius + 1e-4;
    float         low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int l = 0; l < DP_LANES; ++l)
        for (int d = 0; d < 2; ++d) {
            low[d] = fminf(low[d], block->foot[d][l] - 1.1f * stand->extent);
            high[d] = fmaxf(high[d], block->foot[d][l] + 1.1f * stand->extent);
        }
    int met = 0;
    for (int k = 0; k < count; ++k) {
        const Swept at = {(float)(push[k].x0 - o[0] - wide), (float)(push[k].y0 - o[1] - wide),
                          (float)(push[k].x1 - o[0] + wide), (float)(push[k].y1 - o[1] + wide),
                          (float)(push[k].z1 - o[2] + wide)};
        if (at.x0 > high[0] || at.x1 < low[0] || at.y0 > high[1] || at.y1 < low[1]) continue;
        swept[met++] = at;
    }
    return met;
}

#define STEMS_KNOWN 30  // a bit for each of the first stems of a row; the others share the last

static int32_t stem_bit(int c)
{
    return (int32_t)1 << (c < STEMS_KNOWN ? c : STEMS_KNOWN - 1);
}

// The stems of a row, lane by lane, that may be in a sole, on the ground, or too far from the
// particle below, as bits; and whether the row is torn.
DP_CLONES
static void look_at_row(const PlantStand* stand, const PlantBlock* block, int first,
                        const Swept* swept, int count, const float* low, int32_t* due)
{
    const int   rows = stand->shape.rows, a_sheet = stand->shape.stems_a_sheet;
    const float max = LAST_WORD * stand->gap * (1.0f - 1e-5f);
    const float near = LAST_WORD * stand->near * (1.0f - 1e-5f);
    for (int l = 0; l < DP_LANES; ++l) due[l] = 0;
    for (int c = 0; c < a_sheet; ++c) {
        const int     k = (first + c * rows) * DP_LANES, beside = k - rows * DP_LANES;
        const float * x = block->state->at[0] + k, *y = block->state->at[1] + k;
        const float * z = block->state->at[2] + k, *limp = block->state->limp + k;
        const int32_t bit = stem_bit(c);
        for (int l = 0; l < DP_LANES; ++l) {
            const float dx = x[l] - x[l - DP_LANES], dy = y[l] - y[l - DP_LANES];
            const float dz = z[l] - z[l - DP_LANES];
            const int   far = dx * dx + dy * dy + dz * dz > max * max;
            due[l] |= (far | (z[l] <= low[l])) ? bit : 0;
        }
        for (int n = 0; n < count; ++n) {
            const Swept at = swept[n];
            for (int l = 0; l < DP_LANES; ++l) {
                const int aside = (x[l] >= at.x0) & (x[l] <= at.x1) & (y[l] >= at.y0);
                due[l] |= (aside & (y[l] <= at.y1) & (z[l] <= at.z1)) ? bit : 0;
            }
        }
        if (c == 0) continue;
        const float *bx = block->state->at[0] + beside, *by = block->state->at[1] + beside;
        const float *bz = block->state->at[2] + beside, *blimp = block->state->limp + beside;
        for (int l = 0; l < DP_LANES; ++l) {
            const float dx = x[l] - bx[l], dy = y[l] - by[l], dz = z[l] - bz[l];
            due[l] |= (dx * dx + dy * dy + dz * dz > near * near) & (limp[l] + blimp[l] <= 0.0f);
        }
    }
}

// one row of one sheet in one lane: out of everything, near the row below and one another
static void push_row(const PlantStand* stand, PlantBlock* block, const PlantProbe* probe, int first,
                     int32_t due, const float* before, double h)
{
    const DpPlantShape shape = stand->shape;
    const int          size = shape.particles * DP_LANES, l = probe->lane;
    const double       max = (double)(LAST_WORD * stand->gap);
    for (int c = 0; c < shape.stems_a_sheet; ++c) {
        if (!(due & stem_bit(c))) continue;
        const int    k = (first + c * shape.rows) * DP_LANES + l;
        const DpVec3 old =
            world(block, (double)before[k], (double)before[size + k], (double)before[2 * size + k]);
        push_one(probe, k, old, get(block, k - DP_LANES), max, h);
    }
    // who had to go down on the way is the lowest now, and the others follow
    bool torn = true;
    for (int pass = 0; torn && pass < ROW_PASSES; ++pass) torn = keep_row(stand, probe, first, max);
    if (torn) shrink_row(stand, probe, first);
}

void dp_plant_push_block(const PlantStand* stand, PlantBlock* block, const PlantPush* push,
                         int count, const DpPlantGround* ground, const float* before, double left,
                         double h)
{
    const DpPlantShape shape = stand->shape;
    const bool         last = !(left > 0.5 * h);
    Swept              swept[MAX_SWEPT];
    float              low[DP_LANES];
    int32_t            due[DP_LANES];
    const bool         few = count <= MAX_SWEPT;
    const int          met = few ? sweep_block(stand, block, push, count, swept) : 0;
    if (few && met == 0 && !last) return;  // nothing to meet until the ground is asked for
    for (int l = 0; l < DP_LANES; ++l) {
        low[l] = !few ? INFINITY : -INFINITY;
        if (few && last) low[l] = (float)((double)block->ceiling[l] - block->origin[2]) + 1e-5f;
    }
    for (int sheet = 0; sheet < shape.stems; sheet += shape.stems_a_sheet)
        for (int r = DP_PLANT_HELD; r < shape.rows; ++r) {
            const int first = sheet * shape.rows + r;
            look_at_row(stand, block, first, swept, met, low, due);
            for (int l = 0; l < block->count; ++l) {
                if (!due[l] || !block->touched_lane[l]) continue;
                const PlantProbe probe = {push, count, ground, block, l, (double)stand->kind.radius,
                                          left, false};
                push_row(stand, block, &probe, first, due[l], before, h);
            }
        }
}

void dp_plant_hold_block(const PlantStand* stand, PlantBlock* block, const PlantPush* push,
                         int count, const DpPlantGround* ground)
{
    const DpPlantShape shape = stand->shape;
    for (int l = 0; l < DP_LANES; ++l) {
        const bool known = dp_plant_ground_lane(stand, block, ground, l);
        dp_plant_ask_ceiling(stand, block, ground, l);
        block->ground_known[l] = known;
        if (!known && !block->touched_lane[l]) continue;  // it stands as it stood
        const PlantProbe probe = {push, count, ground, block, l, 0.0, 0.0, false};
        for (int stem = 0; stem < shape.stems; ++stem) {
            const int root = stem * shape.rows;
            DpVec3    foot = dp_plant_rest_at(stand, block, root + 1, l);
            foot = world(block, foot.x, foot.y, foot.z);
            foot.z = dp_plant_ground_below(&probe, foot.x, foot.y);
            if (block->touched_lane[l])
                foot.z = fmin(foot.z, dp_plant_sole_over(&probe, &foot, NULL));
            put(block, (root + 1) * DP_LANES + l, foot);
            foot.z -= (double)stand->gap;
            put(block, root * DP_LANES + l, foot);
        }
    }
}
