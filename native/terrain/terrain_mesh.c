// Ground made of triangles: the upper envelope, seen from straight above.
//
// Triangles lie in grids of bins, each grid twice as coarse as the one before. A triangle stands
// once: in the bin of its lower left corner, in the finest grid where it ends in that bin or in the
// next one. A point asks the bins it lies in and those before them, a tile the bins under it and
// before; both use facet_at, so both get the same bits. A triangle reaches a hair beyond its edges:
// a point on an edge, or on a needle too thin to be kept, is never lost between two.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "terrain/terrain_inside.h"

#define NEEDLE 1e-10          // twice the area seen from above, over the longest edge squared
#define SLACK (2.0 * NEEDLE)  // how far it reaches beyond its edges, over the longest edge
#define MAX_BINS 30000        // along one side
#define FINEST 1e-100         // of the ground's box [m]: thinner is none
#define CHUNK 32768           // triangles or points looked at by one worker at a time
#define NOWHERE UINT32_MAX    // the bin of a triangle that is not ground

// a triangle seen from above
typedef struct Facet
{
    double x[3], y[3], z[3];
    double x_min, x_max, y_min, y_max;  // with slack
    double sign;                        // +1 counter-clockwise, -1 clockwise, 0 not ground
    double slack;                       // least value of a side [m^2] < 0
} Facet;

static inline double min3(const double* v)
{
    const double low = v[0] < v[1] ? v[0] : v[1];
    return low < v[2] ? low : v[2];
}

static inline double max3(const double* v)
{
    const double high = v[0] > v[1] ? v[0] : v[1];
    return high > v[2] ? high : v[2];
}

// its corners and its box
static inline Facet facet_box(const MeshGround* mesh, int32_t triangle)
{
    Facet          facet;
    const int32_t* of = mesh->triangle + 3 * (size_t)triangle;
    for (int k = 0; k < 3; ++k) {
        const double* at = mesh->vertex + 3 * (size_t)of[k];
        facet.x[k] = at[0], facet.y[k] = at[1], facet.z[k] = at[2];
    }
    const double x_min = min3(facet.x), x_max = max3(facet.x);
    const double y_min = min3(facet.y), y_max = max3(facet.y);
    const double reach = SLACK * ((x_max - x_min) + (y_max - y_min));
    facet.x_min = x_min - reach, facet.x_max = x_max + reach;
    facet.y_min = y_min - reach, facet.y_max = y_max + reach;
    facet.sign = facet.slack = 0.0;
    return facet;
}

// its orientation and how far it reaches beyond its edges
static inline void facet_finish(Facet* facet)
{
    double longest = 0.0;  // squared
    for (int k = 0; k < 3; ++k) {
        const int    n = (k + 1) % 3;
        const double dx = facet->x[n] - facet->x[k], dy = facet->y[n] - facet->y[k];
        const double squared = dx * dx + dy * dy;
        longest = squared > longest ? squared : longest;
    }
    const double twice = (facet->x[1] - facet->x[0]) * (facet->y[2] - facet->y[0]) -
                         (facet->x[2] - facet->x[0]) * (facet->y[1] - facet->y[0]);
    facet->sign = twice > NEEDLE * longest ? 1.0 : twice < -NEEDLE * longest ? -1.0 : 0.0;
    facet->slack = -SLACK * longest;
}

static inline Facet facet_of(const MeshGround* mesh, int32_t triangle)
{
    Facet facet = facet_box(mesh, triangle);
    facet_finish(&facet);
    return facet;
}

static inline bool in_box(const Facet* facet, double x, double y)
{
    return x >= facet->x_min && x <= facet->x_max && y >= facet->y_min && y <= facet->y_max;
}

// height of a triangle over (x, y) and the shares of its corners; false where it is not
static inline bool facet_at(const Facet* facet, double x, double y, double* z, double share[3])
{
    if (!in_box(facet, x, y)) return false;
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int    a = (k + 1) % 3, b = (k + 2) % 3;
        const double side = facet->sign * ((facet->x[b] - facet->x[a]) * (y - facet->y[a]) -
                                           (facet->y[b] - facet->y[a]) * (x - facet->x[a]));
        if (!(side >= facet->slack)) return false;
        share[k] = side > 0.0 ? side : 0.0;
        sum += share[k];
    }
    for (int k = 0; k < 3; ++k) share[k] /= sum;
    const double height = share[0] * facet->z[0] + share[1] * facet->z[1] + share[2] * facet->z[2];
    *z = dp_clamp(height, min3(facet->z), max3(facet->z));  // level ground stays level to the bit
    return true;
}

