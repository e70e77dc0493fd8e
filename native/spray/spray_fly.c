// spray/spray_fly.c - grains in the air. SUMNER99, MODEL 6.15
#include "base/wide.h"
#include "spray/spray.h"

#include <math.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/vec.h"

#define CHUNK 256           // grains that are worked on at once
#define LANES 8             // numbers that are compared at once
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
    size_t     room;                   // for so many there is
    uint32_t   names;                  // given so far
    double *   x, *y, *z, *u, *v, *w;  // place [m] and velocity [m/s]     (count)
    double*    lowest;                 // below this it has fallen by the ground [m]
    double*    late;                   // flies so much less in the next step    [s]
    uint32_t*  name;
    uint8_t*   kind;
    uint8_t*   state;
    DpLanding* landing;

    // how high the ground is in squares under grains, of a rectangle of them
    double*  highest;   // INFINITY: not known (squares_y, squares_x) [m]
    int*     ended;     // so many of each chunk do not fly on
    int32_t* square;    // under each grain, or -1                   (count)
    double (*wide)[4];  // lowest x, highest x, lowest y, highest y, of chunks [m]
    double corner_x, corner_y, squares_each;  // [m], [m], [1/m]
    int    squares_x, squares_y;              // 0: nothing is known
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
    void* const blocks[] = {cloud->x,    cloud->y,     cloud->z,      cloud->u,
                            cloud->v,    cloud->w,     cloud->lowest, cloud->late,
                            cloud->name, cloud->kind,  cloud->state,  cloud->landing,
                            cloud->wide, cloud->ended, cloud->square, cloud->highest};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
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
    if (count <= cloud->room) return true;
    const size_t chunks = (count + CHUNK - 1) / CHUNK;
    count = chunks * CHUNK;
    double** const numbers[] = {&cloud->x, &cloud->y, &cloud->z,      &cloud->u,
                                &cloud->v, &cloud->w, &cloud->lowest, &cloud->late};
    bool           fits = dp_make_room(&cloud->name, count, sizeof *cloud->name) &&
                dp_make_room(&cloud->kind, count, 1) && dp_make_room(&cloud->state, count, 1) &&
                dp_make_room(&cloud->landing, count, sizeof *cloud->landing) &&
                dp_make_room(&cloud->square, count, sizeof *cloud->square) &&
                dp_make_room(&cloud->wide, chunks, sizeof *cloud->wide) &&
                dp_make_room(&cloud->ended, chunks, sizeof *cloud->ended);
    for (size_t k = 0; fits && k < sizeof numbers / sizeof *numbers; ++k)
        fits = dp_make_room(numbers[k], count, sizeof(double));
    if (fits) cloud->room = count;
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

typedef struct Flight
{
    DpCloud*             cloud;
    const DpSprayGround* ground;
    double               dt;
} Flight;

static int size_of(const DpCloud* cloud, int chunk)
{
    const int left = cloud->count - chunk * CHUNK;
    return left < CHUNK ? left : CHUNK;
}

// lowest and highest of some numbers, of which there are CHUNK or less
DP_CLONES static void bound(int count, const double* restrict x, double* restrict found)
{
    double low[LANES], high[LANES];
    int    n = 0;
    for (int k = 0; k < LANES; ++k) low[k] = INFINITY, high[k] = -INFINITY;
    for (; n + LANES <= count; n += LANES)
        for (int k = 0; k < LANES; ++k) {
            low[k] = x[n + k] < low[k] ? x[n + k] : low[k];
            high[k] = x[n + k] > high[k] ? x[n + k] : high[k];
        }
    for (int k = 0; n + k < count; ++k) {
        low[k] = x[n + k] < low[k] ? x[n + k] : low[k];
        high[k] = x[n + k] > high[k] ? x[n + k] : high[k];
    }
    for (int k = 1; k < LANES; ++k) {
        low[0] = low[k] < low[0] ? low[k] : low[0];
        high[0] = high[k] > high[0] ? high[k] : high[0];
    }
    found[0] = low[0], found[1] = high[0];
}

static void bound_chunk(void* context, int index, int worker)
{
    DpCloud* const cloud = ((const Flight*)context)->cloud;
    const size_t   first = (size_t)index * CHUNK;
    const int      count = size_of(cloud, index);
    (void)worker;
    bound(count, cloud->x + first, cloud->wide[index]);
    bound(count, cloud->y + first, cloud->wide[index] + 2);
}

// a number within 0 and `most`, of any number
static inline double within(double number, double most)
{
    const double low = number > 0.0 ? number : 0.0;
    return low < most ? low : most;
}

// The squares that grains are over, or -1.
DP_CLONES static void squares_of(int count, const DpCloud* cloud, const double* restrict x,
                                 const double* restrict y, int32_t* restrict square)
{
    const double  each = cloud->squares_each, x0 = cloud->corner_x, y0 = cloud->corner_y;
    const int32_t row = cloud->squares_x;
    const double  nx = cloud->squares_x, ny = cloud->squares_y;
    for (int n = 0; n < count; ++n) {
        const double  i = (x[n] - x0) * each, j = (y[n] - y0) * each;
        const int32_t at = (int32_t)within(j, ny) * row + (int32_t)within(i, nx);
        const int     in = (i >= 0.0) & (j >= 0.0) & (i < nx) & (j < ny);
        square[n] = in ? at : -1;
    }
}

