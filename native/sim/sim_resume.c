// sim/sim_resume.c - go on: a simulation becomes what another one had become, as sim_state.c kept it.
//
// All is read before anything is changed: what is damaged, or of another simulation, changes nothing.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/stream.h"
#include "sim/sim_state.h"

#define FARTHEST ((int64_t)1 << 40)  // cells
#define WIDEST ((int64_t)1 << 24)    // cells along one side of what a limb presses on
#define LARGEST ((int64_t)1 << 26)   // and in all
#define MIN_LIMB 100                 // bytes of a limb are no fewer
#define SLIDE_BYTES 32               // .. of a print that slides

// What was read, until it is taken.
typedef struct State
{
    int                  next, limbs;
    Limb*                limb;  // of which only what is kept is filled in (limbs)
    Pressing*            pressing;
    DpCellRect*          slide;
    int                  slides;
    DpSimReport          report;
    Gone                 gone;
    DpTerrainState*      terrain;
    DpPlantsState*       plants;
    DpGrassState*        grass;
    DpPlantDisplay*      fresh;  // if stems were shown, and here they are not yet
    DpPlantDisplayState* display;
    SprayStage           spray;
} State;

static void drop(State* state)
{
    for (int l = 0; state->limb && l < state->limbs; ++l) {
        dp_free(state->limb[l].met);
        dp_carry_destroy(state->limb[l].carry);
    }
    for (int l = 0; state->pressing && l < state->limbs; ++l) dp_free(state->pressing[l].value);
    dp_free(state->limb), dp_free(state->pressing), dp_free(state->slide);
    dp_terrain_state_destroy(state->terrain);
    dp_plants_state_destroy(state->plants);
    dp_grass_state_destroy(state->grass);
    dp_plant_display_state_destroy(state->display);
    dp_plant_display_destroy(state->fresh);
    dp_spray_drop(&state->spray);
    dp_cloud_destroy(state->spray.cloud);
}

static DpCellRect read_cells(DpStateReader* reader)
{
    DpCellRect cells;
    cells.i0 = (long)dp_read_int(reader, -FARTHEST, FARTHEST);
    cells.i1 = (long)dp_read_int(reader, -FARTHEST, FARTHEST);
    cells.j0 = (long)dp_read_int(reader, -FARTHEST, FARTHEST);
    cells.j1 = (long)dp_read_int(reader, -FARTHEST, FARTHEST);
    const int64_t nx = cells.i1 - cells.i0, ny = cells.j1 - cells.j0;
    const bool    fits = nx <= 0 || ny <= 0 || (nx <= WIDEST && ny <= WIDEST && nx * ny <= LARGEST);
    dp_read_check(reader, fits);
    return fits ? cells : (DpCellRect){0, 0, 0, 0};
}

static DpVec3 read_vec(DpStateReader* reader)
{
    DpVec3 v;
    v.x = dp_read_number(reader, -1e9, 1e9);
    v.y = dp_read_number(reader, -1e9, 1e9);
    v.z = dp_read_number(reader, -1e9, 1e9);
    return v;
}

// Values of cells, all from `low` on; NULL where there are none, or no bytes for them, or no memory.
static float* read_grid(DpStateReader* reader, DpCellRect at, float low, bool* room)
{
    const size_t count = dp_cells_empty(at) ? 0 : (size_t)(at.i1 - at.i0) * (size_t)(at.j1 - at.j0);
    dp_read_check(reader, count <= (reader->end - reader->at) / sizeof(float));
    if (count == 0 || reader->status != DP_OK) return NULL;
    float* value = dp_alloc(count, sizeof *value);
    *room = *room && value;
    if (!value) return NULL;
    dp_read_floats(reader, value, count);
    bool holds = true;
    for (size_t k = 0; k < count; ++k) holds = holds && value[k] >= low && value[k] < INFINITY;
    dp_read_check(reader, holds);
    return value;
}

static void read_limb(DpStateReader* reader, uint32_t version, Limb* limb, Pressing* p, bool* room)
{
    const uint8_t flags = dp_read_u8(reader);
    dp_read_check(reader, flags < (version > 3 ? 32 : 16));
    limb->stands = flags & 1, limb->spills = flags >> 1 & 1;
    limb->flows = flags >> 2 & 1, p->waits = flags >> 3 & 1, limb->ploughs = flags >> 4;
    limb->heap_height = dp_read_number(reader, 0.0, 1e9);
    limb->margin = dp_read_number(reader, 0.0, 1e9);
    limb->unlaid = dp_read_number(reader, 0.0, 1e9);
    limb->sink = dp_read_number(reader, -1e9, 1e9);
    limb->lowered = dp_read_number(reader, -1e9, 1e9);
    if (version > 3) limb->owed = dp_read_number(reader, 0.0, 1e9);
    limb->slip = read_vec(reader), limb->sheared = read_vec(reader);
    if (version > 4) dp_shear_load(reader, &limb->shear);
    limb->trodden = read_cells(reader), limb->met_at = read_cells(reader);
    limb->met = read_grid(reader, limb->met_at, -1e9f, room);
    p->at = read_cells(reader), p->value = read_grid(reader, p->at, 0.0f, room);
    p->i0 = p->at.i0, p->j0 = p->at.j0;
    if (!p->value) p->at = (DpCellRect){0, 0, 0, 0};
    p->row = (int)(p->at.i1 - p->at.i0);
}

