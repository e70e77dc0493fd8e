// Gradient noise over square lattices, and the pieces nearest to points of a lattice.
#include "base/noise.h"

#define HALF 0.6            // height of a wave by that of one twice as long
#define STRAYS 0.9          // share of a lattice square in which its point may lie
#define UNIT_WAVE 5.677717  // 1 over the deviation of a single wave
#define CELLS_A_WAVE 2.0
#define COLUMNS 64  // that are worked on at once

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

// Columns of a row of cells, by where they lie between the corners of a lattice.
typedef struct Columns
{
    int     count;
    int64_t corner[COLUMNS];  // the one before
    double  u[COLUMNS], fade[COLUMNS],
        left[COLUMNS];  // from it, what the next one counts, and what it counts itself
} Columns;

// One row of a lattice over these columns: of the planes on the corners before and behind, height where they pass the row,
// and slope across it.
typedef struct Planes
{
    double before[COLUMNS], before_slope[COLUMNS], behind[COLUMNS], behind_slope[COLUMNS];
} Planes;

static void place_columns(Columns* columns, const DpGrid* grid, long i0, int count, double length,
                          double away)
{
    columns->count = count;
    for (int i = 0; i < count; ++i) {
        const double u = dp_grid_x(grid, i0 + i) / length + away, corner = floor(u);
        columns->corner[i] = (int64_t)corner;
        columns->u[i] = u - corner;
        columns->fade[i] = fade(u - corner);
        columns->left[i] = 1.0 - columns->fade[i];
    }
}

static void place_planes(Planes* planes, const Columns* columns, int64_t n, uint32_t seed)
{
    double slope[4] = {0.0};  // along and across, of the corner before and the one behind
    for (int i = 0; i < columns->count; ++i) {
        const int64_t m = columns->corner[i];
        for (int k = 0; k < 2 && (i == 0 || m != columns->corner[i - 1]); ++k) {
            const uint32_t bits = dp_noise_bits(m + k, n, seed);
            slope[2 * k] = 2.0 * dp_noise_unit(bits) - 1.0;
            slope[2 * k + 1] = 2.0 * dp_noise_unit(bits >> 16) - 1.0;
        }
        planes->before[i] = slope[0] * columns->u[i];
        planes->before_slope[i] = slope[1];
        planes->behind[i] = slope[2] * (columns->u[i] - 1.0);
        planes->behind_slope[i] = slope[3];
    }
}

// dp_noise_wave() of a row of cells, `b` beyond the lower of two rows of the lattice, is added to it
static void add_row(float* restrict out, const Columns* columns, const Planes* low,
                    const Planes* high, double b, double height)
{
    const double up = fade(b), down = 1.0 - up;
    for (int i = 0; i < columns->count; ++i) {
        const double left = columns->left[i], right = columns->fade[i];
        const double below = (low->before[i] + low->before_slope[i] * b) * left +
                             (low->behind[i] + low->behind_slope[i] * b) * right;
        const double above = (high->before[i] + high->before_slope[i] * (b - 1.0)) * left +
                             (high->behind[i] + high->behind_slope[i] * (b - 1.0)) * right;
        out[i] += (float)(height * (UNIT_WAVE * (below * down + above * up)));
    }
}

// one wave of some columns is added
static void add_wave(float* out, size_t row, const DpGrid* grid, DpCellRect cells, double length,
                     double height, uint32_t seed)
{
    Columns      columns;
    Planes       planes[2];
    int          low = 0;
    int64_t      at = INT64_MIN;
    const double aside = dp_noise_unit(dp_noise_bits(0, 1, seed));
    place_columns(&columns, grid, cells.i0, (int)(cells.i1 - cells.i0), length,
                  dp_noise_unit(dp_noise_bits(0, 0, seed)));
    for (long j = cells.j0; j < cells.j1; ++j, out += row) {
        const double  v = dp_grid_y(grid, j) / length + aside, corner = floor(v);
        const int64_t n = (int64_t)corner;
        if (n != at) {
            low = n == at + 1 ? 1 - low : low;
            if (at == INT64_MIN || n != at + 1) place_planes(&planes[low], &columns, n, seed);
            place_planes(&planes[1 - low], &columns, n + 1, seed);
            at = n;
        }
        add_row(out, &columns, &planes[low], &planes[1 - low], v - corner, height);
    }
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
         length *= 0.5, height *= HALF, ++seed)
        for (long i = cells.i0; i < cells.i1; i += COLUMNS) {
            const DpCellRect some = {i, i + COLUMNS < cells.i1 ? i + COLUMNS : cells.i1, cells.j0,
                                     cells.j1};
            add_wave(out + (i - cells.i0), nx, grid, some, length, height, seed);
        }
}

