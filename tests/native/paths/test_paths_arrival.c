// Arrival times: along an axis, round a circle, behind a wall, mirrored, and what is refused.
#include "check.h"
#include "paths/paths.h"

#define N 101
#define CELL 0.25

static float cost[N * N], out[N * N], other[N * N];

static DpPathField even(float value)
{
    for (int k = 0; k < N * N; ++k) cost[k] = value;
    return (DpPathField){N, N, CELL, cost};
}

static void uneven(unsigned seed)
{
    for (int k = 0; k < N * N; ++k) {
        cost[k] = 1.0f + (float)check_random(&seed);
        if (check_random(&seed) < 0.2) cost[k] = INFINITY;
        if (check_random(&seed) < 0.05) cost[k] = NAN;
    }
}

TEST(exact_along_an_axis)
{
    const DpPathField field = even(2.0f);
    const int32_t     goal = 50 * N;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &goal, NULL}) == DP_OK);
    for (int i = 0; i < N; ++i) CHECK_NEAR(out[50 * N + i], 2.0 * CELL * i, 1e-4);
}

TEST(round_a_circle)
{
    const DpPathField field = even(1.0f);
    const int32_t     goal = 50 * N + 50;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &goal, NULL}) == DP_OK);
    double worst = 0.0;
    for (int j = 0; j < N; ++j)
        for (int i = 0; i < N; ++i)
            worst = fmax(worst, fabs((double)out[j * N + i] - CELL * hypot(i - 50, j - 50)));
    CHECK(worst > 0.0 && worst < 0.6 * CELL);
}

TEST(mirrors_and_turns_are_the_same_bits)
{
    static float turned[N * N];
    uneven(7);
    const int32_t goal[2] = {50 * N + 50, 3 * N + 97};
    int32_t       aside[2];
    cost[goal[0]] = cost[goal[1]] = 1.0f;
    const DpPathField field = {N, N, CELL, cost}, other_field = {N, N, CELL, turned};
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){2, goal, NULL}) == DP_OK);
    for (int way = 1; way < 8; ++way) {
        for (int k = 0; k < N * N; ++k) {
            int i = k % N, j = k / N, swap = i;
            if (way & 1) i = N - 1 - i;
            if (way & 2) j = N - 1 - j;
            if (way & 4) swap = i, i = j, j = swap;
            turned[j * N + i] = cost[k];
            for (int g = 0; g < 2; ++g)
                if (goal[g] == k) aside[1 - g] = j * N + i;
        }
        CHECK(dp_paths_arrival(other, &other_field, &(DpGoals){2, aside, NULL}) == DP_OK);
        bool same = true;
        for (int k = 0; k < N * N; ++k) {
            int i = k % N, j = k / N, swap = i;
            if (way & 1) i = N - 1 - i;
            if (way & 2) j = N - 1 - j;
            if (way & 4) swap = i, i = j, j = swap;
            same = same && memcmp(&out[k], &other[j * N + i], sizeof *out) == 0;
        }
        CHECK(same);
    }
}

// costs that no bucket is made for: the order must not depend on buckets
TEST(any_scale_of_costs_and_starts)
{
    DpPathField   field = even(1.0f);
    const int32_t goal[2] = {0, N - 1};
    const float   start[2] = {0.0f, 1e6f};  // too late for anybody
    field.ny = 1;
    cost[60] = 1e6f;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){2, goal, start}) == DP_OK);
    for (int i = 1; i < N; ++i) CHECK(out[i] > out[i - 1]);
    CHECK_CLOSE(out[N - 1], 1e6 * CELL, 0.6);
    cost[60] = INFINITY;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){2, goal, start}) == DP_OK);
    CHECK(out[60] == INFINITY && out[59] < 16.0f && out[61] >= 1e6f && out[N - 1] == 1e6f);
    cost[60] = 1.0f;
    for (int i = 1; i < N; i += 2) cost[i] = 1e-19f;  // less than a time's last digit
    cost[1] = 1e10f;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, goal, NULL}) == DP_OK);
    for (int i = 1; i < N; ++i) CHECK(out[i] > out[i - 1]);
}

TEST(a_start_holds_unless_another_is_earlier)
{
    DpPathField   field = even(1.0f);
    const int32_t goal[3] = {0, 8, 40};
    const float   start[3] = {1.0f, 5.0f, 3.0f};
    field.ny = 1;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){3, goal, start}) == DP_OK);
    CHECK_NEAR(out[0], 1.0, 0.0);
    CHECK_NEAR(out[8], 1.0 + 8 * CELL, 1e-6);
    CHECK_NEAR(out[40], 3.0, 0.0);
}

TEST(bad_input_changes_nothing)
{
    DpPathField   field = even(1.0f);
    const int32_t good = 5, outside = N * N, before = -1, wall = 7;
    const float   late = NAN;
    out[0] = 42.0f;
    cost[7] = INFINITY;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){0, &good, NULL}) == DP_BAD_ARGUMENT);
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &outside, NULL}) == DP_BAD_ARGUMENT);
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &before, NULL}) == DP_BAD_ARGUMENT);
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &wall, NULL}) == DP_BAD_ARGUMENT);
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &good, &late}) == DP_BAD_ARGUMENT);
    const float bad[] = {0.0f, -1.0f, -INFINITY, 1e30f};
    for (int k = 0; k < 4; ++k) {
        cost[9] = bad[k];
        CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &good, NULL}) == DP_BAD_ARGUMENT);
    }
    cost[9] = 1.0f;
    field.cell = 0.0;
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &good, NULL}) == DP_BAD_ARGUMENT);
    field = (DpPathField){65536, 65536, CELL, cost};
    CHECK(dp_paths_arrival(out, &field, &(DpGoals){1, &good, NULL}) == DP_BAD_ARGUMENT);
    CHECK(out[0] == 42.0f);
}

TEST(memory_that_is_not_there)
{
    uneven(3);
    const DpPathField field = {N, N, CELL, cost};
    const int32_t     goal = 0;
    cost[0] = 1.0f;
    out[0] = 42.0f;
    int failed = 0;
    for (;; ++failed) {
        dp_alloc_fail_after(failed);
        const DpStatus status = dp_paths_arrival(out, &field, &(DpGoals){1, &goal, NULL});
        dp_alloc_fail_after(-1);
        if (status == DP_OK) break;
        CHECK(status == DP_NO_MEMORY && out[0] == 42.0f);
        if (failed > 100) break;
    }
    CHECK(failed >= 4 && failed < 100);
    CHECK(out[0] == 0.0f);
}

int main(void)
{
    RUN(exact_along_an_axis);
    RUN(round_a_circle);
    RUN(mirrors_and_turns_are_the_same_bits);
    RUN(any_scale_of_costs_and_starts);
    RUN(a_start_holds_unless_another_is_earlier);
    RUN(bad_input_changes_nothing);
    RUN(memory_that_is_not_there);
    return check_done();
}
