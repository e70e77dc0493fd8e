// Feet on slopes: TRAIL (1) (2), what is carried, and that nothing is pushed into the ground.
#include "base/vec.h"
#include "check.h"
#include "scene.h"

#define T 3

typedef struct Plane
{
    double x, y, height;  // slopes along the axes, height at the origin
    double edge;          // no ground beyond x = edge
    double bump;          // height of a bump of 4 cm about x = 0.5
} Plane;

static double plane_height(const void* ground, double x, double y)
{
    const Plane* p = ground;
    if (p->edge > 0.0 && x > p->edge) return NAN;
    const double near = 1.0 - fabs(x - 0.5) / 0.04;
    return p->height + p->x * x + p->y * y + (near > 0.0 ? p->bump * near : 0.0);
}

static DpVec3 plane_normal(const void* ground, double x, double y, double radius)
{
    const Plane* p = ground;
    (void)x, (void)y, (void)radius;
    return dp_unit(dp_vec3(-p->x, -p->y, 1.0));
}

static DpGroundBelow below_of(const Plane* plane)
{
    return (DpGroundBelow){plane, plane_height, plane_normal};
}

// one foot of a heel and a toe part, 16 cm to the ball; it stands at x = 0.2, then higher up
static Scene foot(double lift)
{
    Scene s = scene_make(T, 10.0, 2, 2);
    s.part_limb[0] = s.part_limb[1] = 0;
    const double point[4][3] = {{-0.06, 0, 0}, {0.14, 0, 0}, {0, 0, 0}, {0.06, 0, 0}};
    const int    role[4] = {DP_POINT_HEEL, DP_POINT_BALL, DP_POINT_BALL, DP_POINT_TIP};
    for (int k = 0; k < 4; ++k) {
        memcpy(s.point + 3 * k, point[k], sizeof point[k]);
        s.point_role[k] = role[k];
    }
    for (int t = 0; t < T; ++t) {
        scene_put(&s, T, 0, t, 0.2, 0.1, lift * t);
        scene_put(&s, T, 1, t, 0.36, 0.1, lift * t);
        scene_com(&s, t, 0.2, 0.0, 0.9);
    }
    return s;
}

typedef struct Placed
{
    double pose[2 * T * 7], com[3 * T];
} Placed;

static DpStatus place(Scene* s, const Plane* plane, const DpPlaceOptions* options, Placed* out)
{
    const double        clearance[4] = {0};
    const DpGait*       gait = scene_gait(s, T, 2, 2);
    const DpGroundBelow below = below_of(plane);
    s->gait.limbs = 1;
    memcpy(out->pose, s->pose, sizeof out->pose);
    memcpy(out->com, s->com, sizeof out->com);
    return dp_foot_place(gait, 0, &below, options, clearance, out->pose, out->com);
}

