// Where a limb is between two samples, what it presses with, and in how many sub-steps.
#include "base/vec.h"
#include "check.h"
#include "sim/sim_inside.h"

#define CELL 0.01
#define ROUND 64  // corners of a wheel

static const float   BOX[] = {-0.1f, -0.05f, 0, 0.1f, -0.05f, 0, 0.1f, 0.05f, 0, -0.1f, 0.05f, 0};
static const int32_t FACES[] = {0, 1, 2, 0, 2, 3};

// One limb of one or two parts over three samples, a second apart.
typedef struct Scene
{
    DpTerrain* terrain;
    DpSim*     sim;
    double     pose[2 * 3 * 7], force[2 * 3 * 3], point[2 * 3 * 3];
} Scene;

static double* pose_of(Scene* s, int part, int sample)
{
    return s->pose + 7 * (3 * part + sample);
}

static Scene scene_make(void)
{
    Scene s = {0};
    for (int k = 0; k < 6; ++k) s.pose[7 * k + 3] = 1.0;
    return s;
}

static double ground_height;  // of the next scene [m]

static Limb* load(Scene* s, int parts, const DpMesh* sole)
{
    static const double    time[] = {0.0, 1.0, 2.0};
    static const double    mass = 70.0;
    static const int32_t   owner[] = {0, 0};
    static const uint8_t   touching[6] = {1, 1, 1, 1, 1, 1};
    const DpMesh           soles[] = {*sole, *sole};
    const DpSoil           soil = dp_soil_default();
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    const DpGround         flat = {.kind = DP_GROUND_FLAT, .height = ground_height};
    const DpSimOptions     chosen = dp_sim_options_default();
    const DpGait           gait = {.times = 3,
                                   .walkers = 1,
                                   .limbs = 1,
                                   .parts = parts,
                                   .time = time,
                                   .mass = &mass,
                                   .pose = s->pose,
                                   .limb_walker = owner,
                                   .part_limb = owner,
                                   .sole = soles};
    CHECK(dp_terrain_create(&s->terrain, &options, &flat) == DP_OK);
    CHECK(dp_sim_create(&s->sim, s->terrain, &chosen) == DP_OK);
    CHECK(dp_sim_load(s->sim, &gait, touching, s->force, s->point) == DP_OK);
    return &s->sim->limb[0];
}

static void scene_drop(Scene* s)
{
    dp_sim_destroy(s->sim);
    dp_terrain_destroy(s->terrain);
}

static const DpMesh box = {4, 2, BOX, FACES};

TEST(poses_between_samples_are_between_and_meet_them)
{
    Scene s = scene_make();
    for (int t = 0; t < 3; ++t) {
        double* pose = pose_of(&s, 0, t);
        pose[0] = 0.1 * t * t, pose[2] = 1.0 / (3.0 + t);
        pose[3] = cos(0.3 * t), pose[6] = sin(0.3 * t);
    }
    load(&s, 1, &box);
    const DpPose half = dp_limb_pose(s.sim, 0, 1, 0.5);
    CHECK_NEAR(half.at.x, 0.25, 1e-12);
    CHECK_NEAR(half.turn.z, sin(0.45), 1e-12);
    const DpPose end = dp_limb_pose(s.sim, 0, 0, 1.0), begin = dp_limb_pose(s.sim, 0, 1, 0.0);
    CHECK(memcmp(&end, &begin, sizeof end) == 0);
    const DpPose last = dp_limb_pose(s.sim, 0, 2, 0.7);
    CHECK(last.at.x == pose_of(&s, 0, 2)[0]);  // nothing comes after it
    scene_drop(&s);
}

TEST(forces_add_and_their_points_are_weighed)
{
    Scene s = scene_make();
    // at sample 0 the parts bear 100 N at x = 0 and 300 N at x = 1; at sample 1 the second lets go
    s.force[2] = -100.0, s.force[9 + 2] = -300.0, s.force[9] = 40.0;
    s.point[9] = 1.0;
    s.force[3 + 2] = -200.0, s.point[3] = 2.0;
    s.point[9 + 3] = (double)NAN;
    const Limb*       limb = load(&s, 2, &box);
    const DpFootForce now = dp_limb_force(s.sim, limb, 0, 0.0);
    CHECK_NEAR(now.force.z, -400.0, 1e-9);
    CHECK_NEAR(now.force.x, 40.0, 1e-9);
    CHECK_NEAR(now.point.x, 0.75, 1e-12);
    const DpFootForce half = dp_limb_force(s.sim, limb, 0, 0.5);
    CHECK_NEAR(half.force.z, -300.0, 1e-9);
    CHECK_NEAR(half.point.x, (150.0 * 1.0 + 100.0 * 2.0) / 300.0, 1e-12);
    const DpFootForce last = dp_limb_force(s.sim, limb, 2, 0.5);
    CHECK(last.force.z == 0.0 && last.point.x == 0.0);  // nobody presses: no place either
    scene_drop(&s);
}

