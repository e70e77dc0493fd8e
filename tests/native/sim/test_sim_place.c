// tests of sim_place.c: feet are placed on a terrain as on the plane that it is. TRAIL (1) (2)
#include "base/vec.h"
#include "check.h"
#include "sim/sim.h"
#include "walker/scene.h"

#define T 3
#define SLOPE_X (-0.2)
#define SLOPE_Y 0.15
#define HIGH 3.0

static double plane_height(const void* ground, double x, double y)
{
    (void)ground;
    return HIGH + SLOPE_X * x + SLOPE_Y * y;
}

static DpVec3 plane_normal(const void* ground, double x, double y, double radius)
{
    (void)ground, (void)x, (void)y, (void)radius;
    return dp_unit(dp_vec3(-SLOPE_X, -SLOPE_Y, 1.0));
}

// a foot of heel, ball and tip that walks over level floor
static Scene foot(double x)
{
    static const double point[3][3] = {{-0.1, 0, 0}, {0.08, 0, 0}, {0.14, 0, 0}};
    static const int    role[3] = {DP_POINT_HEEL, DP_POINT_BALL, DP_POINT_TIP};
    Scene               s = scene_make(T, 10.0, 1, 3);
    for (int k = 0; k < 3; ++k) {
        memcpy(s.point + 3 * k, point[k], sizeof point[k]);
        s.point_role[k] = role[k];
    }
    for (int t = 0; t < T; ++t) {
        scene_put(&s, T, 0, t, x + 0.2 * t, 0.4, 0.05 * t);
        scene_com(&s, t, x + 0.2 * t, 0.3, 0.9);
    }
    return s;
}

static DpTerrain* slope_of(float side)
{
    float height[4];
    for (int k = 0; k < 4; ++k)
        height[k] =
            (float)plane_height(NULL, (double)side * (k % 2 - 0.5), (double)side * (k / 2 - 0.5));
    const DpSoil           soil = dp_soil_default();
    const DpTerrainOptions options = {{0.01, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    const DpGround         ground = {.kind = DP_GROUND_HEIGHTS,
                                     .nx = 2,
                                     .ny = 2,
                                     .x0 = -0.5 * (double)side,
                                     .y0 = -0.5 * (double)side,
                                     .spacing = (double)side,
                                     .heights = height};
    DpTerrain*             terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    return terrain;
}

TEST(feet_stand_on_a_terrain_as_on_its_plane)
{
    static const double clearance[3] = {0};
    const DpGroundBelow plane = {NULL, plane_height, plane_normal};
    DpTerrain*          terrain = slope_of(8.0f);
    DpPlaceOptions      options = dp_place_options_default();
    for (int carry = 0; carry < 2; ++carry) {
        Scene         s = foot(-0.3);
        const DpGait* gait = scene_gait(&s, T, 1, 3);
        double        want[T * 7], want_com[T * 3], pose[T * 7], com[T * 3];
        options.carry = carry;
        for (int t = 0; !carry && t < T; ++t)
            s.pose[7 * t + 2] += plane_height(NULL, s.pose[7 * t], s.pose[7 * t + 1]);
        memcpy(pose, s.pose, sizeof pose), memcpy(want, s.pose, sizeof want);
        memcpy(com, s.com, sizeof com), memcpy(want_com, s.com, sizeof want_com);
        CHECK(dp_foot_place(gait, 0, &plane, &options, clearance, want, want_com) == DP_OK);
        CHECK(dp_sim_place(terrain, gait, 0, &options, clearance, pose, com) == DP_OK);
        double turned = 0.0;
        for (int n = 0; n < T * 7; ++n) {
            CHECK_NEAR(pose[n], want[n], 1e-6);
            turned = fmax(turned, fabs(pose[n] - s.pose[n]));
        }
        for (int n = 0; n < T * 3; ++n) CHECK_NEAR(com[n], want_com[n], 1e-6);
        CHECK(turned > 0.05);
        CHECK_NEAR(com[2] - s.com[2], carry ? plane_height(NULL, -0.3, 0.3) : 0.0, 0.05);
        scene_free(&s);
    }
    dp_terrain_destroy(terrain);
}

TEST(who_is_carried_needs_ground)
{
    static const double clearance[3] = {0};
    DpTerrain*          terrain = slope_of(8.0f);
    DpPlaceOptions      options = dp_place_options_default();
    Scene               s = foot(50.0);
    const DpGait*       gait = scene_gait(&s, T, 1, 3);
    double              pose[T * 7], com[T * 3];
    memcpy(pose, s.pose, sizeof pose), memcpy(com, s.com, sizeof com);
    options.carry = true;
    CHECK(dp_sim_place(terrain, gait, 0, &options, clearance, pose, com) == DP_NO_GROUND);
    CHECK(dp_sim_place(NULL, gait, 0, &options, clearance, pose, com) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_place(terrain, NULL, 0, &options, clearance, pose, com) == DP_BAD_ARGUMENT);
    scene_free(&s);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(feet_stand_on_a_terrain_as_on_its_plane);
    RUN(who_is_carried_needs_ground);
    return check_done();
}
