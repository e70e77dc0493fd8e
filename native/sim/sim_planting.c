// sim/sim_planting.c - plants come onto the ground, are looked at, and rest. TRAIL 4.1
#include <math.h>

#include "base/alloc.h"
#include "sim/sim_inside.h"

static void cover_of(const void* context, double x0, double y0, double cell, int nx, int ny,
                     float* strength, float* roots)
{
    const DpPlantWindow window = {nx, ny, nx, cell, x0, y0};
    dp_plants_cover(context, &window, DP_COVER_FULL, strength, roots);
}

static DpStemLean lean_at(const void* context, double x, double y)
{
    return dp_grass_stem_at(context, x, y);
}

static void measure(PlantStage* stage)
{
    stage->extent = dp_plants_extent(stage->plants);
    stage->root_radius = dp_plants_root_radius(stage->plants);
}

DpStatus dp_sim_plant(DpSim* sim, DpPlants* plants)
{
    if (!sim || !plants || sim->stage.plants || sim->limb) return DP_BAD_ARGUMENT;
    DpGrass* grass = NULL;
    DpStatus status = dp_grass_create(&grass, plants, sim->grid);
    if (status == DP_OK) status = dp_terrain_set_cover(sim->terrain, cover_of, plants);
    if (status != DP_OK) {
        dp_grass_destroy(grass);
        return status;
    }
    sim->stage.plants = plants, sim->stage.grass = grass;
    measure(&sim->stage);
    return DP_OK;
}

DpGrass* dp_sim_grass(const DpSim* sim)
{
    return sim->stage.grass;
}

DpStatus dp_sim_display(const PlantStage* stage, DpPlantDisplay** display)
{
    return dp_plant_display_create(display, stage->plants, lean_at, stage->grass);
}

DpStatus dp_sim_lay(DpSim* sim)
{
    PlantStage* m = &sim->stage;
    if (!m->plants) return DP_BAD_ARGUMENT;
    return m->display ? DP_OK : dp_sim_display(m, &m->display);
}

// from heights over the terrain's base
static void in_the_world(const DpSim* sim, int stand, float* position)
{
    const double base = dp_terrain_datum(sim->terrain);
    const int    count = dp_plants_shape(sim->stage.plants, stand).particles;
    for (int n = 0; n < count; ++n)
        position[3 * n + 2] = (float)((double)position[3 * n + 2] + base);
}

DpStatus dp_sim_shown(const DpSim* sim, int stand, int plant, float* position)
{
    const PlantStage* m = &sim->stage;
    if (!m->plants) return DP_BAD_ARGUMENT;
    const DpPlantGround ground = {
        .cell = sim->grid.cell, .at = dp_sim_surface, .context = sim->terrain};
    const DpStatus status = m->display
                                ? dp_plant_display_read(m->display, &ground, stand, plant, position)
                                : dp_plants_read(m->plants, stand, plant, position, NULL, NULL);
    if (status == DP_OK) in_the_world(sim, stand, position);
    return status;
}

DpStatus dp_sim_stands(const DpSim* sim, int stand, int plant, float* position)
{
    if (!sim->stage.plants) return DP_BAD_ARGUMENT;
    const DpStatus status = dp_plants_read(sim->stage.plants, stand, plant, position, NULL, NULL);
    if (status == DP_OK) in_the_world(sim, stand, position);
    return status;
}

// plants have come or grown within a box [m] around their roots
static void planted(DpSim* sim, const double box[4])
{
    measure(&sim->stage);
    const double r = sim->stage.root_radius;
    dp_sim_cover_anew(sim, box[0] - r, box[1] - r, box[2] + r, box[3] + r);
    dp_grass_grown(sim->stage.grass, box[0] - r, box[1] - r, box[2] + r, box[3] + r);
}

