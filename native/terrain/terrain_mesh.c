// Ground made of triangles: the upper envelope, seen from straight above.
//
// A point asks the bins it lies in and those before them, a tile the bins under it and before; both use
// facet_at, so both get the same bits.
#include <math.h>

#include "terrain/terrain_bins.h"
#include "terrain/terrain_facet.h"

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
    cell_range(facet->x_min, facet->x_max, grid->world.x0, per_cell, grid->i0, &i0, &i1);
    cell_range(facet->y_min, facet->y_max, grid->world.y0, per_cell, grid->j0, &j0, &j1);
    if (i0 > i1 || j0 > j1) return;
    const double z_max = max3(facet->z);
    bool         finished = false;
    for (int j = j0; j <= j1; ++j) {
        const double y = dp_grid_y(&grid->world, grid->j0 + j);
        for (int i = i0; i <= i1; ++i) {
            Highest* here = &top[j * DP_TILE + i];
            if (!can_rise(here, z_max, triangle)) continue;
            const double x = dp_grid_x(&grid->world, grid->i0 + i);
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
    const double      per_cell = 1.0 / grid->world.cell;
    Highest           top[TILE_CELLS];
    for (int n = 0; n < TILE_CELLS; ++n) top[n] = (Highest){NAN, -1};

    const Bins under = bins_of(
        mesh, dp_grid_x(&grid->world, grid->i0), dp_grid_x(&grid->world, grid->i0 + DP_TILE - 1),
        dp_grid_y(&grid->world, grid->j0), dp_grid_y(&grid->world, grid->j0 + DP_TILE - 1));
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
        const double y = dp_grid_y(&grid->world, grid->j0 + j);
        for (int i = 0; i < DP_TILE; ++i) {
            const double x = dp_grid_x(&grid->world, grid->i0 + i);
            const int    n = j * DP_TILE + i;
            height[n] = (float)(top[n].z - grid->datum);
            kind[n] = kind_of(source, top[n].triangle, x, y);
        }
    }
}
