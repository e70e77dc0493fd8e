// One limb's step: slip, soil that waits for a border, whose push lays all soil ahead, and holds.
#include "base/vec.h"
#include "check.h"
#include "sim/sim_inside.h"

#define CELL 0.01
#define RATE 100.0
#define TIMES 201
#define MASS 70.0

static const float BOX[] = {-0.05f, -0.05f, 0, 0.05f, -0.05f, 0, 0.05f, 0.05f, 0, -0.05f, 0.05f, 0};
static const int32_t FACES[] = {0, 1, 2, 0, 2, 3};

// A square sole of 10 cm that stands for two seconds with its whole weight.
typedef struct Scene
{
    DpTerrain* terrain;
    DpSim*     sim;
    double     time[TIMES], pose[TIMES * 7], force[TIMES * 3], point[TIMES * 3];
    uint8_t    touching[TIMES];
} Scene;

static void scene_make(Scene* s)
{
    memset(s, 0, sizeof *s);
    for (int t = 0; t < TIMES; ++t) {
        s->time[t] = t / RATE;
        s->pose[7 * t] = s->pose[7 * t + 1] = s->point[3 * t] = s->point[3 * t + 1] = 0.05;
        s->pose[7 * t + 3] = 1.0;
        s->force[3 * t + 2] = -MASS * DP_GRAVITY;
        s->touching[t] = 1;
    }
}

static void load(Scene* s, const DpSoil* soil, const DpGround* ground, DpHeapLaw law)
{
    static const double    mass = MASS;
    static const int32_t   owner = 0;
    const DpMesh           sole = {4, 2, BOX, FACES};
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, soil, 1, 1, 0, NULL};
    DpSimOptions           chosen = dp_sim_options_default();
    const DpGait           gait = {.times = TIMES,
                                   .walkers = 1,
                                   .limbs = 1,
                                   .parts = 1,
                                   .time = s->time,
                                   .mass = &mass,
                                   .pose = s->pose,
                                   .limb_walker = &owner,
                                   .part_limb = &owner,
                                   .sole = &sole};
    chosen.heap_law = law;
    CHECK(dp_terrain_create(&s->terrain, &options, ground) == DP_OK);
    CHECK(dp_sim_create(&s->sim, s->terrain, &chosen) == DP_OK);
    CHECK(dp_sim_load(s->sim, &gait, s->touching, s->force, s->point) == DP_OK);
}

static void scene_drop(Scene* s)
{
    dp_sim_destroy(s->sim);
    dp_terrain_destroy(s->terrain);
}

static const DpGround flat = {.kind = DP_GROUND_FLAT};
static Scene          scene;

// A push of a quarter of the weight shears the soil once; a smaller one after it leaves the sole where
// it is, one the other way takes it back.
TEST(a_sole_slips_once_and_never_back)
{
    DpSoil soil = dp_soil_default();
    soil.shear_modulus = 0.01f;
    soil.settle_time = 0.05f;
    const double weight = MASS * DP_GRAVITY, wanted = dp_soil_slip(&soil, 0.25 * weight, weight);
    scene_make(&scene);
    for (int t = 0; t < TIMES; ++t) {
        const double push = t < 60 ? 0.25 : t < 120 ? 0.1 : -0.25;
        scene.force[3 * t] = push * weight;
    }
    load(&scene, &soil, &flat, DP_HEAP_REST);
    const Limb* limb = &scene.sim->limb[0];
    CHECK(dp_sim_run(scene.sim, 5) == DP_OK);  // a settle time: 1 - 1/e of it
    CHECK_CLOSE(limb->slip.x, (1.0 - exp(-1.0)) * wanted, 0.02);
    CHECK(dp_sim_run(scene.sim, 58) == DP_OK);
    CHECK_CLOSE(limb->slip.x, wanted, 0.01);
    CHECK(dp_sim_run(scene.sim, 118) == DP_OK);
    CHECK_CLOSE(limb->slip.x, wanted, 0.01);
    CHECK_NEAR(limb->slip.y, 0.0, 1e-12);
    CHECK(dp_sim_run(scene.sim, TIMES - 1) == DP_OK);
    CHECK_NEAR(limb->slip.x, 0.0, 0.02 * wanted);
    scene_drop(&scene);
}

