// soil/soil_heap_paper.c - a rim of fixed width around the sole, TRAIL (12), SOFT22 (13); or a bulge, MODEL 6.3.
//
// Departures
//   TRAIL (12) fills ring 1 only, a rim that gets thinner with the cell. Here the rim is `width` metres
//     wide. As in ring 1 all of it is filled alike, but over its outer fifth what cells get falls to zero,
//     so that a rim of one cell is nearly as high as one of many. test_soil_accumulate.c, paper_falls_off.
//   Cells that the sole covers in part take no soil. A rim from its true edge on would lose its inner
//     side to them and grow high, one from their outer side on would be long and low: it begins midway.
//     test_oracles.py, test_a_paper_rim_does_not_depend_on_the_cell.
//   SOFT22 (14) lets the rim grow at a rate of its own; here what is displaced in a step is laid
//     down in that step, so no soil is in the air.
#include "base/noise.h"
#include "soil/soil_heaps.h"

#define STEPS 65536       // of one cell: distances are whole numbers, alike from any side
#define DIAGONAL 92682    // sqrt(2) cells
#define FAR (1 << 30)     // farther than any rim reaches
#define FALLS 0.2         // outer share of the width over which the rim falls to zero
#define MAX_WIDE 16000    // cells that a rim can be wide
#define BULGE_WIDTHS 4.0  // widths of a bulge, beyond which it is level
#define TABLE 64          // heights of a bulge that are known

// The part of the patch a rim can reach, with a frame of one far cell; distances from where it begins.
typedef struct RimWindow
{
    int      i0, j0, nx, ny;
    size_t   row;
    int32_t* far;     // of a cell's centre [steps] (ny + 2, row)
    double*  weight;  // what a cell asks for (ny, nx)
} RimWindow;

static int32_t* far_at(const RimWindow* window, int i, int j)
{
    return window->far + (size_t)(j - window->j0 + 1) * window->row + (size_t)(i - window->i0 + 1);
}

static double* weight_at(const RimWindow* window, int i, int j)
{
    return window->weight + (size_t)(j - window->j0) * (size_t)window->nx +
           (size_t)(i - window->i0);
}

static void nearer(int32_t* far, int32_t other, int32_t step)
{
    if (other + step < *far) *far = other + step;
}

// from the cells under the sole outward: two passes with straight and slanting steps
static void measure(const RimWindow* window, const DpImprint* imprint, const DpSoilPatch* patch,
                    bool true_edge)
{
    const size_t row = window->row, cells = row * (size_t)(window->ny + 2);
    for (size_t k = 0; k < cells; ++k) window->far[k] = FAR;
    for (int j = window->j0; j < window->j0 + window->ny; ++j)
        for (int i = window->i0; i < window->i0 + window->nx; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (imprint->ring[p] != 0) continue;
            const double cover = (double)imprint->cover[p];
            *far_at(window, i, j) =
                (int32_t)lround((true_edge ? 0.5 - cover : -0.5 * cover) * STEPS);
        }
    for (int pass = 0; pass < 2; ++pass)
        for (int n = 0; n < window->ny; ++n) {
            const int j = window->j0 + (pass ? window->ny - 1 - n : n);
            int32_t*  far = far_at(window, window->i0, j);
            int32_t*  past = pass ? far + row : far - row;
            for (int i = 0; i < window->nx; ++i) {
                nearer(&far[i], past[i], STEPS);
                nearer(&far[i], past[i - 1], DIAGONAL);
                nearer(&far[i], past[i + 1], DIAGONAL);
            }
            for (int i = 1; i < window->nx; ++i) nearer(&far[i], far[i - 1], STEPS);
            for (int i = window->nx - 2; i >= 0; --i) nearer(&far[i], far[i + 1], STEPS);
        }
}

// area under the profile of a rim of width 1 from its inner side to x
static double profile_to(double x)
{
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0 - 0.5 * FALLS;
    const double over = soil_max(x - (1.0 - FALLS), 0.0);
    return x - over * over / (2.0 * FALLS);
}

// how full a cell is: the profile over its side; 1 at the sole, 0 beyond the rim
static double falloff(int32_t far, double wide)
{
    const double at = (double)far / STEPS;
    return wide * (profile_to((at + 0.5) / wide) - profile_to((at - 0.5) / wide));
}

// How a rim falls off outward.
typedef struct Rim
{
    double wide;  // [cells]
    bool   bulges;
    double bulge[TABLE + 2];  // height at k/TABLE of its reach; all of it is BULGE_WIDTHS wide
} Rim;

// x^(1/5) for x >= 0, by own arithmetic
static double fifth_root(double x)
{
    if (!(x > 0.0)) return 0.0;
    double root = x > 1.0 ? x : 1.0;
    for (double last = INFINITY; root < last;) {  // Newton's, from above
        last = root;
        root -= (root - x / (root * root * root * root)) / 5.0;
    }
    return root;
}

