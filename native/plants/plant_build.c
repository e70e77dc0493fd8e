// plants/plant_build.c - plants from roots: neighbours in blocks, and a look-up by place. TRAIL 4.1
// MODEL 7.1
//
// Departures
//   TRAIL (6) gives every plant of a kind one reserve. Here each one's is multiplied by exp(s z),
//   z of mean 0 and deviation 1 with a density as exp(-sqrt(|z|)): most plants are alike, a few give
//   way at once, a few bear nearly anything. With that a lane's cover falls as Cole's did, to 0.3
//   points; a normal z leaves 2.7, a double-exponential one 1.3 (desire_path/plants.py, vigour_at).
#include <limits.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "plants/plant_inside.h"

#define MAX_COUNT (INT_MAX / (4 * DP_LANES))
#define MAX_PLACE 1e7f    // [m]
#define MAX_HEADING 1e6f  // [rad]

// ---- neighbours ------------------------------------------------------------------------------

typedef struct Order
{
    int   strip, plant;
    float x;
} Order;

static int by_place(const void* a, const void* b)
{
    const Order *p = a, *q = b;
    if (p->strip != q->strip) return p->strip < q->strip ? -1 : 1;
    if (p->x < q->x || p->x > q->x) return p->x < q->x ? -1 : 1;
    return p->plant < q->plant ? -1 : p->plant > q->plant;
}

// Roots, and the box around them.
typedef struct Roots
{
    const float *at, *heading;  // (count, 3) [m]; (count) [rad] or NULL
    int          count;
    double       box[4];  // x0, y0, x1, y1 [m]
    double       area;    // of it, > 0 [m^2]
} Roots;

static Roots roots_of(const float* root, const float* heading, int count)
{
    Roots roots = {root, heading, count, {INFINITY, INFINITY, -INFINITY, -INFINITY}, 0.0};
    for (int k = 0; k < count; ++k)
        for (int d = 0; d < 2; ++d) {
            roots.box[d] = fmin(roots.box[d], (double)root[3 * k + d]);
            roots.box[2 + d] = fmax(roots.box[2 + d], (double)root[3 * k + d]);
        }
    const double* box = roots.box;
    roots.area = fmax((box[2] - box[0]) * (box[3] - box[1]), 1e-12);
    return roots;
}

// a plant takes its lane
static void fill_lane(const DpPlants* plants, const PlantStand* stand, const Roots* roots, int k,
                      PlantBlock* block, int lane)
{
    const float*   root = roots->at + 3 * k;
    const uint64_t name = dp_plant_name(root[0], root[1]);
    const double   facing = roots->heading ? (double)roots->heading[k]
                                           : 2.0 * DP_PI * dp_plant_hash(plants->seed, name, 0);
    const double   z = dp_plant_vigour(plants->seed, name, 1);
    for (int d = 0; d < 3; ++d) {
        block->root[d][lane] = root[d];
        if (lane == 0) block->origin[d] = (double)root[d];
        block->foot[d][lane] = (float)((double)root[d] - block->origin[d]);
    }
    block->turn[0][lane] = (float)cos(facing), block->turn[1][lane] = (float)sin(facing);
    block->reserve[lane] = (double)stand->kind.strength * exp((double)stand->kind.spread * z);
    block->alpha[lane] = 1.0f, block->ceiling[lane] = -INFINITY;
    block->plant[lane] = k;
}

// fill blocks with neighbours, strip by strip
static bool fill_blocks(const DpPlants* plants, PlantStand* stand, const Roots* roots)
{
    const int     n = stand->count;
    const double* box = roots->box;
    const double  high = fmax(sqrt(roots->area * DP_LANES / n), (box[3] - box[1]) * 1e-6);
    Order*        order = dp_alloc((size_t)n, sizeof(Order));
    if (!order) return false;
    for (int k = 0; k < n; ++k)
        order[k] =
            (Order){(int)(((double)roots->at[3 * k + 1] - box[1]) / high), k, roots->at[3 * k]};
    qsort(order, (size_t)n, sizeof(Order), by_place);
    for (int slot = 0; slot < stand->blocks * DP_LANES; ++slot) {
        PlantBlock* block = &stand->block[slot / DP_LANES];
        const int   lane = slot % DP_LANES;
        const int   from = slot < n ? slot : slot - lane;  // spare lanes repeat lane 0
        const int   k = order[from].plant;
        fill_lane(plants, stand, roots, k, block, lane);
        float* bounds = stand->box + 4 * (slot / DP_LANES);
        for (int d = 0; d < 2; ++d) {
            const float at = roots->at[3 * k + d];
            bounds[d] = lane == 0 ? at : fminf(bounds[d], at);
            bounds[2 + d] = lane == 0 ? at : fmaxf(bounds[2 + d], at);
        }
        if (slot >= n) continue;
        ++block->count;
        stand->where[k] = slot;
    }
    dp_free(order);
    return true;
}