// ---- pieces --------------------------------------------------------------------------------------

#define MIDDLES \
    (COLUMNS / 2 + 4)  // of the squares around some columns, which are at least two cells wide

// The points of a row of lattice squares, and the numbers of their pieces.
typedef struct Middles
{
    double x[MIDDLES], y[MIDDLES], number[MIDDLES];
} Middles;

static void place_middles(Middles* middles, int64_t m0, int count, int64_t n, uint32_t seed)
{
    for (int k = 0; k < count; ++k) {
        const uint32_t bits = dp_noise_bits(m0 + k, n, seed);
        middles->x[k] = (double)(m0 + k) + 0.5 + STRAYS * (dp_noise_unit(bits) - 0.5);
        middles->y[k] = (double)n + 0.5 + STRAYS * (dp_noise_unit(bits >> 16) - 0.5);
        middles->number[k] = dp_noise_unit(dp_noise_bits(m0 + k, n, seed + 1));
    }
}

// the number of the piece in which (u, v) lies, from the squares around its own, which is the k-th
static double piece(const Middles* row, int k, double u, double v)
{
    double nearest = INFINITY, number = 0.0;
    for (int j = 0; j < 3; ++j)
        for (int i = k - 1; i <= k + 1; ++i) {
            const double x = row[j].x[i] - u, y = row[j].y[i] - v, away = x * x + y * y;
            if (!(away < nearest)) continue;
            nearest = away;
            number = row[j].number[i];
        }
    return sqrt(3.0) * (2.0 * number - 1.0);
}

static void some_pieces(float* out, size_t row, const DpGrid* grid, DpCellRect cells, double size,
                        uint32_t seed)
{
    Middles       middles[3];  // of the rows below, at and above a cell's
    const int64_t m0 = (int64_t)floor(dp_grid_x(grid, cells.i0) / size) - 1;
    const int64_t m1 = (int64_t)floor(dp_grid_x(grid, cells.i1 - 1) / size) + 2;
    int64_t       at = INT64_MIN;
    for (long j = cells.j0; j < cells.j1; ++j, out += row) {
        const double  v = dp_grid_y(grid, j) / size;
        const int64_t n = (int64_t)floor(v);
        for (int k = 0; n != at && k < 3; ++k)
            place_middles(&middles[k], m0, (int)(m1 - m0), n - 1 + k, seed);
        at = n;
        for (long i = cells.i0; i < cells.i1; ++i) {
            const double u = dp_grid_x(grid, i) / size;
            out[i - cells.i0] = (float)piece(middles, (int)((int64_t)floor(u) - m0), u, v);
        }
    }
}

void dp_noise_pieces(const DpGrid* grid, DpCellRect cells, double size, uint32_t seed, float* out)
{
    const size_t nx = (size_t)(cells.i1 - cells.i0), ny = (size_t)(cells.j1 - cells.j0);
    const bool   held = size >= CELLS_A_WAVE * grid->cell;
    for (size_t k = 0; k < nx * ny && !held; ++k) out[k] = 0.0f;
    for (long i = cells.i0; i < cells.i1 && held; i += COLUMNS) {
        const DpCellRect some = {i, i + COLUMNS < cells.i1 ? i + COLUMNS : cells.i1, cells.j0,
                                 cells.j1};
        some_pieces(out + (i - cells.i0), nx, grid, some, size, seed);
    }
}

// chance of the piece in which (u, v) lies, lattice squares being 1 wide
static uint32_t piece_bits(double u, double v, uint32_t seed)
{
    const int64_t m = (int64_t)floor(u), n = (int64_t)floor(v);
    double        nearest = INFINITY;
    uint32_t      found = 0;
    for (int64_t j = n - 1; j <= n + 1; ++j)
        for (int64_t i = m - 1; i <= m + 1; ++i) {
            const uint32_t bits = dp_noise_bits(i, j, seed);
            const double   x = (double)i + 0.5 + STRAYS * (dp_noise_unit(bits) - 0.5) - u;
            const double   y = (double)j + 0.5 + STRAYS * (dp_noise_unit(bits >> 16) - 0.5) - v;
            const double   away = x * x + y * y;
            if (!(away < nearest)) continue;
            nearest = away;
            found = dp_noise_bits(i, j, seed + 1);
        }
    return found;
}

void dp_noise_plates(const DpGrid* grid, DpCellRect cells, double size, uint32_t seed,
                     uint32_t* out)
{
    for (long j = cells.j0; j < cells.j1; ++j)
        for (long i = cells.i0; i < cells.i1; ++i)
            *out++ = piece_bits(dp_grid_x(grid, i) / size, dp_grid_y(grid, j) / size, seed) | 1u;
}
