// plants/plant_ground.c - the ground under plants: where roots stand, how high it is around them.
//
// Grids are told where the ground may have changed since the last step; elsewhere a plant stands
// as it stood. Of the ground around a plant the highest is kept, its ceiling: what is over that
// needs no look at the ground.
#include "base/wide.h"

#include "plants/plant_inside.h"

#define MAX_LOOKS 1024  // at cells, for one ceiling: where more are around a plant, it has none
#define STILL 1e-6f     // who moves less sees the same ground [m]

static bool piece_ok(const DpPlantGround* g)
{
    if (g->at) return true;
    return g->nx > 0 && g->ny > 0 && g->row >= g->nx && g->height && g->cell > 0.0 &&
           g->cell < 1e6 && fabs(g->x0) < 1e9 && fabs(g->y0) < 1e9;
}

bool dp_plant_ground_ok(const DpPlantGround* ground)
{
    bool ok = true;
    for (; ground && ok; ground = ground->next) ok = piece_ok(ground);
    return ok;
}

// of one grid
static double grid_at(const DpPlantGround* ground, double x, double y)
{
    const double u = (x - ground->x0) / ground->cell, v = (y - ground->y0) / ground->cell;
    if (!(u >= -0.5 && v >= -0.5 && u <= ground->nx - 0.5 && v <= ground->ny - 0.5)) return NAN;
    const int    i = (int)dp_clamp(u, 0.0, ground->nx - 1.0);
    const int    j = (int)dp_clamp(v, 0.0, ground->ny - 1.0);
    const int    i1 = i + 1 < ground->nx ? i + 1 : i, j1 = j + 1 < ground->ny ? j + 1 : j;
    const double a = dp_clamp(u - i, 0.0, 1.0), b = dp_clamp(v - j, 0.0, 1.0);
    const float* low = ground->height + (size_t)j * (size_t)ground->row;
    const float* high = ground->height + (size_t)j1 * (size_t)ground->row;
    return (1.0 - b) * ((1.0 - a) * (double)low[i] + a * (double)low[i1]) +
           b * ((1.0 - a) * (double)high[i] + a * (double)high[i1]);
}

double dp_plant_ground_at(const DpPlantGround* ground, double x, double y)
{
    double height = NAN;
    for (; ground && !isfinite(height); ground = ground->next)
        height = ground->at ? ground->at(ground->context, x, y) : grid_at(ground, x, y);
    return height;
}

double dp_plant_floor_at(const PlantBlock* block, const DpPlantGround* ground, int l, double x,
                         double y)
{
    const double height = dp_plant_ground_at(ground, x, y);
    if (isfinite(height)) return height;
    return (double)block->root[2][l] +
           (double)block->slope[0][l] * (x - (double)block->root[0][l]) +
           (double)block->slope[1][l] * (y - (double)block->root[1][l]);
}

// ---- ceilings --------------------------------------------------------------------------------

// are there too many cells within +-span?
static bool is_wide(const DpPlantGround* ground, double span)
{
    const double cells = 2.0 * span / ground->cell + 1.0;
    return !(cells * cells <= MAX_LOOKS);
}

// What grids say of the square of +-span about a root: the highest there; do they hold all of it?
typedef struct Square
{
    float highest;
    bool  any, all;
} Square;

// the highest of a part of a grid and `max`; what is no number is passed over
DP_CLONES
static float highest_in(const DpPlantGround* ground, int i0, int i1, int j0, int j1, float most)
{
    float top[DP_LANES];
    for (int l = 0; l < DP_LANES; ++l) top[l] = most;
    for (int j = j0; j <= j1; ++j) {
        const float* height = ground->height + (size_t)j * (size_t)ground->row;
        int          i = i0;
        for (; i + DP_LANES <= i1 + 1; i += DP_LANES)
            for (int l = 0; l < DP_LANES; ++l)
                top[l] = height[i + l] > top[l] ? height[i + l] : top[l];
        for (; i <= i1; ++i) top[0] = height[i] > top[0] ? height[i] : top[0];
    }
    for (int l = 0; l < DP_LANES; ++l) most = top[l] > most ? top[l] : most;
    return most;
}

static Square look_around(const DpPlantGround* ground, double x, double y, double span)
{
    Square square = {-INFINITY, false, false};
    if (ground && is_wide(ground, span)) square.highest = INFINITY;
    for (; ground; ground = ground->next) {
        if (ground->at) continue;
        const double u0 = (x - span - ground->x0) / ground->cell;
        const double u1 = (x + span - ground->x0) / ground->cell;
        const double v0 = (y - span - ground->y0) / ground->cell;
        const double v1 = (y + span - ground->y0) / ground->cell;
        if (!(u1 >= -0.5 && v1 >= -0.5 && u0 <= ground->nx - 0.5 && v0 <= ground->ny - 0.5))
            continue;
        const int i0 = (int)fmax(u0, 0.0), i1 = (int)fmin(u1 + 1.0, ground->nx - 1.0);
        const int j0 = (int)fmax(v0, 0.0), j1 = (int)fmin(v1 + 1.0, ground->ny - 1.0);
        square.any = true;
        square.all = square.all ||
                     (u0 >= 0.0 && v0 >= 0.0 && u1 <= ground->nx - 1.0 && v1 <= ground->ny - 1.0);
        if (square.highest < INFINITY)
            square.highest = highest_in(ground, i0, i1, j0, j1, square.highest);
    }
    return square;
}