// the same roots by cells of at least their radius
static bool fill_bins(PlantStand* stand, const Roots* roots)
{
    const int     n = stand->count;
    const double* box = roots->box;
    stand->bin = fmax((double)stand->kind.root_radius, sqrt(roots->area / (4.0 * n + 16.0)));
    stand->bin = fmax(stand->bin, fmax(box[2] - box[0], box[3] - box[1]) / 4096.0);
    stand->bx0 = box[0], stand->by0 = box[1];
    stand->bnx = (int)((box[2] - box[0]) / stand->bin) + 1;
    stand->bny = (int)((box[3] - box[1]) / stand->bin) + 1;
    stand->bin_start = dp_alloc((size_t)stand->bnx * (size_t)stand->bny + 1, sizeof(int));
    stand->bin_item = dp_alloc((size_t)n, sizeof(int));
    if (!stand->bin_start || !stand->bin_item) return false;
    const size_t bins = (size_t)stand->bnx * (size_t)stand->bny;
    for (int pass = 0; pass < 2; ++pass) {
        for (int k = n - 1; k >= 0; --k) {
            const int    i = (int)(((double)roots->at[3 * k] - box[0]) / stand->bin);
            const int    j = (int)(((double)roots->at[3 * k + 1] - box[1]) / stand->bin);
            const size_t b = (size_t)j * (size_t)stand->bnx + (size_t)i;
            if (pass == 0)
                ++stand->bin_start[b];
            else
                stand->bin_item[--stand->bin_start[b]] = stand->where[k];
        }
        if (pass == 1) break;
        for (size_t b = 1; b <= bins; ++b) stand->bin_start[b] += stand->bin_start[b - 1];
    }
    return true;
}

// ---- a stand -----------------------------------------------------------------------------------

static void destroy_stand(PlantStand* stand)
{
    for (int b = 0; stand->block && b < stand->blocks; ++b) dp_free(stand->block[b].state);
    dp_free(stand->block), dp_free(stand->rest), dp_free(stand->rest_bend), dp_free(stand->edge);
    dp_free(stand->limit), dp_free(stand->box), dp_free(stand->up);
    dp_free(stand->where), dp_free(stand->bin_start), dp_free(stand->bin_item);
}

DpPlants* dp_plants_create(uint64_t seed)
{
    DpPlants* plants = dp_alloc(1, sizeof *plants);
    if (plants) plants->seed = seed;
    return plants;
}

void dp_plants_destroy(DpPlants* plants)
{
    if (!plants) return;
    for (int s = 0; s < plants->stands; ++s) destroy_stand(&plants->stand[s]);
    dp_free(plants->stand), dp_free(plants->task), dp_free(plants->scratch);
    dp_free(plants->side), dp_free(plants);
}

// arrays of a stand whose kind and count are known; false without memory
static bool make_arrays(PlantStand* stand)
{
    const size_t particles = (size_t)stand->shape.particles, bends = (size_t)stand->shape.bends;
    const size_t blocks = (size_t)stand->blocks;
    stand->rest = dp_alloc(particles, 3 * sizeof(float));
    stand->rest_bend = dp_alloc(bends, 3 * sizeof(float));
    stand->limit = dp_alloc(bends, 2 * sizeof(double));
    stand->edge = dp_alloc(particles, 4 * sizeof(PlantEdge));
    stand->block = dp_alloc(blocks, sizeof(PlantBlock));
    stand->box = dp_alloc(blocks, 4 * sizeof(float));
    stand->up = dp_alloc(blocks, 1);
    stand->where = dp_alloc((size_t)stand->count, sizeof(int));
    return stand->rest && stand->rest_bend && stand->limit && stand->edge && stand->block &&
           stand->box && stand->up && stand->where;
}

DpStatus dp_plants_check(const DpPlantKind* kind, const float* root, const float* heading,
                         int count, DpReason* reason)
{
    if (dp_plant_kind_check(kind, reason) != DP_OK) return DP_BAD_ARGUMENT;
    if (!root || count < 1 || count > MAX_COUNT) {
        dp_reason(reason, "there are %d roots: plant 1 to %d at once", root ? count : 0, MAX_COUNT);
        return DP_BAD_ARGUMENT;
    }
    for (int k = 0; k < 3 * count; ++k) {
        if (fabsf(root[k]) < MAX_PLACE) continue;
        dp_reason(reason, "%c of root %d is %g m: it must lie within %g m of 0", 'x' + k % 3, k / 3,
                  (double)root[k], (double)MAX_PLACE);
        return DP_BAD_ARGUMENT;
    }
    for (int k = 0; heading && k < count; ++k) {
        if (fabsf(heading[k]) < MAX_HEADING) continue;
        dp_reason(reason, "heading %d is %g rad: it must lie within %g of 0", k, (double)heading[k],
                  (double)MAX_HEADING);
        return DP_BAD_ARGUMENT;
    }
    return DP_OK;
}

DpStatus dp_plants_add(DpPlants* plants, const DpPlantKind* kind, const float* root,
                       const float* heading, int count, int* stand_name)
{
    if (!plants || !stand_name) return DP_BAD_ARGUMENT;
    if (dp_plants_check(kind, root, heading, count, NULL) != DP_OK) return DP_BAD_ARGUMENT;
    PlantStand* more = dp_realloc(plants->stand, (size_t)plants->stands + 1, sizeof(PlantStand));
    if (!more) return DP_NO_MEMORY;
    plants->stand = more;
    PlantStand* stand = &more[plants->stands];
    *stand = (PlantStand){.kind = *kind, .shape = dp_plant_shape(kind), .count = count};
    stand->blocks = (count + DP_LANES - 1) / DP_LANES;
    const bool room = make_arrays(stand);
    if (room) dp_plant_shape_stand(stand);
    const Roots roots = roots_of(root, heading, count);
    if (!room || !fill_blocks(plants, stand, &roots) || !fill_bins(stand, &roots)) {
        destroy_stand(stand);
        return DP_NO_MEMORY;
    }
    *stand_name = plants->stands++;
    return DP_OK;
}

DpPlantShape dp_plants_shape(const DpPlants* plants, int stand)
{
    const bool there = plants && stand >= 0 && stand < plants->stands;
    return there ? plants->stand[stand].shape : (DpPlantShape){0};
}

int dp_plants_count(const DpPlants* plants, int stand)
{
    int sum = 0;
    for (int s = 0; plants && s < plants->stands; ++s)
        if (stand < 0 || s == stand) sum += plants->stand[s].count;
    return sum;
}
