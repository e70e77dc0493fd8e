// plants/plant_step.c - one step of all plants: who wakes, who moves, who may sleep again.
//
// Cost follows the walkers: of a sleeping block only the box of its roots is looked at. Blocks do
// not touch each other, so any number of workers gives the same plants.
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "plants/plant_inside.h"

#define AT_REST 0.003  // of its height, nearer to its rest shape than this, a plant is at rest
#define QUIET 0.6      // for so many swings before it sleeps

typedef struct PlantTask
{
    PlantStand* stand;
    PlantBlock* block;
} PlantTask;

// what one step's workers share
typedef struct Step
{
    DpPlants*            plants;
    const DpPlantGround* ground;
    PlantPush*           push;
    int                  pushes, steps;
    double               dt;
    size_t               scratch;  // floats of one worker
} Step;

// one block lives through the step
static void live(void* context, int index, int worker)
{
    const Step*       step = context;
    const PlantTask   task = step->plants->task[index];
    const PlantStand* stand = task.stand;
    PlantBlock*       block = task.block;
    const size_t      places = (size_t)stand->shape.particles * DP_LANES;
    const size_t      bends = (size_t)stand->shape.bends * DP_LANES;
    float*            before = step->plants->scratch + (size_t)worker * step->scratch;
    float *           give = before + 3 * places, *length = give + bends;
    float*            soft = length + 2 * (size_t)stand->edges * DP_LANES;
    const double      h = step->dt / step->steps;

    dp_plant_hold_block(stand, block, step->push, step->pushes, step->ground);
    dp_plant_soften(stand, soft, h);
    dp_plant_prepare(stand, block, give, h);
    dp_plant_lengths(stand, block, length);
    float fastest = 0.0f;
    for (int k = 1; k <= step->steps; ++k) {
        dp_plant_substep(stand, block, give, length, before, soft, h);
        if (block->touched)
            dp_plant_push_block(stand, block, step->push, step->pushes, step->ground, before,
                                step->dt * (step->steps - k) / step->steps, h);
        fastest = dp_plant_speeds(stand, block, before, h);
    }
    dp_plant_shorten(stand, block, length);
    if (step->ground) dp_plant_ground_block(stand, block, step->ground);
    dp_plant_wear_block(stand, block, step->dt);
    const double slow = AT_REST * (double)stand->kind.height * dp_plant_return_rate(&stand->kind);
    const bool   calm = !block->touched && !block->wearing && (double)fastest < slow * slow;
    block->quiet = calm ? block->quiet + step->dt : 0.0;
}

// ---- who takes part --------------------------------------------------------------------------

static bool add_task(DpPlants* plants, int* tasks, PlantStand* stand, PlantBlock* block)
{
    if (!dp_make_room(&plants->task, (size_t)*tasks + 1, sizeof *plants->task)) return false;
    plants->task[(*tasks)++] = (PlantTask){stand, block};
    return true;
}

// blocks that live through this step; -1 without memory
static int call_up(DpPlants* plants, const PlantPush* push, int count, double dt)
{
    int       tasks = 0;
    PlantPush all = {0};
    for (int k = 0; k < count; ++k) {
        all.x0 = k ? fmin(all.x0, push[k].x0) : push[k].x0;
        all.y0 = k ? fmin(all.y0, push[k].y0) : push[k].y0;
        all.x1 = k ? fmax(all.x1, push[k].x1) : push[k].x1;
        all.y1 = k ? fmax(all.y1, push[k].y1) : push[k].y1;
    }
    for (int s = 0; s < plants->stands; ++s) {
        PlantStand* stand = &plants->stand[s];
        const float span = 1.0001f * (float)dp_plant_span(stand) + 1e-4f;
        const float x0 = (float)all.x0 - span, x1 = (float)all.x1 + span;
        const float y0 = (float)all.y0 - span, y1 = (float)all.y1 + span;
        for (int b = 0; b < stand->blocks; ++b) {
            const float* box = stand->box + 4 * b;
            const bool   near = count > 0 && box[0] < x1 && box[2] > x0 && box[1] < y1 &&
                              box[3] > y0 && dp_plant_meets_any(box, push, count, (double)span);
            if (!near && !stand->up[b]) continue;
            PlantBlock* block = &stand->block[b];
            dp_memory_ease(DP_EASE_PAGE);
            if (!near)
                block->touched = false, memset(block->touched_lane, 0, sizeof block->touched_lane);
            else
                dp_plant_touch(stand, block, push, count, dt);
            if (!block->touched && !block->awake) continue;
            if (!block->awake && !dp_plant_wake(plants, stand, block)) return -1;
            stand->up[b] = 1;
            block->changed = false, block->broke = 0;
            if (!add_task(plants, &tasks, stand, block)) return -1;
        }
    }
    return tasks;
}

