// tests/bench/bench_soil.c - what one footstep costs: imprint, rings, compress, accumulate,
// stabilize.
//
//   scripts/bench soil   or   build/bench_soil [prints]
//
// A 75 kg walker stands 36 frames at 60 Hz on a sole of 28 x 10 cm that rolls from heel to toe;
// then the foot lifts off and everything comes to rest within 0.1 degrees. Times are per frame of
// the stance with the lift-off in them, best of several prints, each on fresh ground. At the end
// the same sweeps are made by a plain loop with branches, cell by cell.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../native/soil/ground.h"
#include "imprint/imprint.h"
#include "timing.h"

#define FRAMES 36
#define STANDING 16  // sweeps of a frame while the foot stands, as sim/sim_press.c; then to rest
#define TENTH (0.1 * DP_PI / 180.0)

static Ground make(double cell, double degrees)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 0.6e6f;
    soil.rest_angle = (float)(degrees * DP_PI / 180.0);
    return ground_make((int)(1.2 / cell), (int)(0.96 / cell), cell, soil);
}

typedef struct Cost
{
    double imprint, rings, compress, accumulate, stabilize, liftoff;  // [s] a print
    int    sweeps, lift_sweeps;
    double depth, rim, volume;
} Cost;

static double total(Cost c)
{
    return c.imprint + c.rings + c.compress + c.accumulate + c.stabilize + c.liftoff;
}

// rolls about its heel, stands, rolls about its ball
static DpPose pose_at(double u)
{
    double pitch = 0.0, about = 0.0;
    if (u < 0.15) pitch = 0.35 * (0.15 - u) / 0.15, about = -0.14;
    if (u > 0.6) pitch = -0.6 * (u - 0.6) / 0.4, about = 0.06;
    const DpPose pose = {{about - about * cos(pitch), 0.0, -about * sin(pitch)},
                         {cos(0.5 * pitch), 0.0, -sin(0.5 * pitch), 0.0}};
    return pose;
}

