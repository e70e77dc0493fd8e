// tests/bench/bench_plants.c - what grass costs: a lawn awake, the same in a plain loop, a meadow.
//
//   scripts/bench plants   or   build/bench_plants [frames]
//
// 200 plants of 28 particles, all awake, swaying, with a boot among them; the same projections,
// plant by plant and constraint by constraint, in a plain loop; 100,000 plants with one walker.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "plants/plants.h"
#include "timing.h"

#define SIDE 31
#define ROWS 7
#define STEMS 4
#define P (ROWS * STEMS)
#define PLANTS 200
#define SUBSTEPS 8

// a boot of 30 x 10 cm over its window
static float boot[SIDE * SIDE];

static DpPlantCollider boot_at(double x, double y, double z, double speed)
{
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i)
            boot[j * SIDE + i] = abs(j - SIDE / 2) <= 5 ? 0.0f : INFINITY;
    for (int k = 0; k < SIDE * SIDE; ++k)
        if (isfinite(boot[k])) boot[k] = (float)z;
    DpPlantCollider c = {.nx = SIDE, .ny = SIDE, .row = SIDE, .cell = 0.01, .bottom = boot};
    c.x0 = x - 0.15, c.y0 = y - 0.15, c.thickness = 0.1, c.friction = 0.5;
    c.velocity = dp_vec3(speed, 0.0, 0.0);
    return c;
}

static DpPlants* stand(int wanted, double density, double side, int* count)
{
    float* flat = dp_alloc((size_t)wanted, 2 * sizeof(float));
    float* root = dp_alloc((size_t)wanted, 3 * sizeof(float));
    int    name = 0;
    dp_plants_place(0, 0, side, side, density, NULL, 0, 0, 7, flat, wanted, count);
    for (int k = 0; k < *count; ++k) root[3 * k] = flat[2 * k], root[3 * k + 1] = flat[2 * k + 1];
    DpPlants*         plants = dp_plants_create(1);
    const DpPlantKind kind = dp_plant_kind_default();
    dp_plants_add(plants, &kind, root, NULL, *count, &name);
    dp_free(flat), dp_free(root);
    return plants;
}

static int by_size(const void* a, const void* b)
{
    const double x = *(const double*)a, y = *(const double*)b;
    return x < y ? -1 : x > y;
}

static double median(double* t, int n)
{
    qsort(t, (size_t)n, sizeof *t, by_size);
    return t[n / 2];
}

static void give_speeds(DpPlants* plants, int count)
{
    float    velocity[3 * P];
    unsigned seed = 5;
    for (int k = 0; k < count; ++k) {
        for (int c = 0; c < 3 * P; ++c) {
            seed = seed * 1664525u + 1013904223u;
            velocity[c] = c / 3 % ROWS < 2 ? 0.0f : (float)(seed >> 8) / 16777216.0f - 0.5f;
        }
        dp_plants_write(plants, 0, k, NULL, velocity, NULL);
    }
}

static void lawn(int frames, int with_boot, const char* name)
{
    int       count = 0, awake = 0;
    DpPlants* plants = stand(PLANTS, 80.0, 1.5812, &count);
    double*   t = dp_alloc((size_t)frames, sizeof(double));
    for (int f = 0; f < frames; ++f) {
        if (f % 10 == 0) give_speeds(plants, count);
        const DpPlantCollider c = boot_at(0.4 + 0.01 * (f % 60), 0.8, 0.01, 0.6);
        DpPlantsReport        told;
        const double          start = bench_now();
        dp_plants_step(plants, NULL, &c, with_boot, 1.0 / 60.0, 1, &told);
        t[f] = bench_now() - start;
        awake = told.awake;
    }
    const double best = (qsort(t, (size_t)frames, sizeof *t, by_size), t[0]);
    printf("%-34s %7.0f us a frame (best %.0f), %d awake\n", name, 1e6 * median(t, frames),
           1e6 * best, awake);
    bench_keep("plants", name, best);
    dp_free(t);
    dp_plants_destroy(plants);
}

// ---- the same in a plain loop: an array of plants, an array of constraints ---------------------

typedef struct Stick
{
    int   a, b;
    float wa, wb, rest, soft;
} Stick;

typedef struct Plain
{
    float at[P][3], was[P][3], speed[P][3];
} Plain;

static int sticks(Stick* s)
{
    int n = 0;
    for (int pass = 0; pass < 3; ++pass)
        for (int c = 0; c < STEMS; ++c)
            for (int r = 0; r < ROWS; ++r) {
                const int here = c * ROWS + r;
                int       to[2] = {-1, -1};
                if (pass == 0 && c + 1 < STEMS) to[0] = here + ROWS;
                if (pass == 1 && c + 1 < STEMS && r + 1 < ROWS) to[0] = here + ROWS + 1;
                if (pass == 1 && c + 1 < STEMS && r > 0) to[1] = here + ROWS - 1;
                if (pass == 2 && r + 1 < ROWS) to[0] = here + 1;
                for (int k = 0; k < 2; ++k) {
                    const float wa = r < 2 ? 0.0f : 1.0f, wb = to[k] % ROWS < 2 ? 0.0f : 1.0f;
                    if (to[k] < 0 || !(wa + wb > 0.0f)) continue;
                    const float rest = pass == 0 ? 0.0167f : pass == 1 ? 0.026f : 0.02f;
                    s[n++] = (Stick){here,           to[k], wa / (wa + wb),
                                     wb / (wa + wb), rest,  pass == 2 ? 1.0f : 0.2f};
                }
            }
    return n;
}

