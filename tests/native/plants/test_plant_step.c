// who wakes, who sleeps, and the same bits for any number of workers.
#include "lawn.h"

static void walk(DpPlants* plants, int workers, int frames, DpPlantsReport* sum)
{
    float bottom[SOLE_SIDE * SOLE_SIDE];
    for (int f = 0; f < frames; ++f) {
        DpPlantCollider c =
            sole(bottom, 0.01, 0.2 + 0.02 * f, 0.4, f % 20 < 12 ? 0.0 : 0.05, 0.28, 0.10, 0.05);
        c.velocity = dp_vec3(1.2, 0, 0);
        DpPlantsReport told;
        CHECK(dp_plants_step(plants, NULL, &c, 1, 1.0 / 60, workers, &told) == DP_OK);
        sum->awake = told.awake > sum->awake ? told.awake : sum->awake;
        sum->broke += told.broke;
        sum->changes += told.changes;
    }
}

TEST(any_number_of_workers_gives_the_same_bits)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.spread = 1.3f;
    const int workers[3] = {1, 2, 5};
    float*    first = dp_alloc(900, 168 * sizeof(float));
    for (int w = 0; w < 3; ++w) {
        DpPlants*      plants = lawn(&kind, 60, 15, 0.05, 1);
        DpPlantsReport sum = {0};
        walk(plants, workers[w], 60, &sum);
        CHECK(sum.awake > 200 && sum.broke > 0 && sum.changes > 0);
        int differ = 0;
        for (int k = 0; k < 900; ++k) {
            float at[84], speed[84];
            dp_plants_read(plants, 0, k, at, speed, NULL);
            float* was = first + 168 * k;
            if (w == 0) memcpy(was, at, sizeof at), memcpy(was + 84, speed, sizeof speed);
            differ += memcmp(was, at, sizeof at) != 0 || memcmp(was + 84, speed, sizeof speed) != 0;
        }
        CHECK(differ == 0);
        dp_plants_destroy(plants);
    }
    dp_free(first);
}

TEST(the_meadow_sleeps_and_the_walker_wakes_few)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 100, 100, 0.1, 1);
    DpPlantsReport    sum = {0}, told = {0};
    const size_t      asleep = dp_bytes_live();
    for (int f = 0; f < 5; ++f)
        CHECK(dp_plants_step(plants, NULL, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
    CHECK(told.awake == 0 && told.changes == 0);
    CHECK(dp_bytes_live() - asleep < 65536);
    walk(plants, 1, 60, &sum);
    CHECK(sum.awake > 8 && sum.awake < 400);
    for (int f = 0; f < 600; ++f) dp_plants_step(plants, NULL, NULL, 0, 1.0 / 60, 1, &told);
    CHECK(told.awake == 0);
    dp_plants_destroy(plants);
}

TEST(what_broke_is_told_and_where)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 40, 10, 0.1, 1);
    float             bottom[SOLE_SIDE * SOLE_SIDE];
    double            lost = 0.0;
    int               broke = 0;
    for (int f = 0; f < 120; ++f) {
        const DpPlantCollider c = sole(bottom, 0.01, 2.0, 0.4, 0.0, 0.28, 0.10, 0.0);
        DpPlantsReport        told;
        dp_plants_step(plants, NULL, &c, 1, 1.0 / 60, 1, &told);
        broke += told.broke;
        CHECK(told.changes <= 1);
        const DpPlantBox at = told.box[0];
        if (told.changes) CHECK(at.x0 < 2.0 && at.x1 > 2.0 && at.y0 < 0.4 && at.y1 > 0.4);
        if (told.changes) CHECK(at.x1 - at.x0 < 2.0);
    }
    for (int k = 0; k < 400; ++k) lost += 20.0 * (1.0 - dp_plants_alpha(plants, 0, k));
    CHECK(broke > 0);
    CHECK_NEAR(lost, broke, 1e-3);
    dp_plants_destroy(plants);
}