// who bears a tenth of its body's weight shears a tenth as fast
TEST(who_only_begins_to_carry_slips_little)
{
    DpSoil soil = dp_soil_default();
    soil.shear_modulus = 0.01f;
    soil.settle_time = 0.05f;
    scene_make(&scene);
    for (int t = 0; t < TIMES; ++t) {
        scene.force[3 * t + 2] = -0.1 * MASS * DP_GRAVITY;
        scene.force[3 * t] = 0.025 * MASS * DP_GRAVITY;
    }
    load(&scene, &soil, &flat, DP_HEAP_REST);
    CHECK(dp_sim_run(scene.sim, 5) == DP_OK);
    const double wanted = dp_soil_slip(&soil, 0.25, 1.0);
    CHECK_CLOSE(scene.sim->limb[0].slip.x, (1.0 - exp(-0.1)) * wanted, 0.02);
    scene_drop(&scene);
}

// On a slope of 20 degrees the weight alone shears the soil, downhill along it.
TEST(on_a_slope_the_weight_pushes_downhill)
{
    const double   steep = tan(20.0 * DP_PI / 180.0), weight = MASS * DP_GRAVITY;
    const float    high = (float)(4.0 * steep);
    const float    heights[] = {0.0f, high, 0.0f, high};  // from x = -2 to 2
    const DpGround hill = {.kind = DP_GROUND_HEIGHTS,
                           .nx = 2,
                           .ny = 2,
                           .x0 = -2.0,
                           .y0 = -2.0,
                           .spacing = 4.0,
                           .heights = heights};
    DpSoil         soil = dp_soil_default();
    soil.shear_modulus = 0.01f, soil.settle_time = 0.05f;
    const double wanted =
        dp_soil_slip(&soil, weight * sin(20.0 * DP_PI / 180.0), weight * cos(20.0 * DP_PI / 180.0));
    scene_make(&scene);
    for (int t = 0; t < TIMES; ++t) scene.pose[7 * t + 2] = scene.point[3 * t + 2] = 2.05 * steep;
    load(&scene, &soil, &hill, DP_HEAP_REST);
    CHECK(dp_sim_run(scene.sim, 60) == DP_OK);
    const DpVec3 slip = scene.sim->limb[0].slip;
    CHECK(wanted > 1e-3);
    CHECK_CLOSE(dp_length(slip), wanted, 0.01);
    CHECK_CLOSE(slip.z, steep * slip.x, 1e-3);
    CHECK(slip.x < 0.0);
    scene_drop(&scene);
}

// A foot that is pulled up presses nothing, and shears nothing.
TEST(who_is_pulled_up_leaves_no_print)
{
    DpSoil soil = dp_soil_default();
    soil.shear_modulus = 0.01f, soil.settle_time = 0.05f;
    scene_make(&scene);
    for (int t = 0; t < TIMES; ++t) scene.force[3 * t] = 50.0, scene.force[3 * t + 2] = 100.0;
    load(&scene, &soil, &flat, DP_HEAP_REST);
    CHECK(dp_sim_run(scene.sim, 60) == DP_OK);
    CHECK(dp_sim_report(scene.sim).pressed == 0.0 && dp_sim_report(scene.sim).deepest == 0.0);
    CHECK(dp_sim_report(scene.sim).off_ground ==
          0);  // there is ground under it, on which it does not press
    CHECK(dp_length(scene.sim->limb[0].slip) == 0.0);
    scene_drop(&scene);
}

