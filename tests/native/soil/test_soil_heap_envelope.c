// tests of soil_heap_envelope.c and soil_heap_window.c: MODEL 6.3
//
// Cones are held against shortest ways, cell by cell, over and over until none is shorter.
#include "check.h"
#include "ground.h"
#include "soil/soil_heap_inside.h"

#define NX 37
#define NY 29
#define CELL 0.01
#define SLOPE 0.6
#define HEIGHT 0.05

static int32_t surface[64 * 64], fill[64 * 64], turn[64 * 64], spare[64];
static Apex    apex[3];

static Heap heap_on(Ground* ground, int i0, int j0, int nx, int ny)
{
    Heap heap = {
        .patch = &ground->patch, .imprint = &ground->imprint, .apex = apex, .hollow = INFINITY};
    heap.window.row = 64;
    heap.window.surface = surface, heap.window.fill = fill;
    heap.window.turn = turn, heap.window.spare = spare;
    CHECK(dp_heap_open(&heap, HEIGHT, SLOPE, dp_cells(i0, j0, nx, ny)));
    return heap;
}

// ground that goes up and down, with holes, and a sole
static Ground uneven_ground(unsigned seed)
{
    Ground ground = ground_make(NX, NY, CELL, dp_soil_default());
    for (int k = 0; k < NX * NY; ++k) {
        ground.base_height[k] = 3.0f + 0.01f * (float)check_random(&seed);
        ground.compression[k] = 0.02f * (float)check_random(&seed);
        ground.heap[k] = check_random(&seed) < 0.5 ? 0.0f : 0.01f * (float)check_random(&seed);
        if (check_random(&seed) < 0.04) ground.base_height[k] = NAN;
        const int i = k % NX, j = k / NX;
        ground.imprint.ring[k] = i >= 14 && i < 22 && j >= 9 && j < 21 ? 0 : DP_RING_FAR;
    }
    return ground;
}

TEST(the_surface_is_read_in_steps)
{
    Ground ground = uneven_ground(3u);
    for (int k = 0; k < NX * NY; ++k) ground.compression[k] += k % 11 == 0 ? 0.1f : 0.0f;
    Heap heap = heap_on(&ground, 2, 3, 30, 20);
    heap.hollow = 0.1f;
    CHECK(dp_heap_open(&heap, HEIGHT, SLOPE, dp_cells(2, 3, 30, 20)));
    int steps = 0;
    CHECK(frexp(heap.step, &steps) == 0.5 && heap.step < 1e-8);
    CHECK_NEAR(heap.straight * heap.step, SLOPE * CELL, heap.step);
    CHECK_NEAR(heap.diagonal * heap.step, SLOPE * CELL * sqrt(2.0), heap.step);
    for (int j = -1; j <= 20; ++j)
        for (int i = -1; i <= 30; ++i) {
            const int32_t at = row_of(&heap.window, surface, j)[i];
            const size_t  p = (size_t)(j + 3) * NX + (size_t)(i + 2);
            const bool    takes = i >= 0 && i < 30 && j >= 0 && j < 20 &&
                               soil_is_ground(ground.base_height[p]) &&
                               ground.imprint.ring[p] != 0 && ground.compression[p] < 0.1f;
            CHECK((at == WALL) == !takes);
            if (takes)
                CHECK_NEAR(heap.level + at * heap.step,
                           (double)ground.base_height[p] - (double)ground.compression[p] +
                               (double)ground.heap[p],
                           heap.step);
        }
    // runs end where walls begin, and the other way round
    for (int j = 0; j < 20; ++j)
        for (int from = 0, to = 0; from < 30; from = to) {
            const int32_t* row = row_of(&heap.window, surface, j);
            const int32_t  told = row_of(&heap.window, turn, j)[from];
            to = told < 0 ? -told : told;
            CHECK((told < 0) == (row[from] == WALL) && to > from && to <= 30);
            for (int i = from; i < to; ++i) CHECK((row[i] == WALL) == (row[from] == WALL));
            CHECK(to == 30 || (row[to] == WALL) != (row[from] == WALL));
        }
    ground_free(&ground);
}