static void plain_substep(Plain* p, const Stick* stick, int n, float h)
{
    for (int k = 0; k < P; ++k)
        for (int d = 0; d < 3; ++d) {
            p->was[k][d] = p->at[k][d];
            if (k % ROWS < 2) continue;
            p->speed[k][d] *= 0.9877f;
            p->at[k][d] += h * p->speed[k][d];
        }
    for (int c = 0; c < STEMS; ++c)
        for (int r = 0; r + 2 < ROWS; ++r)
            for (int d = 0; d < 3; ++d) {
                const int   k = c * ROWS + r;
                const float off = 0.05f * (p->at[k][d] - 2.0f * p->at[k + 1][d] + p->at[k + 2][d]);
                if (r > 1) p->at[k][d] -= off;
                if (r > 0) p->at[k + 1][d] += 2.0f * off;
                p->at[k + 2][d] -= off;
            }
    for (int e = 0; e < n; ++e) {
        const Stick* s = &stick[e];
        float        to[3], d2 = 0.0f;
        for (int d = 0; d < 3; ++d) to[d] = p->at[s->b][d] - p->at[s->a][d], d2 += to[d] * to[d];
        const float length = sqrtf(d2);
        if (!(length > 1e-9f)) continue;
        float share = s->soft * (length - s->rest) / length;
        if (length > 1.04f * s->rest) share = fmaxf(share, (length - 1.04f * s->rest) / length);
        for (int d = 0; d < 3; ++d) {
            p->at[s->a][d] += s->wa * share * to[d];
            p->at[s->b][d] -= s->wb * share * to[d];
        }
    }
    for (int k = 0; k < P; ++k) {
        if (k % ROWS < 2) continue;
        if (p->at[k][2] < 0.0f) p->at[k][2] = 0.0f;
        for (int d = 0; d < 3; ++d) p->speed[k][d] = (p->at[k][d] - p->was[k][d]) / h;
    }
}

static void plain(int frames)
{
    Stick     stick[128];
    const int n = sticks(stick);
    Plain*    p = dp_alloc(PLANTS, sizeof(Plain));
    double*   t = dp_alloc((size_t)frames, sizeof(double));
    unsigned  seed = 5;
    float     sum = 0.0f;
    for (int f = 0; f < frames; ++f) {
        for (int k = 0; k < PLANTS && f % 10 == 0; ++k)
            for (int c = 0; c < P; ++c)
                for (int d = 0; d < 3; ++d) {
                    if (f == 0)
                        p[k].at[c][d] = d == 0   ? 0.0167f * (float)(c / ROWS)
                                        : d == 2 ? 0.02f * (float)(c % ROWS - 1)
                                                 : 0.0f;
                    seed = seed * 1664525u + 1013904223u;
                    p[k].speed[c][d] =
                        c % ROWS < 2 ? 0.0f : (float)(seed >> 8) / 16777216.0f - 0.5f;
                }
        const double start = bench_now();
        for (int k = 0; k < PLANTS; ++k)
            for (int s = 0; s < SUBSTEPS; ++s) plain_substep(&p[k], stick, n, 1.0f / 480.0f);
        t[f] = bench_now() - start;
    }
    for (int k = 0; k < PLANTS; ++k) sum += p[k].at[P - 1][2];
    const double best = (qsort(t, (size_t)frames, sizeof *t, by_size), t[0]);
    printf("%-34s %7.0f us a frame (best %.0f), %d edges [%.2f]\n", "the same, plain loop",
           1e6 * median(t, frames), 1e6 * best, n, (double)sum);
    dp_free(t), dp_free(p);
}

static void meadow(int frames)
{
    int          count = 0, most = 0;
    const double start = bench_now();
    DpPlants*    plants = stand(100000, 80.0, 35.4, &count);
    printf("%d plants placed and planted in %.0f ms, %.0f MB\n", count, 1e3 * (bench_now() - start),
           (double)dp_bytes_live() / 1048576.0);
    double* t = dp_alloc((size_t)frames, sizeof(double));
    for (int f = 0; f < frames; ++f) {
        // a walker of 1.4 m/s: a foot stands 0.3 s of every half second
        const double s = (double)f / 60.0, stride = floor(s / 0.5),
                     phase = (s - 0.5 * stride) / 0.5;
        const double    x = 5.0 + 0.7 * stride;
        DpPlantCollider c = phase < 0.6 ? boot_at(x, 15.0, 0.0, 0.0)
                                        : boot_at(x + 0.7 * (phase - 0.6) / 0.4, 15.1, 0.06, 3.5);
        DpPlantsReport  told;
        const double    begin = bench_now();
        dp_plants_step(plants, NULL, &c, 1, 1.0 / 60.0, 1, &told);
        t[f] = bench_now() - begin;
        most = told.awake > most ? told.awake : most;
    }
    const double worst = (qsort(t, (size_t)frames, sizeof *t, by_size), t[frames - 1]);
    printf("%-34s %7.0f us a frame (worst %.0f), at most %d awake\n", "100,000 plants, one walker",
           1e6 * median(t, frames), 1e6 * worst, most);
    bench_keep("plants", "100000 plants and one walker", median(t, frames));
    dp_free(t);
    dp_plants_destroy(plants);
}

int main(int argc, char** argv)
{
    const int frames = bench_count(argc, argv, 300);
    lawn(frames, 0, "200 plants x 28 particles, awake");
    lawn(frames, 1, "the same, with a boot");
    plain(frames);
    meadow(frames);
    return 0;
}
