// Ground made of triangles: the upper envelope, seen from straight above.
//
// Triangles lie in a uniform grid of bins. A point asks the triangles of its bin, a tile those of
// the bins under it; both use facet_at, so both get the same bits. A triangle reaches a hair beyond
// its edges: a point on an edge, or on a needle too thin to be kept, is never lost between two.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "terrain/terrain_inside.h"

#define NEEDLE 1e-10          // twice the area seen from above, over the longest edge squared
#define SLACK (2.0 * NEEDLE)  // how far it reaches beyond its edges, over the longest edge
#define BIN_SHARE 6           // entries in bins, per triangle, before bins are made coarser
#define MOST_BINS 30000       // along one side

// a triangle seen from above
typedef struct Facet
{
    double x[3], y[3], z[3];
    double x_min, x_max, y_min, y_max;  // with slack
    double sign;                        // +1 counter-clockwise, -1 clockwise, 0 not ground
    double slack;                       // least value of a side [m^2] < 0
} Facet;

static inline double least(const double* v)
{
    const double low = v[0] < v[1] ? v[0] : v[1];
    return low < v[2] ? low : v[2];
}

static inline double most(const double* v)
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
    const double x_min = least(facet.x), x_max = most(facet.x);
    const double y_min = least(facet.y), y_max = most(facet.y);
    const double reach = SLACK * ((x_max - x_min) + (y_max - y_min));
    facet.x_min = x_min - reach, facet.x_max = x_max + reach;
    facet.y_min = y_min - reach, facet.y_max = y_max + reach;
    facet.sign = facet.slack = 0.0;
    return facet;
}

// which way it runs and how far it reaches beyond its edges
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
    *z = dp_clamp(height, least(facet->z), most(facet->z));  // level ground stays level to the bit
    return true;
}

// ---- bins -------------------------------------------------------------------------------------

static int bin_of(double at, double from, double bin, int bins)
{
    const double steps = (at - from) / bin;
    return steps <= 0.0 ? 0 : steps >= (double)(bins - 1) ? bins - 1 : (int)steps;
}

// rectangle of bins, both ends included
typedef struct Bins
{
    int x0, x1, y0, y1;
} Bins;

static Bins bins_of(const MeshGround* mesh, double x_min, double x_max, double y_min, double y_max)
{
    const Bins bins = {
        bin_of(x_min, mesh->x0, mesh->bin, mesh->nx), bin_of(x_max, mesh->x0, mesh->bin, mesh->nx),
        bin_of(y_min, mesh->y0, mesh->bin, mesh->ny), bin_of(y_max, mesh->y0, mesh->bin, mesh->ny)};
    return bins;
}

static Bins facet_bins(const MeshGround* mesh, const Facet* facet)
{
    return bins_of(mesh, facet->x_min, facet->x_max, facet->y_min, facet->y_max);
}

static void set_bins(MeshGround* mesh, const double bounds[4], double bin)
{
    mesh->x0 = bounds[0], mesh->y0 = bounds[1];
    mesh->bin = bin;
    mesh->nx = (int)((bounds[2] - bounds[0]) / bin) + 1;
    mesh->ny = (int)((bounds[3] - bounds[1]) / bin) + 1;
}

static size_t count_entries(const MeshGround* mesh)
{
    size_t entries = 0;
    for (int32_t t = 0; t < mesh->triangle_count; ++t) {
        const Facet facet = facet_of(mesh, t);
        if (facet.sign == 0.0) continue;
        const Bins bins = facet_bins(mesh, &facet);
        entries += (size_t)(bins.x1 - bins.x0 + 1) * (size_t)(bins.y1 - bins.y0 + 1);
    }
    return entries;
}

// a few triangles a bin and a few bins a triangle; a huge triangle among small ones asks for
// coarser bins, one bin for all at the worst
static size_t choose_bins(MeshGround* mesh, const double bounds[4], size_t facing)
{
    const double wide = bounds[2] - bounds[0], high = bounds[3] - bounds[1];
    const double longer = fmax(wide, high);
    double       bin = fmax(2.0 * sqrt(wide * high / (double)facing),
                            longer / fmin((double)facing, (double)MOST_BINS));
    for (;; bin *= 2.0) {
        set_bins(mesh, bounds, bin);
        const size_t entries = count_entries(mesh);
        if (entries <= BIN_SHARE * facing + 64 || (mesh->nx == 1 && mesh->ny == 1)) return entries;
    }
}

