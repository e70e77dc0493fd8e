// bench_carve.c - a step of a body of 10,000 triangles that carves, against one pass over its triangles and footprint.
//
//   scripts/bench carve
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "desire_path.h"
#include "timing.h"

#define AROUND 100  // corners along a parallel
#define RINGS 50
#define CORNERS (AROUND * RINGS)
#define RADIUS 0.3
#define STEPS 120

static float   corner[3 * CORNERS];
static int32_t triangle[3 * 2 * AROUND * (RINGS - 1)];

// a ball, open at its poles
static DpMesh ball(void)
{
    int32_t* at = triangle;
    for (int r = 0; r < RINGS; ++r)
        for (int k = 0; k < AROUND; ++k) {
            const double down = DP_PI * (r + 0.5) / RINGS, around = 2.0 * DP_PI * k / AROUND;
            float* const to = corner + 3 * (r * AROUND + k);
            to[0] = (float)(RADIUS * sin(down) * cos(around));
            to[1] = (float)(RADIUS * sin(down) * sin(around));
            to[2] = (float)(-RADIUS * cos(down));
            if (r == RINGS - 1) continue;
            const int32_t a = r * AROUND + k, b = r * AROUND + (k + 1) % AROUND;
            *at++ = a, *at++ = b, *at++ = b + AROUND;
            *at++ = a, *at++ = b + AROUND, *at++ = a + AROUND;
        }
    return (DpMesh){CORNERS, 2 * AROUND * (RINGS - 1), corner, triangle};
}

static DpPose pose_at(int step, double speed)
{
    const double along = speed * step / STEPS, down = 0.05 + 0.05 * step / STEPS;
    return (DpPose){{along, 0.0, RADIUS - down}, {1.0, 0.0, 0.0, 0.0}};
}

// one pass [s]
static double pass(const DpMesh* mesh)
{
    enum
    {
        SIDE = 62
    };
    static float      bottom[SIDE * SIDE], cover[SIDE * SIDE];
    DpImprint         imprint = {.bottom = bottom, .cover = cover};
    const DpSoilPatch patch = {
        .nx = SIDE, .ny = SIDE, .row = SIDE, .cell = 0.01, .x0 = -0.305, .y0 = -0.305};
    DpImprintScratch* scratch = dp_imprint_scratch_create();
    double            best = INFINITY;
    for (int n = 0; n < 50; ++n) {
        const DpPose pose = pose_at(n, 0.0);
        const double begun = bench_now();
        dp_imprint_foot(&imprint, &patch, mesh, &pose, 1, dp_imprint_samples(0.01, 1.0), scratch);
        best = fmin(best, bench_now() - begun);
    }
    dp_imprint_scratch_destroy(scratch);
    return best;
}

static DpTerrain* sand(void)
{
    static DpSoil soil;
    soil = dp_soil_default();
    const DpTerrainOptions options = {
        .grid = {0.01, 0.0, 0.0}, .soils = &soil, .soil_count = 1, .workers = 1};
    const DpGround ground = {.kind = DP_GROUND_FLAT};
    DpTerrain*     terrain = NULL;
    if (dp_terrain_create(&terrain, &options, &ground) != DP_OK) return NULL;
    return terrain;
}

// a step of the simulation while the ball goes down 5 cm, and along at some speed [s]
static double step(const DpMesh* mesh, double speed)
{
    static double  time[STEPS + 1], pose[STEPS + 1][7], none[STEPS + 1][3];
    static uint8_t touching[STEPS + 1];
    const double   mass = 1.0;
    const int32_t  first = 0;
    const uint8_t  law = DP_CONTACT_CARVE;
    for (int k = 0; k <= STEPS; ++k) {
        const DpPose p = pose_at(k, speed);
        time[k] = k / 120.0, touching[k] = 1;
        pose[k][0] = p.at.x, pose[k][1] = p.at.y, pose[k][2] = p.at.z, pose[k][3] = 1.0;
    }
    const DpGait       gait = {.times = STEPS + 1,
                               .walkers = 1,
                               .limbs = 1,
                               .parts = 1,
                               .time = time,
                               .mass = &mass,
                               .pose = pose[0],
                               .limb_walker = &first,
                               .part_limb = &first,
                               .sole = mesh,
                               .contact_law = &law};
    DpTerrain*         terrain = sand();
    DpSim*             sim = NULL;
    double             best = INFINITY;
    const DpSimOptions options = dp_sim_options_default();
    if (terrain && dp_sim_create(&sim, terrain, &options) == DP_OK &&
        dp_sim_load(sim, &gait, touching, none[0], none[0]) == DP_OK)
        for (int k = 10; k < STEPS; k += 10) {
            dp_sim_run(sim, k);
            const double begun = bench_now();
            dp_sim_run(sim, k + 10);
            best = fmin(best, (bench_now() - begun) / 10.0);
        }
    dp_sim_destroy(sim);
    dp_terrain_destroy(terrain);
    return best;
}

int main(void)
{
    const DpMesh mesh = ball();
    const double once = pass(&mesh);
    printf("%d triangles, cells of 1 cm: one pass %.2f ms\n", mesh.triangle_count, 1e3 * once);
    static const struct
    {
        const char* what;
        double      speed;
    } runs[] = {{"down", 0.0}, {"along at 0.5 m/s", 0.5}, {"along at 3 m/s", 3.0}};
    for (int n = 0; n < 3; ++n) {
        const double took = step(&mesh, runs[n].speed);
        printf("%-18s %.2f ms a step, %.1f passes\n", runs[n].what, 1e3 * took, took / once);
        bench_keep("carve", runs[n].what, took);
    }
    return 0;
}