static Cost footstep(double cell, double degrees, DpHeapLaw law)
{
    static const float   corner[] = {-.14f, -.05f, 0,    .14f, -.05f, 0,     .14f, .05f,
                                     0,     -.14f, .05f, 0,    -.14f, -.05f, .03f, .14f,
                                     -.05f, .03f,  .14f, .05f, .03f,  -.14f, .05f, .03f};
    static const int32_t side[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                   2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 3, 0, 4, 3, 4, 7};
    const DpMesh         sole = {8, 12, corner, side};
    Ground               w = make(cell, degrees);
    w.patch.soils = w.soil;
    DpImprintScratch*   rasters = dp_imprint_scratch_create();
    DpSoilScratch*      scratch = dp_soil_scratch_create();
    const DpHeapOptions options = {law, 0.04, 0.5 * 75.0 * DP_GRAVITY, {0.0, 0.0, 0.0}};
    const int           rings = law == DP_HEAP_PAPER ? 2 + (int)(0.04 / cell) : 1;
    Cost                cost = {0};
    double              height = 0.0;
    DpCellRect          region = {0};
    for (int f = 0; f < FRAMES; ++f) {
        const double u = (f + 0.5) / FRAMES;
        const DpPose pose = pose_at(u);
        DpFootForce  foot = {{120.0 * sin(2 * DP_PI * (u - 0.5)), 10.0,
                              -75.0 * DP_GRAVITY * fmin(1.1, 7.0 * fmin(u, 1.0 - u))},
                             {0.2 * (u - 0.4), 0.0, 0.0},
                             {0.0, 0.0, 1.0}};
        double       t0 = bench_now();
        dp_imprint_foot(&w.imprint, &w.patch, &sole, &pose, 1, dp_imprint_samples(cell, 1.0),
                        rasters);
        double t1 = bench_now();
        cost.imprint += t1 - t0;
        DpPressed pressed;
        dp_soil_compress(&w.patch, &w.imprint, &foot, DP_CONTACT_SOLE, 1.0 / 60, &pressed);
        t0 = bench_now();
        cost.compress += t0 - t1;
        dp_imprint_rings(&w.imprint, &w.patch, rings);
        t1 = bench_now();
        cost.rings += t1 - t0;
        dp_soil_accumulate(&w.patch, &w.imprint, &foot, pressed.displaced, &options, &height,
                           scratch);
        t0 = bench_now();
        cost.accumulate += t0 - t1;
        // where soil lies: the sole and what a heap of height T reaches
        const int wide =
            2 + (int)((law == DP_HEAP_PAPER ? 0.05 : height / tan(degrees * DP_PI / 180.0)) / cell);
        const DpCellRect under = {w.imprint.i0, w.imprint.i1, w.imprint.j0, w.imprint.j1};
        region = dp_cells_join(region, dp_cells_grown(under, wide));
        t0 = bench_now();
        DpSettled settled;
        dp_soil_stabilize(&w.patch, &w.imprint, &region, TENTH, STANDING, scratch, &settled);
        cost.stabilize += bench_now() - t0;
        cost.sweeps += settled.sweeps;
        region = dp_cells_join(region, settled.changed);
    }
    DpSettled    settled;
    const double t0 = bench_now();
    dp_soil_stabilize(&w.patch, NULL, &region, TENTH, 100000, scratch, &settled);
    cost.liftoff = bench_now() - t0;
    cost.lift_sweeps = settled.sweeps;
    for (int k = 0; k < w.patch.nx * w.patch.ny; ++k) {
        cost.depth = fmax(cost.depth, (double)w.compression[k]);
        cost.rim = fmax(cost.rim, (double)w.heap[k]);
        cost.volume += (double)w.heap[k] * cell * cell;
    }
    dp_soil_scratch_destroy(scratch);
    dp_imprint_scratch_destroy(rasters);
    ground_free(&w);
    return cost;
}

// ---- the same sweep as a plain loop with branches --------------------------------------------

static void plain_sweep(const Ground* w, float* share, float* next)
{
    const int nx = w->patch.nx, ny = w->patch.ny;
    for (int pass = 0; pass < 2; ++pass)
        for (int j = 1; j < ny - 1; ++j)
            for (int i = 1; i < nx - 1; ++i) {
                const int   p = j * nx + i;
                const float at = w->base_height[p] - w->compression[p] + w->heap[p];
                float       sum = 0.0f, in = 0.0f;
                int         lower = 0;
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a) {
                        if (!a && !b) continue;
                        const int   q = p + b * nx + a;
                        const float far = (float)w->patch.cell * (a && b ? 1.41421356f : 1.0f);
                        const float to = w->base_height[q] - w->compression[q] + w->heap[q];
                        const float out = at - to - w->rest_slope[p] * far;
                        if (out > 0.0f) sum += out, ++lower;
                        const float come = to - at - w->rest_slope[q] * far;
                        if (pass == 1 && come > 0.0f) in += share[q] * come;
                    }
                if (pass == 0)
                    share[p] = lower ? fminf(1.0f, w->heap[p] * (float)(lower + 1) / sum) /
                                           (float)(lower + 1)
                                     : 0.0f;
                else
                    next[p] = w->heap[p] - share[p] * sum + in;
            }
    memcpy(w->heap, next, (size_t)(nx * ny) * sizeof(float));
}

