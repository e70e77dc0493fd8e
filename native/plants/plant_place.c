// plants/plant_place.c - where plants grow: by chance, but never too close. Poisson-disc, seeded.
//
// Darts are thrown until the ground has as many plants as its density asks for. A dart sticks with
// the chance that `weight` gives its place, if no root stands nearer than sqrt(PACKING / density):
// a maximal packing has 0.7, so there is always room.
#include "base/alloc.h"
#include "plants/plant_inside.h"

#define PACKING 0.5
#define DARTS 60         // for each plant, before giving up
#define THINNEST 0.0625  // where fewer are wanted, roots keep no more distance than at this

static double weight_at(const float* weight, int wx, int wy, double u, double v)
{
    if (!weight) return 1.0;
    const int i = u * wx < wx ? (int)(u * wx) : wx - 1, j = v * wy < wy ? (int)(v * wy) : wy - 1;
    return dp_clamp((double)weight[(size_t)j * (size_t)wx + (size_t)i], 0.0, 1.0);
}

typedef struct Field
{
    double x0, y0, cell;
    int    nx, ny;
    int *  first, *next;  // roots by cells
} Field;

static bool has_room(const Field* field, const float* root, double x, double y, double apart)
{
    const int span = (int)ceil(apart / field->cell);
    const int ci = (int)((x - field->x0) / field->cell), cj = (int)((y - field->y0) / field->cell);
    for (int j = cj - span; j <= cj + span; ++j)
        for (int i = ci - span; i <= ci + span; ++i) {
            if (i < 0 || j < 0 || i >= field->nx || j >= field->ny) continue;
            int k = field->first[(size_t)j * (size_t)field->nx + (size_t)i] - 1;
            for (; k >= 0; k = field->next[k] - 1) {
                const double dx = (double)root[2 * k] - x, dy = (double)root[2 * k + 1] - y;
                if (dx * dx + dy * dy < apart * apart) return false;
            }
        }
    return true;
}

// note root k; one from beside the field in the field's cell that is nearest
static void put(Field* field, int k, double x, double y)
{
    const int i = (int)dp_clamp((x - field->x0) / field->cell, 0.0, field->nx - 1.0);
    const int j = (int)dp_clamp((y - field->y0) / field->cell, 0.0, field->ny - 1.0);
    int*      first = &field->first[(size_t)j * (size_t)field->nx + (size_t)i];
    field->next[k] = *first;
    *first = k + 1;
}

DpStatus dp_plants_place(double x0, double y0, double x1, double y1, double density,
                         const float* weight, int wx, int wy, uint64_t seed, float* root,
                         int max_count, int* count)
{
    if (!root || !count || max_count < 1 || *count < 0 || *count > max_count || !(x1 > x0) ||
        !(y1 > y0) || !(density > 0.0))
        return DP_BAD_ARGUMENT;
    if (!(fabs(x0) < 1e7 && fabs(y0) < 1e7 && x1 < 1e7 && y1 < 1e7 && density < 1e9))
        return DP_BAD_ARGUMENT;
    if (weight && (wx < 1 || wy < 1)) return DP_BAD_ARGUMENT;
    const double area = (x1 - x0) * (y1 - y0), apart = sqrt(PACKING / density);
    double       mean = weight ? 0.0 : 1.0;
    for (size_t k = 0; weight && k < (size_t)wx * (size_t)wy; ++k) {
        if (!(weight[k] >= 0.0f)) return DP_BAD_ARGUMENT;
        mean += fmin((double)weight[k], 1.0) / ((double)wx * wy);
    }
    // what is wanted of a fraction of a plant is left to chance
    const int    given = *count;
    const double wanted = floor(area * density * mean + dp_plant_hash(seed, 0, 3));
    const int    goal = wanted < max_count - given ? given + (int)wanted : max_count;
    if (goal == given) return DP_OK;

    Field field = {.x0 = x0, .y0 = y0, .cell = fmax(apart, sqrt(area / (4.0 * max_count + 64.0)))};
    field.cell = fmax(field.cell, fmax(x1 - x0, y1 - y0) / 30000.0);
    field.nx = (int)((x1 - x0) / field.cell) + 1, field.ny = (int)((y1 - y0) / field.cell) + 1;
    field.first = dp_alloc((size_t)field.nx * (size_t)field.ny, sizeof(int));
    field.next = dp_alloc((size_t)goal, sizeof(int));
    const double darts = DARTS * (double)(goal - given) / fmax(mean, 1e-3);
    for (int k = 0; field.first && field.next && k < given; ++k)
        put(&field, k, (double)root[2 * k], (double)root[2 * k + 1]);
    for (uint64_t k = 0; field.first && field.next && *count < goal && (double)k < darts; ++k) {
        const double u = dp_plant_hash(seed, k, 0), v = dp_plant_hash(seed, k, 1);
        const double want = weight_at(weight, wx, wy, u, v);
        if (!(dp_plant_hash(seed, k, 2) < want)) continue;
        const float  x = (float)(x0 + u * (x1 - x0)), y = (float)(y0 + v * (y1 - y0));
        const double near = apart / sqrt(fmax(want, THINNEST));
        if (!has_room(&field, root, (double)x, (double)y, near)) continue;
        root[2 * *count] = x, root[2 * *count + 1] = y;
        put(&field, (*count)++, (double)x, (double)y);
    }
    const bool room = field.first && field.next;
    dp_free(field.first), dp_free(field.next);
    return room ? DP_OK : DP_NO_MEMORY;
}