// ---- bins -------------------------------------------------------------------------------------

// column or row of the finest bins
static inline int bin_of(double at, double from, double per_bin, int bins)
{
    const double steps = (at - from) * per_bin;
    return steps <= 0.0 ? 0 : steps >= (double)(bins - 1) ? bins - 1 : (int)steps;
}

// rectangle of bins, both ends included
typedef struct Bins
{
    int x0, x1, y0, y1;
} Bins;

static inline Bins bins_of(const MeshGround* mesh, double x_min, double x_max, double y_min,
                           double y_max)
{
    const Bins bins = {bin_of(x_min, mesh->x0, mesh->per_bin, mesh->nx),
                       bin_of(x_max, mesh->x0, mesh->per_bin, mesh->nx),
                       bin_of(y_min, mesh->y0, mesh->per_bin, mesh->ny),
                       bin_of(y_max, mesh->y0, mesh->per_bin, mesh->ny)};
    return bins;
}

// the finest grid a triangle fits, and its bin there
static uint32_t place_of(const MeshGround* mesh, const Facet* facet)
{
    const Bins at = bins_of(mesh, facet->x_min, facet->x_max, facet->y_min, facet->y_max);
    int        l = 0;
    while ((at.x1 >> l) - (at.x0 >> l) > 1 || (at.y1 >> l) - (at.y0 >> l) > 1) ++l;
    const BinGrid* grid = &mesh->grid[l];
    return (uint32_t)(grid->first + (at.y0 >> l) * grid->nx + (at.x0 >> l));
}

// a few triangles a bin
static void choose_bins(MeshGround* mesh, const double bounds[4], size_t triangles)
{
    const double wide = bounds[2] - bounds[0], high = bounds[3] - bounds[1];
    const double longer = fmax(wide, high);
    const double bin = fmax(2.0 * sqrt(wide * high / (double)triangles),
                            longer / fmin((double)triangles, (double)MAX_BINS));
    mesh->x0 = bounds[0], mesh->y0 = bounds[1];
    mesh->per_bin = 1.0 / bin;
    mesh->nx = (int)(wide / bin) + 1;
    mesh->ny = (int)(high / bin) + 1;
    int first = 0;
    for (int l = 0;; ++l) {
        const int nx = ((mesh->nx - 1) >> l) + 1, ny = ((mesh->ny - 1) >> l) + 1;
        mesh->grid[l] = (BinGrid){nx, ny, first, false};
        first += nx * ny;
        mesh->grids = l + 1;
        if (nx == 1 && ny == 1) break;
    }
    mesh->bins = first;
}

typedef struct Binning
{
    const DpGround* ground;
    MeshGround*     mesh;
    uint32_t*       place;  // bin of every triangle
    struct Share
    {
        double bounds[4];
        size_t facing;
        bool   bad;
        bool   level;  // its points are as high as the first of all
    } * share;         // what every chunk found
} Binning;

static int chunks_of(size_t count)
{
    return (int)((count + CHUNK - 1) / CHUNK);
}

static int end_of(int chunk, int count)
{
    return count - chunk * CHUNK < CHUNK ? count : (chunk + 1) * CHUNK;
}

static void take_points(void* context, int chunk, int worker)
{
    Binning*      binning = context;
    struct Share* share = &binning->share[chunk];
    const double* vertex = binning->ground->vertex;
    const size_t  first = 3 * (size_t)chunk * CHUNK;
    const size_t  end = 3 * (size_t)end_of(chunk, binning->ground->vertex_count);
    double        x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    bool          bad = false, level = true;
    (void)worker;
    for (size_t n = first; n < end; n += 3) {
        const double x = vertex[n], y = vertex[n + 1], z = vertex[n + 2];
        level &= z == vertex[2];
        bad |= !(fabs(x) < 1e100 && fabs(y) < 1e100 && fabs(z) < 1e100);  // squares are finite
        x0 = x < x0 ? x : x0, x1 = x > x1 ? x : x1;
        y0 = y < y0 ? y : y0, y1 = y > y1 ? y : y1;
    }
    *share = (struct Share){{x0, y0, x1, y1}, 0, bad, level};
    memcpy(binning->mesh->vertex + first, vertex + first, (end - first) * sizeof *vertex);
}