// the highest of ground that is a function, cell by cell; +inf if that takes too long
static float highest_of(const DpPlantGround* ground, double x, double y, double span)
{
    while (ground && !ground->at) ground = ground->next;
    if (!ground || is_wide(ground, span)) return INFINITY;
    const double cells = ceil(span / ground->cell) + 1.0;
    float        highest = -INFINITY;
    for (double j = -cells; j <= cells; ++j)
        for (double i = -cells; i <= cells; ++i)
            highest = fmaxf(highest, (float)ground->at(ground->context, x + i * ground->cell,
                                                       y + j * ground->cell));
    return highest;
}

static double around(const PlantStand* stand)
{
    return (double)(stand->extent + stand->kind.radius);
}

void dp_plant_ask_ceiling(const PlantStand* stand, PlantBlock* block, const DpPlantGround* ground,
                          int l)
{
    const double x = (double)block->root[0][l], y = (double)block->root[1][l];
    if (block->ceiling[l] > -INFINITY) return;
    block->moved = true;
    block->ceiling[l] = fmaxf(look_around(ground, x, y, around(stand)).highest,
                              highest_of(ground, x, y, around(stand)));
}

// ---- plants on it ----------------------------------------------------------------------------

bool dp_plant_ground_lane(const PlantStand* stand, PlantBlock* block, const DpPlantGround* ground,
                          int l)
{
    const double x = (double)block->root[0][l], y = (double)block->root[1][l];
    const Square square = look_around(ground, x, y, around(stand));
    float*       ceiling = &block->ceiling[l];
    if (!square.any) return false;
    block->moved = true;
    if (square.all)
        *ceiling = square.highest;
    else if (*ceiling > -INFINITY)  // the rest is as it was
        *ceiling = fmaxf(*ceiling, square.highest);
    const double height = dp_plant_ground_at(ground, x, y);
    if (!isfinite(height)) return true;
    const double d = fmax(ground->cell, 0.5 * (double)fmaxf(stand->kind.width, stand->kind.depth));
    block->root[2][l] = (float)height;
    block->foot[2][l] = (float)(height - block->origin[2]);
    for (int k = 0; k < 2; ++k) {
        const double dx = k ? 0.0 : d, dy = k ? d : 0.0;
        const double lower = dp_plant_ground_at(ground, x - dx, y - dy);
        const double upper = dp_plant_ground_at(ground, x + dx, y + dy);
        double       slope = (upper - lower) / (2.0 * d);
        if (!isfinite(slope)) slope = isfinite(upper) ? (upper - height) / d : (height - lower) / d;
        if (!isfinite(slope)) slope = 0.0;
        block->slope[k][l] = (float)dp_clamp(slope, -1.0, 1.0);
    }
    return true;
}

// is a particle where its ground was seen, and on it?
static bool lies_still(const PlantState* state, int k)
{
    return fabsf(state->at[0][k] - state->seen[0][k]) < STILL &&
           fabsf(state->at[1][k] - state->seen[1][k]) < STILL && state->floor[k] > DP_NO_FLOOR &&
           state->at[2][k] >= state->floor[k];
}

void dp_plant_ground_block(const PlantStand* stand, PlantBlock* block, const DpPlantGround* ground)
{
    const int    rows = stand->shape.rows;
    float* const z = block->state->at[2];
    for (int at = 0; at < stand->shape.particles; ++at) {
        if (at % rows < DP_PLANT_HELD) continue;
        for (int l = 0; l < DP_LANES; ++l) {
            const int    k = at * DP_LANES + l;
            const double own = block->origin[2] + (double)z[k], most = (double)block->ceiling[l];
            double       height = most;  // over all ground: it falls no further in a step
            if (own <= most) {
                if (!block->ground_known[l] && lies_still(block->state, k)) continue;
                const double x = block->origin[0] + (double)block->state->at[0][k];
                const double y = block->origin[1] + (double)block->state->at[1][k];
                height = dp_plant_ground_at(ground, x, y);
                for (int d = 0; d < 2; ++d) block->state->seen[d][k] = block->state->at[d][k];
            }
            block->state->floor[k] =
                isfinite(height) ? (float)(height - block->origin[2]) : DP_NO_FLOOR;
            // soles had the last word where they touch
            if (own < height && !block->touched_lane[l]) z[k] = block->state->floor[k];
        }
    }
}
