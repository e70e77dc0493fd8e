// sim/sim_spray.c - what sticks to soles, flies and lands, after the soil of a step. SUMNER99, MODEL 6.15
//
//   limbs that press or leave ---> coats ---> cloud ---> heaps, which slide where they are too steep
//
// One thread goes through parts and landings in their order; grains fly on all of them. Bits are the same for any number.
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define PLACE_WIDTH 2.0   // grains across a place from which one is taken, or where it lies
#define MAX_SPEED 40.0    // a part that is faster was put elsewhere [m/s]
#define SLIDE_ALONG 64    // cells along what slides together
#define SETTLE_STEP 0.01  // [s]
#define LONGEST 6000      // steps until all is down

DpStatus dp_sim_spray(DpSim* sim, const DpSprayNumbers* numbers)
{
    if (!sim || !numbers || sim->spray.cloud || sim->next > 0 ||
        dp_spray_check(numbers, NULL) != DP_OK)
        return DP_BAD_ARGUMENT;
    sim->spray.cloud = dp_cloud_create(numbers);
    if (!sim->spray.cloud) return DP_NO_MEMORY;
    sim->spray.numbers = *numbers;
    return DP_OK;
}

bool dp_sim_sprays(const DpSim* sim)
{
    return sim->spray.cloud != NULL;
}

int dp_sim_grains(const DpSim* sim)
{
    return sim->spray.cloud ? dp_cloud_count(sim->spray.cloud) : 0;
}

DpGrain dp_sim_grain(const DpSim* sim, int index)
{
    DpGrain grain = dp_cloud_grain(sim->spray.cloud, index);
    grain.at.z += sim->datum;
    return grain;
}

static int held_by(const SprayStage* spray)
{
    int held = 0;
    for (int p = 0; spray->coat && p < spray->parts; ++p) held += dp_coat_held(spray->coat[p]);
    return held;
}

void dp_spray_drop(SprayStage* spray)
{
    for (int p = 0; spray->coat && p < spray->parts; ++p) dp_coat_destroy(spray->coat[p]);
    dp_free(spray->coat);
    spray->coat = NULL, spray->parts = 0;
}

void dp_spray_leave(SprayStage* spray, const SprayStage* before)
{
    spray->coat = NULL, spray->parts = 0;
    spray->carried_off += held_by(before);
}

void dp_spray_report(const SprayStage* spray, DpSimReport* report)
{
    if (!spray->cloud) return;
    const double volume = dp_spray_volume(&spray->numbers);
    report->stuck = volume * (double)(held_by(spray) + spray->carried_off);
    report->airborne = volume * (double)dp_cloud_count(spray->cloud);
    report->thrown = volume * (double)spray->thrown;
    report->beside = volume * (double)spray->beside;
}

// ---- a step ------------------------------------------------------------------------------------

static bool dig(void* context, double x, double y, uint8_t* kind)
{
    DpSim*       sim = context;
    DpDug        dug;
    const double volume = dp_spray_volume(&sim->spray.numbers);
    const double width = PLACE_WIDTH * sim->spray.numbers.particle_size;
    if (!dp_terrain_dig(sim->terrain, x, y, width, volume, &dug)) return false;
    sim->report.loosened += dug.firm;  // it left the ground it stood in
    *kind = dug.kind;
    return true;
}

// The coat of a part, made when the part first presses.
static DpStatus coat_of(DpSim* sim, int part, DpCoat** coat)
{
    SprayStage* spray = &sim->spray;
    if (!spray->coat) {
        spray->coat = dp_alloc((size_t)sim->cast.parts, sizeof *spray->coat);
        if (!spray->coat) return DP_NO_MEMORY;
        spray->parts = sim->cast.parts;
    }
    *coat = spray->coat[part];
    if (*coat) return DP_OK;
    const DpStatus status =
        dp_coat_create(coat, &sim->cast.sole[part], &spray->numbers, (uint32_t)part);
    spray->coat[part] = *coat;
    return status;
}

static DpStatus step_part(DpSim* sim, const Limb* limb, int part, int sample,
                          const DpSprayGround* ground)
{
    SprayStage*  spray = &sim->spray;
    const double dt = dp_sim_interval(sim, sample);
    const bool   presses = limb->active && !limb->lifts;
    DpCoat*      coat = spray->coat ? spray->coat[part] : NULL;
    if (!dp_limb_there(sim, limb, sample) || !dp_limb_there(sim, limb, sample + 1)) return DP_OK;
    if (!coat && !presses) return DP_OK;
    DpStatus status = coat ? DP_OK : coat_of(sim, part, &coat);
    if (status != DP_OK) return status;
    DpCoatStep step = {.from = dp_limb_pose(sim, part, sample, 0.0),
                       .to = dp_limb_pose(sim, part, sample, 1.0),
                       .dt = dt,
                       .sink = limb->sink,
                       .presses = presses,
                       .ground = ground,
                       .dig = dig,
                       .digger = sim};
    step.jumps = dp_length(dp_sub(step.to.at, step.from.at)) > MAX_SPEED * dt;
    const int before = dp_cloud_count(spray->cloud);
    status = dp_coat_step(coat, &step, spray->cloud);
    spray->thrown += dp_cloud_count(spray->cloud) - before;
    return status;
}

