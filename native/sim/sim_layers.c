// sim/sim_layers.c - how thick layers of the ground still are where it was pressed, and which are seen. MODEL 6.17
#include <math.h>

#include "base/alloc.h"
#include "sim/sim_inside.h"

// what is known of some cells, side by side
typedef struct Cells
{
    float *kind, *compression, *heap, *coats;  // coats: thickness of all of them [m]
    float* own;                                // .. of the one that is asked for
} Cells;

#define GRIDS 5

bool dp_sim_is_of_layers(const DpSim* sim, int field)
{
    bool any = false;
    for (int k = 0; k < dp_terrain_soil_count(sim->terrain); ++k) {
        int            count;
        const DpLayer* layers = dp_terrain_layers(sim->terrain, k, &count);
        if (!layers) continue;
        if (field >= DP_FIELD_SURFACE && field < DP_FIELD_COAT)
            any = any || dp_terrain_knows(sim->terrain, field);
        if (field >= DP_FIELD_LAYER)  // the last is the ground below
            any = any || field - DP_FIELD_LAYER < layers[count - 1].place;
    }
    return any;
}

// How thick a layer is that was pressed together with those around it [m].
static double left_of(const DpLayer* layers, int count, int n, double depth)
{
    return layers[n].thickness - dp_soil_layer_pressed(layers, count, n, depth);
}

static double thickness(const DpLayer* layers, int count, int place, double depth)
{
    for (int n = 0; n + 1 < count; ++n)
        if (layers[n].place == place) return left_of(layers, count, n, depth);
    return 0.0;
}

// How much of what is seen of a cell without coats is of a soil: each layer hides what lies below.
static double seen_bare(const DpLayer* layers, int count, int name, double depth, double heap)
{
    double seen = 0.0, through = 1.0;
    for (int n = 0; n < count && through > 0.0; ++n) {
        const double left = left_of(layers, count, n, depth) + (n == 0 ? heap : 0.0);
        const double hides = n + 1 < count ? fmin(left / DP_COVERS, 1.0) : 1.0;  // MODEL 6.17
        if (layers[n].name == name) seen += through * hides;
        through *= 1.0 - hides;
    }
    return seen;
}

static DpStatus add_coats(const DpSim* sim, int name, const DpCellRect* at, Cells* cells,
                          float* one)
{
    const int    nx = (int)(at->i1 - at->i0), ny = (int)(at->j1 - at->j0);
    const size_t count = (size_t)nx * (size_t)ny;
    const int*   soil = NULL;
    DpStatus     status = DP_OK;
    for (int k = 0; k < dp_terrain_coats(sim->terrain, &soil) && status == DP_OK; ++k) {
        int            layers;
        const DpLayer* top = dp_terrain_layers(sim->terrain, soil[k], &layers);
        const int      own = top ? top->name : soil[k];
        status = dp_terrain_read(sim->terrain, DP_FIELD_COAT + own, at->i0, at->j0, nx, ny, one);
        for (size_t n = 0; n < count && status == DP_OK; ++n) {
            cells->coats[n] += one[n];
            if (own == name) cells->own[n] = one[n];
        }
    }
    return status;
}

static DpStatus read_cells(const DpSim* sim, int field, const DpCellRect* at, Cells* cells,
                           float* one)
{
    const struct
    {
        int    field;
        float* out;
    } grid[] = {{DP_FIELD_KIND, cells->kind},
                {DP_FIELD_COMPRESSION, cells->compression},
                {DP_FIELD_HEAP, cells->heap}};
    const int nx = (int)(at->i1 - at->i0), ny = (int)(at->j1 - at->j0);
    DpStatus  status = DP_OK;
    for (int k = 0; k < 3 && status == DP_OK; ++k)
        status = dp_terrain_read(sim->terrain, grid[k].field, at->i0, at->j0, nx, ny, grid[k].out);
    if (status != DP_OK || field >= DP_FIELD_LAYER) return status;
    return add_coats(sim, field - DP_FIELD_SURFACE, at, cells, one);
}

DpStatus dp_sim_layers(const DpSim* sim, int field, const DpCellRect* at, float* out)
{
    const size_t count = (size_t)(at->i1 - at->i0) * (size_t)(at->j1 - at->j0);
    float* const room = dp_alloc(GRIDS * count, sizeof *room);
    if (!room) return DP_NO_MEMORY;
    Cells cells = {room, room + count, room + 2 * count, room + 3 * count, room + 4 * count};
    const DpStatus status = read_cells(sim, field, at, &cells, out);
    for (size_t n = 0; n < count && status == DP_OK; ++n) {
        int            layers;
        const DpLayer* layer = dp_terrain_layers(sim->terrain, (int)cells.kind[n], &layers);
        const double   depth = (double)cells.compression[n];
        if (field >= DP_FIELD_LAYER) {
            out[n] = (float)thickness(layer, layers, field - DP_FIELD_LAYER, depth);
            continue;
        }
        const int    name = field - DP_FIELD_SURFACE;
        const double all = (double)cells.coats[n], hides = fmin(all / DP_COVERS, 1.0);
        const double bare = layer ? seen_bare(layer, layers, name, depth, (double)cells.heap[n])
                                  : (double)((int)cells.kind[n] == name);
        out[n] =
            (float)((1.0 - hides) * bare + (all > 0.0 ? hides * (double)cells.own[n] / all : 0.0));
    }
    dp_free(room);
    return status;
}
