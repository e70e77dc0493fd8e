// spray/spray_fly.c - grains in the air. SUMNER99, MODEL 6.15
#include "base/wide.h"
#include "spray/spray.h"

#include <math.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/vec.h"

#define CHUNK 256           // grains that are worked on at once
#define HALVINGS 16         // by which the place is found where a path meets the ground
#define AIR_DENSITY 1.2     // [kg/m^3]
#define DRAG_OF_SPHERE 0.5  // of grains, which are not round
#define MOST_GRAINS (1 << 24)
#define MOST_SQUARES (1 << 18)
#define GRAIN_BYTES 73  // of a saved one

typedef enum State
{
    FLIES = 0,
    LANDED = 1,
    FELL = 2  // beside the ground
} State;

struct DpCloud
{
    double     drag;  // k: it slows down by k |v| v                     [1/m]
    int        count;
    uint32_t   names;                  // given so far
    double *   x, *y, *z, *u, *v, *w;  // place [m] and velocity [m/s]     (count)
    double*    lowest;                 // below this it has fallen by the ground [m]
    double*    late;                   // flies so much less in the next step    [s]
    uint32_t*  name;
    uint8_t*   kind;
    uint8_t*   state;
    DpLanding* landing;

    // how high the ground is in squares under grains, of a rectangle of them; not a number: not asked for yet
    double *highest, corner_x, corner_y;  // (squares_y, squares_x), [m]
    int     squares_x, squares_y;         // 0: nothing is known
};

// ---- a life ------------------------------------------------------------------------------------

DpCloud* dp_cloud_create(const DpSprayNumbers* numbers)
{
    DpCloud* cloud = dp_alloc(1, sizeof *cloud);
    if (!cloud) return NULL;
    // k = g / (terminal speed)^2, of a sphere in fast air
    cloud->drag =
        0.75 * DRAG_OF_SPHERE * AIR_DENSITY / (numbers->particle_density * numbers->particle_size);
    return cloud;
}

void dp_cloud_destroy(DpCloud* cloud)
{
    if (!cloud) return;
    void* const blocks[] = {cloud->x,    cloud->y,    cloud->z,      cloud->u,
                            cloud->v,    cloud->w,    cloud->lowest, cloud->late,
                            cloud->name, cloud->kind, cloud->state,  cloud->landing};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
    dp_free(cloud->highest);
    dp_free(cloud);
}

int dp_cloud_count(const DpCloud* cloud)
{
    return cloud->count;
}

DpGrain dp_cloud_grain(const DpCloud* cloud, int index)
{
    return (DpGrain){dp_vec3(cloud->x[index], cloud->y[index], cloud->z[index]),
                     dp_vec3(cloud->u[index], cloud->v[index], cloud->w[index]), cloud->name[index],
                     cloud->kind[index]};
}

static bool fit(DpCloud* cloud, size_t count)
{
    double** const numbers[] = {&cloud->x, &cloud->y, &cloud->z,      &cloud->u,
                                &cloud->v, &cloud->w, &cloud->lowest, &cloud->late};
    bool           fits = dp_make_room(&cloud->name, count, sizeof *cloud->name) &&
                dp_make_room(&cloud->kind, count, 1) && dp_make_room(&cloud->state, count, 1) &&
                dp_make_room(&cloud->landing, count, sizeof *cloud->landing);
    for (size_t k = 0; fits && k < sizeof numbers / sizeof *numbers; ++k)
        fits = dp_make_room(numbers[k], count, sizeof(double));
    return fits;
}

DpStatus dp_cloud_add(DpCloud* cloud, const DpGrain* grain, double late)
{
    if (cloud->count >= MOST_GRAINS || !fit(cloud, (size_t)cloud->count + 1)) return DP_NO_MEMORY;
    const int n = cloud->count++;
    cloud->x[n] = grain->at.x, cloud->y[n] = grain->at.y, cloud->z[n] = grain->at.z;
    cloud->u[n] = grain->velocity.x, cloud->v[n] = grain->velocity.y;
    cloud->w[n] = grain->velocity.z;
    cloud->lowest[n] = grain->at.z - DP_SPRAY_FALL;
    cloud->late[n] = late;
    cloud->name[n] = cloud->names++;
    cloud->kind[n] = grain->kind;
    cloud->state[n] = FLIES;
    return DP_OK;
}

// ---- flight ------------------------------------------------------------------------------------