static void take_triangles(void* context, int chunk, int worker)
{
    Binning*       binning = context;
    MeshGround*    mesh = binning->mesh;
    struct Share*  share = &binning->share[chunk];
    const int32_t* corner = binning->ground->triangle;
    const int      end = end_of(chunk, mesh->triangle_count);
    double         x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    (void)worker;
    *share = (struct Share){{0.0}, 0, false, false};
    for (int t = chunk * CHUNK; t < end; ++t) {
        for (size_t n = 3 * (size_t)t; n < 3 * (size_t)t + 3; ++n) {
            share->bad |= corner[n] < 0 || corner[n] >= mesh->vertex_count;
            mesh->triangle[n] = corner[n];
        }
        if (share->bad) return;
        const Facet facet = facet_of(mesh, t);
        binning->place[t] = facet.sign == 0.0 ? NOWHERE : place_of(mesh, &facet);
        if (facet.sign == 0.0) continue;
        ++share->facing;
        const double left = min3(facet.x), right = max3(facet.x);
        const double near = min3(facet.y), far = max3(facet.y);
        x0 = left < x0 ? left : x0, x1 = right > x1 ? right : x1;
        y0 = near < y0 ? near : y0, y1 = far > y1 ? far : y1;
    }
    share->bounds[0] = x0, share->bounds[1] = y0, share->bounds[2] = x1, share->bounds[3] = y1;
}

// the box of all chunks; false when one is bad
static bool sum_up(const struct Share* share, int chunks, double bounds[4], size_t* facing)
{
    bounds[0] = bounds[1] = INFINITY, bounds[2] = bounds[3] = -INFINITY;
    *facing = 0;
    for (int c = 0; c < chunks; ++c, ++share) {
        if (share->bad) return false;
        *facing += share->facing;
        for (int k = 0; k < 2; ++k) {
            bounds[k] = fmin(bounds[k], share->bounds[k]);
            bounds[k + 2] = fmax(bounds[k + 2], share->bounds[k + 2]);
        }
    }
    return true;
}

// points, then triangles, copied, looked through and given their places; how many of them face up
// or down, and where these lie
static DpStatus take_mesh(Binning* binning, int workers, double bounds[4], size_t* facing)
{
    const DpGround* ground = binning->ground;
    const int       point_chunks = chunks_of((size_t)ground->vertex_count);
    const int       chunks = chunks_of((size_t)ground->triangle_count);
    dp_parallel_for(point_chunks, workers, take_points, binning);
    if (!sum_up(binning->share, point_chunks, bounds, facing)) return DP_BAD_ARGUMENT;
    binning->mesh->level = true;
    for (int c = 0; c < point_chunks; ++c) binning->mesh->level &= binning->share[c].level;
    for (bool again = false;; again = true) {
        double box[4];
        memcpy(box, bounds, sizeof box);
        for (int k = 0; k < 2; ++k)  // wide enough to be cut into bins, however far off it lies
            if (!(box[k + 2] - box[k] > FINEST)) box[k + 2] += 1.0 + 1e-9 * fabs(box[k]);
        choose_bins(binning->mesh, box, (size_t)ground->triangle_count);
        dp_parallel_for(chunks, workers, take_triangles, binning);
        if (!sum_up(binning->share, chunks, bounds, facing)) return DP_BAD_ARGUMENT;
        if (*facing == 0) return DP_NO_GROUND;
        // points of no triangle may lie far off: then once more, with bins where the ground is
        const double wide = bounds[2] - bounds[0], high = bounds[3] - bounds[1];
        if (again || 4.0 * wide * high >= (box[2] - box[0]) * (box[3] - box[1])) return DP_OK;
    }
}

// counted, summed up, filled from the back: ascending within a bin
static bool fill_bins(MeshGround* mesh, const uint32_t* place, size_t facing)
{
    mesh->start = dp_alloc((size_t)mesh->bins + 1, sizeof *mesh->start);
    mesh->item = dp_alloc(facing, sizeof *mesh->item);
    if (!mesh->start || !mesh->item) return false;
    for (int32_t t = 0; t < mesh->triangle_count; ++t)
        if (place[t] != NOWHERE) ++mesh->start[place[t]];
    int32_t sum = 0;
    for (int b = 0; b <= mesh->bins; ++b) {
        sum += mesh->start[b];
        mesh->start[b] = sum;  // where the bin ends; placing moves it back to where it begins
    }
    for (int32_t t = mesh->triangle_count; t-- > 0;)
        if (place[t] != NOWHERE) mesh->item[--mesh->start[place[t]]] = t;
    for (int l = 0; l < mesh->grids; ++l) {
        BinGrid* grid = &mesh->grid[l];
        grid->used = mesh->start[grid->first] < mesh->start[grid->first + grid->nx * grid->ny];
    }
    return true;
}

