// Gradient noise over square lattices, and the pieces nearest to points of a lattice.
#include "base/noise.h"

#define HALF 0.6            // height of a wave by that of one twice as long
#define STRAYS 0.9          // share of a lattice square in which its point may lie
#define UNIT_WAVE 5.677717  // 1 over the deviation of a single wave
#define CELLS_A_WAVE 2.0

uint32_t dp_noise_bits(int64_t i, int64_t j, uint32_t seed)
{
    uint32_t h = (uint32_t)i * 0x9e3779b1u + (uint32_t)j * 0x85ebca6bu + seed * 0xc2b2ae35u;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return h ^ h >> 16;
}

double dp_noise_unit(uint32_t bits)
{
    return ((double)(bits & 0xffffu) + 0.5) / 65536.0;
}

double dp_noise_growth(double x)
{
    const double y = (x < -16.0 ? -16.0 : x > 16.0 ? 16.0 : x) / 64.0;
    double       e = (12.0 + 6.0 * y + y * y) / (12.0 - 6.0 * y + y * y);  // Pade's of e^y
    for (int k = 0; k < 6; ++k) e *= e;
    return e;
}

// ---- waves ---------------------------------------------------------------------------------------

static double fade(double t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// height at (u, v) from a corner of the lattice, of the plane that stands on it
static double plane(int64_t i, int64_t j, uint32_t seed, double u, double v)
{
    const uint32_t bits = dp_noise_bits(i, j, seed);
    return (2.0 * dp_noise_unit(bits) - 1.0) * u + (2.0 * dp_noise_unit(bits >> 16) - 1.0) * v;
}

double dp_noise_wave(double u, double v, uint32_t seed)
{
    const double  i = floor(u), j = floor(v), a = u - i, b = v - j;
    const int64_t m = (int64_t)i, n = (int64_t)j;
    const double  low =
        plane(m, n, seed, a, b) * (1.0 - fade(a)) + plane(m + 1, n, seed, a - 1.0, b) * fade(a);
    const double high = plane(m, n + 1, seed, a, b - 1.0) * (1.0 - fade(a)) +
                        plane(m + 1, n + 1, seed, a - 1.0, b - 1.0) * fade(a);
    return UNIT_WAVE * (low * (1.0 - fade(b)) + high * fade(b));
}

void dp_noise_waves(const DpGrid* grid, DpCellRect cells, double longest, double shortest,
                    uint32_t seed, float* out)
{
    const size_t nx = (size_t)(cells.i1 - cells.i0), ny = (size_t)(cells.j1 - cells.j0);
    double       variance = 0.0, height = 1.0;
    for (double length = longest; length > 0.99 * shortest; length *= 0.5, height *= HALF)
        variance += height * height;
    for (size_t k = 0; k < nx * ny; ++k) out[k] = 0.0f;
    height = 1.0 / sqrt(variance);
    for (double length = longest; length > 0.99 * shortest && length >= CELLS_A_WAVE * grid->cell;
         length *= 0.5, height *= HALF, ++seed) {
        const double away = dp_noise_unit(dp_noise_bits(0, 0, seed)),
                     aside = dp_noise_unit(dp_noise_bits(0, 1, seed));
        for (size_t j = 0; j < ny; ++j)
            for (size_t i = 0; i < nx; ++i) {
                const double u = dp_grid_x(grid, cells.i0 + (long)i) / length + away;
                const double v = dp_grid_y(grid, cells.j0 + (long)j) / length + aside;
                out[j * nx + i] += (float)(height * dp_noise_wave(u, v, seed));
            }
    }
}

// ---- pieces --------------------------------------------------------------------------------------

// the number of the piece in which (u, v) lies, lattice squares being 1 wide
static double piece(double u, double v, uint32_t seed)
{
    const int64_t m = (int64_t)floor(u), n = (int64_t)floor(v);
    double        nearest = INFINITY, number = 0.0;
    for (int64_t j = n - 1; j <= n + 1; ++j)
        for (int64_t i = m - 1; i <= m + 1; ++i) {
            const uint32_t bits = dp_noise_bits(i, j, seed);
            const double   x = (double)i + 0.5 + STRAYS * (dp_noise_unit(bits) - 0.5) - u;
            const double   y = (double)j + 0.5 + STRAYS * (dp_noise_unit(bits >> 16) - 0.5) - v;
            const double   away = x * x + y * y;
            if (!(away < nearest)) continue;
            nearest = away;
            number = dp_noise_unit(dp_noise_bits(i, j, seed + 1));
        }
    return sqrt(3.0) * (2.0 * number - 1.0);
}

void dp_noise_pieces(const DpGrid* grid, DpCellRect cells, double size, uint32_t seed, float* out)
{
    const size_t nx = (size_t)(cells.i1 - cells.i0), ny = (size_t)(cells.j1 - cells.j0);
    const bool   held = size >= CELLS_A_WAVE * grid->cell;
    for (size_t j = 0; j < ny; ++j)
        for (size_t i = 0; i < nx; ++i) {
            const double u = dp_grid_x(grid, cells.i0 + (long)i) / size;
            const double v = dp_grid_y(grid, cells.j0 + (long)j) / size;
            out[j * nx + i] = held ? (float)piece(u, v, seed) : 0.0f;
        }
}
