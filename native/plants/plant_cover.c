// plants/plant_cover.c - how much of the ground is held by roots. TRAIL (7), TRAIL (8), MODEL 7.4
//
// Departures
//   TRAIL (7): as printed, the mean of (1 - d/w) alpha cannot reach 1 and does not know density.
//   Here the kernels' sum is set against the sum under full cover, K_ref = density * pi R^2 / 3, or
//   against itself where plants stand denser. DP_COVER_PAPER is as printed.
#include "base/wide.h"

#include <string.h>

#include "plants/plant_inside.h"

#define RUNNERS 4.0  // seeds and runners come from so many times as far as roots reach
#define CHUNK 64     // cells of a row summed at once

// sums over the plants around a point
typedef struct Sums
{
    double full;    // sum of K / K_ref
    double intact;  // the same times alpha
    double root;    // the same times alpha E_v0
    double paper, paper_root;
    int    plants;
} Sums;

// the bins that circles about x0..x1, y meet: false if none
static bool bins_around(const PlantStand* stand, double x0, double x1, double y, double radius,
                        int range[4])
{
    const double i0 = floor((x0 - radius - stand->bx0) / stand->bin);
    const double i1 = floor((x1 + radius - stand->bx0) / stand->bin);
    const double j0 = floor((y - radius - stand->by0) / stand->bin);
    const double j1 = floor((y + radius - stand->by0) / stand->bin);
    if (i1 < 0.0 || j1 < 0.0 || i0 >= stand->bnx || j0 >= stand->bny) return false;
    range[0] = i0 > 0.0 ? (int)i0 : 0, range[1] = i1 < stand->bnx - 1 ? (int)i1 : stand->bnx - 1;
    range[2] = j0 > 0.0 ? (int)j0 : 0, range[3] = j1 < stand->bny - 1 ? (int)j1 : stand->bny - 1;
    return true;
}

// wide: kernels go so many times as far
static void add_plants(Sums* sums, const PlantStand* stand, double x, double y, double wide)
{
    const double radius = wide * (double)stand->kind.root_radius,
                 modulus = (double)stand->kind.modulus;
    const double full = (double)stand->kind.full_density * DP_PI * radius * radius / 3.0;  // K_ref
    int          range[4];
    if (!bins_around(stand, x, x, y, radius, range)) return;
    for (int j = range[2]; j <= range[3]; ++j)
        for (int i = range[0]; i <= range[1]; ++i) {
            const int* start = stand->bin_start + (size_t)j * (size_t)stand->bnx + (size_t)i;
            for (int k = start[0]; k < start[1]; ++k) {
                const int         slot = stand->bin_item[k], lane = slot % DP_LANES;
                const PlantBlock* block = &stand->block[slot / DP_LANES];
                const double      dx = (double)block->root[0][lane] - x;
                const double      dy = (double)block->root[1][lane] - y;
                const double      d2 = dx * dx + dy * dy, alpha = (double)block->alpha[lane];
                if (d2 >= radius * radius) continue;
                const double kernel = 1.0 - sqrt(d2) / radius;  // K = 1 - d/R
                sums->full += kernel / full;
                sums->intact += kernel * alpha / full;
                sums->root += kernel * alpha * modulus / full;
                sums->paper += kernel * alpha;
                sums->paper_root += kernel * alpha * modulus;
                ++sums->plants;
            }
        }
}

static Sums sums_at(const DpPlants* plants, double x, double y, double wide)
{
    Sums sums = {0};
    for (int s = 0; s < plants->stands; ++s) add_plants(&sums, &plants->stand[s], x, y, wide);
    return sums;
}

float dp_plant_cover_around(const DpPlants* plants, float x, float y)
{
    const Sums sums = sums_at(plants, (double)x, (double)y, RUNNERS);
    return (float)(sums.intact / fmax(sums.full, 1.0));
}

static bool window_ok(const DpPlantWindow* w)
{
    return w && w->nx > 0 && w->ny > 0 && w->row >= w->nx && w->cell > 0.0 && w->cell < 1e6 &&
           fabs(w->x0) < 1e9 && fabs(w->y0) < 1e9;
}

// the same over a row of cells, stand by stand; a cell's sums do not know the row's other cells
typedef struct Row
{
    double full[CHUNK], intact[CHUNK], root[CHUNK];
} Row;

// one plant adds to cells a <= i < b, whose centres lie at first + i * cell from it
DP_CLONES
static void add_plant(Row* row, int a, int b, double first, double cell, double dy2, double radius,
                      double weight, double alpha, double modulus)
{
    const double inverse = 1.0 / radius, intact = weight * alpha, root = intact * modulus;
    for (int i = a; i < b; ++i) {
        const double dx = first + i * cell;
        const double kernel = 1.0 - sqrt(dx * dx + dy2) * inverse;  // K = 1 - d/R
        const double k = kernel > 0.0 ? kernel : 0.0;
        row->full[i] += k * weight;
        row->intact[i] += k * intact;
        row->root[i] += k * root;
    }
}