static void count_or_place(MeshGround* mesh, int32_t triangle, bool place)
{
    const Facet facet = facet_of(mesh, triangle);
    if (facet.sign == 0.0) return;
    const Bins at = facet_bins(mesh, &facet);
    for (int by = at.y0; by <= at.y1; ++by)
        for (int bx = at.x0; bx <= at.x1; ++bx) {
            size_t* start = &mesh->start[(size_t)by * (size_t)mesh->nx + (size_t)bx];
            if (place)
                mesh->item[--*start] = triangle;
            else
                ++*start;
        }
}

// counted, summed up, filled from the back: ascending within a bin
static bool fill_bins(MeshGround* mesh, size_t entries)
{
    const size_t bins = (size_t)mesh->nx * (size_t)mesh->ny;
    mesh->start = dp_alloc(bins + 1, sizeof *mesh->start);
    mesh->item = dp_alloc(entries, sizeof *mesh->item);
    if (!mesh->start || !mesh->item) return false;
    for (int32_t t = 0; t < mesh->triangle_count; ++t) count_or_place(mesh, t, false);
    size_t sum = 0;
    for (size_t b = 0; b <= bins; ++b) {
        sum += mesh->start[b];
        mesh->start[b] = sum;  // where the bin ends; placing moves it back to where it begins
    }
    for (int32_t t = mesh->triangle_count; t-- > 0;) count_or_place(mesh, t, true);
    return true;
}

static DpStatus check_mesh(const DpGround* ground)
{
    if (ground->vertex_count < 3 || ground->triangle_count < 1 || !ground->vertex ||
        !ground->triangle)
        return DP_BAD_ARGUMENT;
    const size_t numbers = 3 * (size_t)ground->vertex_count;
    for (size_t n = 0; n < numbers; ++n)
        if (!(fabs(ground->vertex[n]) < 1e100)) return DP_BAD_ARGUMENT;  // squares must be finite
    const size_t corners = 3 * (size_t)ground->triangle_count;
    for (size_t n = 0; n < corners; ++n)
        if (ground->triangle[n] < 0 || ground->triangle[n] >= ground->vertex_count)
            return DP_BAD_ARGUMENT;
    return DP_OK;
}

DpStatus mesh_create(MeshGround* mesh, const DpGround* ground, double bounds[4])
{
    const DpStatus status = check_mesh(ground);
    if (status != DP_OK) return status;
    mesh->vertex_count = ground->vertex_count;
    mesh->triangle_count = ground->triangle_count;
    mesh->vertex = dp_alloc((size_t)ground->vertex_count, 3 * sizeof(double));
    mesh->triangle = dp_alloc((size_t)ground->triangle_count, 3 * sizeof(int32_t));
    if (!mesh->vertex || !mesh->triangle) return DP_NO_MEMORY;
    memcpy(mesh->vertex, ground->vertex, (size_t)ground->vertex_count * 3 * sizeof(double));
    memcpy(mesh->triangle, ground->triangle, (size_t)ground->triangle_count * 3 * sizeof(int32_t));

    size_t facing = 0;
    bounds[0] = bounds[1] = INFINITY, bounds[2] = bounds[3] = -INFINITY;
    for (int32_t t = 0; t < mesh->triangle_count; ++t) {
        const Facet facet = facet_of(mesh, t);
        if (facet.sign == 0.0) continue;
        ++facing;
        bounds[0] = fmin(bounds[0], least(facet.x)), bounds[2] = fmax(bounds[2], most(facet.x));
        bounds[1] = fmin(bounds[1], least(facet.y)), bounds[3] = fmax(bounds[3], most(facet.y));
    }
    if (facing == 0) return DP_NO_GROUND;
    const size_t entries = choose_bins(mesh, bounds, facing);
    return fill_bins(mesh, entries) ? DP_OK : DP_NO_MEMORY;
}

void mesh_destroy(MeshGround* mesh)
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

static uint8_t kind_of(const Rest* rest, int32_t triangle, double x, double y)
{
    if (rest->kind_count == 0 || triangle < 0) return 0;
    const int32_t* corner = rest->mesh.triangle + 3 * (size_t)triangle;
    const Facet    facet = facet_of(&rest->mesh, triangle);
    const size_t   of[3] = {(size_t)corner[0], (size_t)corner[1], (size_t)corner[2]};
    double         z, share[3];
    return facet_at(&facet, x, y, &z, share) ? heaviest_kind(rest, 3, of, share) : 0;
}

