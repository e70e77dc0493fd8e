// plants/plant_step.c - one step of the meadow: who wakes, who moves, who may sleep again.
//
// Cost follows the walkers: of a sleeping block only the box of its roots is looked at. Blocks do
// not touch each other, so any number of workers gives the same plants.
#include <string.h>

#include "base/alloc.h"
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

DpVec3 plant_rest_at(const PlantStand* stand, const PlantBlock* block, int particle, int l)
{
    const int    rows = stand->shape.rows;
    const float *at = stand->rest + 3 * particle,
                *foot = stand->rest + 3 * (particle / rows * rows);
    const double c = (double)block->turn[0][l], s = (double)block->turn[1][l];
    const double x = (double)at[0], y = (double)at[1], fx = (double)foot[0], fy = (double)foot[1];
    const double lift = (double)block->slope[0][l] * (c * fx - s * fy) +
                        (double)block->slope[1][l] * (s * fx + c * fy);
    return dp_vec3((double)block->foot[0][l] + c * x - s * y,
                   (double)block->foot[1][l] + s * x + c * y,
                   (double)block->foot[2][l] + (double)at[2] + lift);
}

bool plant_wake(DpPlants* plants, PlantStand* stand, PlantBlock* block)
{
    if (!block->state) {
        const size_t places = (size_t)stand->shape.particles * DP_LANES;
        const size_t bends = (size_t)stand->shape.bends * DP_LANES;
        const size_t head = (sizeof(PlantState) + 63) / 64 * 64;
        char* memory = dp_alloc(1, head + bends * sizeof(double) + 10 * places * sizeof(float));
        if (!memory) return false;
        PlantState* state = block->state = (PlantState*)(void*)memory;
        state->strength = (double*)(void*)(memory + head);
        float* grid = (float*)(void*)(memory + head + bends * sizeof(double));
        for (int d = 0; d < 3; ++d, grid += places) state->at[d] = grid;
        for (int d = 0; d < 3; ++d, grid += places) state->speed[d] = grid;
        state->limp = grid;
        state->floor = grid + places;
        for (int d = 0; d < 2; ++d) state->seen[d] = grid + (size_t)(2 + d) * places;
        for (int p = 0; p < stand->shape.particles; ++p)
            for (int l = 0; l < DP_LANES; ++l) {
                const DpVec3 at = plant_rest_at(stand, block, p, l);
                state->at[0][p * DP_LANES + l] = (float)at.x;
                state->at[1][p * DP_LANES + l] = (float)at.y;
                state->at[2][p * DP_LANES + l] = (float)at.z;
            }
        for (size_t k = 0; k < bends; ++k) state->strength[k] = block->reserve[k % DP_LANES];
    } else if (!block->awake) {
        plant_catch_up(stand, block, plants->now - block->asleep_since);
    }
    for (int k = 0; !block->awake && k < stand->shape.particles * DP_LANES; ++k)
        block->state->floor[k] = DP_NO_FLOOR;
    block->awake = true;
    block->quiet = 0.0;
    return true;
}

static void put_to_sleep(const DpPlants* plants, const PlantStand* stand, PlantBlock* block)
{
    const size_t places = (size_t)stand->shape.particles * DP_LANES;
    for (int d = 0; d < 3; ++d) memset(block->state->speed[d], 0, places * sizeof(float));
    block->awake = false;
    block->asleep_since = plants->now;
}

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

    plant_hold_block(stand, block, step->push, step->pushes, step->ground);
    plant_soften(stand, soft, h);
    plant_prepare(stand, block, give, h);
    plant_lengths(stand, block, length);
    float fastest = 0.0f;
    for (int k = 1; k <= step->steps; ++k) {
        plant_substep(stand, block, give, length, before, soft, h);
        if (block->touched)
            plant_push_block(stand, block, step->push, step->pushes, step->ground, before,
                             step->dt * (step->steps - k) / step->steps, h);
        fastest = plant_speeds(stand, block, before, h);
    }
    plant_shorten(stand, block, length);
    if (step->ground) plant_ground_block(stand, block, step->ground);
    plant_wear_block(stand, block, step->dt);
    const double slow = AT_REST * (double)stand->kind.height * plant_return_rate(&stand->kind);
    const bool   calm = !block->touched && !block->wearing && (double)fastest < slow * slow;
    block->quiet = calm ? block->quiet + step->dt : 0.0;
}

