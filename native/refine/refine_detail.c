// What ground is like below a cell, by place: grit, crumbs, veins, and edges that stray. MODEL 8.3
#include "base/noise.h"
#include "base/parallel.h"
#include "refine/refine.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#define BLOCK 4096  // points a worker takes in one go
#define STRAYS 0.9  // share of a lattice square in which its crumb may lie
#define APART 2.6   // width of the squares by the radius of their crumbs
#define SMALL 0.6   // radius of the smallest crumb of a size, by the largest
#define RADIUS_2 \
    0.653333333  // means of the square and of the cube of radii spread evenly from SMALL to 1
#define RADIUS_3 0.544
#define PENTAGON 3.632712640  // area, by the square of the radius of the circle within
#define HIGH 0.8              // height of a crumb by its radius
#define STEEP 1.6  // its flanks rise so much from its edge, in its heights, up to a flat top
#define FILLED 0.505208333  // its mean height over its pentagon, in its heights
#define SHOWS 0.5           // a crumb shows where the heap is so high, in its radii
#define FINEST 0.004        // no edge strays over less [m]
#define ROUGH 0.7           // half as long waves of an edge are so high, by the longer ones
#define VEIN 0.55           // a vein is where noise of variance 1 is nearer to 0
#define VEIN_MEAN 0.1513    // mean of veins of height 1

typedef struct Job
{
    const double*   point;
    int             points;
    const DpDetail* detail;
    uint32_t        seed;
    float*          shown;
} Job;

// gradient noise whose lattice begins somewhere by chance
static double wave(double x, double y, double length, uint32_t seed)
{
    return dp_noise_wave(x / length + dp_noise_unit(dp_noise_bits(0, 0, seed)),
                         y / length + dp_noise_unit(dp_noise_bits(0, 1, seed)), seed);
}

// two waves, the second of half the length and half as high; of variance 1
static double waves(double x, double y, double length, uint32_t seed)
{
    return (wave(x, y, length, seed) + 0.5 * wave(x, y, 0.5 * length, seed + 1)) / sqrt(1.25);
}

// waves of that length, and shorter by halves as long as they are seen; of variance 1
static double strays(double x, double y, double length, uint32_t seed)
{
    double sum = 0.0, squares = 0.0, high = 1.0;
    for (uint32_t k = 0; k == 0 || length > FINEST; ++k, length *= 0.5, high *= ROUGH) {
        sum += high * wave(x, y, length, seed + k);
        squares += high * high;
    }
    return sum / sqrt(squares);
}

// ---- crumbs ----------------------------------------------------------------------------------------

// how far (x, y) is from the middle of a pentagon that is turned by chance, sides being 1 away
static double across(double x, double y, double turn)
{
    static const double side[5][2] = {{1.0, 0.0},
                                      {0.30901699437494742, 0.95105651629515357},
                                      {-0.80901699437494742, 0.58778525229247313},
                                      {-0.80901699437494742, -0.58778525229247313},
                                      {0.30901699437494742, -0.95105651629515357}};
    const double        c = (1.0 - turn * turn) / (1.0 + turn * turn),
                 s = 2.0 * turn / (1.0 + turn * turn);
    const double u = c * x - s * y, v = s * x + c * y;
    double       most = 0.0;
    for (int k = 0; k < 5; ++k) most = fmax(most, side[k][0] * u + side[k][1] * v);
    return most;
}

// height of the crumbs of one size at a place, less their mean; *threshold: of the heap that shows them
static double crumbs_of(double x, double y, double radius, double share, uint32_t seed,
                        double* threshold)
{
    const double  square = APART * radius;
    const double  there = share * APART * APART / (PENTAGON * RADIUS_2);  // in how many squares
    const int64_t m = (int64_t)floor(x / square), n = (int64_t)floor(y / square);
    double        high = -there * HIGH * FILLED * PENTAGON * RADIUS_3 * radius / (APART * APART);
    for (int64_t j = n - 1; j <= n + 1; ++j)
        for (int64_t i = m - 1; i <= m + 1; ++i) {
            const uint32_t bits = dp_noise_bits(i, j, seed), more = dp_noise_bits(i, j, seed + 1);
            if (dp_noise_unit(more) >= there) continue;
            const uint32_t last = dp_noise_bits(i, j, seed + 2);
            const double   size = radius * (SMALL + (1.0 - SMALL) * dp_noise_unit(more >> 16));
            const double dx = x - square * ((double)i + 0.5 + STRAYS * (dp_noise_unit(bits) - 0.5));
            const double dy =
                y - square * ((double)j + 0.5 + STRAYS * (dp_noise_unit(bits >> 16) - 0.5));
            const double away = across(dx / size, dy / size, 2.0 * dp_noise_unit(last) - 1.0);
            if (away >= 1.0) continue;
            high += HIGH * size * fmin(1.0, STEEP * (1.0 - away));
            *threshold = fmax(*threshold, SHOWS * size);
        }
    return high;
}

