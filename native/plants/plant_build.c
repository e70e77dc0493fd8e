// plants/plant_build.c - plants from roots: shape, edges, neighbours in blocks. TRAIL 4.1
//
// Departures
//   TRAIL (6) gives every plant of a kind one reserve. Here each one's is multiplied by exp(s z),
//   z of mean 0 and deviation 1 with a density as exp(-sqrt(|z|)): most plants are alike, a few give
//   way at once, a few bear nearly anything. With that a lane's cover falls as Cole's did, to 0.3
//   points; a normal z leaves 2.7, a double-exponential one 1.3 (desire_path/plants.py, vigour_at).
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "plants/plant_inside.h"

#define PI 3.14159265358979323846
#define ROWS_MOST 64
#define STEMS_MOST 96

DpPlantKind dp_plant_kind_default(void)
{
    return (DpPlantKind){
        .form = DP_PLANT_SURFACE,
        .sheets = 2,
        .height = 0.10f,
        .width = 0.05f,
        .depth = 0.05f,
        .spacing = 0.015f,
        .radius = 0.005f,
        .curl = 0.0f,
        .sway = 3.0f,
        .across = 20.0f,
        .damping = 6.0f,
        .strength = 0.1f,
        .degrade_angle = (float)(10.0 * PI / 180.0),
        .break_angle = (float)(70.0 * PI / 180.0),
        .degrade_rate = 0.1f,
        .recover_rate = 0.1f,
        .spread = 0.0f,
        .regrow_rate = (float)(1.02 / (365.25 * 86400.0)),
        .seed_share = 0.0f,
        .reach = 0.15f,
        .full_density = 40.0f,
        .modulus = 10e6f,
    };
}

// low <= value <= high, and a number
static bool within(float value, double low, double high)
{
    return (double)value >= low && (double)value <= high;
}

DpStatus dp_plant_kind_check(const DpPlantKind* kind)
{
    if (!kind) return DP_BAD_ARGUMENT;
    const bool form = kind->form == DP_PLANT_SURFACE ||
                      (kind->form == DP_PLANT_TUFT && kind->sheets >= 2 && kind->sheets <= 3);
    const bool size = within(kind->height, 0.0, 10.0) && within(kind->width, 0.0, 10.0) &&
                      within(kind->depth, 0.0, 10.0) && within(kind->spacing, 1e-4, 10.0) &&
                      within(kind->radius, 0.0, 1.0);
    const bool swing = within(kind->curl, 0.0, 0.5 * PI + 1e-6) && within(kind->sway, 1e-3, 1e3) &&
                       within(kind->across, 1e-3, 1e4) && within(kind->damping, 0.0, 1e4);
    const bool wear = within(kind->strength, 1e-9, 1e9) &&
                      within(kind->degrade_angle, 0.0, PI + 1e-6) &&
                      within(kind->break_angle, kind->degrade_angle, 1e3) &&
                      within(kind->degrade_rate, 0.0, 1e9) &&
                      within(kind->recover_rate, 0.0, 1e9) && within(kind->spread, 0.0, 4.0) &&
                      within(kind->regrow_rate, 0.0, 1e3) && within(kind->seed_share, 0.0, 1.0);
    const bool roots = within(kind->reach, 1e-3, 100.0) && within(kind->full_density, 1e-6, 1e9) &&
                       within(kind->modulus, 0.0, 1e12);
    if (!form || !size || !swing || !wear || !roots) return DP_BAD_ARGUMENT;
    const DpPlantShape shape = dp_plant_shape(kind);
    return shape.rows > ROWS_MOST || shape.stems > STEMS_MOST ? DP_BAD_ARGUMENT : DP_OK;
}

// steps of `spacing` that fit in `length`, and the one they start from
static int grid_count(float length, float spacing)
{
    const double steps = floor((double)length / (double)spacing + 1e-4);
    return steps < 1000.0 ? (int)steps + 1 : 1001;
}

DpPlantShape dp_plant_shape(const DpPlantKind* kind)
{
    DpPlantShape shape;
    const int    sheets = kind->form == DP_PLANT_TUFT ? kind->sheets : 1;
    shape.rows = grid_count(kind->height, kind->spacing);
    if (shape.rows < DP_PLANT_HELD + 1) shape.rows = DP_PLANT_HELD + 1;
    shape.stems_a_sheet = grid_count(kind->width, kind->spacing);
    shape.stems = sheets * shape.stems_a_sheet;
    shape.particles = shape.stems * shape.rows;
    shape.bends = shape.stems * (shape.rows - 2);
    return shape;
}

