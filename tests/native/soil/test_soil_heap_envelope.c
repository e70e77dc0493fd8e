// tests of soil_heap_envelope.c: MODEL 6.3
//
// Cones are held against shortest ways, cell by cell, over and over until none is shorter.
#include "heap.h"

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
    RUN(cones_fall_by_their_slope_around_all_that_takes_no_soil);
    RUN(one_cone_on_level_ground);
    return check_done();
}