static double crumbs(const DpDetail* detail, double x, double y, uint32_t seed, double* threshold)
{
    int    sizes = 0;
    double high = 0.0;
    *threshold = SHOWS * detail->min_crumb;
    if (!(detail->crumb_share > 0.0)) return 0.0;
    for (double radius = detail->max_crumb; radius > 0.99 * detail->min_crumb; radius *= 0.5)
        ++sizes;
    for (double radius = detail->max_crumb; radius > 0.99 * detail->min_crumb;
         radius *= 0.5, seed += 3)
        high += crumbs_of(x, y, radius, detail->crumb_share / sizes, seed, threshold);
    return high;
}

// ---- all -------------------------------------------------------------------------------------------

static void detail_at(const DpDetail* detail, const double* point, uint32_t seed, float* shown)
{
    const double x = point[0], y = point[1];
    double       threshold = 0.0, vein = 0.0, grit = 0.0, away[2] = {0.0, 0.0};
    if (detail->vein_height > 0.0) {
        const double near = 1.0 - fabs(wave(x, y, detail->vein_size, seed)) / VEIN;
        vein = detail->vein_height * ((near > 0.0 ? near * near : 0.0) - VEIN_MEAN);
    }
    if (detail->grit_height > 0.0)
        grit = detail->grit_height * waves(x, y, detail->grit_size, seed + 1);
    if (detail->fray > 0.0)
        for (uint32_t k = 0; k < 2; ++k)
            away[k] = detail->fray * strays(x, y, detail->fray_size, seed + 1000 + 100 * k);
    shown[0] = (float)vein;
    shown[1] = (float)crumbs(detail, x, y, seed + 7, &threshold);
    shown[2] = (float)grit;
    shown[3] = (float)away[0];
    shown[4] = (float)away[1];
    shown[5] = (float)threshold;
}

static void work(void* context, int index, int worker)
{
    (void)worker;
    const Job* job = context;
    const int  first = index * BLOCK;
    const int  end = job->points - first < BLOCK ? job->points : first + BLOCK;
    for (int k = first; k < end; ++k)
        detail_at(job->detail, job->point + 3 * (size_t)k, job->seed, job->shown + 6 * (size_t)k);
}

#define DETAIL(...) DP_NUMBER_ROW(DpDetail, __VA_ARGS__)
static const DpNumber numbers[] = {DP_DETAIL_NUMBERS(DETAIL)};
#define COUNT ((int)(sizeof numbers / sizeof *numbers))

const DpNumber* dp_detail_numbers(int* count)
{
    *count = COUNT;
    return numbers;
}

DpDetail dp_detail_default(void)
{
    DpDetail detail;
    dp_numbers_usual(&detail, numbers, COUNT);
    return detail;
}

DpStatus dp_refine_detail(const double* point, int points, const DpDetail* detail, uint32_t seed,
                          float* shown)
{
    if (dp_numbers_check(detail, numbers, COUNT, NULL) != DP_OK ||
        detail->min_crumb > detail->max_crumb)
        return DP_BAD_ARGUMENT;
    for (size_t k = 0; k < 3 * (size_t)points; ++k)
        if (!(fabs(point[k]) < 1e9)) return DP_BAD_ARGUMENT;
    Job job = {point, points, detail, seed, shown};
    dp_parallel_for((points + BLOCK - 1) / BLOCK, dp_parallel_width(), work, &job);
    return DP_OK;
}