static DpSimReport read_report(DpStateReader* reader, uint32_t version)
{
    DpSimReport report = {0};
    report.contacts = (int)dp_read_int(reader, 0, INT32_MAX);
    report.off_ground = (int)dp_read_int(reader, 0, INT32_MAX);
    report.deepest = dp_read_number(reader, 0.0, 1e9);
    report.pressed = dp_read_number(reader, 0.0, 1e30);
    report.pressed_heap = dp_read_number(reader, 0.0, 1e30);
    report.displaced = dp_read_number(reader, 0.0, 1e30);
    report.broke = (long)dp_read_int(reader, 0, INT64_MAX);
    report.awake = (int)dp_read_int(reader, 0, INT32_MAX);
    if (version > 1) report.loosened = dp_read_number(reader, 0.0, 1e30);
    if (version > 1) report.rebounded = dp_read_number(reader, -1e30, 1e30);
    return report;
}

static DpStatus read_slides(DpStateReader* reader, State* state)
{
    const size_t count = dp_read_count(reader, INT32_MAX, SLIDE_BYTES);
    if (count == 0 || reader->status != DP_OK) return reader->status;
    state->slide = dp_alloc(count, sizeof *state->slide);
    if (!state->slide) return DP_NO_MEMORY;
    state->slides = (int)count;
    for (size_t k = 0; k < count; ++k) {
        state->slide[k] = read_cells(reader);
        dp_read_check(reader, !dp_cells_empty(state->slide[k]));
    }
    return reader->status;
}

static DpStatus read_sim(const DpSim* sim, DpStateReader* reader, State* state)
{
    double number[8], here[8];
    dp_sim_identity(sim, here);
    const uint32_t version = dp_read_chunk(reader, DP_STATE_NAME, DP_STATE_VERSION);
    dp_read_doubles(reader, number, 8);
    dp_read_check(reader, memcmp(number, here, sizeof here) == 0);
    dp_read_check(reader, dp_read_u64(reader) == (uint64_t)sim->cast.walkers);
    dp_read_check(reader, dp_read_u64(reader) == (uint64_t)sim->cast.parts);
    const int samples = sim->motion ? dp_motion_samples(sim->motion) : 1;
    state->next = (int)dp_read_int(reader, 0, samples - 1);
    dp_read_check(reader, dp_read_f64(reader) == dp_sim_time(sim, state->next));
    state->report = read_report(reader, version);
    state->limbs = (int)dp_read_count(reader, (size_t)sim->cast.limbs, MIN_LIMB);
    dp_read_check(reader, state->limbs == sim->cast.limbs);
    if (reader->status != DP_OK) return reader->status;
    bool room = true;
    state->limb = dp_alloc((size_t)state->limbs + 1, sizeof *state->limb);
    state->pressing = dp_alloc((size_t)state->limbs + 1, sizeof *state->pressing);
    if (!state->limb || !state->pressing) return DP_NO_MEMORY;
    for (int l = 0; l < state->limbs && room && reader->status == DP_OK; ++l)
        read_limb(reader, version, &state->limb[l], &state->pressing[l], &room);
    const DpStatus slides = room && version > 2 ? read_slides(reader, state) : DP_OK;
    if (slides == DP_NO_MEMORY) room = false;
    if (room) dp_read_end(reader);
    return room ? reader->status : DP_NO_MEMORY;
}

// What sticks to the limbs, where soil does.
static DpStatus read_carried(const DpSim* sim, DpStateReader* reader, State* state)
{
    const int coats = dp_terrain_coats(sim->terrain, NULL);
    if (coats == 0) return DP_OK;
    dp_read_chunk(reader, DP_STATE_CARRIED, DP_STATE_CARRIED_VERSION);
    for (int k = 0; k < DP_MAX_COATS; ++k) state->gone.taken[k] = dp_read_number(reader, 0.0, 1e30);
    for (int k = 0; k < DP_MAX_COATS; ++k)
        state->gone.carried[k] = dp_read_number(reader, 0.0, 1e30);
    for (int l = 0; l < state->limbs && reader->status == DP_OK; ++l) {
        DpStatus status = dp_carry_create(&state->limb[l].carry, coats, sim->grid.cell);
        if (status == DP_OK) status = dp_carry_load(state->limb[l].carry, reader);
        if (status != DP_OK) return status;
    }
    dp_read_end(reader);
    return reader->status;
}

