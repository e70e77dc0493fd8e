// Paths: straight, through mazes, with pulls that would lead elsewhere; where there is none.
#include "check.h"

#include <string.h>

#include "paths/paths.h"

#define N 61
#define CELL 0.5

static float cost[N * N], time_[N * N], pull[2 * N * N], down[2 * N * N];

static DpPathField field_to(int32_t goal)
{
    const DpPathField from = {N, N, CELL, cost};
    CHECK(dp_paths_arrival(time_, &from, &(DpGoals){1, &goal, NULL}) == DP_OK);
    return (DpPathField){N, N, CELL, time_};
}

static int cell_of(const double* at)
{
    return (int)floor(at[1] / CELL) * N + (int)floor(at[0] / CELL);
}

TEST(directions_are_unit_vectors_to_the_goal)
{
    for (int k = 0; k < N * N; ++k) cost[k] = 1.0f;
    cost[5 * N + 5] = INFINITY;
    const DpPathField field = field_to(30 * N + 30);
    CHECK(dp_paths_direction(down, &field) == DP_OK);
    CHECK(down[2 * (5 * N + 5)] == 0.0f && down[2 * (30 * N + 30)] == 0.0f);
    for (int k = 0; k < N * N; ++k) {
        const double x = 30 - k % N, y = 30 - k / N, far = hypot(x, y);
        if (far < 8.0 || hypot(x - 25.0, y - 25.0) < 3.0 || (x > 24.0 && y > 24.0)) continue;
        CHECK_NEAR(hypot((double)down[2 * k], (double)down[2 * k + 1]), 1.0, 1e-6);
        CHECK((double)down[2 * k] * x / far + (double)down[2 * k + 1] * y / far > cos(0.12));
    }
}

TEST(a_path_is_straight_on_even_ground)
{
    for (int k = 0; k < N * N; ++k) cost[k] = 1.0f;
    const DpPathField field = field_to(40 * N + 50);
    DpPath            path = {0};
    CHECK(dp_paths_descend(&path, &field, NULL, 2.2, 3.1, 0.25, NULL) == DP_OK);
    CHECK(cell_of(path.point + 2 * (path.count - 1)) == 40 * N + 50);
    CHECK_NEAR(0.25 * (path.count - 1), hypot(25.25 - 2.2, 20.25 - 3.1), 0.6);
    dp_free(path.point);
}

// Through a thicket, with a pull that tries anything: it ends at the goal, and never stands in an obstacle.
TEST(every_path_ends_at_the_goal)
{
    unsigned seed = 11;
    int      gone = 0;
    for (int round = 0; round < 20; ++round) {
        for (int k = 0; k < N * N; ++k)
            cost[k] =
                check_random(&seed) < 0.3 ? INFINITY : 1.0f + 20.0f * (float)check_random(&seed);
        const int32_t goal = (int32_t)(check_random(&seed) * N * N);
        cost[goal] = 1.0f;
        for (int k = 0; k < N * N; ++k) {
            const double turn = 6.3 * check_random(&seed), size = round % 3 ? 0.97 : 5.0;
            pull[2 * k] = (float)(size * cos(turn)), pull[2 * k + 1] = (float)(size * sin(turn));
        }
        const DpPathField field = field_to(goal);
        for (int k = 0; k < N * N; k += 7) {
            if (!(time_[k] < INFINITY)) continue;
            DpPath path = {0};
            CHECK(dp_paths_descend(&path, &field, pull, (k % N + 0.3) * CELL, (k / N + 0.8) * CELL,
                                   0.1 + 0.4 * check_random(&seed), NULL) == DP_OK);
            CHECK(cell_of(path.point + 2 * (path.count - 1)) == goal);
            for (int p = 0; p < path.count; ++p)
                CHECK(time_[cell_of(path.point + 2 * p)] < INFINITY);
            dp_free(path.point);
            gone += 1;
        }
    }
    CHECK(gone > 1000);
}