// An island just as large as the sole has no border. What is displaced waits until the sole, which is
// drawn aside, leaves some of the island free.
TEST(soil_waits_for_a_border)
{
    static const float heights[] = {0.0f, 0.0f, 0.0f, 0.0f};
    const DpGround     island = {
            .kind = DP_GROUND_HEIGHTS, .nx = 2, .ny = 2, .spacing = 0.1, .heights = heights};
    const DpSoil soil = dp_soil_default();
    scene_make(&scene);
    for (int t = 100; t < TIMES; ++t) scene.pose[7 * t] += 0.03;
    load(&scene, &soil, &island, DP_HEAP_PAPER);
    CHECK(dp_sim_run(scene.sim, 98) == DP_OK);
    const DpSimReport before = dp_sim_report(scene.sim);
    CHECK(before.pressed > 1e-6);
    CHECK(before.displaced == 0.0 && before.heaped == 0.0);
    CHECK(dp_sim_run(scene.sim, TIMES - 1) == DP_OK);
    const DpSimReport after = dp_sim_report(scene.sim);
    CHECK_CLOSE(after.displaced,
                2.0 * (double)soil.poisson_ratio * (after.pressed + after.pressed_heap), 1e-6);
    CHECK(after.heaped > 0.9 * (after.displaced - after.pressed_heap));
    scene_drop(&scene);
}

// mean heap of the cells on a column beside the sole, in its middle
static double beside(const Scene* s, long i)
{
    float heap[4];
    CHECK(dp_terrain_read(s->terrain, DP_FIELD_HEAP, i, 3, 1, 4, heap) == DP_OK);
    return 0.25 * (double)(heap[0] + heap[1] + heap[2] + heap[3]);
}

// A soil without a threshold takes half the body's weight: a quarter of it is half way. TRAIL (13)
TEST(half_the_weight_lays_all_ahead)
{
    DpSoil soil = dp_soil_default();
    for (int turn = 0; turn < 3; ++turn) {
        const double push = turn == 0 ? 0.25 : 0.5;  // of the weight
        soil.push_threshold = turn == 2 ? (float)(MASS * DP_GRAVITY) : 0.0f;
        scene_make(&scene);
        for (int t = 0; t < TIMES; ++t) scene.force[3 * t] = push * MASS * DP_GRAVITY;
        load(&scene, &soil, &flat, DP_HEAP_PAPER);
        CHECK(dp_sim_run(scene.sim, 1) == DP_OK);
        const double behind = beside(&scene, -1), ahead = beside(&scene, 10);
        CHECK(ahead > 0.0);
        if (turn == 1)
            CHECK_NEAR(behind / ahead, 0.0, 1e-6);
        else  // half of it evenly, half ahead: nearly 1 there, so that ahead gets twice as much
            CHECK_NEAR(behind / ahead, 0.5, 0.02);
        scene_drop(&scene);
    }
}

TEST(who_is_held_presses_no_deeper)
{
    const DpSoil soil = dp_soil_default();
    double       deepest[2];
    for (int held = 0; held < 2; ++held) {
        scene_make(&scene);
        for (int t = 3; held && t < 60; ++t) scene.touching[t] |= DP_HELD;
        load(&scene, &soil, &flat, DP_HEAP_REST);
        CHECK(dp_sim_run(scene.sim, 3) == DP_OK);
        const double begun = dp_sim_report(scene.sim).deepest;
        CHECK(dp_sim_run(scene.sim, 60) == DP_OK);
        deepest[held] = dp_sim_report(scene.sim).deepest;
        CHECK(begun > 0.0);
        if (held)
            CHECK(deepest[held] == begun);
        else
            CHECK(deepest[held] > 1.2 * begun);
        CHECK(dp_sim_run(scene.sim, TIMES - 1) == DP_OK);
        deepest[held] = dp_sim_report(scene.sim).deepest;
        scene_drop(&scene);
    }
    CHECK_CLOSE(deepest[1], deepest[0], 1e-6);
}

