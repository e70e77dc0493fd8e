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
#define MARGIN_MOST 0.5    // beside a sole [m]
#define SETTLED_MARGIN 16  // cells around trodden ground whose soil came to rest

// ---- a life ----------------------------------------------------------------------------------

static void cover_of(const void* context, double x0, double y0, double cell, int nx, int ny,
                     float* strength, float* roots)
{
    const DpPlantWindow window = {nx, ny, nx, cell, x0, y0};
    dp_plants_cover(context, &window, DP_COVER_FULL, strength, roots);
}

static void measure(Meadow* meadow)
{
    meadow->extent = dp_plants_extent(meadow->plants);
    meadow->reach = dp_plants_reach(meadow->plants);
}

DpStatus dp_sim_plant(DpSim* sim, DpPlants* plants)
{
    if (!sim || !plants || sim->meadow.plants || sim->limb) return DP_BAD_ARGUMENT;
    DpLean*  lean = NULL;
    DpStatus status = dp_lean_create(&lean, plants, sim->cell, sim->origin_x, sim->origin_y);
    if (status == DP_OK) status = dp_terrain_set_cover(sim->terrain, cover_of, plants);
    if (status != DP_OK) {
        dp_lean_destroy(lean);
        return status;
    }
    sim->meadow.plants = plants, sim->meadow.lean = lean;
    measure(&sim->meadow);
    return DP_OK;
}

DpLean* dp_sim_lean(const DpSim* sim)
{
    return sim->meadow.lean;
}

DpStatus dp_sim_lay(DpSim* sim)
{
    Meadow* m = &sim->meadow;
    if (!m->plants) return DP_BAD_ARGUMENT;
    return m->laid ? DP_OK : dp_laid_create(&m->laid, m->plants, m->lean);
}

// where no limb is near, plants still stand and lie on the ground
static double surface(const void* terrain, double x, double y)
{
    return dp_terrain_surface_at(terrain, x, y);
}

// from heights over the terrain's base
static void in_the_world(const DpSim* sim, int stand, float* position)
{
    const double base = dp_terrain_datum(sim->terrain);
    const int    count = dp_plants_shape(sim->meadow.plants, stand).particles;
    for (int n = 0; n < count; ++n)
        position[3 * n + 2] = (float)((double)position[3 * n + 2] + base);
}

DpStatus dp_sim_shown(const DpSim* sim, int stand, int plant, float* position)
{
    const Meadow* m = &sim->meadow;
    if (!m->plants) return DP_BAD_ARGUMENT;
    const DpPlantGround ground = {.cell = sim->cell, .at = surface, .context = sim->terrain};
    const DpStatus      status = m->laid ? dp_laid_read(m->laid, &ground, stand, plant, position)
                                         : dp_plants_read(m->plants, stand, plant, position, NULL, NULL);
    if (status == DP_OK) in_the_world(sim, stand, position);
    return status;
}

DpStatus dp_sim_stands(const DpSim* sim, int stand, int plant, float* position)
{
    if (!sim->meadow.plants) return DP_BAD_ARGUMENT;
    const DpStatus status = dp_plants_read(sim->meadow.plants, stand, plant, position, NULL, NULL);
    if (status == DP_OK) in_the_world(sim, stand, position);
    return status;
}

Cells dp_sim_cells(const DpSim* sim, double x0, double y0, double x1, double y1)
{
    const double most = 1e9;
    const Cells cells = {(long)dp_clamp(floor((x0 - sim->origin_x) / sim->cell - 0.5), -most, most),
                         (long)dp_clamp(ceil((x1 - sim->origin_x) / sim->cell + 0.5), -most, most),
                         (long)dp_clamp(floor((y0 - sim->origin_y) / sim->cell - 0.5), -most, most),
                         (long)dp_clamp(ceil((y1 - sim->origin_y) / sim->cell + 0.5), -most, most)};
    return cells;
}

// the ground asks again for its cover within a box [m]
static void cover_anew(DpSim* sim, double x0, double y0, double x1, double y1)
{
    const Cells at = dp_sim_cells(sim, x0, y0, x1, y1);
    dp_terrain_refresh_cover(sim->terrain, at.i0, at.i1, at.j0, at.j1);
}