// the envelope of the cones, by relaxing every cell by its eight neighbours until nothing changes
static void slow_envelope(const Heap* heap, double height, int64_t want[NY][NX])
{
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i) want[j][i] = NOTHING;
    for (int k = 0; k < heap->apex_count; ++k) {
        const Apex*  at = &heap->apex[k];
        const double top =
            (at->ground - heap->level + height * at->root) / heap->step - at->away * heap->straight;
        want[at->j][at->i] = (int64_t)floor(top + 0.5);
    }
    for (bool more = true; more;) {
        more = false;
        for (int j = 0; j < NY; ++j)
            for (int i = 0; i < NX; ++i)
                for (int q = 0; q < 9; ++q) {
                    const int x = i + q % 3 - 1, y = j + q / 3 - 1;
                    if (q == 4 || x < 0 || x >= NX || y < 0 || y >= NY) continue;
                    if (row_of(&heap->window, surface, j)[i] == WALL) continue;
                    if (want[y][x] <= NOTHING / 2) continue;
                    const int64_t come = want[y][x] - (q % 2 ? heap->straight : heap->diagonal);
                    if (come > want[j][i]) want[j][i] = come, more = true;
                }
    }
}

TEST(cones_fall_by_their_slope_around_all_that_takes_no_soil)
{
    for (unsigned seed = 1; seed <= 8; ++seed) {
        Ground ground = uneven_ground(seed);
        // on three sides of the sole, cells that take soil
        const int at[3][2] = {{13, 12}, {22, 17}, {17, 8}};
        for (int k = 0; k < 3; ++k) {
            ground.base_height[at[k][1] * NX + at[k][0]] = 3.0f;
            apex[k] = (Apex){at[k][0], at[k][1], 3.0, k == 0 ? 1.0 : 0.7, 0.25 * k, 0.0, 0.0};
        }
        Heap heap = heap_on(&ground, 0, 0, NX, NY);
        heap.apex_count = 1 + (int)(seed % 3);
        static int64_t want[NY][NX];
        slow_envelope(&heap, HEIGHT, want);
        const Laid laid = dp_heap_fill(&heap, HEIGHT);
        int64_t    volume = 0, cells = 0;
        for (int j = 0; j < NY; ++j)
            for (int i = 0; i < NX; ++i) {
                const int64_t got = row_of(&heap.window, fill, j)[i];
                const int64_t over = want[j][i] - row_of(&heap.window, surface, j)[i];
                CHECK(want[j][i] > NOTHING / 2 ? got == want[j][i] : got <= NOTHING / 2);
                volume += over > 0 ? over : 0, cells += over > 0;
            }
        CHECK(laid.volume == volume && laid.cells == cells && cells > 20);
        ground_free(&ground);
    }
}

// one cone on level ground: T high, its foot T / slope away along a row, and as much soil as a chamfer cone holds
TEST(one_cone_on_level_ground)
{
    Ground ground = ground_make(NX, NY, CELL, dp_soil_default());
    for (int k = 0; k < NX * NY; ++k) ground.imprint.ring[k] = DP_RING_FAR;
    apex[0] = (Apex){18, 14, 0.0, 1.0, 0.0, 0.0, 0.0};
    Heap heap = heap_on(&ground, 0, 0, NX, NY);
    heap.apex_count = 1;
    const Laid laid = dp_heap_fill(&heap, HEIGHT);
    double     volume = 0.0;
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i) {
            const int    x = abs(i - 18), y = abs(j - 14), aslant = x < y ? x : y;
            const double far = (x > y ? x : y) - aslant + sqrt(2.0) * aslant;
            const double over = HEIGHT - SLOPE * CELL * far;
            volume += over > 0.0 ? over : 0.0;
            CHECK_NEAR(row_of(&heap.window, fill, j)[i] * heap.step, over, 60 * heap.step);
        }
    CHECK_CLOSE((double)laid.volume * heap.step, volume, 1e-6);
    ground_free(&ground);
}

int main(void)
{
    RUN(the_surface_is_read_in_steps);
    RUN(cones_fall_by_their_slope_around_all_that_takes_no_soil);
    RUN(one_cone_on_level_ground);
    return check_done();
}