// splitmix64 over the three names
double plant_hash(uint64_t seed, uint64_t a, uint64_t b)
{
    uint64_t z = seed ^ (a + 1) * 0x9E3779B97F4A7C15u ^ (b + 1) * 0xC2B2AE3D27D4EB4Fu;
    for (int k = 0; k < 2; ++k) {
        z += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        z ^= z >> 31;
    }
    return (double)(z >> 11) / 9007199254740992.0;
}

double plant_vigour(uint64_t seed, uint64_t a, uint64_t b)
{
    const double most = 8.0, least = 1e-12;
    const double t = -log((plant_hash(seed, a, 3 * b) + least) *
                          (plant_hash(seed, a, 3 * b + 1) + least));  // sum of two exponential ones
    const double z = fmin(fmax(t, 0.0) * t / sqrt(120.0), most);
    return plant_hash(seed, a, 3 * b + 2) < 0.5 ? -z : z;
}

uint64_t plant_name(float x, float y)
{
    uint32_t    bits[2];
    const float at[2] = {x + 0.0f, y + 0.0f};  // -0 is 0
    memcpy(bits, at, sizeof bits);
    return (uint64_t)bits[0] << 32 | bits[1];
}

double plant_return_rate(const DpPlantKind* kind)
{
    const double swing = 2.0 * PI * (double)kind->sway, damping = (double)kind->damping;
    return damping > 2.0 * swing ? swing * swing / damping : swing;
}

double plant_rise_rate(const DpPlantKind* kind)
{
    const double rate = fmin(0.5 * (double)kind->damping, plant_return_rate(kind));
    return fmax(rate, 0.2 * (double)kind->sway);  // without damping, too
}

// ---- shape -----------------------------------------------------------------------------------

// squared frequency of a stem of n free particles, of mass and bending stiffness 1: the lowest
// eigenvalue of B^T B, B the second differences, by inverse iteration
static double lowest_mode(int n)
{
    double u[ROWS_MOST], v[ROWS_MOST], size = 1.0;
    for (int k = 0; k < n; ++k) u[k] = k + 1.0;
    for (int pass = 0; pass < 30; ++pass) {
        for (int k = n - 1; k >= 0; --k)  // B^T v = u
            v[k] = u[k] + (k + 1 < n ? 2.0 * v[k + 1] : 0.0) - (k + 2 < n ? v[k + 2] : 0.0);
        for (int k = 0; k < n; ++k)  // B u = v
            u[k] = v[k] + (k > 0 ? 2.0 * u[k - 1] : 0.0) - (k > 1 ? u[k - 2] : 0.0);
        double sum = 0.0;
        for (int k = 0; k < n; ++k) sum += u[k] * u[k];
        size = sqrt(sum);
        for (int k = 0; k < n; ++k) u[k] /= size;
    }
    return 1.0 / size;
}

// a stem rises from its foot and bends outward by curl at every particle
static void rest_shape(PlantStand* stand)
{
    const DpPlantKind* kind = &stand->kind;
    const DpPlantShape shape = stand->shape;
    const int          sheets = shape.stems / shape.stems_a_sheet, columns = shape.stems_a_sheet;
    stand->gap = kind->height / (float)(shape.rows - DP_PLANT_HELD);
    for (int s = 0; s < sheets; ++s)
        for (int c = 0; c < columns; ++c) {
            const double along = PI * s / sheets, ax = cos(along), ay = sin(along);
            const double wide = (double)(s == 0 ? kind->width : kind->depth);
            const double off = columns > 1 ? wide * (c / (columns - 1.0) - 0.5) : 0.0;
            const double side = off > 1e-9 ? 1.0 : off < -1e-9 ? -1.0 : 0.0;
            const double dx = kind->form == DP_PLANT_TUFT ? side * ax : -ay;
            const double dy = kind->form == DP_PLANT_TUFT ? side * ay : ax;
            double       x = off * ax, y = off * ay, z = -(double)stand->gap;
            float*       at = stand->rest + 3 * (s * columns + c) * shape.rows;
            for (int r = 0; r < shape.rows; ++r, at += 3) {
                at[0] = (float)x, at[1] = (float)y, at[2] = (float)z;
                const double far = sqrt(x * x + y * y + z * z);
                if (far > (double)stand->extent) stand->extent = (float)far;
                stand->aside = fmaxf(stand->aside, (float)sqrt(x * x + y * y));
                const double lean = dx != 0.0 || dy != 0.0 ? (double)kind->curl * r : 0.0;
                const double most = lean < 0.9 * PI ? lean : 0.9 * PI;  // no stem rolls up
                x += (double)stand->gap * sin(most) * dx;
                y += (double)stand->gap * sin(most) * dy;
                z += (double)stand->gap * cos(most);
                if (r > 0 && z < 0.0) z = 0.0;
            }
        }
    // a stem as long as it is may lie down
    const float reach = kind->height + 0.5f * fmaxf(kind->width, kind->depth);
    stand->extent = fmaxf(stand->extent, 1.06f * reach);
    for (int b = 0; b < shape.bends; ++b) {
        const int    stem = b / (shape.rows - 2), row = b % (shape.rows - 2);
        const float* at = stand->rest + 3 * (stem * shape.rows + row);
        for (int d = 0; d < 3; ++d)
            stand->rest_bend[3 * b + d] = at[d] - 2.0f * at[3 + d] + at[6 + d];
    }
    const double swing = 2.0 * PI * (double)kind->sway;
    stand->bend_rate = (float)(swing * swing / lowest_mode(shape.rows - DP_PLANT_HELD));
}