static void add_stand(Row* row, const PlantStand* stand, double x0, double y, double cell, int n)
{
    const double radius = (double)stand->kind.root_radius, modulus = (double)stand->kind.modulus;
    const double weight =
        3.0 / ((double)stand->kind.full_density * DP_PI * radius * radius);  // 1/K_ref
    int range[4];
    if (!bins_around(stand, x0, x0 + (n - 1) * cell, y, radius, range)) return;
    for (int j = range[2]; j <= range[3]; ++j) {
        const int* start = stand->bin_start + (size_t)j * (size_t)stand->bnx;
        for (int k = start[range[0]]; k < start[range[1] + 1]; ++k) {
            const int         slot = stand->bin_item[k], lane = slot % DP_LANES;
            const PlantBlock* block = &stand->block[slot / DP_LANES];
            const double      first = x0 - (double)block->root[0][lane];
            const double      dy = y - (double)block->root[1][lane], dy2 = dy * dy;
            if (dy2 >= radius * radius) continue;
            const double wide = sqrt(radius * radius - dy2);
            const double a = (-wide - first) / cell, b = (wide - first) / cell + 1.0;
            const int    from = a > 0.0 ? (a < n ? (int)a : n) : 0;
            const int    to = b < n ? (b > 0.0 ? (int)b : 0) : n;
            add_plant(row, from, to, first, cell, dy2, radius, weight, (double)block->alpha[lane],
                      modulus);
        }
    }
}

static void cover_printed(const DpPlants* plants, const DpPlantWindow* window, float* strength,
                          float* modulus)
{
    for (int j = 0; j < window->ny; ++j)
        for (int i = 0; i < window->nx; ++i) {
            const size_t at = (size_t)j * (size_t)window->row + (size_t)i;
            const Sums   sums =
                sums_at(plants, window->x0 + i * window->cell, window->y0 + j * window->cell, 1.0);
            const double share = sums.plants ? 1.0 / sums.plants : 0.0;
            if (strength) strength[at] = (float)fmin(share * sums.paper, 1.0);  // TRAIL (7)
            if (modulus) modulus[at] = (float)(share * sums.paper_root);        // TRAIL (8)
        }
}

DpStatus dp_plants_cover(const DpPlants* plants, const DpPlantWindow* window, DpCoverLaw law,
                         float* strength, float* modulus)
{
    if (!plants || !window_ok(window) || (law != DP_COVER_FULL && law != DP_COVER_PAPER))
        return DP_BAD_ARGUMENT;
    if (law == DP_COVER_PAPER) {
        cover_printed(plants, window, strength, modulus);
        return DP_OK;
    }
    for (int j = 0; j < window->ny; ++j)
        for (int i0 = 0; i0 < window->nx; i0 += CHUNK) {
            const int n = window->nx - i0 < CHUNK ? window->nx - i0 : CHUNK;
            Row       row = {0};
            for (int s = 0; s < plants->stands; ++s)
                add_stand(&row, &plants->stand[s], window->x0 + i0 * window->cell,
                          window->y0 + j * window->cell, window->cell, n);
            for (int i = 0; i < n; ++i) {
                const size_t at = (size_t)j * (size_t)window->row + (size_t)(i0 + i);
                const double share = 1.0 / fmax(row.full[i], 1.0);
                if (strength) strength[at] = (float)fmin(share * row.intact[i], 1.0);  // TRAIL (7)
                if (modulus) modulus[at] = (float)(share * row.root[i]);               // TRAIL (8)
            }
        }
    return DP_OK;
}

// what wears a stem keeps it down until its strength is back
static double heal_rate(const DpPlantKind* kind)
{
    const double swing = dp_plant_rise_rate(kind),
                 back = (double)kind->recover_rate / (double)kind->strength;
    return kind->degrade_rate > 0.0f ? fmin(swing, back) : swing;
}

void dp_plants_stature(const DpPlants* plants, const DpPlantWindow* window,
                       const DpPlantStature* out)
{
    for (int j = 0; j < window->ny; ++j)
        for (int i0 = 0; i0 < window->nx; i0 += CHUNK) {
            const int n = window->nx - i0 < CHUNK ? window->nx - i0 : CHUNK;
            double    full[CHUNK] = {0}, intact[CHUNK] = {0}, high[CHUNK] = {0}, rise[CHUNK] = {0};
            double    heal[CHUNK] = {0}, limp[CHUNK] = {0};
            for (int s = 0; s < plants->stands; ++s) {
                const DpPlantKind* kind = &plants->stand[s].kind;
                const double       swings = dp_plant_rise_rate(kind), heals = heal_rate(kind);
                const double bears = 1.0 - cos(fmin((double)kind->degrade_angle, 0.5 * DP_PI));
                Row          row = {0};
                add_stand(&row, &plants->stand[s], window->x0 + i0 * window->cell,
                          window->y0 + j * window->cell, window->cell, n);
                for (int i = 0; i < n; ++i) {
                    full[i] += row.full[i], intact[i] += row.intact[i];
                    high[i] += row.full[i] * (double)kind->height;
                    rise[i] += row.full[i] * swings, heal[i] += row.full[i] * heals;
                    limp[i] += row.full[i] * bears;
                }
            }
            for (int i = 0; i < n; ++i) {
                const size_t at = (size_t)j * (size_t)window->row + (size_t)(i0 + i);
                const double share = full[i] > 0.0 ? 1.0 / full[i] : 0.0;
                out->broken[at] = (float)(share * (full[i] - intact[i]));
                if (!out->height) continue;
                out->height[at] = (float)(share * high[i]),
                out->rate[at] = (float)(share * rise[i]);
                out->heal[at] = (float)(share * heal[i]), out->limp[at] = (float)(share * limp[i]);
            }
        }
}