static void square_chunk(void* context, int index, int worker)
{
    DpCloud* const cloud = ((const Flight*)context)->cloud;
    const size_t   first = (size_t)index * CHUNK;
    (void)worker;
    squares_of(size_of(cloud, index), cloud, cloud->x + first, cloud->y + first,
               cloud->square + first);
}

// The rectangle of squares that all grains are over. False: they are spread too far, or there is no memory.
static bool lay_squares(DpCloud* cloud, const DpSprayGround* ground, int chunks)
{
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    for (int c = 0; c < chunks; ++c) {
        const double* const wide = cloud->wide[c];
        x0 = wide[0] < x0 ? wide[0] : x0, x1 = wide[1] > x1 ? wide[1] : x1;
        y0 = wide[2] < y0 ? wide[2] : y0, y1 = wide[3] > y1 ? wide[3] : y1;
    }
    const double each = 1.0 / ground->side;
    const double i0 = floor((x0 - ground->x0) * each), j0 = floor((y0 - ground->y0) * each);
    const double nx = floor((x1 - ground->x0) * each) - i0 + 1.0;
    const double ny = floor((y1 - ground->y0) * each) - j0 + 1.0;
    if (!(nx * ny <= MOST_SQUARES) || fabs(i0) > 1e9 || fabs(j0) > 1e9) return false;
    if (!dp_make_room(&cloud->highest, (size_t)nx * (size_t)ny, sizeof *cloud->highest))
        return false;
    cloud->squares_x = (int)nx, cloud->squares_y = (int)ny, cloud->squares_each = each;
    cloud->corner_x = ground->x0 + i0 * ground->side;
    cloud->corner_y = ground->y0 + j0 * ground->side;
    return true;
}

// How high the ground is under all grains, where that can be known.
static void look_down(Flight* flight, int chunks, int workers)
{
    DpCloud* const             cloud = flight->cloud;
    const DpSprayGround* const ground = flight->ground;
    cloud->squares_x = cloud->squares_y = 0;
    if (!ground->highest) return;
    dp_parallel_for(chunks, workers, bound_chunk, flight);
    if (!lay_squares(cloud, ground, chunks)) return;
    dp_parallel_for(chunks, workers, square_chunk, flight);
    const int  squares = cloud->squares_x * cloud->squares_y;
    const long i0 = lround((cloud->corner_x - ground->x0) * cloud->squares_each);
    const long j0 = lround((cloud->corner_y - ground->y0) * cloud->squares_each);
    for (int s = 0; s < squares; ++s) cloud->highest[s] = INFINITY;
    for (int n = 0; n < cloud->count; ++n)
        if (cloud->square[n] >= 0) cloud->highest[cloud->square[n]] = NAN;  // is asked for
    for (int s = 0; s < squares; ++s)
        if (isnan(cloud->highest[s]))
            cloud->highest[s] = ground->highest(ground->context, i0 + s % cloud->squares_x,
                                                j0 + s / cloud->squares_x);
}

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
    const size_t         first = (size_t)index * CHUNK;
    const int            count = size_of(cloud, index);
    double* const        late = cloud->late + first;
    double *const x = cloud->x + first, *const y = cloud->y + first, *const z = cloud->z + first;
    double  from[3][CHUNK];
    int32_t square[CHUNK];
    int     ended = 0;
    (void)worker;
    for (int n = 0; n < count; ++n) from[0][n] = x[n], from[1][n] = y[n], from[2][n] = z[n];
    fly(count, flight->dt, cloud->drag, late, x, y, z, cloud->u + first, cloud->v + first,
        cloud->w + first);
    if (cloud->squares_x > 0) squares_of(count, cloud, x, y, square);
    for (int n = 0; n < count; ++n) {
        late[n] = 0.0;
        if (cloud->squares_x > 0 && square[n] >= 0 && z[n] > cloud->highest[square[n]]) continue;
        const double height = ground->surface(ground->ground, x[n], y[n]);
        if (z[n] <= height)
            stop(cloud, (int)first + n, dp_vec3(from[0][n], from[1][n], from[2][n]), ground);
        else if (isnan(height) && z[n] < cloud->lowest[first + (size_t)n])
            cloud->state[first + (size_t)n] = FELL;
        ended += cloud->state[first + (size_t)n] != FLIES;
    }
    cloud->ended[index] = ended;
}

// Those that fly on move up; those that do not are listed.
static int sort_out(DpCloud* cloud)
{
    int kept = 0, out = 0;
    for (int n = 0; n < cloud->count; ++n) {
        if (n % CHUNK == 0 && kept == n && cloud->ended[n / CHUNK] == 0) {
            kept += size_of(cloud, n / CHUNK);
            n = kept - 1;
            continue;
        }
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
    if (chunks <= 4) workers = 1;
    look_down(&flight, chunks, workers);
    dp_parallel_for(chunks, workers, fly_chunk, &flight);
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