// ---- who takes part --------------------------------------------------------------------------

static bool finite3(DpVec3 v)
{
    return fabs(v.x) < 1e9 && fabs(v.y) < 1e9 && fabs(v.z) < 1e9;
}

static bool collider_ok(const DpPlantCollider* c)
{
    if (!finite3(c->velocity) || !(c->friction >= 0.0 && c->friction < 1e9)) return false;
    if (!c->bottom) return finite3(c->from) && finite3(c->to) && c->radius > 0.0 && c->radius < 1e6;
    return c->nx > 0 && c->ny > 0 && c->row >= c->nx && c->cell > 0.0 && c->cell < 1e6 &&
           fabs(c->x0) < 1e9 && fabs(c->y0) < 1e9 && c->thickness > 0.0 && c->thickness < 1e6;
}

// the box a collider goes through; false if it is nowhere
static bool sweep(PlantPush* push, double dt)
{
    const DpPlantCollider* c = push->collider;
    if (c->bottom) {
        int   i0 = c->nx, i1 = -1, j0 = c->ny, j1 = -1;
        float low = INFINITY, high = -INFINITY;
        for (int j = 0; j < c->ny; ++j)
            for (int i = 0; i < c->nx; ++i) {
                const float b = c->bottom[(size_t)j * (size_t)c->row + (size_t)i];
                if (!isfinite(b)) continue;
                i0 = i < i0 ? i : i0, i1 = i > i1 ? i : i1, j0 = j < j0 ? j : j0, j1 = j;
                low = fminf(low, b), high = fmaxf(high, b);
            }
        if (i1 < 0) return false;
        push->x0 = c->x0 + (i0 - 0.5) * c->cell, push->x1 = c->x0 + (i1 + 0.5) * c->cell;
        push->y0 = c->y0 + (j0 - 0.5) * c->cell, push->y1 = c->y0 + (j1 + 0.5) * c->cell;
        push->z0 = (double)low, push->z1 = (double)high + c->thickness;
    } else {
        push->x0 = fmin(c->from.x, c->to.x) - c->radius,
        push->x1 = fmax(c->from.x, c->to.x) + c->radius;
        push->y0 = fmin(c->from.y, c->to.y) - c->radius,
        push->y1 = fmax(c->from.y, c->to.y) + c->radius;
        push->z0 = fmin(c->from.z, c->to.z) - c->radius,
        push->z1 = fmax(c->from.z, c->to.z) + c->radius;
    }
    const DpVec3 back = dp_scale(c->velocity, -dt);
    push->x0 += fmin(back.x, 0.0), push->x1 += fmax(back.x, 0.0);
    push->y0 += fmin(back.y, 0.0), push->y1 += fmax(back.y, 0.0);
    push->z0 += fmin(back.z, 0.0), push->z1 += fmax(back.z, 0.0);
    return true;
}

// how far from its root a plant can be met
static double reach_of(const PlantStand* stand)
{
    return (double)stand->extent + (double)stand->kind.radius;
}

// how far to a side each plant of a block stands or lies, at most
static void lies_aside(const PlantStand* stand, const PlantBlock* block, double aside[DP_LANES])
{
    float most[DP_LANES];
    for (int l = 0; l < DP_LANES; ++l) most[l] = block->state ? 0.0f : stand->aside;
    for (int p = 0; block->state && p < stand->shape.particles; ++p)
        for (int d = 0; d < 2; ++d) {
            const float* at = block->state->at[d] + p * DP_LANES;
            for (int l = 0; l < DP_LANES; ++l) {
                const float off = fabsf(at[l] - block->foot[d][l]);
                most[l] = off > most[l] ? off : most[l];
            }
        }
    for (int l = 0; l < DP_LANES; ++l) aside[l] = (double)most[l];
}