// What a limb held in the state is the simulation's afterwards.
static void take_limb(DpSim* sim, State* state, int l)
{
    Limb *limb = &sim->limb[l], was = *limb;
    dp_free(was.met);
    dp_carry_destroy(was.carry);
    *limb = state->limb[l];
    limb->walker = was.walker, limb->part = was.part, limb->part_count = was.part_count;
    limb->law = was.law, limb->length = was.length, limb->samples = was.samples, limb->boxed = -1;
    dp_free(sim->pressing[l].value);
    sim->pressing[l] = state->pressing[l];
    state->limb[l].met = NULL, state->pressing[l].value = NULL;
    state->limb[l].carry = NULL;
}

static void take_limbs(DpSim* sim, State* state)
{
    sim->gone = state->gone;
    for (int l = 0; l < state->limbs; ++l) take_limb(sim, state, l);
    dp_free(sim->slide);
    sim->slide = state->slide, sim->slides = state->slides;
    state->slide = NULL;
}

// The halves of plants, grass and stems as they are shown.
static DpStatus read_stage(const PlantStage* stage, DpStateReader* reader, State* state)
{
    DpStatus status = dp_plants_load(stage->plants, reader, &state->plants);
    if (status == DP_OK) status = dp_grass_load(stage->grass, reader, &state->grass);
    if (status != DP_OK) return status;
    dp_read_chunk(reader, DP_STATE_SHOWN, DP_STATE_SHOWN_VERSION);
    const uint8_t shown = dp_read_u8(reader);
    dp_read_check(reader, shown <= 1);
    dp_read_end(reader);
    if (reader->status != DP_OK) return reader->status;
    if (!shown) return stage->display ? DP_BAD_FILE : DP_OK;
    if (!stage->display) status = dp_sim_display(stage, &state->fresh);
    if (status != DP_OK) return status;
    return dp_plant_display_load(stage->display ? stage->display : state->fresh, reader,
                                 &state->display);
}

static void take_stage(PlantStage* stage, State* state)
{
    if (!state->plants) return;
    dp_plants_restore(stage->plants, state->plants);
    dp_grass_restore(stage->grass, state->grass);
    if (state->fresh) stage->display = state->fresh;
    if (state->display) dp_plant_display_restore(stage->display, state->display);
    state->plants = NULL, state->grass = NULL, state->fresh = NULL, state->display = NULL;
}

DpStatus dp_sim_load_state(DpSim* sim, const void* bytes, size_t size)
{
    if (!sim || !bytes || sim->next > 0 || (sim->motion && dp_motion_is_live(sim->motion)))
        return DP_BAD_ARGUMENT;
    State         state = {0};
    DpStateReader reader = dp_read_open(bytes, size);
    DpStatus      status = read_sim(sim, &reader, &state);
    if (status == DP_OK) status = dp_terrain_load(sim->terrain, &reader, &state.terrain);
    if (status == DP_OK) status = read_carried(sim, &reader, &state);
    if (status == DP_OK && sim->stage.plants) status = read_stage(&sim->stage, &reader, &state);
    if (status == DP_OK) status = dp_spray_load(sim, &reader, &state.spray);
    if (status == DP_OK && reader.at != reader.size) status = DP_BAD_FILE;
    if (status != DP_OK) {
        drop(&state);
        return status;
    }
    take_stage(&sim->stage, &state);
    dp_terrain_restore(sim->terrain, state.terrain);  // asks plants for their cover
    state.terrain = NULL;
    take_limbs(sim, &state);
    if (sim->spray.cloud) {
        const SprayStage was = sim->spray;
        sim->spray = state.spray, state.spray = was;
    }
    sim->datum = dp_terrain_datum(sim->terrain);
    sim->next = state.next, sim->report = state.report;
    sim->speculation.planned = false, sim->speculation.count = 0;
    for (int n = 0; sim->stage.swept && n < 2 * sim->stage.parts; ++n)
        sim->stage.swept[n].sample = -1;
    drop(&state);
    return DP_OK;
}

DpStatus dp_sim_join_state(DpSim* sim, const void* bytes, size_t size, const DpStatePart* part)
{
    if (!sim || !bytes || !part || !sim->motion || sim->next > 0 || sim->stage.plants ||
        sim->spray.cloud || dp_terrain_coats(sim->terrain, NULL) > 0 ||
        dp_motion_is_live(sim->motion))
        return DP_BAD_ARGUMENT;
    State         state = {0};
    DpStateReader reader = dp_read_open(bytes, size);
    DpStatus      status = read_sim(sim, &reader, &state);
    if (status == DP_OK) status = dp_terrain_load(sim->terrain, &reader, &state.terrain);
    if (status == DP_OK && reader.at != reader.size) status = DP_BAD_FILE;
    if (status == DP_OK && state.slides > 0) status = DP_BAD_ARGUMENT;
    if (status == DP_OK)
        status = dp_terrain_join(sim->terrain, state.terrain, part->tile, part->tiles);
    if (status == DP_OK) {
        state.terrain = NULL;
        for (int l = 0; l < state.limbs; ++l)
            if (part->walkers[sim->limb[l].walker]) take_limb(sim, &state, l);
    }
    drop(&state);
    return status;
}