// plants have come or grown within a box [m] around their roots
static void planted(DpSim* sim, const double box[4])
{
    measure(&sim->meadow);
    const double r = sim->meadow.reach;
    cover_anew(sim, box[0] - r, box[1] - r, box[2] + r, box[3] + r);
    dp_lean_grown(sim->meadow.lean, box[0] - r, box[1] - r, box[2] + r, box[3] + r);
}

// The root on the rest ground and the slope there; false where there is none.
static bool stand_on(const DpSim* sim, const DpPlantKind* kind, const float xy[2], float root[3],
                     float slope[2])
{
    const double d = fmax(sim->cell, 0.5 * (double)fmaxf(kind->width, kind->depth));
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
    if (!sim || !sim->meadow.plants || !xy || count < 0 || !stand || !grown ||
        dp_plant_kind_check(kind) != DP_OK)
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
        status = dp_plants_add(sim->meadow.plants, kind, root, NULL, n, stand);
    if (status == DP_OK && n > 0) {
        status = dp_plants_slope(sim->meadow.plants, *stand, slope);
        *grown = n;
        planted(sim, box);
    }
    dp_free(root), dp_free(slope);
    return status;
}

DpStatus dp_sim_rest(DpSim* sim, double seconds)
{
    if (!sim->meadow.plants) return DP_OK;
    const DpStatus status = dp_plants_rest(sim->meadow.plants, seconds);
    if (status != DP_OK) return status;
    planted(sim, (const double[4]){-1e9, -1e9, 1e9, 1e9});
    return seconds > 0.0 ? dp_lean_step(sim->meadow.lean, NULL, NULL, 0, seconds) : DP_OK;
}

double dp_meadow_margin(const DpSim* sim)
{
    return fmin(sim->meadow.extent + sim->meadow.reach, MARGIN_MOST);
}

DpStatus dp_meadow_fit(DpSim* sim, int parts, int limbs)
{
    Meadow* m = &sim->meadow;
    if (!m->plants) return DP_OK;
    m->parts = parts, m->limbs = limbs;
    m->shadow = dp_alloc(2 * (size_t)parts, sizeof *m->shadow);
    for (int n = 0; m->shadow && n < 2 * parts; ++n) m->shadow[n].sample = -1;
    m->sole = dp_alloc((size_t)parts, sizeof *m->sole);
    m->ground = dp_alloc((size_t)limbs, sizeof *m->ground);
    m->height = dp_alloc((size_t)limbs, sizeof *m->height);
    m->height_room = dp_alloc((size_t)limbs, sizeof *m->height_room);
    const bool whole = m->shadow && m->sole && m->ground && m->height && m->height_room;
    return whole ? DP_OK : DP_NO_MEMORY;
}

void dp_meadow_drop(DpSim* sim)
{
    Meadow* m = &sim->meadow;
    for (int n = 0; m->shadow && n < 2 * m->parts; ++n) {
        dp_free(m->shadow[n].imprint.bottom);
        dp_free(m->shadow[n].imprint.cover);
    }
    for (int l = 0; m->height && l < m->limbs; ++l) dp_free(m->height[l]);
    dp_free(m->shadow), dp_free(m->sole), dp_free(m->ground), dp_free(m->height),
        dp_free(m->height_room);
    *m = (Meadow){.plants = m->plants,
                  .lean = m->lean,
                  .laid = m->laid,
                  .extent = m->extent,
                  .reach = m->reach};
}

static bool make_room(float** grid, size_t* room, size_t cells)
{
    if (cells <= *room) return true;
    dp_free(*grid);
    *room = cells + cells / 4;
    *grid = dp_alloc(*room, sizeof **grid);
    if (!*grid) *room = 0;
    return *grid != NULL;
}

// ---- a step ----------------------------------------------------------------------------------