// The root on the base ground and the slope there; false where there is none.
static bool stand_on(const DpSim* sim, const DpPlantKind* kind, const float xy[2], float root[3],
                     float slope[2])
{
    const double d = fmax(sim->grid.cell, 0.5 * (double)fmaxf(kind->width, kind->depth));
    const double x = (double)xy[0], y = (double)xy[1];
    const double at[10] = {x, y, x - d, y, x + d, y, x, y - d, x, y + d};
    double       z[5];
    dp_terrain_base_height(sim->terrain, 5, at, z);
    if (!isfinite(z[0])) return false;
    root[0] = xy[0], root[1] = xy[1], root[2] = (float)(z[0] - dp_terrain_datum(sim->terrain));
    for (int k = 0; k < 2; ++k) {  // one-sided at an edge
        const double low = z[1 + 2 * k], high = z[2 + 2 * k];
        const double across = (high - low) / (2.0 * d);
        const double aside = isfinite(high) ? (high - z[0]) / d : (z[0] - low) / d;
        slope[k] = (float)(isfinite(across) ? across : isfinite(aside) ? aside : 0.0);
    }
    return true;
}

DpStatus dp_sim_grow(DpSim* sim, const DpPlantKind* kind, const float* xy, int count, int* stand,
                     int* grown)
{
    if (!sim || !sim->stage.plants || !xy || count < 0 || !stand || !grown ||
        dp_plant_kind_check(kind, NULL) != DP_OK)
        return DP_BAD_ARGUMENT;
    *stand = -1, *grown = 0;
    float*   root = dp_alloc((size_t)count + 1, 3 * sizeof *root);
    float*   slope = dp_alloc((size_t)count + 1, 2 * sizeof *slope);
    DpStatus status = root && slope ? DP_OK : DP_NO_MEMORY;
    double   box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    int      n = 0;
    for (int k = 0; k < count && status == DP_OK; ++k) {
        if (!(fabsf(xy[2 * k]) < 1e7f && fabsf(xy[2 * k + 1]) < 1e7f)) status = DP_BAD_ARGUMENT;
        if (status != DP_OK || !stand_on(sim, kind, xy + 2 * k, root + 3 * n, slope + 2 * n))
            continue;
        for (int d = 0; d < 2; ++d) {
            box[d] = fmin(box[d], (double)xy[2 * k + d]);
            box[2 + d] = fmax(box[2 + d], (double)xy[2 * k + d]);
        }
        ++n;
    }
    if (status == DP_OK && n > 0)
        status = dp_plants_add(sim->stage.plants, kind, root, NULL, n, stand);
    if (status == DP_OK && n > 0) {
        status = dp_plants_slope(sim->stage.plants, *stand, slope);
        *grown = n;
        planted(sim, box);
    }
    dp_free(root), dp_free(slope);
    return status;
}

DpStatus dp_sim_pass_time(DpSim* sim, double seconds)
{
    if (!sim->stage.plants) return DP_OK;
    const DpStatus status = dp_plants_advance_time(sim->stage.plants, seconds);
    if (status != DP_OK) return status;
    planted(sim, (const double[4]){-1e9, -1e9, 1e9, 1e9});
    return seconds > 0.0 ? dp_grass_step(sim->stage.grass, NULL, NULL, 0, seconds) : DP_OK;
}

double dp_stage_margin(const DpSim* sim)
{
    return fmin(sim->stage.extent + sim->stage.root_radius, DP_STAGE_MARGIN);
}

DpStatus dp_stage_fit(DpSim* sim, int parts, int limbs)
{
    PlantStage* m = &sim->stage;
    if (!m->plants) return DP_OK;
    m->parts = parts, m->limbs = limbs;
    m->swept = dp_alloc(2 * (size_t)parts, sizeof *m->swept);
    for (int n = 0; m->swept && n < 2 * parts; ++n) m->swept[n].sample = -1;
    m->sole = dp_alloc((size_t)parts, sizeof *m->sole);
    m->ground = dp_alloc((size_t)limbs, sizeof *m->ground);
    m->height = dp_alloc((size_t)limbs, sizeof *m->height);
    const bool valid = m->swept && m->sole && m->ground && m->height;
    return valid ? DP_OK : DP_NO_MEMORY;
}

void dp_stage_drop(DpSim* sim)
{
    PlantStage* m = &sim->stage;
    for (int n = 0; m->swept && n < 2 * m->parts; ++n) {
        dp_free(m->swept[n].imprint.bottom);
        dp_free(m->swept[n].imprint.cover);
    }
    for (int l = 0; m->height && l < m->limbs; ++l) dp_free(m->height[l]);
    dp_free(m->swept), dp_free(m->sole), dp_free(m->ground), dp_free(m->height);
    *m = dp_stage_empty(m);
}