// Where grains are after a step: by the speed in its middle, which without air is exact.
DP_CLONES static void fly(int count, double dt, double drag, const double* restrict late,
                          double* restrict x, double* restrict y, double* restrict z,
                          double* restrict u, double* restrict v, double* restrict w)
{
    for (int n = 0; n < count; ++n) {
        const double h = dt - late[n];
        const double s = drag * sqrt(u[n] * u[n] + v[n] * v[n] + w[n] * w[n]);
        const double um = u[n] - 0.5 * h * s * u[n];
        const double vm = v[n] - 0.5 * h * s * v[n];
        const double wm = w[n] - 0.5 * h * (s * w[n] + DP_GRAVITY);
        const double sm = drag * sqrt(um * um + vm * vm + wm * wm);
        x[n] += h * um, y[n] += h * vm, z[n] += h * wm;
        u[n] -= h * sm * um, v[n] -= h * sm * vm, w[n] -= h * (sm * wm + DP_GRAVITY);
    }
}

// The square of a grain, or -1.
static inline int square_of(const DpCloud* cloud, double each, double x, double y)
{
    const double i = (x - cloud->corner_x) * each, j = (y - cloud->corner_y) * each;
    if (!(i >= 0.0 && j >= 0.0 && i < cloud->squares_x && j < cloud->squares_y)) return -1;
    return (int)j * cloud->squares_x + (int)i;
}

// How high the ground is under all grains. Where they are spread too far, or without memory, nothing is known.
static void look_down(DpCloud* cloud, const DpSprayGround* ground)
{
    const double each = 1.0 / ground->side;
    double       x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    cloud->squares_x = cloud->squares_y = 0;
    if (!ground->highest) return;
    for (int n = 0; n < cloud->count; ++n) {
        const double x = cloud->x[n], y = cloud->y[n];
        x0 = x < x0 ? x : x0, x1 = x > x1 ? x : x1;
        y0 = y < y0 ? y : y0, y1 = y > y1 ? y : y1;
    }
    const double i0 = floor((x0 - ground->x0) * each), j0 = floor((y0 - ground->y0) * each);
    const double nx = floor((x1 - ground->x0) * each) - i0 + 1.0;
    const double ny = floor((y1 - ground->y0) * each) - j0 + 1.0;
    if (!(nx * ny <= MOST_SQUARES) || fabs(i0) > 1e9 || fabs(j0) > 1e9) return;
    const int squares = (int)nx * (int)ny;
    if (!dp_make_room(&cloud->highest, (size_t)squares, sizeof *cloud->highest)) return;
    cloud->squares_x = (int)nx, cloud->squares_y = (int)ny;
    cloud->corner_x = ground->x0 + i0 * ground->side;
    cloud->corner_y = ground->y0 + j0 * ground->side;
    for (int s = 0; s < squares; ++s) cloud->highest[s] = INFINITY;
    for (int n = 0; n < cloud->count; ++n) {
        const int s = square_of(cloud, each, cloud->x[n], cloud->y[n]);
        if (s >= 0) cloud->highest[s] = NAN;
    }
    for (int s = 0; s < squares; ++s)
        if (isnan(cloud->highest[s]))
            cloud->highest[s] = ground->highest(ground->context, (long)i0 + s % cloud->squares_x,
                                                (long)j0 + s / cloud->squares_x);
}

typedef struct Flight
{
    DpCloud*             cloud;
    const DpSprayGround* ground;
    double               dt;
} Flight;

// Where the path of a grain, from `from`, meets the ground; it ends below it.
static void stop(DpCloud* cloud, int n, DpVec3 from, const DpSprayGround* ground)
{
    const DpVec3 to = dp_vec3(cloud->x[n], cloud->y[n], cloud->z[n]), path = dp_sub(to, from);
    double       over = 0.0, under = 1.0;
    for (int k = 0; k < HALVINGS; ++k) {
        const double middle = 0.5 * (over + under);
        const DpVec3 at = dp_add(from, dp_scale(path, middle));
        if (at.z <= ground->surface(ground->ground, at.x, at.y))
            under = middle;
        else
            over = middle;
    }
    cloud->x[n] = from.x + under * path.x, cloud->y[n] = from.y + under * path.y;
    cloud->state[n] = LANDED;
}