// the surface around a limb: what its soles can push plants onto, and what its soil moved
static DpStatus take_ground(DpSim* sim, const Limb* limb, Cells near)
{
    Meadow* m = &sim->meadow;
    Cells   at = near;
    if (limb->active) {
        const long  spare = limb->lifts ? SETTLED_MARGIN : 0;
        const Cells soil = {limb->patch.i0 - spare, limb->patch.i1 + spare, limb->patch.j0 - spare,
                            limb->patch.j1 + spare};
        if (!dp_cells_empty(limb->patch)) at = dp_cells_join(at, soil);
    }
    if (dp_cells_empty(at)) return DP_OK;
    const DpStatus status = dp_terrain_touch(sim->terrain, at.i0, at.i1, at.j0, at.j1);
    if (status != DP_OK) return status;
    const int l = m->grounds, nx = (int)(at.i1 - at.i0), ny = (int)(at.j1 - at.j0);
    if (!make_room(&m->height[l], &m->height_room[l], (size_t)nx * (size_t)ny)) return DP_NO_MEMORY;
    dp_terrain_surface(sim->terrain, at.i0, at.j0, nx, ny, m->height[l]);
    m->ground[l] = (DpPlantGround){.nx = nx,
                                   .ny = ny,
                                   .row = nx,
                                   .cell = sim->cell,
                                   .x0 = sim->origin_x + ((double)at.i0 + 0.5) * sim->cell,
                                   .y0 = sim->origin_y + ((double)at.j0 + 0.5) * sim->cell,
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
static void take_sole(DpSim* sim, const Limb* limb, Shadow* shadow, double was, double dt)
{
    Meadow*              m = &sim->meadow;
    const DpPlantGround* ground = &m->ground[m->grounds - 1];
    const DpImprint*     imprint = &shadow->imprint;
    const int            nx = (int)(shadow->at.i1 - shadow->at.i0);
    const int            ny = (int)(shadow->at.j1 - shadow->at.j0);
    const double         x0 = sim->origin_x + ((double)shadow->at.i0 + 0.5) * sim->cell;
    const double         y0 = sim->origin_y + ((double)shadow->at.j0 + 0.5) * sim->cell;
    const long           di = lround((x0 - ground->x0) / sim->cell);
    const long           dj = lround((y0 - ground->y0) / sim->cell);
    if (imprint->i0 >= imprint->i1) return;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            float* bottom = &imprint->bottom[j * nx + i];
            if (isfinite(*bottom))
                *bottom = fmaxf(*bottom - (float)limb->lowered, surface_at(ground, i + di, j + dj));
        }
    DpVec3 moved = shadow->way;
    moved.z -= shadow->jumps ? 0.0 : limb->lowered - was;
    m->sole[m->soles++] =
        (DpPlantCollider){.nx = nx,
                          .ny = ny,
                          .row = nx,
                          .cell = sim->cell,
                          .x0 = x0,
                          .y0 = y0,
                          .bottom = imprint->bottom,
                          .thickness = fmax(FOOT_HIGH, shadow->to.z1 - shadow->to.z0),
                          .velocity = dp_scale(moved, 1.0 / dt),
                          .friction = FRICTION};
}

// so low that plants can meet it; not where there is no ground
static bool is_near(const DpSim* sim, const Limb* limb, const Shadow* shadow)
{
    return shadow->low - fmax(limb->lowered, 0.0) < shadow->ground + sim->meadow.extent;
}

// a limb's soles and the ground around them
static DpStatus take_limb(DpSim* sim, Limb* limb, int sample, double dt)
{
    Meadow*      m = &sim->meadow;
    const double was = limb->lowered, margin = fmin(m->extent, MARGIN_MOST);
    const int    grounds = m->grounds;
    Cells        near = {0, 0, 0, 0};
    limb->lowered = limb->stands ? limb->sink : was * exp(-dt / RISE_TIME);
    for (int p = 0; p < limb->part_count; ++p) {
        const Shadow* shadow = dp_shadow_way(sim, limb->part[p], sample);
        const DpBox   a = shadow->from, b = shadow->to;
        if (!is_near(sim, limb, shadow)) continue;
        near = dp_cells_join(near,
                             dp_sim_cells(sim, fmin(a.x0, b.x0) - margin, fmin(a.y0, b.y0) - margin,
                                          fmax(a.x1, b.x1) + margin, fmax(a.y1, b.y1) + margin));
    }
    DpStatus status = take_ground(sim, limb, near);
    for (int p = 0; p < limb->part_count && m->grounds > grounds && status == DP_OK; ++p) {
        Shadow* shadow = dp_shadow_way(sim, limb->part[p], sample);
        if (!is_near(sim, limb, shadow)) continue;
        status = dp_shadow_cast(sim, shadow, limb->part[p], sim->bench[0].imprint_scratch);
        if (status == DP_OK) take_sole(sim, limb, shadow, was, dt);
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
    DpPlantsTold         told;
    DpStatus             status[2];
} Moving;

static void move(void* context, int index, int worker)
{
    Moving*       moving = context;
    DpSim*        sim = moving->sim;
    const Meadow* m = &sim->meadow;
    if (index == 0)
        moving->status[0] = dp_plants_step(m->plants, moving->ground, m->sole, m->soles, moving->dt,
                                           sim->bench_count, &moving->told);
    else if (index == 1)
        moving->status[1] = dp_lean_step(m->lean, moving->ground, m->sole, m->soles, moving->dt);
    else if (index < 2 + moving->ahead)
        dp_ahead_press(sim, moving->sample + 1, index - 2, &sim->bench[worker]);
    else
        dp_shadow_ahead(sim, index - 2 - moving->ahead, moving->sample + 1,
                        sim->bench[worker].imprint_scratch);
}

// soil has come to rest where limbs had trodden, and nothing moves any more
DpStatus dp_meadow_settled(DpSim* sim, Limb* limb)
{
    Meadow* m = &sim->meadow;
    if (!m->plants) return DP_OK;
    const DpPlantGround elsewhere = {.cell = sim->cell, .at = surface, .context = sim->terrain};
    m->grounds = 0;
    limb->patch = limb->trodden, limb->active = limb->lifts = true;
    const DpStatus status = take_ground(sim, limb, (Cells){0, 0, 0, 0});
    limb->active = limb->lifts = false;
    if (status != DP_OK || m->grounds == 0) return status;
    m->ground[0].next = &elsewhere;
    return dp_plants_follow(m->plants, m->ground);
}

DpStatus dp_meadow_step(DpSim* sim, int sample, bool more)
{
    Meadow*      m = &sim->meadow;
    const double dt = sim->time[sample + 1] - sim->time[sample];
    DpStatus     status = DP_OK;
    m->soles = m->grounds = 0;
    for (int l = 0; l < sim->gait.limbs && status == DP_OK; ++l)
        status = take_limb(sim, &sim->limb[l], sample, dt);
    if (status != DP_OK) return status;
    const DpPlantGround elsewhere = {.cell = sim->cell, .at = surface, .context = sim->terrain};
    for (int g = 0; g < m->grounds; ++g)
        m->ground[g].next = g + 1 < m->grounds ? &m->ground[g + 1] : &elsewhere;
    const DpPlantGround* ground = m->grounds > 0 ? m->ground : &elsewhere;
    int                  ahead = 0;
    status = dp_plants_follow(m->plants, ground);
    if (status == DP_OK) status = dp_lean_ready(m->lean, m->sole, m->soles);
    if (status == DP_OK && more && sim->bench_count > 1)
        status = dp_ahead_open(sim, sample + 1, &ahead);
    if (status != DP_OK) return status;

    Moving    moving = {.sim = sim, .sample = sample, .ground = ground, .dt = dt, .ahead = ahead};
    const int shadows = more && sim->bench_count > 1 ? m->parts : 0;
    dp_parallel_for(2 + ahead + shadows, sim->bench_count, move, &moving);
    for (int k = 0; k < 2; ++k)
        if (moving.status[k] != DP_OK) return moving.status[k];
    const DpPlantsTold told = moving.told;
    sim->report.awake = told.awake;
    sim->report.broke += told.broke;
    for (int k = 0; k < told.changes && status == DP_OK; ++k) {
        const DpPlantBox box = told.box[k];
        cover_anew(sim, box.x0, box.y0, box.x1, box.y1);  // TRAIL (9), in the next step
        dp_ahead_worn(sim, box.x0, box.y0, box.x1, box.y1);
        status = dp_lean_worn(m->lean, box.x0, box.y0, box.x1, box.y1);
    }
    if (status == DP_OK && m->laid) status = dp_laid_step(m->laid);
    return status;
}