// A sole over an edge presses with a point that lies over no ground: it slips on the soil that is nearest to it, a band
// along its way, not on that of the last cell of its patch.
TEST(beside_an_edge_the_nearest_soil_counts)
{
    static float           height[31 * 61], weight[2 * 31 * 61];
    const double           push = 0.25 * MASS * DP_GRAVITY;
    static const double    mass = MASS;
    static const int32_t   owner = 0;
    const DpMesh           sole = {4, 2, BOX, FACES};
    DpSoil                 soils[2] = {dp_soil_default(), dp_soil_default()};
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, soils, 2, 1, 0, NULL};
    const DpSimOptions     chosen = dp_sim_options_default();
    soils[1].shear_modulus = 0.01f, soils[1].settle_time = 0.05f;
    for (int k = 0; k < 31 * 61; ++k) {  // from (-0.3, -0.3) to (0, 0.3)
        const double y = CELL * (k / 31) - 0.3;
        weight[31 * 61 + k] = y > 0.0 && y < 0.1 ? 1.0f : 0.0f;
        weight[k] = 1.0f - weight[31 * 61 + k];
    }
    const DpGround ground = {.kind = DP_GROUND_HEIGHTS,
                             .nx = 31,
                             .ny = 61,
                             .x0 = -0.3,
                             .y0 = -0.3,
                             .spacing = CELL,
                             .heights = height,
                             .kind_count = 2,
                             .kind_weight = weight};
    scene_make(&scene);
    for (int t = 0; t < TIMES; ++t) {
        scene.pose[7 * t] = 0.0, scene.point[3 * t] = 0.02;
        scene.force[3 * t + 1] = push;
    }
    const DpGait gait = {.times = TIMES,
                         .walkers = 1,
                         .limbs = 1,
                         .parts = 1,
                         .time = scene.time,
                         .mass = &mass,
                         .pose = scene.pose,
                         .limb_walker = &owner,
                         .part_limb = &owner,
                         .sole = &sole};
    CHECK(dp_terrain_create(&scene.terrain, &options, &ground) == DP_OK);
    CHECK(dp_sim_create(&scene.sim, scene.terrain, &chosen) == DP_OK);
    CHECK(dp_sim_load(scene.sim, &gait, scene.touching, scene.force, scene.point) == DP_OK);
    CHECK(dp_sim_run(scene.sim, 60) == DP_OK);
    const double wanted = dp_soil_slip(&soils[1], push, MASS * DP_GRAVITY);
    CHECK(wanted > 0.005);
    CHECK_CLOSE(scene.sim->limb[0].slip.y, wanted, 0.01);
    scene_drop(&scene);
}

// the farthest column ahead of a sole that stands, on which soil lies [cells]
static long farthest_heap(const Scene* s)
{
    float heap[60];
    CHECK(dp_terrain_read(s->terrain, DP_FIELD_HEAP, 10, 5, 60, 1, heap) == DP_OK);
    long far = 0;
    for (long i = 0; i < 60; ++i)
        if (heap[i] > 1e-5f) far = i;
    return far;
}

// Soil that goes 0.1 m in 10 s has slid by no more than a cell or two after 1.5 s, however many sweeps would bring it
// to rest; one that takes no time has gone as far as it will. MODEL 6.4
TEST(slides_that_take_time_go_no_farther_in_a_step)
{
    long far[2];
    for (int slow = 0; slow < 2; ++slow) {
        DpSoil soil = dp_soil_default();
        soil.poisson_ratio = 0.5f, soil.rest_angle = (float)(4.0 * DP_PI / 180.0);
        soil.settle_time = 0.05f, soil.young_modulus = 4e5f, soil.flow_time = slow ? 10.0f : 0.0f;
        scene_make(&scene);
        load(&scene, &soil, &flat, DP_HEAP_PAPER);
        CHECK(dp_sim_run(scene.sim, 150) == DP_OK);
        far[slow] = farthest_heap(&scene);
        scene_drop(&scene);
    }
    printf("    %ld cells, %ld at once\n", far[1], far[0]);
    CHECK(far[1] >= 4 && far[1] <= 7);  // a rim of 4 cm, and a sweep every second
    CHECK(far[0] > far[1] + 3);
}

int main(void)
{
    RUN(a_sole_slips_once_and_never_back);
    RUN(who_only_begins_to_carry_slips_little);
    RUN(on_a_slope_the_weight_pushes_downhill);
    RUN(who_is_pulled_up_leaves_no_print);
    RUN(soil_waits_for_a_border);
    RUN(half_the_weight_lays_all_ahead);
    RUN(who_is_held_presses_no_deeper);
    RUN(beside_an_edge_the_nearest_soil_counts);
    RUN(slides_that_take_time_go_no_farther_in_a_step);
    return check_done();
}