DpStatus dp_mesh_create(MeshGround* mesh, const DpGround* ground, int workers, double bounds[4])
{
    if (ground->vertex_count < 3 || ground->triangle_count < 1 || !ground->vertex ||
        !ground->triangle)
        return DP_BAD_ARGUMENT;
    const size_t points = (size_t)ground->vertex_count, triangles = (size_t)ground->triangle_count;
    const int    chunks = chunks_of(points > triangles ? points : triangles);
    mesh->vertex_count = ground->vertex_count;
    mesh->triangle_count = ground->triangle_count;
    mesh->vertex = dp_alloc(points, 3 * sizeof(double));
    mesh->triangle = dp_alloc(triangles, 3 * sizeof(int32_t));
    Binning  binning = {ground, mesh, dp_alloc(triangles, sizeof(uint32_t)),
                        dp_alloc((size_t)chunks, sizeof(struct Share))};
    size_t   facing = 0;
    DpStatus status = DP_NO_MEMORY;
    if (mesh->vertex && mesh->triangle && binning.place && binning.share)
        status = take_mesh(&binning, workers, bounds, &facing);
    if (status == DP_OK) {
        int32_t t = 0;
        while (binning.place[t] == NOWHERE) ++t;
        mesh->somewhere = mesh->vertex[3 * (size_t)mesh->triangle[3 * (size_t)t] + 2];
    }
    if (status == DP_OK && !fill_bins(mesh, binning.place, facing)) status = DP_NO_MEMORY;
    dp_free(binning.place);
    dp_free(binning.share);
    return status;
}

void dp_mesh_destroy(MeshGround* mesh)
{
    dp_free(mesh->vertex);
    dp_free(mesh->triangle);
    dp_free(mesh->start);
    dp_free(mesh->item);
}

// ---- asking -----------------------------------------------------------------------------------

// the highest so far; of equals the first triangle, whichever comes first
typedef struct Highest
{
    double  z;
    int32_t triangle;  // -1 = none
} Highest;

static inline void rise(Highest* top, double z, int32_t triangle)
{
    if (top->triangle < 0 || z > top->z || (z == top->z && triangle < top->triangle)) {
        top->z = z;
        top->triangle = triangle;
    }
}

static uint8_t kind_of(const Source* source, int32_t triangle, double x, double y)
{
    if (source->kind_count == 0 || triangle < 0) return 0;
    const int32_t* corner = source->mesh.triangle + 3 * (size_t)triangle;
    const Facet    facet = facet_of(&source->mesh, triangle);
    const size_t   of[3] = {(size_t)corner[0], (size_t)corner[1], (size_t)corner[2]};
    double         z, share[3];
    return facet_at(&facet, x, y, &z, share) ? dp_source_kind(source, 3, of, share) : 0;
}

// the triangles of a row of bins that can lie over a rectangle of finest bins
typedef struct Items
{
    const int32_t *at, *end;
} Items;

static inline Items items_of(const MeshGround* mesh, const BinGrid* grid, int l, const Bins* under,
                             int row)
{
    const int   before = (under->x0 >> l) - 1;
    const int   first = grid->first + row * grid->nx + (before < 0 ? 0 : before);
    const int   last = grid->first + row * grid->nx + (under->x1 >> l);
    const Items items = {mesh->item + mesh->start[first], mesh->item + mesh->start[last + 1]};
    return items;
}

static inline int first_row(int l, const Bins* under)
{
    const int before = (under->y0 >> l) - 1;
    return before < 0 ? 0 : before;
}

