// sim/sim_layers.c - how thick layers of the ground still are where it was pressed. MODEL 6.17
#include "base/alloc.h"
#include "sim/sim_inside.h"

bool dp_sim_has_layer(const DpSim* sim, int layer)
{
    bool any = false;
    for (int k = 0; k < dp_terrain_soil_count(sim->terrain) && layer >= 0; ++k) {
        int count;
        if (dp_terrain_layers(sim->terrain, k, &count)) any = any || layer + 1 < count;
    }
    return any;
}

DpStatus dp_sim_layer(const DpSim* sim, int layer, const DpCellRect* at, float* out)
{
    const int    nx = (int)(at->i1 - at->i0), ny = (int)(at->j1 - at->j0);
    const size_t cells = (size_t)nx * (size_t)ny;
    float* const kind = dp_alloc(cells, sizeof *kind);
    if (!kind) return DP_NO_MEMORY;
    DpStatus status =
        dp_terrain_read(sim->terrain, DP_FIELD_COMPRESSION, at->i0, at->j0, nx, ny, out);
    if (status == DP_OK)
        status = dp_terrain_read(sim->terrain, DP_FIELD_KIND, at->i0, at->j0, nx, ny, kind);
    for (size_t n = 0; n < cells && status == DP_OK; ++n) {
        int            count;
        const DpLayer* layers = dp_terrain_layers(sim->terrain, (int)kind[n], &count);
        const bool     there = layers && layer + 1 < count;  // the last is the ground below
        const double   thick = there ? layers[layer].thickness : 0.0;
        const double   gone =
            there ? dp_soil_layer_pressed(layers, count, layer, (double)out[n]) : 0.0;
        out[n] = (float)(thick - gone);
    }
    dp_free(kind);
    return status;
}