// exp(-(e/w)^1.4), less what it is where it ends
static void make_bulge(Rim* rim)
{
    const double end = dp_noise_growth(-BULGE_WIDTHS * fifth_root(BULGE_WIDTHS * BULGE_WIDTHS));
    for (int k = 0; k <= TABLE + 1; ++k) {
        const double x = BULGE_WIDTHS * k / TABLE;
        rim->bulge[k] = soil_max(dp_noise_growth(-x * fifth_root(x * x)) - end, 0.0);
    }
}

static double height_of(const Rim* rim, int32_t far)
{
    if (!rim->bulges) return falloff(far, rim->wide);
    const double at = soil_max((double)far / STEPS, 0.0) / rim->wide * TABLE / BULGE_WIDTHS;
    if (!(at < TABLE)) return 0.0;
    const int k = (int)at;
    return rim->bulge[k] + (at - k) * (rim->bulge[k + 1] - rim->bulge[k]);  // MODEL 6.3
}

static bool open_window(RimWindow* window, const DpSoilPatch* patch, const DpImprint* imprint,
                        double wide, DpSoilScratch* scratch)
{
    const int more = 2 + (int)ceil(wide);
    const int i0 = imprint->i0 > more ? imprint->i0 - more : 0;
    const int j0 = imprint->j0 > more ? imprint->j0 - more : 0;
    const int i1 = patch->nx - imprint->i1 > more ? imprint->i1 + more : patch->nx;
    const int j1 = patch->ny - imprint->j1 > more ? imprint->j1 + more : patch->ny;
    *window = (RimWindow){i0, j0, i1 - i0, j1 - j0, (size_t)(i1 - i0) + 2, NULL, NULL};
    const size_t cells = window->row * ((size_t)window->ny + 2);
    const size_t weights = (size_t)window->nx * (size_t)window->ny * sizeof *window->weight;
    char*        block = dp_soil_scratch_block(scratch, weights + cells * sizeof *window->far);
    if (!block) return false;
    window->weight = (double*)(void*)block;
    window->far = (int32_t*)(void*)(block + weights);
    return true;
}

// lay the volume by shares and by how the rim falls off; none on cells pressed to `hollow` [m]
static DpStatus lay(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                    double volume, const Rim* rim, float hollow, DpSoilScratch* scratch)
{
    const double coarse = ldexp(1.5, 52 - 30), area = patch->cell * patch->cell;
    const double wide = soil_min(rim->bulges ? BULGE_WIDTHS * rim->wide : rim->wide, MAX_WIDE);
    RimWindow    window;
    if (!open_window(&window, patch, imprint, wide, scratch)) return DP_NO_MEMORY;
    measure(&window, imprint, patch, rim->bulges);

    const double  beyond = rim->bulges ? (double)FAR : ceil((rim->wide + 0.5) * STEPS);
    const int32_t end = beyond < (double)FAR ? (int32_t)beyond : FAR;  // as far out a rim is level
    double        total = 0.0;
    for (int j = window.j0; j < window.j0 + window.ny; ++j)
        for (int i = window.i0; i < window.i0 + window.nx; ++i) {
            const size_t p = soil_at(patch, i, j);
            double*      weight = weight_at(&window, i, j);
            *weight = 0.0;
            const int32_t far = *far_at(&window, i, j);
            if (far >= end || imprint->ring[p] <= 0 || !soil_is_ground(patch->base_height[p]))
                continue;
            const double full = height_of(rim, far);
            if (!(full > 0.0) || !(patch->compression[p] < hollow)) continue;
            *weight = soil_on_grid(dp_soil_heap_share(shares, patch, i, j) * full, coarse);
            total += *weight;
        }
    if (!(total > 0.0)) return DP_NO_GROUND;
    for (int j = window.j0; j < window.j0 + window.ny; ++j)  // normalised as a whole
        for (int i = window.i0; i < window.i0 + window.nx; ++i) {
            const double weight = *weight_at(&window, i, j);
            if (weight > 0.0)
                patch->heap[soil_at(patch, i, j)] +=
                    (float)(weight / total * volume / area);  // TRAIL (12)
        }
    return DP_OK;
}

DpStatus dp_soil_heap_paper(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                            double volume, double width, DpSoilScratch* scratch)
{
    if (!(width > 0.0)) return DP_BAD_ARGUMENT;
    const Rim rim = {.wide = soil_min(soil_max(width / patch->cell, 1.0), MAX_WIDE)};
    return lay(patch, imprint, shares, volume, &rim, INFINITY, scratch);
}

DpStatus dp_soil_heap_bulge(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                            double volume, double width, DpSoilScratch* scratch)
{
    Rim rim = {.wide = soil_max(width / patch->cell, 0.5), .bulges = true};
    make_bulge(&rim);
    const float    hollow = dp_soil_hollow(patch, imprint);
    const DpStatus status = lay(patch, imprint, shares, volume, &rim, hollow, scratch);
    if (status != DP_NO_GROUND) return status;
    return lay(patch, imprint, shares, volume, &rim, INFINITY, scratch);
}