static void add_edge(PlantStand* stand, int a, int b, double rate)
{
    const int rows = stand->shape.rows;
    const int held_a = a % rows < DP_PLANT_HELD, held_b = b % rows < DP_PLANT_HELD;
    if (held_a && held_b) return;
    double d2 = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double along = (double)stand->rest[3 * b + d] - (double)stand->rest[3 * a + d];
        d2 += along * along;
    }
    PlantEdge* edge = &stand->edge[stand->edges++];
    *edge = (PlantEdge){.a = a, .b = b, .rest = (float)sqrt(d2), .rate = (float)rate};
    edge->share_a = held_a ? 0.0f : held_b ? 1.0f : 0.5f;
    edge->share_b = 1.0f - edge->share_a;
}

// across, then diagonals, then stems upward: what comes last holds best. Edges that follow one
// another share no particle, so that a machine can work on several. TRAIL (5)
static void join_edges(PlantStand* stand)
{
    const int    rows = stand->shape.rows, columns = stand->shape.stems_a_sheet;
    const double swing = 2.0 * PI * (double)stand->kind.across, rate = swing * swing;
    for (int odd = 0; odd < 2; ++odd)
        for (int stem = odd; stem < stand->shape.stems; stem += 2)
            for (int r = 0; stem % columns + 1 < columns && r < rows; ++r)
                add_edge(stand, stem * rows + r, (stem + 1) * rows + r, rate);
    for (int odd = 0; odd < 2; ++odd)
        for (int stem = odd; stem < stand->shape.stems; stem += 2)
            for (int r = 0; stem % columns + 1 < columns && r + 1 < rows; ++r) {
                add_edge(stand, stem * rows + r, (stem + 1) * rows + r + 1, 4.0 * rate);
                add_edge(stand, (stem + 1) * rows + r, stem * rows + r + 1, 4.0 * rate);
            }
    stand->near = INFINITY;
    for (int e = 0; e < stand->edges; ++e) {
        const float *a = stand->rest + 3 * stand->edge[e].a,
                    *b = stand->rest + 3 * stand->edge[e].b;
        if (stand->edge[e].b - stand->edge[e].a == rows)
            stand->near = fminf(stand->near, hypotf(b[0] - a[0], b[1] - a[1]));
    }
    for (int r = 1; r + 1 < rows; ++r)
        for (int stem = 0; stem < stand->shape.stems; ++stem)
            add_edge(stand, stem * rows + r, stem * rows + r + 1, 0.0);
}

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