// on a mountain heights count from the terrain's datum: those of poses and of the centre of pressure
TEST(heights_count_from_the_datum)
{
    Scene s = scene_make();
    ground_height = 2000.25;
    for (int t = 0; t < 3; ++t) {
        pose_of(&s, 0, t)[2] = 2000.5;
        s.force[3 * t + 2] = -100.0, s.point[3 * t + 2] = 2000.375;
    }
    const Limb*  limb = load(&s, 1, &box);
    const double datum = dp_terrain_datum(s.terrain);
    ground_height = 0.0;
    CHECK(fabs(2000.25 - datum) < 17.0);
    CHECK_NEAR(dp_limb_pose(s.sim, 0, 0, 0.5).at.z, 2000.5 - datum, 1e-9);
    CHECK_NEAR(dp_limb_force(s.sim, limb, 0, 0.5).point.z, 2000.375 - datum, 1e-9);
    scene_drop(&s);
}

TEST(cells_hold_both_ends_and_a_margin)
{
    Scene s = scene_make();
    pose_of(&s, 0, 1)[0] = 0.5;
    pose_of(&s, 0, 2)[0] = 9.0;
    const Limb*      limb = load(&s, 1, &box);
    const DpCellRect at = dp_limb_cells(s.sim, limb, 0, 0.0301);
    CHECK(at.i0 == -14 && at.i1 == 64);
    CHECK(at.j0 == -9 && at.j1 == 9);
    scene_drop(&s);
}

TEST(what_slides_does_so_by_half_cells)
{
    Scene s = scene_make();
    pose_of(&s, 0, 1)[0] = 2.4 * CELL;
    pose_of(&s, 0, 2)[0] = 2.4 * CELL + 5.0;
    const Limb* limb = load(&s, 1, &box);
    CHECK(dp_limb_substeps(s.sim, limb, 0) == 5);
    CHECK(dp_limb_substeps(s.sim, limb, 1) == 64);  // no more, however fast
    CHECK(dp_limb_substeps(s.sim, limb, 2) == 1);
    scene_drop(&s);
}

// a wheel's lowest points stand still, but what it rolls on moves
TEST(what_rolls_does_so_by_half_cells)
{
    static float   vertex[3 * ROUND];
    static int32_t face[3 * (ROUND - 2)];
    const double   radius = 0.5, turn = 0.1;  // by which it rolls in a step [rad]
    for (int k = 0; k < ROUND; ++k) {
        const double a = 2.0 * DP_PI * k / ROUND;
        vertex[3 * k] = (float)(radius * sin(a)), vertex[3 * k + 2] = (float)(-radius * cos(a));
    }
    for (int k = 0; k < ROUND - 2; ++k)
        face[3 * k] = 0, face[3 * k + 1] = k + 1, face[3 * k + 2] = k + 2;
    const DpMesh wheel = {ROUND, ROUND - 2, vertex, face};
    for (int parts = 1; parts <= 2; ++parts) {
        Scene s = scene_make();
        for (int p = 0; p < 2; ++p)
            for (int t = 0; t < 3; ++t) {
                double* pose = pose_of(&s, p, t);
                pose[0] = radius * turn * t, pose[2] = radius;
                pose[3] = cos(0.5 * turn * t), pose[5] = sin(0.5 * turn * t);
            }
        const Limb* limb = load(&s, parts, &wheel);
        const int   steps = dp_limb_substeps(s.sim, limb, 0);
        if (parts == 1)
            CHECK(steps >= 9 && steps <= 11);  // 5 cm at 1 cm a cell
        else
            CHECK(steps <= 3);  // a foot's parts roll from one to the other
        scene_drop(&s);
    }
}

// a plate that rocks from edge to edge: no corner slides, but what it stands on moves all along it
TEST(what_rocks_does_so_by_half_cells)
{
    Scene s = scene_make();
    for (int t = 0; t < 3; ++t) {
        const double pitch = t == 0 ? 0.2 : -0.2;
        pose_of(&s, 0, t)[3] = cos(0.5 * pitch), pose_of(&s, 0, t)[5] = sin(0.5 * pitch);
    }
    const Limb* limb = load(&s, 1, &box);
    CHECK(dp_limb_substeps(s.sim, limb, 0) == (int)ceil(0.2 * cos(0.2) / (0.5 * CELL)));
    CHECK(dp_limb_substeps(s.sim, limb, 1) == 1);
    scene_drop(&s);
}

int main(void)
{
    RUN(poses_between_samples_are_between_and_meet_them);
    RUN(forces_add_and_their_points_are_weighed);
    RUN(heights_count_from_the_datum);
    RUN(cells_hold_both_ends_and_a_margin);
    RUN(what_slides_does_so_by_half_cells);
    RUN(what_rolls_does_so_by_half_cells);
    RUN(what_rocks_does_so_by_half_cells);
    return check_done();
}