double dp_mesh_at(const Source* source, double x, double y, uint8_t* kind)
{
    const MeshGround* mesh = &source->mesh;
    if (!isfinite(x) || !isfinite(y)) return NAN;
    const Bins at = bins_of(mesh, x, x, y, y);
    Highest    top = {NAN, -1};
    for (int l = 0; l < mesh->grids; ++l) {
        const BinGrid* grid = &mesh->grid[l];
        if (!grid->used) continue;
        for (int row = first_row(l, &at); row <= at.y1 >> l; ++row) {
            const Items items = items_of(mesh, grid, l, &at, row);
            for (const int32_t* item = items.at; item < items.end; ++item) {
                Facet  facet = facet_box(mesh, *item);
                double z, share[3];
                if (!in_box(&facet, x, y)) continue;
                facet_finish(&facet);
                if (facet_at(&facet, x, y, &z, share)) rise(&top, z, *item);
            }
        }
    }
    if (kind) *kind = kind_of(source, top.triangle, x, y);
    return top.z;
}

// cells whose centres can lie in low..high; facet_at has the last word
static inline void cell_range(double low, double high, double origin, double per_cell, long from,
                              int* first, int* last)
{
    const double spare = 0.01 + fabs((double)from) * 0x1p-48;  // more than rounding takes
    const double before =
        dp_clamp((low - origin) * per_cell - (double)from - 0.5 - spare, -1.0, DP_TILE);
    const double after =
        dp_clamp((high - origin) * per_cell - (double)from - 0.5 + spare, -1.0, DP_TILE - 1);
    *first = (int)(before + 1.0);  // ceil of what is not whole
    *last = (int)(after + 1.0) - 1;
}

static inline bool can_rise(const Highest* top, double z_max, int32_t triangle)
{
    return top->triangle < 0 || z_max > top->z || (z_max == top->z && triangle < top->triangle);
}

static void raise_cells(Facet* facet, int32_t triangle, const TileGrid* grid, double per_cell,
                        Highest* top)
{
    int i0, i1, j0, j1;
    cell_range(facet->x_min, facet->x_max, grid->origin_x, per_cell, grid->i0, &i0, &i1);
    cell_range(facet->y_min, facet->y_max, grid->origin_y, per_cell, grid->j0, &j0, &j1);
    if (i0 > i1 || j0 > j1) return;
    const double z_max = max3(facet->z);
    bool         finished = false;
    for (int j = j0; j <= j1; ++j) {
        const double y = cell_at(grid->origin_y, grid->cell, grid->j0 + j);
        for (int i = i0; i <= i1; ++i) {
            Highest* here = &top[j * DP_TILE + i];
            if (!can_rise(here, z_max, triangle)) continue;
            const double x = cell_at(grid->origin_x, grid->cell, grid->i0 + i);
            double       z, share[3];
            if (!finished) facet_finish(facet);
            finished = true;
            if (facet_at(facet, x, y, &z, share)) rise(here, z, triangle);
        }
    }
}

void dp_mesh_tile(const Source* source, const TileGrid* grid, float* height, uint8_t* kind)
{
    const MeshGround* mesh = &source->mesh;
    const double      per_cell = 1.0 / grid->cell;
    Highest           top[TILE_CELLS];
    for (int n = 0; n < TILE_CELLS; ++n) top[n] = (Highest){NAN, -1};

    const Bins under = bins_of(mesh, cell_at(grid->origin_x, grid->cell, grid->i0),
                               cell_at(grid->origin_x, grid->cell, grid->i0 + DP_TILE - 1),
                               cell_at(grid->origin_y, grid->cell, grid->j0),
                               cell_at(grid->origin_y, grid->cell, grid->j0 + DP_TILE - 1));
    for (int l = 0; l < mesh->grids; ++l) {
        const BinGrid* bins = &mesh->grid[l];
        if (!bins->used) continue;
        for (int row = first_row(l, &under); row <= under.y1 >> l; ++row) {
            const Items items = items_of(mesh, bins, l, &under, row);
            for (const int32_t* item = items.at; item < items.end; ++item) {
                Facet facet = facet_box(mesh, *item);
                raise_cells(&facet, *item, grid, per_cell, top);
            }
        }
    }

    for (int j = 0; j < DP_TILE; ++j) {
        const double y = cell_at(grid->origin_y, grid->cell, grid->j0 + j);
        for (int i = 0; i < DP_TILE; ++i) {
            const double x = cell_at(grid->origin_x, grid->cell, grid->i0 + i);
            const int    n = j * DP_TILE + i;
            height[n] = (float)(top[n].z - grid->datum);
            kind[n] = kind_of(source, top[n].triangle, x, y);
        }
    }
}