// walkers that are far apart change the ground at both places, and not between
TEST(changes_far_apart_have_boxes_of_their_own)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.01f;
    DpPlants*       plants = lawn(&kind, 200, 10, 0.1, 1);
    float           bottom[2][SOLE_SIDE * SOLE_SIDE];
    double          wide = 0.0;
    int             most = 0;
    DpPlantCollider c[2];
    for (int k = 0; k < 2; ++k)
        c[k] = sole(bottom[k], 0.01, 2.0 + 15.0 * k, 0.4, 0.0, 0.28, 0.10, 0.0);
    for (int f = 0; f < 30; ++f) {
        DpPlantsReport told;
        CHECK(dp_plants_step(plants, NULL, c, 2, 1.0 / 60, 1, &told) == DP_OK);
        most = told.changes > most ? told.changes : most;
        for (int k = 0; k < told.changes; ++k) wide = fmax(wide, told.box[k].x1 - told.box[k].x0);
    }
    CHECK(most == 2);
    CHECK(wide > 0.3 && wide < 2.0);
    dp_plants_destroy(plants);
}

// what changes side by side is one box, however the boxes come to meet
TEST(boxes_that_meet_are_one)
{
    enum
    {
        FEET = 12
    };
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.01f, kind.root_radius = 0.5f;
    DpPlants*       plants = lawn(&kind, 120, 4, 0.1, 1);
    float           bottom[SOLE_SIDE * SOLE_SIDE];
    DpPlantCollider c[FEET];
    int             most = 0, joined = 0;
    for (int k = 0; k < FEET; ++k)
        c[k] = sole(bottom, 0.01, 0.5 + 0.9 * (k * 5 % FEET), 0.15, 0.0, 0.28, 0.10, 0.0);
    for (int f = 0; f < 30; ++f) {
        DpPlantsReport told;
        CHECK(dp_plants_step(plants, NULL, c, FEET, 1.0 / 60, 1, &told) == DP_OK);
        most = told.changes > most ? told.changes : most;
        for (int a = 0; a < told.changes; ++a) {
            joined += told.box[a].x1 - told.box[a].x0 > 3.0;
            for (int b = 0; b < a; ++b)
                CHECK(told.box[a].x0 > told.box[b].x1 || told.box[b].x0 > told.box[a].x1);
        }
    }
    CHECK(most >= 1 && joined > 0);
    dp_plants_destroy(plants);
}

// a box that has grown by another meets what neither met
TEST(boxes_that_have_grown_meet_others)
{
    const float     place[3][2] = {{0.3f, 0.0f}, {2.0f, 0.5f}, {1.0f, 1.9f}};
    const float     span[3] = {0.6f, 0.6f, 1.0f};
    static float    bottom[3][SOLE_SIDE * SOLE_SIDE];
    DpPlants*       plants = dp_plants_create(1);
    DpPlantCollider c[3];
    int             all = 0;
    for (int k = 0; k < 3; ++k) {
        DpPlantKind kind = dp_plant_kind_default();
        const float root[3] = {place[k][0], place[k][1], 0.0f}, heading = 0.0f;
        int         stand;
        kind.strength = 1e-6f, kind.root_radius = span[k];
        CHECK(dp_plants_add(plants, &kind, root, &heading, 1, &stand) == DP_OK && stand == k);
        c[k] = sole(bottom[k], 0.01, (double)root[0], (double)root[1], 0.0, 0.28, 0.10, 0.0);
    }
    for (int f = 0; f < 30; ++f) {
        DpPlantsReport told;
        CHECK(dp_plants_step(plants, NULL, c, 3, 1.0 / 60, 1, &told) == DP_OK);
        for (int a = 0; a < told.changes; ++a)
            for (int b = 0; b < a; ++b)
                CHECK(told.box[a].x0 > told.box[b].x1 || told.box[b].x0 > told.box[a].x1 ||
                      told.box[a].y0 > told.box[b].y1 || told.box[b].y0 > told.box[a].y1);
        all += told.changes == 1 && told.box[0].x1 - told.box[0].x0 > 2.7;
    }
    CHECK(all > 0);  // all three broke in one step
    dp_plants_destroy(plants);
}