static void compare(double degrees)
{
    enum
    {
        SWEEPS = 200
    };
    double best[2] = {1e9, 1e9};
    int    made = 0;
    for (int run = 0; run < 5; ++run)
        for (int m = 0; m < 2; ++m) {
            Ground w = make(0.01, degrees);
            w.patch.soils = w.soil;
            w.patch.nx = w.patch.row = 61, w.patch.ny = 43;
            unsigned seed = 1;
            for (int k = 0; k < 61 * 43; ++k) {
                seed = seed * 1664525u + 1013904223u;
                w.heap[k] =
                    (k % 61 % 60 && k > 61 && k < 61 * 42) ? (float)(seed >> 8) * 5e-9f : 0.0f;
            }
            float*         share = dp_alloc(61 * 43, 4);
            float*         next = dp_alloc(61 * 43, 4);
            DpSoilScratch* scratch = dp_soil_scratch_create();
            DpSettled      settled = {0};
            const double   t0 = bench_now();
            if (m == 0)
                dp_soil_stabilize(&w.patch, NULL, NULL, 1e-6, SWEEPS, scratch, &settled);
            else
                for (int k = 0; k < SWEEPS; ++k) plain_sweep(&w, share, next);
            const double spent = (bench_now() - t0) / (m == 0 ? settled.sweeps : SWEEPS);
            if (m == 0) made = settled.sweeps;
            if (spent < best[m]) best[m] = spent;
            dp_soil_scratch_destroy(scratch);
            dp_free(share), dp_free(next);
            ground_free(&w);
        }
    printf(
        "one sweep of 61 x 43 cells, all loose, %2.0f deg: %5.1f us (of %d), plain loop %5.1f us: "
        "%.1f times\n",
        degrees, best[0] * 1e6, made, best[1] * 1e6, best[1] / best[0]);
}

// the parts of a print that are not too small to tell
static void keep(int law, double cell, double degrees, const Cost* cost)
{
    const struct
    {
        const char* name;
        double      took;
    } part[] = {{"whole", total(*cost)},        {"imprint", cost->imprint},
                {"compress", cost->compress},   {"accumulate", cost->accumulate},
                {"stabilize", cost->stabilize}, {"lift-off", cost->liftoff}};
    for (size_t k = 0; k < sizeof part / sizeof *part; ++k) {
        char what[64];
        snprintf(what, sizeof what, "%s heap %g mm %g deg: %s", law ? "paper" : "rest",
                 1000.0 * cell, degrees, part[k].name);
        if (part[k].took > 0.01 * total(*cost)) bench_keep("soil", what, part[k].took / FRAMES);
    }
}

int main(int argc, char** argv)
{
    const int    prints = bench_count(argc, argv, 12);
    const double angles[] = {32.0, 15.0, 8.0};
    printf("us a frame (36 frames and the lift-off, best of %d prints)\n", prints);
    printf(
        "heap  cell deg |  total imprint rings compress accumulate stabilize liftoff | sweeps lift "
        "| depth rim mm, heap l\n");
    for (int law = 0; law < 2; ++law)
        for (int c = 0; c < 2; ++c)
            for (int a = 0; a < 3; ++a) {
                const double cell = c ? 0.005 : 0.01;
                if (law == DP_HEAP_PAPER && c) continue;
                Cost best = footstep(cell, angles[a], (DpHeapLaw)law);
                for (int k = 1; k < (c ? (prints + 2) / 3 : prints); ++k) {
                    const Cost cost = footstep(cell, angles[a], (DpHeapLaw)law);
                    if (total(cost) < total(best)) best = cost;
                }
                const double f = 1e6 / FRAMES;
                printf(
                    "%-5s %4.0f %3.0f | %6.1f %7.1f %5.1f %8.1f %10.1f %9.1f %7.1f | %6d %4d | "
                    "%4.1f %4.1f %6.3f\n",
                    law ? "paper" : "rest", cell * 1000, angles[a], total(best) * f,
                    best.imprint * f, best.rings * f, best.compress * f, best.accumulate * f,
                    best.stabilize * f, best.liftoff * f, best.sweeps, best.lift_sweeps,
                    best.depth * 1000, best.rim * 1000, best.volume * 1000);
                keep(law, cell, angles[a], &best);
            }
    compare(32.0);
    compare(8.0);
    return 0;
}