static DpPose pose_of(const Placed* placed, int part, int t)
{
    const double* p = placed->pose + 7 * (part * T + t);
    return (DpPose){{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
}

static double over(const Plane* plane, DpPose pose, double x)
{
    const DpVec3 at = dp_place(pose, dp_vec3(x, 0.0, 0.0));
    return at.z - plane_height(plane, at.x, at.y);
}

TEST(level_ground_changes_nothing)
{
    Scene          s = foot(0.02);
    const DpQuat   rolled = dp_quat_about(dp_vec3(0, 1, 0), -0.3);
    DpPlaceOptions options = dp_place_options_default();
    Plane          plane = {0};
    Placed         placed;
    s.pose[3] = rolled.w, s.pose[5] = rolled.y;  // the heel strikes
    s.pose[2] = 0.06 * sin(-0.3) + 0.05;
    for (int carry = 0; carry < 2; ++carry) {
        options.carry = carry;
        CHECK(place(&s, &plane, &options, &placed) == DP_OK);
        for (int n = 0; n < 2 * T * 7; ++n) CHECK_NEAR(placed.pose[n], s.pose[n], 1e-12);
        for (int n = 0; n < 3 * T; ++n) CHECK_NEAR(placed.com[n], s.com[n], 1e-12);
    }
    scene_free(&s);
}

TEST(a_foot_lies_on_the_slope)  // TRAIL (1)
{
    Scene          s = foot(0.0);
    DpPlaceOptions options = dp_place_options_default();
    options.carry = true;
    const Plane plane = {-0.2, 0.15, 3.0, 0.0, 0.0};  // downhill and to the side
    Placed      placed;
    CHECK(place(&s, &plane, &options, &placed) == DP_OK);
    for (int part = 0; part < 2; ++part) {
        const DpPose pose = pose_of(&placed, part, 0);
        const DpVec3 up = dp_turn(pose.turn, dp_vec3(0, 0, 1));
        const DpVec3 n = plane_normal(&plane, 0, 0, 1);
        const DpVec3 ahead = dp_turn(pose.turn, dp_vec3(1, 0, 0));
        CHECK_NEAR(dp_dot(up, n), 1.0, 1e-12);
        CHECK_NEAR(ahead.y, 0.0, 1e-12);  // the heading stays
        CHECK(ahead.x > 0.9);
        CHECK_NEAR(over(&plane, pose, 0.06), 0.0, 1e-9);
        CHECK_NEAR(over(&plane, pose, -0.06), 0.0, 1e-9);
    }
    // heel and toe hang together at the ball, and the body is as high over the ground as it was
    const DpVec3 ball = dp_place(pose_of(&placed, 0, 0), dp_vec3(0.16, 0, 0));
    CHECK_NEAR(dp_length(dp_sub(ball, pose_of(&placed, 1, 0).at)), 0.0, 1e-9);
    CHECK_NEAR(placed.com[2], 0.9 + plane_height(&plane, 0.2, 0.0), 1e-9);
    scene_free(&s);
}

TEST(turns_less_the_higher_it_is)  // TRAIL (1)
{
    Scene          s = foot(0.1);
    DpPlaceOptions options = dp_place_options_default();
    options.carry = true;
    const double slope = 10.0 * DP_PI / 180.0;
    const Plane  plane = {-tan(slope), 0.0, 0.0, 0.0, 0.0};
    Placed       placed;
    CHECK(place(&s, &plane, &options, &placed) == DP_OK);
    const double want[T] = {1.0, 0.5, 0.0};
    for (int t = 0; t < T; ++t) {
        const DpVec3 ahead = dp_turn(pose_of(&placed, 0, t).turn, dp_vec3(1, 0, 0));
        CHECK_NEAR(asin(-ahead.z), want[t] * slope, 1e-9);
    }
    scene_free(&s);
}

TEST(heels_stay_up_where_it_is_steep)  // TRAIL (2)
{
    Scene          s = foot(0.0);
    DpPlaceOptions options = dp_place_options_default();
    options.carry = true;
    const double degree = DP_PI / 180.0;
    const double slopes[3] = {14.0, 25.0, -25.0}, want[3] = {0.0, 10.0, 0.0};
    for (int n = 0; n < 3; ++n) {
        const Plane plane = {tan(slopes[n] * degree), 0.0, 0.0, 0.0, 0.0};
        Placed      placed;
        CHECK(place(&s, &plane, &options, &placed) == DP_OK);
        const DpVec3 heel = dp_turn(pose_of(&placed, 0, 0).turn, dp_vec3(1, 0, 0));
        const DpVec3 toe = dp_turn(pose_of(&placed, 1, 0).turn, dp_vec3(1, 0, 0));
        CHECK_NEAR(acos(dp_clamp(dp_dot(heel, toe), -1, 1)), want[n] * degree, 1e-6);
        CHECK_NEAR(over(&plane, pose_of(&placed, 1, 0), 0.06), 0.0, 1e-9);
        CHECK((over(&plane, pose_of(&placed, 0, 0), -0.06) > 0.03) == (n == 1));
    }
    scene_free(&s);
}

TEST(as_printed_feet_lie_flat_near_the_ground)  // TRAIL (1)
{
    Scene          s = foot(0.0);
    DpPlaceOptions options = dp_place_options_default();
    const Plane    plane = {0};
    const DpQuat   rolled = dp_quat_about(dp_vec3(0, 1, 0), -0.3);
    Placed         placed;
    options.flat = true;
    s.pose[3] = rolled.w, s.pose[5] = rolled.y;
    s.pose[2] = 0.06 * sin(0.3);  // the heel's tip on the ground
    CHECK(place(&s, &plane, &options, &placed) == DP_OK);
    CHECK_NEAR(dp_turn(pose_of(&placed, 0, 0).turn, dp_vec3(1, 0, 0)).z, 0.0, 0.11);
    scene_free(&s);
}

TEST(nothing_is_pushed_into_the_ground)
{
    Scene          s = foot(0.0);
    DpPlaceOptions options = dp_place_options_default();
    Placed         placed;
    for (int carry = 0; carry < 2; ++carry) {
        options.carry = carry;
        const Plane bumpy = {0.1, 0.0, carry ? 2.0 : -0.02, 0.0, 0.05};
        for (int t = 0; t < T; ++t) {  // toes over the bump
            s.pose[7 * t] = 0.3;
            s.pose[7 * (T + t)] = 0.46;
        }
        CHECK(place(&s, &bumpy, &options, &placed) == DP_OK);
        const double point[4] = {-0.06, 0.14, 0.0, 0.06};
        double       least = 1.0;
        for (int k = 0; k < 4; ++k)
            least = fmin(least, over(&bumpy, pose_of(&placed, k / 2, 0), point[k]));
        // uncarried, the toes were deeper than that in the bump before
        CHECK(carry ? least >= -1e-9 : least >= -0.07);
    }
    scene_free(&s);
}

TEST(beside_the_ground_what_was_last_is_held)
{
    Scene          s = foot(0.0);
    DpPlaceOptions options = dp_place_options_default();
    options.carry = true;
    Placed placed;
    Plane  plane = {0.0, 0.0, 1.0, 2.0, 0.0};
    scene_put(&s, T, 0, 0, 9.0, 0.0, 0.0), scene_put(&s, T, 1, 0, 9.16, 0.0, 0.0);
    CHECK(place(&s, &plane, &options, &placed) == DP_OK);
    CHECK_NEAR(pose_of(&placed, 0, 0).at.z, 1.0, 1e-9);
    plane.edge = 0.001, plane.height = 1.0;
    for (int t = 0; t < T; ++t) scene_com(&s, t, 9.0, 0.0, 0.9);
    CHECK(place(&s, &plane, &options, &placed) == DP_NO_GROUND);
    scene_free(&s);
}

TEST(refuses_what_cannot_be)
{
    Scene               s = foot(0.0);
    DpPlaceOptions      options = dp_place_options_default();
    const Plane         plane = {0};
    const DpGroundBelow below = below_of(&plane), none = {&plane, NULL, plane_normal};
    const double        clearance[4] = {0};
    Placed              placed;
    CHECK(place(&s, &plane, &options, &placed) == DP_OK);
    CHECK(dp_foot_place(&s.gait, 1, &below, &options, clearance, placed.pose, placed.com) ==
          DP_BAD_ARGUMENT);
    CHECK(dp_foot_place(&s.gait, 0, &none, &options, clearance, placed.pose, placed.com) ==
          DP_BAD_ARGUMENT);
    options.max_clearance = 0.0;
    CHECK(place(&s, &plane, &options, &placed) == DP_BAD_ARGUMENT);
    options = dp_place_options_default();
    options.floor = NAN;
    CHECK(place(&s, &plane, &options, &placed) == DP_BAD_ARGUMENT);
    scene_free(&s);
}

// a part that has no tip is as near to the ground as its first point
TEST(a_part_without_a_tip_has_a_ball)
{
    DpPlaceOptions options = dp_place_options_default();
    const Plane    plane = {-0.2, 0.15, 3.0, 0.0, 0.0};
    Placed         placed[2];
    options.carry = true;
    for (int k = 0; k < 2; ++k) {
        Scene s = foot(0.03);
        if (k) s.point_role[3] = DP_POINT_BALL;
        CHECK(place(&s, &plane, &options, &placed[k]) == DP_OK);
        scene_free(&s);
    }
    for (int n = 0; n < 2 * T * 7; ++n) CHECK_NEAR(placed[1].pose[n], placed[0].pose[n], 1e-9);
}

int main(void)
{
    RUN(level_ground_changes_nothing);
    RUN(a_foot_lies_on_the_slope);
    RUN(turns_less_the_higher_it_is);
    RUN(heels_stay_up_where_it_is_steep);
    RUN(as_printed_feet_lie_flat_near_the_ground);
    RUN(nothing_is_pushed_into_the_ground);
    RUN(beside_the_ground_what_was_last_is_held);
    RUN(refuses_what_cannot_be);
    RUN(a_part_without_a_tip_has_a_ball);
    return check_done();
}