// however many they are, each change lies in one of the boxes
TEST(many_changes_share_boxes)
{
    enum
    {
        MANY = 40
    };
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.01f;
    DpPlants*       plants = lawn(&kind, MANY, 2, 3.0, 1);
    float           bottom[SOLE_SIDE * SOLE_SIDE];
    DpPlantCollider c[MANY];
    DpPlantsReport  told;
    int             broken = 0;
    double          alpha[MANY];
    for (int k = 0; k < MANY; ++k)
        c[k] = sole(bottom, 0.01, 3.0 * k + 0.03, 0.0, 0.0, 0.28, 0.10, 0.0), alpha[k] = 1.0;
    for (int f = 0; f < 30; ++f) {
        CHECK(dp_plants_step(plants, NULL, c, MANY, 1.0 / 60, 1, &told) == DP_OK);
        CHECK(told.changes >= 0 && told.changes <= DP_PLANT_BOXES);
        for (int k = 0; k < MANY; ++k) {
            const double now = dp_plants_alpha(plants, 0, k);
            bool         told_of = !(now < alpha[k]);
            broken += now < alpha[k];
            alpha[k] = now;
            for (int n = 0; n < told.changes; ++n)
                told_of = told_of || (told.box[n].x0 < 3.0 * k && told.box[n].x1 > 3.0 * k);
            CHECK(told_of);
        }
    }
    CHECK(broken > MANY / 2);
    dp_plants_destroy(plants);
}

TEST(several_kinds_stand_on_one_ground)
{
    DpPlantKind kind = dp_plant_kind_default();
    DpPlants*   plants = lawn(&kind, 10, 10, 0.1, 1);
    float       root[3] = {0.45f, 0.45f, 0.0f}, bottom[SOLE_SIDE * SOLE_SIDE];
    int         stand = 0;
    kind.form = DP_PLANT_TUFT, kind.height = 0.8f, kind.spacing = 0.08f, kind.width = 0.16f;
    CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_OK);
    CHECK(stand == 1 && dp_plants_count(plants, 1) == 1 && dp_plants_count(plants, -1) == 101);
    const DpPlantCollider c = sole(bottom, 0.01, 0.45, 0.45, 0.0, 0.28, 0.1, 0.0);
    for (int f = 0; f < 60; ++f) step(plants, &c, 1, 1.0 / 60);
    float* at = dp_alloc((size_t)dp_plant_shape(&kind).particles, 3 * sizeof(float));
    CHECK(dp_plants_read(plants, 1, 0, at, NULL, NULL) == DP_OK);
    CHECK(isfinite(at[0]));
    dp_free(at);
    dp_plants_destroy(plants);
}

TEST(bad_steps_are_refused)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 3, 3, 0.1, 1);
    float             bottom[SOLE_SIDE * SOLE_SIDE];
    DpPlantsReport    told;
    DpPlantCollider   c = sole(bottom, 0.01, 0.1, 0.1, 0.0, 0.28, 0.1, 0.0);
    CHECK(dp_plants_step(plants, NULL, &c, 1, 0.0, 1, &told) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_step(plants, NULL, &c, 1, NAN, 1, &told) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_step(plants, NULL, NULL, 1, 0.1, 1, &told) == DP_BAD_ARGUMENT);
    c.velocity.x = NAN;
    CHECK(dp_plants_step(plants, NULL, &c, 1, 0.1, 1, &told) == DP_BAD_ARGUMENT);
    c.velocity.x = 0.0, c.row = 1;
    CHECK(dp_plants_step(plants, NULL, &c, 1, 0.1, 1, &told) == DP_BAD_ARGUMENT);
    c.row = c.nx;
    for (long passes = 0; passes < 4; ++passes) {
        dp_alloc_fail_after(passes);
        CHECK(dp_plants_step(plants, NULL, &c, 1, 0.1, 1, &told) == DP_NO_MEMORY);
    }
    dp_alloc_fail_after(-1);
    CHECK(dp_plants_step(plants, NULL, &c, 1, 0.1, 1, &told) == DP_OK);
    CHECK(told.awake == 9);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(any_number_of_workers_gives_the_same_bits);
    RUN(the_meadow_sleeps_and_the_walker_wakes_few);
    RUN(what_broke_is_told_and_where);
    RUN(changes_far_apart_have_boxes_of_their_own);
    RUN(boxes_that_meet_are_one);
    RUN(boxes_that_have_grown_meet_others);
    RUN(many_changes_share_boxes);
    RUN(several_kinds_stand_on_one_ground);
    RUN(bad_steps_are_refused);
    return check_done();
}
