// sim/sim_state.c - what a simulation has become, kept; sim_resume.c takes it back.
#include "sim/sim_state.h"

#include <string.h>

#include "base/stream.h"

static void write_cells(DpStateWriter* writer, DpCellRect cells)
{
    dp_write_i64(writer, cells.i0), dp_write_i64(writer, cells.i1);
    dp_write_i64(writer, cells.j0), dp_write_i64(writer, cells.j1);
}

static void write_vec(DpStateWriter* writer, DpVec3 v)
{
    dp_write_f64(writer, v.x), dp_write_f64(writer, v.y), dp_write_f64(writer, v.z);
}

static void write_limb(DpStateWriter* writer, const Limb* limb, const Pressing* pressing)
{
    dp_write_u8(writer, (uint8_t)(limb->stands | limb->spills << 1 | limb->flows << 2 |
                                  pressing->waits << 3 | limb->ploughs << 4));
    dp_write_f64(writer, limb->heap_height), dp_write_f64(writer, limb->margin);
    dp_write_f64(writer, limb->unlaid), dp_write_f64(writer, limb->sink);
    dp_write_f64(writer, limb->lowered), dp_write_f64(writer, limb->owed);
    write_vec(writer, limb->slip), write_vec(writer, limb->sheared);
    dp_shear_save(writer, &limb->shear);
    write_cells(writer, limb->trodden);
    const DpCellRect at = pressing->at, met = limb->met ? limb->met_at : (DpCellRect){0, 0, 0, 0};
    write_cells(writer, met);
    if (!dp_cells_empty(met))
        dp_write_floats(writer, limb->met, (size_t)(met.i1 - met.i0) * (size_t)(met.j1 - met.j0));
    write_cells(writer, at);
    for (long j = at.j0; !dp_cells_empty(at) && j < at.j1; ++j)
        dp_write_floats(writer,
                        pressing->value + (j - pressing->j0) * pressing->row + at.i0 - pressing->i0,
                        (size_t)(at.i1 - at.i0));
}

static void write_report(DpStateWriter* writer, const DpSimReport* report)
{
    dp_write_i64(writer, report->contacts), dp_write_i64(writer, report->off_ground);
    dp_write_f64(writer, report->deepest), dp_write_f64(writer, report->pressed);
    dp_write_f64(writer, report->pressed_heap), dp_write_f64(writer, report->displaced);
    dp_write_i64(writer, report->broke), dp_write_i64(writer, report->awake);
    dp_write_f64(writer, report->loosened), dp_write_f64(writer, report->rebounded);
}

void dp_sim_identity(const DpSim* sim, double number[8])
{
    const DpSimOptions* o = &sim->options;
    const double        all[8] = {
               sim->grid.cell, sim->grid.x0, sim->grid.y0,     o->law,
               o->heap_law,    o->rim_width, o->normal_radius, sim->stage.plants ? 1.0 : 0.0};
    memcpy(number, all, sizeof all);
}

double dp_sim_time(const DpSim* sim, int sample)
{
    return sim->motion ? dp_motion_time(sim->motion, sample) : 0.0;
}

DpStatus dp_sim_save_state(const DpSim* sim, DpStateWriter* writer)
{
    double number[8];
    if (!sim || !writer || (sim->motion && dp_motion_is_live(sim->motion))) return DP_BAD_ARGUMENT;
    dp_sim_identity(sim, number);
    dp_write_chunk(writer, DP_STATE_NAME, DP_STATE_VERSION);
    dp_write_doubles(writer, number, 8);
    dp_write_u64(writer, (uint64_t)sim->cast.walkers),
        dp_write_u64(writer, (uint64_t)sim->cast.parts);
    dp_write_u64(writer, (uint64_t)sim->next);
    dp_write_f64(writer, dp_sim_time(sim, sim->next));
    write_report(writer, &sim->report);
    dp_write_u64(writer, (uint64_t)sim->cast.limbs);
    for (int l = 0; l < sim->cast.limbs; ++l) write_limb(writer, &sim->limb[l], &sim->pressing[l]);
    dp_write_u64(writer, (uint64_t)sim->slides);
    for (int k = 0; k < sim->slides; ++k) write_cells(writer, sim->slide[k]);
    dp_write_end(writer);
    dp_terrain_save(sim->terrain, writer);
    if (dp_terrain_coats(sim->terrain, NULL) > 0) {
        dp_write_chunk(writer, DP_STATE_CARRIED, DP_STATE_CARRIED_VERSION);
        dp_write_doubles(writer, sim->gone.taken, DP_MAX_COATS);
        dp_write_doubles(writer, sim->gone.carried, DP_MAX_COATS);
        for (int l = 0; l < sim->cast.limbs; ++l) dp_carry_save(sim->limb[l].carry, writer);
        dp_write_end(writer);
    }
    if (sim->stage.plants) {
        dp_plants_save(sim->stage.plants, writer);
        dp_grass_save(sim->stage.grass, writer);
        dp_write_chunk(writer, DP_STATE_SHOWN, DP_STATE_SHOWN_VERSION);
        dp_write_u8(writer, sim->stage.display != NULL);
        dp_write_end(writer);
        if (sim->stage.display) dp_plant_display_save(sim->stage.display, writer);
    }
    dp_spray_save(sim, writer);
    return writer->status;
}