TEST(where_there_is_no_path)
{
    for (int k = 0; k < N * N; ++k) cost[k] = 1.0f;
    for (int k = 0; k < N; ++k) cost[20 * N + k] = INFINITY;
    const DpPathField field = field_to(0);
    DpPath            path = {0};
    CHECK(dp_paths_descend(&path, &field, NULL, 5.0, 25.0, 0.25, NULL) == DP_NO_GROUND);
    CHECK(dp_paths_descend(&path, &field, NULL, 5.0, 10.2, 0.25, NULL) == DP_NO_GROUND);
    CHECK(dp_paths_descend(&path, &field, NULL, -0.1, 5.0, 0.25, NULL) == DP_NO_GROUND);
    CHECK(dp_paths_descend(&path, &field, NULL, (double)NAN, 5.0, 0.25, NULL) == DP_NO_GROUND);
    CHECK(dp_paths_descend(&path, &field, NULL, 5.0, 1e300, 0.25, NULL) == DP_NO_GROUND);
    CHECK(dp_paths_descend(&path, &field, NULL, 5.0, 5.0, 0.0, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_paths_descend(&path, &field, NULL, 5.0, 5.0, 0.6, NULL) == DP_BAD_ARGUMENT);
    dp_alloc_fail_after(1);
    CHECK(dp_paths_descend(&path, &field, NULL, 8.0, 8.0, 0.05, NULL) == DP_NO_MEMORY);
    dp_alloc_fail_after(-1);
    CHECK(path.point == NULL && path.count == 0);
    CHECK(dp_paths_descend(&path, &field, NULL, 0.2, 0.2, 0.25, NULL) == DP_OK && path.count == 1);
    dp_free(path.point);
}

// Errors turn a path to their own side, and it comes to the goal all the same; a heading that is kept turns late.
TEST(who_strays_comes_to_the_goal)
{
    float turn[3] = {0.3f, 0.3f, 0.3f};
    for (int k = 0; k < N * N; ++k) cost[k] = 1.0f;
    const DpPathField field = field_to(30 * N + 55);
    const DpStray     stray = {2.0, turn, 3}, still = {0.0, turn, 0}, wrong = {-1.0, NULL, 0};
    DpPath            path = {0}, other = {0}, straight = {0};
    CHECK(dp_paths_descend(&path, &field, NULL, 2.25, 15.25, 0.25, &stray) == DP_OK);
    CHECK(cell_of(path.point + 2 * (path.count - 1)) == 30 * N + 55);
    CHECK(path.point[101] > 15.25 + 1.0);  // to the left of where it goes
    for (int k = 0; k < 3; ++k) turn[k] = -turn[k];
    CHECK(dp_paths_descend(&other, &field, NULL, 2.25, 15.25, 0.25, &stray) == DP_OK);
    CHECK(other.count == path.count);
    for (int p = 0; p < path.count && p < other.count; ++p)
        CHECK_NEAR(other.point[2 * p + 1] - 15.25, 15.25 - path.point[2 * p + 1], 1e-9);
    dp_free(path.point), dp_free(other.point);
    path = other = (DpPath){0};
    CHECK(dp_paths_descend(&path, &field, NULL, 2.2, 3.1, 0.25, &still) == DP_OK);
    CHECK(dp_paths_descend(&straight, &field, NULL, 2.2, 3.1, 0.25, NULL) == DP_OK);
    CHECK(path.count == straight.count &&
          !memcmp(path.point, straight.point, 2 * sizeof(double) * (size_t)path.count));
    dp_free(path.point), dp_free(straight.point);
    CHECK(dp_paths_descend(&other, &field, NULL, 2.2, 3.1, 0.25, &wrong) == DP_BAD_ARGUMENT);
}

int main(void)
{
    RUN(directions_are_unit_vectors_to_the_goal);
    RUN(a_path_is_straight_on_even_ground);
    RUN(every_path_ends_at_the_goal);
    RUN(where_there_is_no_path);
    RUN(who_strays_comes_to_the_goal);
    return check_done();
}
