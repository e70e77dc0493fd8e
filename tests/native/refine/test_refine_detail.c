#include "refine/refine.h"

#include <stdint.h>
#include <string.h>

#include "../check.h"

#define COUNT 10000

static const DpDetail all = {0.001, 0.006, 0.3, 0.002, 0.007, 0.007, 0.026, 0.002, 0.02};

static double random_at(uint32_t* state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 16777216.0;
}

// places in a square of 4 m, (COUNT, 3)
static double* places(void)
{
    double*  point = malloc(3 * COUNT * sizeof *point);
    uint32_t state = 7;
    for (int k = 0; k < 3 * COUNT; ++k) point[k] = 4.0 * random_at(&state) - 2.0;
    return point;
}

// MODEL 8.3
TEST(heights_and_shifts_are_of_mean_0)
{
    double* point = places();
    float*  shown = malloc(6 * COUNT * sizeof *shown);
    CHECK(dp_refine_detail(point, COUNT, &all, 1, shown) == DP_OK);
    for (int part = 0; part < 5; ++part) {
        double sum = 0.0, squares = 0.0;
        for (int k = 0; k < COUNT; ++k) {
            sum += shown[6 * k + part];
            squares += (double)shown[6 * k + part] * shown[6 * k + part];
        }
        CHECK(squares > 0.0 && fabs(sum / COUNT) < 0.05 * sqrt(squares / COUNT));
    }
    free(shown);
    free(point);
}

// alone or among others, high or low: it is the place that counts
TEST(a_place_is_always_like_this)
{
    double* point = places();
    float * shown = malloc(6 * COUNT * sizeof *shown), one[6];
    CHECK(dp_refine_detail(point, COUNT, &all, 3, shown) == DP_OK);
    for (int k = 0; k < COUNT; k += 997) {
        point[3 * k + 2] += 5.0;
        CHECK(dp_refine_detail(point + 3 * k, 1, &all, 3, one) == DP_OK);
        CHECK(memcmp(one, shown + 6 * k, sizeof one) == 0);
    }
    free(shown);
    free(point);
}

TEST(ground_is_flat_that_nothing_is_known_of)
{
    const double   here[6] = {0.1, 0.2, 0.0, -3.0, 5.0, 0.0};
    const DpDetail usual = dp_detail_default();
    float          shown[12];
    int            count = 0;
    CHECK(dp_detail_numbers(&count) != NULL && count == (int)(sizeof usual / sizeof(double)));
    CHECK(dp_refine_detail(here, 2, &usual, 1, shown) == DP_OK);
    for (int k = 0; k < 5; ++k) CHECK(shown[k] == 0.0f && shown[6 + k] == 0.0f);
}

TEST(what_cannot_be_is_refused)
{
    const double here[3] = {0.0, 0.0, 0.0}, nowhere[3] = {NAN, 0.0, 0.0}, far[3] = {1e10, 0.0, 0.0};
    float        shown[6] = {9, 9, 9, 9, 9, 9};
    DpDetail     wrong[6] = {all, all, all, all, all, all};
    wrong[0].grit_height = -1.0;
    wrong[1].crumb_share = 0.51;
    wrong[2].min_crumb = 0.01;
    wrong[3].fray_size = 0.0;
    wrong[4].vein_height = NAN;
    wrong[5].grit_size = INFINITY;
    for (int k = 0; k < 6; ++k)
        CHECK(dp_refine_detail(here, 1, &wrong[k], 0, shown) == DP_BAD_ARGUMENT);
    CHECK(dp_refine_detail(nowhere, 1, &all, 0, shown) == DP_BAD_ARGUMENT);
    CHECK(dp_refine_detail(far, 1, &all, 0, shown) == DP_BAD_ARGUMENT);
    CHECK(shown[0] == 9.0f && shown[5] == 9.0f);
    CHECK(dp_refine_detail(here, 0, &all, 0, shown) == DP_OK && shown[0] == 9.0f);
}

int main(void)
{
    RUN(heights_and_shifts_are_of_mean_0);
    RUN(a_place_is_always_like_this);
    RUN(ground_is_flat_that_nothing_is_known_of);
    RUN(what_cannot_be_is_refused);
    return check_done();
}