double mesh_at(const Rest* rest, double x, double y, uint8_t* kind)
{
    const MeshGround* mesh = &rest->mesh;
    if (!isfinite(x) || !isfinite(y)) return NAN;
    const Bins   at = bins_of(mesh, x, x, y, y);
    const size_t bin = (size_t)at.y0 * (size_t)mesh->nx + (size_t)at.x0;
    Highest      top = {NAN, -1};
    for (size_t n = mesh->start[bin]; n < mesh->start[bin + 1]; ++n) {
        Facet  facet = facet_box(mesh, mesh->item[n]);
        double z, share[3];
        if (!in_box(&facet, x, y)) continue;
        facet_finish(&facet);
        if (facet_at(&facet, x, y, &z, share)) rise(&top, z, mesh->item[n]);
    }
    if (kind) *kind = kind_of(rest, top.triangle, x, y);
    return top.z;
}

// cells whose centres can lie in low..high; facet_at has the last word
static inline void cell_range(double low, double high, double origin, double cell, long from,
                              int* first, int* last)
{
    const double before = dp_clamp((low - origin) / cell - 1.5 - (double)from, 0.0, DP_TILE);
    const double after = dp_clamp((high - origin) / cell + 0.5 - (double)from, -1.0, DP_TILE - 1);
    *first = (int)before;
    *last = (int)ceil(after);
    if (*last > DP_TILE - 1) *last = DP_TILE - 1;
}

static void raise_cells(const Facet* facet, int32_t triangle, const TileGrid* grid, Highest* top)
{
    int i0, i1, j0, j1;
    cell_range(facet->x_min, facet->x_max, grid->origin_x, grid->cell, grid->i0, &i0, &i1);
    cell_range(facet->y_min, facet->y_max, grid->origin_y, grid->cell, grid->j0, &j0, &j1);
    for (int j = j0; j <= j1; ++j) {
        const double y = cell_at(grid->origin_y, grid->cell, grid->j0 + j);
        for (int i = i0; i <= i1; ++i) {
            const double x = cell_at(grid->origin_x, grid->cell, grid->i0 + i);
            double       z, share[3];
            if (facet_at(facet, x, y, &z, share)) rise(&top[j * DP_TILE + i], z, triangle);
        }
    }
}

void mesh_tile(const Rest* rest, const TileGrid* grid, float* height, uint8_t* kind)
{
    const MeshGround* mesh = &rest->mesh;
    Highest           top[TILE_CELLS];
    for (int n = 0; n < TILE_CELLS; ++n) top[n] = (Highest){NAN, -1};

    const Bins under = bins_of(mesh, cell_at(grid->origin_x, grid->cell, grid->i0),
                               cell_at(grid->origin_x, grid->cell, grid->i0 + DP_TILE - 1),
                               cell_at(grid->origin_y, grid->cell, grid->j0),
                               cell_at(grid->origin_y, grid->cell, grid->j0 + DP_TILE - 1));
    for (int by = under.y0; by <= under.y1; ++by)
        for (int bx = under.x0; bx <= under.x1; ++bx) {
            const size_t bin = (size_t)by * (size_t)mesh->nx + (size_t)bx;
            for (size_t n = mesh->start[bin]; n < mesh->start[bin + 1]; ++n) {
                Facet      facet = facet_box(mesh, mesh->item[n]);
                const Bins at = facet_bins(mesh, &facet);
                const int  once_x = at.x0 > under.x0 ? at.x0 : under.x0;
                const int  once_y = at.y0 > under.y0 ? at.y0 : under.y0;
                if (bx != once_x || by != once_y) continue;  // it stands in other bins too
                facet_finish(&facet);
                raise_cells(&facet, mesh->item[n], grid, top);
            }
        }

    for (int j = 0; j < DP_TILE; ++j) {
        const double y = cell_at(grid->origin_y, grid->cell, grid->j0 + j);
        for (int i = 0; i < DP_TILE; ++i) {
            const double x = cell_at(grid->origin_x, grid->cell, grid->i0 + i);
            const int    n = j * DP_TILE + i;
            height[n] = (float)top[n].z;
            kind[n] = kind_of(rest, top[n].triangle, x, y);
        }
    }
}
