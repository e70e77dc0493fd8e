// sim/sim_plants.c - what plants do in a step, once the soil has moved: roots follow the surface,
// soles press and brush, stems wear, and cover changes what the next step presses. TRAIL 4.1
//
// The soles are those that press the soil, where the pressed soil holds them: never below it. Feet
// in swing brush what they come near to.
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define FOOT_HIGH 0.15     // above its sole a foot is at least so high [m]
#define FRICTION 0.5       // of leaves on a sole [-]
#define RISE_TIME 0.1      // in which a sole that let go is where it was recorded [s]
#define SETTLED_MARGIN 16  // cells around trodden ground whose soil came to rest

// the surface around a limb: what its soles can push plants onto, and what its soil moved
static DpStatus take_ground(DpSim* sim, const Limb* limb, DpCellRect near)
{
    PlantStage* m = &sim->stage;
    DpCellRect  at = near;
    if (limb->active) {
        const long       spare = limb->lifts ? SETTLED_MARGIN : 0;
        const DpCellRect soil = {limb->patch.i0 - spare, limb->patch.i1 + spare,
                                 limb->patch.j0 - spare, limb->patch.j1 + spare};
        if (!dp_cells_empty(limb->patch)) at = dp_cells_join(at, soil);
    }
    if (dp_cells_empty(at)) return DP_OK;
    const DpStatus status = dp_terrain_touch(sim->terrain, at);
    if (status != DP_OK) return status;
    const int    l = m->grounds, nx = (int)(at.i1 - at.i0), ny = (int)(at.j1 - at.j0);
    const size_t cells = (size_t)nx * (size_t)ny;
    if (!dp_make_room(&m->height[l], cells, sizeof *m->height[l])) return DP_NO_MEMORY;
    dp_terrain_surface(sim->terrain, at.i0, at.j0, nx, ny, m->height[l]);
    m->ground[l] = (DpPlantGround){.nx = nx,
                                   .ny = ny,
                                   .row = nx,
                                   .cell = sim->grid.cell,
                                   .x0 = dp_grid_x(&sim->grid, at.i0),
                                   .y0 = dp_grid_y(&sim->grid, at.j0),
                                   .height = m->height[l],
                                   .rose = limb->lifts};
    ++m->grounds;
    return DP_OK;
}

// height of the surface at a cell of the ground taken last, -inf where there is none
static float surface_at(const DpPlantGround* ground, long i, long j)
{
    if (i < 0 || j < 0 || i >= ground->nx || j >= ground->ny) return -INFINITY;
    const float height = ground->height[j * ground->row + i];
    return isfinite(height) ? height : -INFINITY;
}

// a part's underside at the end of the step, lowered as its limb is, on the ground and not in it
static void take_sole(DpSim* sim, const Limb* limb, SweptSole* swept, double was, double dt)
{
    PlantStage*          m = &sim->stage;
    const DpPlantGround* ground = &m->ground[m->grounds - 1];
    const DpImprint*     imprint = &swept->imprint;
    const int            nx = (int)(swept->at.i1 - swept->at.i0);
    const int            ny = (int)(swept->at.j1 - swept->at.j0);
    const double         x0 = dp_grid_x(&sim->grid, swept->at.i0);
    const double         y0 = dp_grid_y(&sim->grid, swept->at.j0);
    const long           di = lround((x0 - ground->x0) / sim->grid.cell);
    const long           dj = lround((y0 - ground->y0) / sim->grid.cell);
    if (imprint->i0 >= imprint->i1) return;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            float* bottom = &imprint->bottom[j * nx + i];
            if (isfinite(*bottom))
                *bottom = fmaxf(*bottom - (float)limb->lowered, surface_at(ground, i + di, j + dj));
        }
    DpVec3 moved = swept->displacement;
    moved.z -= swept->jumps ? 0.0 : limb->lowered - was;
    m->sole[m->soles++] =
        (DpPlantCollider){.nx = nx,
                          .ny = ny,
                          .row = nx,
                          .cell = sim->grid.cell,
                          .x0 = x0,
                          .y0 = y0,
                          .bottom = imprint->bottom,
                          .thickness = fmax(FOOT_HIGH, swept->to.z1 - swept->to.z0),
                          .velocity = dp_scale(moved, 1.0 / dt),
                          .friction = FRICTION};
}

// so low that plants can meet it; not where there is no ground
static bool is_near(const DpSim* sim, const Limb* limb, const SweptSole* swept)
{
    return swept->low - fmax(limb->lowered, 0.0) < swept->ground + sim->stage.extent;
}

