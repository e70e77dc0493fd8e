// tests of soil_heap_window.c: the surface in whole steps, so fine as its heights allow. MODEL 6.3
#include "heap.h"

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

// the steps are as fine as they can be while all heights fit: of the lowest firm ground, the highest surface, a heap on
// top and a cone that falls across the window
TEST(steps_are_as_fine_as_the_heights_allow)
{
    Ground       ground = ground_make(NX, NY, CELL, dp_soil_default());
    const double tall[] = {0.02, 0.5, 40.0, 3000.0};
    for (int k = 0; k < NX * NY; ++k) ground.imprint.ring[k] = DP_RING_FAR;
    for (int n = 0; n < 4; ++n) {
        // wherever in the window the extremes stand
        for (int at = 0; at < 30; at += 7) {
            const int low = (4 + at % 20) * NX + 2 + at, high = (22 - at % 20) * NX + 31 - at;
            ground.compression[low] = (float)(0.25 * tall[n]);
            ground.base_height[high] = (float)(0.5 * tall[n]),
            ground.heap[high] = (float)(0.25 * tall[n]);
            const Heap   heap = heap_on(&ground, 2, 3, 30, 20);
            const double range = tall[n] + HEIGHT + SLOPE * CELL * (30 + 20);
            CHECK(range <= heap.step * MAX_STEPS && range > 0.5 * heap.step * MAX_STEPS);
            CHECK_NEAR(heap.level, -(0.25 * tall[n]), 1e-6 * tall[n]);
            ground.compression[low] = 0.0f;
            ground.base_height[high] = ground.heap[high] = 0.0f;
        }
    }
    // what lies beside the window does not count, nor does ground that is not there
    ground.heap[2 * NX + 5] = 9.0f, ground.heap[5 * NX + 1] = 9.0f;
    ground.heap[23 * NX + 5] = 9.0f, ground.heap[5 * NX + 32] = 9.0f;
    ground.base_height[10 * NX + 10] = NAN, ground.heap[10 * NX + 10] = 9.0f;
    const Heap level = heap_on(&ground, 2, 3, 30, 20);
    CHECK(level.step * MAX_STEPS < 2.0 * (HEIGHT + SLOPE * CELL * (30 + 20)));
    ground_free(&ground);
}

TEST(heights_that_fit_no_steps_are_refused)
{
    Ground ground = ground_make(NX, NY, CELL, dp_soil_default());
    Heap   heap = heap_on(&ground, 0, 0, NX, NY);
    CHECK(!dp_heap_open(&heap, INFINITY, SLOPE, dp_cells(0, 0, NX, NY)));
    CHECK(!dp_heap_open(&heap, 2e12, SLOPE, dp_cells(0, 0, NX, NY)));
    CHECK(dp_heap_open(&heap, 1e11, SLOPE, dp_cells(0, 0, NX, NY)));
    for (int k = 0; k < NX * NY; ++k) ground.base_height[k] = NAN;
    CHECK(!dp_heap_open(&heap, HEIGHT, SLOPE, dp_cells(0, 0, NX, NY)));  // no ground at all
    ground_free(&ground);
}

int main(void)
{
    RUN(the_surface_is_read_in_steps);
    RUN(steps_are_as_fine_as_the_heights_allow);
    RUN(heights_that_fit_no_steps_are_refused);
    return check_done();
}