static bool prepare_sides(DpPlants* plants, PlantPush* push, int count)
{
    size_t cells = 0;
    for (int k = 0; k < count; ++k)
        if (push[k].collider->bottom) cells += PLANT_SIDE_CELLS(push[k].collider);
    if (!dp_make_room(&plants->side, cells, sizeof *plants->side)) return false;
    float* out = plants->side;
    for (int k = 0; k < count; ++k) {
        if (!push[k].collider->bottom) continue;
        dp_plant_side_field(push[k].collider, out);
        push[k].out = out;
        out += PLANT_SIDE_CELLS(push[k].collider);
    }
    return true;
}

// one more box where cover may have changed: those that meet become one, and some if there are many
static void report_change(DpPlantsReport* report, DpPlantBox box)
{
    for (int k = 0; k < report->changes;) {
        const DpPlantBox at = report->box[k];
        const bool meet = at.x0 <= box.x1 && box.x0 <= at.x1 && at.y0 <= box.y1 && box.y0 <= at.y1;
        if (!meet && report->changes < DP_PLANT_BOXES) {
            ++k;
            continue;
        }
        box = (DpPlantBox){fmin(at.x0, box.x0), fmin(at.y0, box.y0), fmax(at.x1, box.x1),
                           fmax(at.y1, box.y1)};
        report->box[k] = report->box[--report->changes];
        k = 0;
    }
    report->box[report->changes++] = box;
}

// what happened, and who may sleep; in the order of the blocks
static void report_step(DpPlants* plants, int tasks, DpPlantsReport* report)
{
    for (int t = 0; t < tasks; ++t) {
        PlantStand* stand = plants->task[t].stand;
        PlantBlock* block = plants->task[t].block;
        const int   b = (int)(block - stand->block);
        report->awake += block->count;
        report->broke += block->broke;
        if (block->changed) {
            const float* box = stand->box + 4 * b;
            const double span = (double)stand->kind.root_radius;
            report_change(report, (DpPlantBox){(double)box[0] - span, (double)box[1] - span,
                                               (double)box[2] + span, (double)box[3] + span});
        }
        if (block->quiet * (double)stand->kind.sway < QUIET) continue;
        dp_plant_put_to_sleep(plants, stand, block);
        stand->up[b] = 0;
    }
}

DpStatus dp_plants_step(DpPlants* plants, const DpPlantGround* ground,
                        const DpPlantCollider* colliders, int count, double dt, int workers,
                        DpPlantsReport* report)
{
    if (!plants || !report || count < 0 || (count > 0 && !colliders)) return DP_BAD_ARGUMENT;
    if (!(dt > 0.0 && dt < 1e6) || !dp_plant_ground_ok(ground)) return DP_BAD_ARGUMENT;
    for (int k = 0; k < count; ++k)
        if (!dp_plant_collider_ok(&colliders[k])) return DP_BAD_ARGUMENT;
    memset(report, 0, sizeof *report);
    Step step = {.plants = plants, .ground = ground, .dt = dt};
    step.push = dp_alloc((size_t)count + 1, sizeof(PlantPush));
    if (!step.push) return DP_NO_MEMORY;
    for (int k = 0; k < count; ++k) {
        step.push[step.pushes].collider = &colliders[k];
        if (dp_plant_sweep(&step.push[step.pushes], dt)) ++step.pushes;
    }
    const double wanted = ceil(dt / DP_SUBSTEP - 1e-9);
    step.steps = wanted < 1.0 ? 1 : wanted > DP_MAX_SUBSTEPS ? DP_MAX_SUBSTEPS : (int)wanted;

    const int tasks = call_up(plants, step.push, step.pushes, dt);
    workers = workers < 1 ? 1 : workers > 64 ? 64 : workers;
    for (int s = 0; s < plants->stands; ++s) {
        const PlantStand* stand = &plants->stand[s];
        const size_t floats = DP_LANES * (size_t)(3 * stand->shape.particles + stand->shape.bends +
                                                  2 * stand->edges) +
                              (size_t)stand->edges;
        step.scratch = floats > step.scratch ? floats : step.scratch;
    }
    step.scratch = (step.scratch + 15) / 16 * 16;
    bool room = tasks >= 0 && prepare_sides(plants, step.push, step.pushes);
    room = room &&
           dp_make_room(&plants->scratch, step.scratch * (size_t)workers, sizeof *plants->scratch);
    if (room && tasks > 0) dp_parallel_for(tasks, workers, live, &step);
    if (room) plants->now += dt;
    if (room) report_step(plants, tasks, report);
    dp_free(step.push);
    return room ? DP_OK : DP_NO_MEMORY;
}