// fill blocks with neighbours, strip by strip
static bool fill_blocks(const DpPlants* plants, PlantStand* stand, const float* root,
                        const float* heading)
{
    const int n = stand->count;
    double    box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int k = 0; k < n; ++k)
        for (int d = 0; d < 2; ++d) {
            box[d] = fmin(box[d], (double)root[3 * k + d]);
            box[2 + d] = fmax(box[2 + d], (double)root[3 * k + d]);
        }
    const double area = fmax((box[2] - box[0]) * (box[3] - box[1]), 1e-12);
    const double high = fmax(sqrt(area * DP_LANES / n), (box[3] - box[1]) * 1e-6);
    Order*       order = dp_alloc((size_t)n, sizeof(Order));
    if (!order) return false;
    for (int k = 0; k < n; ++k)
        order[k] = (Order){(int)(((double)root[3 * k + 1] - box[1]) / high), k, root[3 * k]};
    qsort(order, (size_t)n, sizeof(Order), by_place);
    for (int slot = 0; slot < stand->blocks * DP_LANES; ++slot) {
        PlantBlock*    block = &stand->block[slot / DP_LANES];
        const int      lane = slot % DP_LANES;
        const int      from = slot < n ? slot : slot - lane;  // spare lanes repeat lane 0
        const int      k = order[from].plant;
        const uint64_t name = plant_name(root[3 * k], root[3 * k + 1]);
        const double   facing =
            heading ? (double)heading[k] : 2.0 * PI * plant_hash(plants->seed, name, 0);
        const double z = plant_vigour(plants->seed, name, 1);
        for (int d = 0; d < 3; ++d) {
            block->root[d][lane] = root[3 * k + d];
            if (lane == 0) block->origin[d] = (double)root[3 * k + d];
            block->foot[d][lane] = (float)((double)root[3 * k + d] - block->origin[d]);
        }
        block->turn[0][lane] = (float)cos(facing), block->turn[1][lane] = (float)sin(facing);
        block->reserve[lane] = (double)stand->kind.strength * exp((double)stand->kind.spread * z);
        block->alpha[lane] = 1.0f, block->ceiling[lane] = -INFINITY;
        block->plant[lane] = k;
        float* roots = stand->box + 4 * (slot / DP_LANES);
        for (int d = 0; d < 2; ++d) {
            const float at = root[3 * k + d];
            roots[d] = lane == 0 ? at : fminf(roots[d], at);
            roots[2 + d] = lane == 0 ? at : fmaxf(roots[2 + d], at);
        }
        if (slot >= n) continue;
        ++block->count;
        stand->where[k] = slot;
    }
    dp_free(order);

    // the same roots by cells of at least a reach
    stand->bin = fmax((double)stand->kind.reach, sqrt(area / (4.0 * n + 16.0)));
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
            const int    i = (int)(((double)root[3 * k] - box[0]) / stand->bin);
            const int    j = (int)(((double)root[3 * k + 1] - box[1]) / stand->bin);
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

static void unmake(PlantStand* stand)
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
    for (int s = 0; s < plants->stands; ++s) unmake(&plants->stand[s]);
    dp_free(plants->stand), dp_free(plants->task), dp_free(plants->scratch);
    dp_free(plants->side), dp_free(plants);
}

DpStatus dp_plants_add(DpPlants* plants, const DpPlantKind* kind, const float* root,
                       const float* heading, int count, int* stand_name)
{
    if (!plants || !root || !stand_name || count < 1 || count > INT_MAX / (4 * DP_LANES))
        return DP_BAD_ARGUMENT;
    if (dp_plant_kind_check(kind) != DP_OK) return DP_BAD_ARGUMENT;
    for (int k = 0; k < 3 * count; ++k)
        if (!(fabsf(root[k]) < 1e7f)) return DP_BAD_ARGUMENT;
    for (int k = 0; heading && k < count; ++k)
        if (!(fabsf(heading[k]) < 1e6f)) return DP_BAD_ARGUMENT;

    PlantStand* more = dp_realloc(plants->stand, (size_t)plants->stands + 1, sizeof(PlantStand));
    if (!more) return DP_NO_MEMORY;
    plants->stand = more;
    PlantStand* stand = &more[plants->stands];
    memset(stand, 0, sizeof *stand);
    stand->kind = *kind;
    stand->shape = dp_plant_shape(kind);
    stand->count = count;
    stand->blocks = (count + DP_LANES - 1) / DP_LANES;
    stand->rest = dp_alloc((size_t)stand->shape.particles, 3 * sizeof(float));
    stand->rest_bend = dp_alloc((size_t)stand->shape.bends, 3 * sizeof(float));
    stand->limit = dp_alloc((size_t)stand->shape.bends, 2 * sizeof(double));
    stand->edge = dp_alloc((size_t)stand->shape.particles, 4 * sizeof(PlantEdge));
    stand->block = dp_alloc((size_t)stand->blocks, sizeof(PlantBlock));
    stand->box = dp_alloc((size_t)stand->blocks, 4 * sizeof(float));
    stand->up = dp_alloc((size_t)stand->blocks, 1);
    stand->where = dp_alloc((size_t)count, sizeof(int));
    const bool room = stand->rest && stand->rest_bend && stand->limit && stand->edge &&
                      stand->block && stand->box && stand->up && stand->where;
    if (room) rest_shape(stand), join_edges(stand), plant_limits(stand);
    if (!room || !fill_blocks(plants, stand, root, heading)) {
        unmake(stand);
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