// mark the plants that a collider can meet, as they are and as far as they move in a step of dt
static void touch(const PlantStand* stand, PlantBlock* block, const PlantPush* push, int count,
                  double dt)
{
    const double half = 0.5 * (double)fmaxf(stand->kind.width, stand->kind.depth);
    const double high = (double)(DP_STRETCH_MOST * stand->kind.height + stand->kind.radius) + 0.01;
    const double spare = (double)stand->kind.radius + (double)DP_SPEED_MOST * dt + 0.01;
    double       aside[DP_LANES];
    lies_aside(stand, block, aside);
    block->touched = false;
    for (int l = 0; l < DP_LANES; ++l) {
        const double x = (double)block->root[0][l], y = (double)block->root[1][l];
        const double z = (double)block->root[2][l];
        const double lift = (double)(fabsf(block->slope[0][l]) + fabsf(block->slope[1][l])) * half;
        const double tall = high + lift;  // outer stems stand higher on a slope
        const double reach = fmin(reach_of(stand), aside[l] + spare);
        const double deep = reach_of(stand);
        bool         meets = false;
        for (int k = 0; k < count && l < block->count; ++k)
            meets = meets ||
                    (x + reach > push[k].x0 && x - reach < push[k].x1 && y + reach > push[k].y0 &&
                     y - reach < push[k].y1 && z + tall > push[k].z0 && z - deep < push[k].z1);
        block->touched_lane[l] = meets;
        block->touched = block->touched || meets;
    }
}

static bool add_task(DpPlants* plants, int* tasks, PlantStand* stand, PlantBlock* block)
{
    if (*tasks == plants->task_room) {
        const int  room = plants->task_room ? 2 * plants->task_room : 64;
        PlantTask* more = dp_realloc(plants->task, (size_t)room, sizeof(PlantTask));
        if (!more) return false;
        plants->task = more, plants->task_room = room;
    }
    plants->task[(*tasks)++] = (PlantTask){stand, block};
    return true;
}

// can any of the colliders, which may be far apart, meet a block whose roots lie within the box?
static bool meets_any(const float box[4], const PlantPush* push, int count, double reach)
{
    for (int k = 0; k < count; ++k)
        if ((double)box[0] < push[k].x1 + reach && (double)box[2] > push[k].x0 - reach &&
            (double)box[1] < push[k].y1 + reach && (double)box[3] > push[k].y0 - reach)
            return true;
    return false;
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
        const float reach = 1.0001f * (float)reach_of(stand) + 1e-4f;
        const float x0 = (float)all.x0 - reach, x1 = (float)all.x1 + reach;
        const float y0 = (float)all.y0 - reach, y1 = (float)all.y1 + reach;
        for (int b = 0; b < stand->blocks; ++b) {
            const float* box = stand->box + 4 * b;
            const bool   near = count > 0 && box[0] < x1 && box[2] > x0 && box[1] < y1 &&
                              box[3] > y0 && meets_any(box, push, count, (double)reach);
            if (!near && !stand->up[b]) continue;
            PlantBlock* block = &stand->block[b];
            if (!near)
                block->touched = false, memset(block->touched_lane, 0, sizeof block->touched_lane);
            else
                touch(stand, block, push, count, dt);
            if (!block->touched && !block->awake) continue;
            if (!block->awake && !plant_wake(plants, stand, block)) return -1;
            stand->up[b] = 1;
            block->changed = false, block->broke = 0;
            if (!add_task(plants, &tasks, stand, block)) return -1;
        }
    }
    return tasks;
}

static bool make_room(float** memory, size_t* room, size_t wanted)
{
    if (wanted <= *room) return true;
    float* more = dp_realloc(*memory, wanted, sizeof(float));
    if (!more) return false;
    *memory = more, *room = wanted;
    return true;
}