// What lies too steep slides in the next step, with what lies near it.
static DpStatus let_slide(DpSim* sim, DpCellRect cells)
{
    for (int k = 0; k < sim->slides; ++k) {
        const DpCellRect both = dp_cells_join(sim->slide[k], cells);
        if (both.i1 - both.i0 > SLIDE_ALONG || both.j1 - both.j0 > SLIDE_ALONG) continue;
        sim->slide[k] = both;
        return DP_OK;
    }
    if (!dp_make_room(&sim->slide, (size_t)sim->slides + 1, sizeof *sim->slide))
        return DP_NO_MEMORY;
    sim->slide[sim->slides++] = cells;
    return DP_OK;
}

static DpStatus lay(DpSim* sim, const DpLanding* landing)
{
    SprayStage*  spray = &sim->spray;
    const double volume = dp_spray_volume(&spray->numbers);
    const double width = PLACE_WIDTH * spray->numbers.particle_size;
    DpCellRect   cells;
    double       laid = 0.0;
    DpStatus     status = DP_OK;
    if (!landing->beside)
        status =
            dp_terrain_drop(sim->terrain, landing->x, landing->y, width, volume, &cells, &laid);
    if (status != DP_OK) return status;
    if (!(laid > 0.0)) {  // nothing there holds it
        ++spray->beside;
        return DP_OK;
    }
    return dp_terrain_steep(sim->terrain, cells) ? let_slide(sim, cells) : DP_OK;
}

static DpStatus fly(DpSim* sim, const DpSprayGround* ground, double dt)
{
    const DpLanding* landing;
    int              landings;
    DpStatus         status =
        dp_cloud_fly(sim->spray.cloud, ground, dt, sim->worker_count, &landing, &landings);
    for (int n = 0; n < landings && status == DP_OK; ++n) status = lay(sim, &landing[n]);
    return status;
}

// how high a tile is, within half a cell around it, too: the surface is bilinear between cells
static double highest(void* terrain, long tx, long ty)
{
    double found = -INFINITY;
    for (int n = 0; n < 9; ++n)
        found = fmax(found, dp_terrain_highest(terrain, tx + n % 3 - 1, ty + n / 3 - 1));
    return found;
}

static DpSprayGround ground_of(const DpSim* sim)
{
    const double cell = sim->grid.cell;
    return (DpSprayGround){.surface = dp_sim_surface,
                           .ground = sim->terrain,
                           .highest = highest,
                           .context = sim->terrain,
                           .side = cell * DP_TILE,
                           .x0 = sim->grid.x0,
                           .y0 = sim->grid.y0};
}

DpStatus dp_spray_step(DpSim* sim, int sample)
{
    if (!sim->spray.cloud) return DP_OK;
    const DpSprayGround ground = ground_of(sim);
    for (int l = 0; l < sim->cast.limbs; ++l) {
        const Limb* limb = &sim->limb[l];
        for (int p = 0; p < limb->part_count; ++p) {
            const DpStatus status = step_part(sim, limb, limb->part[p], sample, &ground);
            if (status != DP_OK) return status;
        }
    }
    return fly(sim, &ground, dp_sim_interval(sim, sample));
}

DpStatus dp_spray_land(DpSim* sim)
{
    if (!sim->spray.cloud) return DP_OK;
    const DpSprayGround ground = ground_of(sim);
    DpStatus            status = DP_OK;
    for (int k = 0; k < LONGEST && status == DP_OK && dp_sim_grains(sim) > 0; ++k)
        status = fly(sim, &ground, SETTLE_STEP);
    return status;
}

// ---- kept from run to run ----------------------------------------------------------------------

#define NAME "spry"
#define VERSION 1

void dp_spray_save(const DpSim* sim, DpStateWriter* writer)
{
    const SprayStage* spray = &sim->spray;
    if (!spray->cloud) return;
    dp_write_chunk(writer, NAME, VERSION);
    dp_write_i64(writer, spray->thrown), dp_write_i64(writer, spray->beside);
    dp_write_i64(writer, spray->carried_off);
    dp_cloud_save(spray->cloud, writer);
    for (int p = 0; p < sim->cast.parts; ++p)
        dp_coat_save(spray->coat ? spray->coat[p] : NULL, writer);
    dp_write_end(writer);
}

DpStatus dp_spray_load(const DpSim* sim, DpStateReader* reader, SprayStage* state)
{
    const SprayStage* spray = &sim->spray;
    if (!spray->cloud) return DP_OK;
    state->numbers = spray->numbers;
    dp_read_chunk(reader, NAME, VERSION);
    state->thrown = (long)dp_read_int(reader, 0, INT64_MAX);
    state->beside = (long)dp_read_int(reader, 0, INT64_MAX);
    state->carried_off = (long)dp_read_int(reader, 0, INT64_MAX);
    if (reader->status != DP_OK) return reader->status;
    DpStatus status = dp_cloud_load(&state->cloud, &spray->numbers, reader);
    if (status != DP_OK) return status;
    const int parts = sim->cast.parts;
    state->coat = parts > 0 ? dp_alloc((size_t)parts, sizeof *state->coat) : NULL;
    if (parts > 0 && !state->coat) return DP_NO_MEMORY;
    state->parts = parts;
    for (int p = 0; p < parts && status == DP_OK; ++p)
        status =
            dp_coat_load(&state->coat[p], &sim->cast.sole[p], &spray->numbers, (uint32_t)p, reader);
    if (status == DP_OK) dp_read_end(reader);
    return status == DP_OK ? reader->status : status;
}