static void fly_chunk(void* context, int index, int worker)
{
    const Flight*        flight = context;
    DpCloud*             cloud = flight->cloud;
    const DpSprayGround* ground = flight->ground;
    const int            first = index * CHUNK;
    const int            count = cloud->count - first < CHUNK ? cloud->count - first : CHUNK;
    double               x[CHUNK], y[CHUNK], z[CHUNK];
    (void)worker;
    for (int k = 0; k < count; ++k)
        x[k] = cloud->x[first + k], y[k] = cloud->y[first + k], z[k] = cloud->z[first + k];
    fly(count, flight->dt, cloud->drag, cloud->late + first, cloud->x + first, cloud->y + first,
        cloud->z + first, cloud->u + first, cloud->v + first, cloud->w + first);
    for (int k = 0, n = first; k < count; ++k, ++n) {
        cloud->late[n] = 0.0;
        const int square = cloud->squares_x > 0
                               ? square_of(cloud, 1.0 / ground->side, cloud->x[n], cloud->y[n])
                               : -1;
        if (square >= 0 && cloud->z[n] > cloud->highest[square]) continue;
        const double height = ground->surface(ground->ground, cloud->x[n], cloud->y[n]);
        if (cloud->z[n] <= height)
            stop(cloud, n, dp_vec3(x[k], y[k], z[k]), ground);
        else if (isnan(height) && cloud->z[n] < cloud->lowest[n])
            cloud->state[n] = FELL;
    }
}

// Those that fly on move up; those that do not are listed.
static int sort_out(DpCloud* cloud)
{
    int kept = 0, out = 0;
    for (int n = 0; n < cloud->count; ++n) {
        if (cloud->state[n] != FLIES) {
            cloud->landing[out++] =
                (DpLanding){cloud->x[n], cloud->y[n], cloud->kind[n], cloud->state[n] == FELL};
            continue;
        }
        if (kept < n) {
            cloud->x[kept] = cloud->x[n], cloud->y[kept] = cloud->y[n];
            cloud->z[kept] = cloud->z[n], cloud->u[kept] = cloud->u[n];
            cloud->v[kept] = cloud->v[n], cloud->w[kept] = cloud->w[n];
            cloud->lowest[kept] = cloud->lowest[n], cloud->late[kept] = cloud->late[n];
            cloud->name[kept] = cloud->name[n], cloud->kind[kept] = cloud->kind[n];
            cloud->state[kept] = FLIES;
        }
        ++kept;
    }
    cloud->count = kept;
    return out;
}

DpStatus dp_cloud_fly(DpCloud* cloud, const DpSprayGround* ground, double dt, int workers,
                      const DpLanding** landing, int* landings)
{
    if (!(dt >= 0.0) || !isfinite(dt)) return DP_BAD_ARGUMENT;
    Flight    flight = {cloud, ground, dt};
    const int chunks = (cloud->count + CHUNK - 1) / CHUNK;
    look_down(cloud, ground);
    dp_parallel_for(chunks, chunks > 4 ? workers : 1, fly_chunk, &flight);
    *landings = sort_out(cloud);
    *landing = cloud->landing;
    return DP_OK;
}

// ---- kept from run to run ----------------------------------------------------------------------

void dp_cloud_save(const DpCloud* cloud, DpStateWriter* writer)
{
    const size_t  count = (size_t)cloud->count;
    double* const numbers[] = {cloud->x, cloud->y, cloud->z,      cloud->u,
                               cloud->v, cloud->w, cloud->lowest, cloud->late};
    dp_write_u64(writer, cloud->names);
    dp_write_u64(writer, count);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        dp_write_doubles(writer, numbers[k], count);
    for (size_t n = 0; n < count; ++n) dp_write_u8(writer, cloud->kind[n]);
    for (size_t n = 0; n < count; ++n) dp_write_u64(writer, cloud->name[n]);
}

DpStatus dp_cloud_load(DpCloud** cloud_out, const DpSprayNumbers* numbers, DpStateReader* reader)
{
    DpCloud* cloud = dp_cloud_create(numbers);
    if (!cloud) return DP_NO_MEMORY;
    cloud->names = (uint32_t)dp_read_int(reader, 0, UINT32_MAX);
    const size_t count = dp_read_count(reader, MOST_GRAINS, GRAIN_BYTES);
    if (count > 0 && !fit(cloud, count)) {
        dp_cloud_destroy(cloud);
        return DP_NO_MEMORY;
    }
    double* const of[] = {cloud->x, cloud->y, cloud->z,      cloud->u,
                          cloud->v, cloud->w, cloud->lowest, cloud->late};
    for (size_t k = 0; k < sizeof of / sizeof *of; ++k)
        for (size_t n = 0; n < count; ++n) of[k][n] = dp_read_number(reader, -1e9, 1e9);
    for (size_t n = 0; n < count; ++n) cloud->kind[n] = dp_read_u8(reader);
    for (size_t n = 0; n < count; ++n)
        cloud->name[n] = (uint32_t)dp_read_int(reader, 0, UINT32_MAX);
    if (reader->status != DP_OK) {
        dp_cloud_destroy(cloud);
        return reader->status;
    }
    cloud->count = (int)count;
    *cloud_out = cloud;
    return DP_OK;
}