static bool prepare_sides(DpPlants* plants, PlantPush* push, int count)
{
    size_t cells = 0;
    for (int k = 0; k < count; ++k)
        if (push[k].collider->bottom) cells += PLANT_SIDE_CELLS(push[k].collider);
    if (!make_room(&plants->side, &plants->side_room, cells)) return false;
    float* out = plants->side;
    for (int k = 0; k < count; ++k) {
        if (!push[k].collider->bottom) continue;
        plant_side_field(push[k].collider, out);
        push[k].out = out;
        out += PLANT_SIDE_CELLS(push[k].collider);
    }
    return true;
}

// one more box where cover may have changed: those that meet become one, and some if there are many
static void tell_change(DpPlantsTold* told, DpPlantBox box)
{
    for (int k = 0; k < told->changes;) {
        const DpPlantBox at = told->box[k];
        const bool meet = at.x0 <= box.x1 && box.x0 <= at.x1 && at.y0 <= box.y1 && box.y0 <= at.y1;
        if (!meet && told->changes < DP_PLANT_BOXES) {
            ++k;
            continue;
        }
        box = (DpPlantBox){fmin(at.x0, box.x0), fmin(at.y0, box.y0), fmax(at.x1, box.x1),
                           fmax(at.y1, box.y1)};
        told->box[k] = told->box[--told->changes];
        k = 0;
    }
    told->box[told->changes++] = box;
}

// what happened, and who may sleep; in the order of the blocks
static void tell(DpPlants* plants, int tasks, DpPlantsTold* told)
{
    for (int t = 0; t < tasks; ++t) {
        PlantStand* stand = plants->task[t].stand;
        PlantBlock* block = plants->task[t].block;
        const int   b = (int)(block - stand->block);
        told->awake += block->count;
        told->broke += block->broke;
        if (block->changed) {
            const float* box = stand->box + 4 * b;
            const double reach = (double)stand->kind.reach;
            tell_change(told, (DpPlantBox){(double)box[0] - reach, (double)box[1] - reach,
                                           (double)box[2] + reach, (double)box[3] + reach});
        }
        if (block->quiet * (double)stand->kind.sway < QUIET) continue;
        put_to_sleep(plants, stand, block);
        stand->up[b] = 0;
    }
}

DpStatus dp_plants_step(DpPlants* plants, const DpPlantGround* ground,
                        const DpPlantCollider* colliders, int count, double dt, int workers,
                        DpPlantsTold* told)
{
    if (!plants || !told || count < 0 || (count > 0 && !colliders)) return DP_BAD_ARGUMENT;
    if (!(dt > 0.0 && dt < 1e6) || !plant_ground_ok(ground)) return DP_BAD_ARGUMENT;
    for (int k = 0; k < count; ++k)
        if (!collider_ok(&colliders[k])) return DP_BAD_ARGUMENT;
    memset(told, 0, sizeof *told);
    Step step = {.plants = plants, .ground = ground, .dt = dt};
    step.push = dp_alloc((size_t)count + 1, sizeof(PlantPush));
    if (!step.push) return DP_NO_MEMORY;
    for (int k = 0; k < count; ++k) {
        step.push[step.pushes].collider = &colliders[k];
        if (sweep(&step.push[step.pushes], dt)) ++step.pushes;
    }
    const double wanted = ceil(dt / DP_SUBSTEP - 1e-9);
    step.steps = wanted < 1.0 ? 1 : wanted > DP_SUBSTEPS_MOST ? DP_SUBSTEPS_MOST : (int)wanted;

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
    room =
        room && make_room(&plants->scratch, &plants->scratch_room, step.scratch * (size_t)workers);
    if (room && tasks > 0) dp_parallel_for(tasks, workers, live, &step);
    if (room) plants->now += dt;
    if (room) tell(plants, tasks, told);
    dp_free(step.push);
    return room ? DP_OK : DP_NO_MEMORY;
}