// a limb's soles and the ground around them
static DpStatus take_limb(DpSim* sim, Limb* limb, int sample, double dt)
{
    PlantStage*  m = &sim->stage;
    const double was = limb->lowered, margin = fmin(m->extent, DP_STAGE_MARGIN);
    const int    grounds = m->grounds;
    DpCellRect   near = {0, 0, 0, 0};
    limb->lowered = limb->stands ? limb->sink : was * exp(-dt / RISE_TIME);
    for (int p = 0; p < limb->part_count; ++p) {
        const SweptSole* swept = dp_sweep_path(sim, limb->part[p], sample);
        const DpBox      a = swept->from, b = swept->to;
        if (!is_near(sim, limb, swept)) continue;
        near = dp_cells_join(near,
                             dp_sim_cells(sim, fmin(a.x0, b.x0) - margin, fmin(a.y0, b.y0) - margin,
                                          fmax(a.x1, b.x1) + margin, fmax(a.y1, b.y1) + margin));
    }
    DpStatus status = take_ground(sim, limb, near);
    for (int p = 0; p < limb->part_count && m->grounds > grounds && status == DP_OK; ++p) {
        SweptSole* swept = dp_sweep_path(sim, limb->part[p], sample);
        if (!is_near(sim, limb, swept)) continue;
        status = dp_sweep_cast(sim, swept, limb->part[p], sim->scratch[0].imprint_scratch);
        if (status == DP_OK) take_sole(sim, limb, swept, was, dt);
    }
    return status;
}

// What goes on at once: plants move, the lean meets the same soles; for the next step limbs press
// ahead and soles are cast. None reads what another writes.
typedef struct Moving
{
    DpSim*               sim;
    int                  sample;
    const DpPlantGround* ground;
    double               dt;
    int                  ahead;  // limbs
    DpPlantsReport       report;
    DpStatus             status[2];
} Moving;

static void move(void* context, int index, int worker)
{
    Moving*           moving = context;
    DpSim*            sim = moving->sim;
    const PlantStage* m = &sim->stage;
    if (index == 0)
        moving->status[0] = dp_plants_step(m->plants, moving->ground, m->sole, m->soles, moving->dt,
                                           sim->worker_count, &moving->report);
    else if (index == 1)
        moving->status[1] = dp_grass_step(m->grass, moving->ground, m->sole, m->soles, moving->dt);
    else if (index < 2 + moving->ahead)
        dp_speculate_press(sim, moving->sample + 1, index - 2, &sim->scratch[worker]);
    else
        dp_sweep_ahead(sim, index - 2 - moving->ahead, moving->sample + 1,
                       sim->scratch[worker].imprint_scratch);
}

// soil has come to rest where limbs had trodden, and nothing moves any more
DpStatus dp_stage_settled(DpSim* sim, Limb* limb)
{
    PlantStage* m = &sim->stage;
    if (!m->plants) return DP_OK;
    const DpPlantGround elsewhere = {
        .cell = sim->grid.cell, .at = dp_sim_surface, .context = sim->terrain};
    m->grounds = 0;
    limb->patch = limb->trodden, limb->active = limb->lifts = true;
    const DpStatus status = take_ground(sim, limb, (DpCellRect){0, 0, 0, 0});
    limb->active = limb->lifts = false;
    if (status != DP_OK || m->grounds == 0) return status;
    m->ground[0].next = &elsewhere;
    return dp_plants_follow(m->plants, m->ground);
}

DpStatus dp_stage_step(DpSim* sim, int sample, bool more)
{
    PlantStage*  m = &sim->stage;
    const double dt = dp_sim_interval(sim, sample);
    DpStatus     status = DP_OK;
    m->soles = m->grounds = 0;
    for (int l = 0; l < sim->cast.limbs && status == DP_OK; ++l)
        status = take_limb(sim, &sim->limb[l], sample, dt);
    if (status != DP_OK) return status;
    const DpPlantGround elsewhere = {
        .cell = sim->grid.cell, .at = dp_sim_surface, .context = sim->terrain};
    for (int g = 0; g < m->grounds; ++g)
        m->ground[g].next = g + 1 < m->grounds ? &m->ground[g + 1] : &elsewhere;
    const DpPlantGround* ground = m->grounds > 0 ? m->ground : &elsewhere;
    int                  ahead = 0;
    status = dp_plants_follow(m->plants, ground);
    if (status == DP_OK) status = dp_grass_ready(m->grass, m->sole, m->soles);
    if (status == DP_OK && more && sim->worker_count > 1)
        status = dp_speculate_open(sim, sample + 1, &ahead);
    if (status != DP_OK) return status;

    Moving    moving = {.sim = sim, .sample = sample, .ground = ground, .dt = dt, .ahead = ahead};
    const int soles_ahead = more && sim->worker_count > 1 ? m->parts : 0;
    dp_parallel_for(2 + ahead + soles_ahead, sim->worker_count, move, &moving);
    for (int k = 0; k < 2; ++k)
        if (moving.status[k] != DP_OK) return moving.status[k];
    const DpPlantsReport report = moving.report;
    sim->report.awake = report.awake;
    sim->report.broke += report.broke;
    for (int k = 0; k < report.changes && status == DP_OK; ++k) {
        const DpPlantBox box = report.box[k];
        dp_sim_cover_anew(sim, box.x0, box.y0, box.x1, box.y1);  // TRAIL (9), in the next step
        dp_speculate_worn(sim, box.x0, box.y0, box.x1, box.y1);
        status = dp_grass_worn(m->grass, box.x0, box.y0, box.x1, box.y1);
    }
    if (status == DP_OK && m->display) status = dp_plant_display_step(m->display);
    return status;
}
