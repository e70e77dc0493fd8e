// tests of motion_cast.c: who walks is kept as it was given, and numbers that cannot be worked with are refused
#include "check.h"
#include "motion/motion.h"

#define T 3
#define PARTS 3

static const double  times[T] = {0.0, 0.5, 1.0}, mass[2] = {60.0, 5.0};
static const int32_t walker_of[2] = {1, 0}, limb_of[PARTS] = {1, 0, 1};
static const uint8_t law[2] = {DP_LAW_ANY, 1};
static const float   vertex[PARTS][15] = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                          {0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 2, 1},
                                          {0, 0, 2, 3, 0, 2, 3, 3, 2, 0, 3, 2, 1, 1, 4}};
static const int32_t triangle[PARTS][9] = {
    {0, 1, 2}, {0, 1, 2, 0, 2, 3}, {0, 1, 4, 1, 2, 4, 2, 3, 4}};
static double  pose[PARTS * T * 7], force[PARTS * T * 3], point[PARTS * T * 3];
static uint8_t touching[PARTS * T];

// every number its own; turns about each of the axes
static DpGait cast_of(DpMesh sole[PARTS])
{
    for (int p = 0; p < PARTS; ++p) sole[p] = (DpMesh){3 + p, 1 + p, vertex[p], triangle[p]};
    for (int k = 0; k < PARTS * T; ++k) {
        double* at = pose + 7 * k;
        for (int d = 0; d < 3; ++d) {
            at[d] = 10.0 * k + d, force[3 * k + d] = 100.0 * k + d - 50.0;
            point[3 * k + d] = -10.0 * k - d, at[4 + d] = d == k % 3 ? sin(0.7) : 0.0;
        }
        at[3] = cos(0.7);
        touching[k] = (uint8_t)(k % 2);
    }
    return (DpGait){.times = T,
                    .walkers = 2,
                    .limbs = 2,
                    .parts = PARTS,
                    .time = times,
                    .mass = mass,
                    .pose = pose,
                    .limb_walker = walker_of,
                    .part_limb = limb_of,
                    .sole = sole,
                    .contact_law = law};
}

TEST(who_walks_is_kept)
{
    DpMesh              sole[PARTS];
    const DpGait        gait = cast_of(sole);
    const DpLoadedPoses loads = {pose, touching, force, point};
    DpMotion*           motion = NULL;
    CHECK(dp_motion_record(&motion, &gait, &loads) == DP_OK);
    const DpGait* cast = dp_motion_cast(motion);
    CHECK(cast->walkers == 2 && cast->limbs == 2 && cast->parts == PARTS);
    CHECK(memcmp(cast->mass, mass, sizeof mass) == 0);
    CHECK(memcmp(cast->limb_walker, walker_of, sizeof walker_of) == 0);
    CHECK(memcmp(cast->part_limb, limb_of, sizeof limb_of) == 0);
    CHECK(memcmp(cast->contact_law, law, sizeof law) == 0);
    for (int p = 0; p < PARTS; ++p) {
        const DpMesh* own = &cast->sole[p];
        CHECK(own->vertex_count == 3 + p && own->triangle_count == 1 + p);
        CHECK(own->vertex != vertex[p] && own->triangle != triangle[p]);
        CHECK(memcmp(own->vertex, vertex[p], (size_t)(3 * (3 + p)) * sizeof(float)) == 0);
        CHECK(memcmp(own->triangle, triangle[p], (size_t)(3 * (1 + p)) * sizeof(int32_t)) == 0);
        for (int t = 0; t < T; ++t) {
            const int   k = p * T + t;
            DpPartState is;
            CHECK(dp_motion_part(motion, p, t, &is));
            const double got[13] = {is.pose.at.x,       is.pose.at.y,        is.pose.at.z,
                                    is.pose.turn.w,     is.pose.turn.x,      is.pose.turn.y,
                                    is.pose.turn.z,     is.force.x,          is.force.y,
                                    is.force.z,         is.pressure_point.x, is.pressure_point.y,
                                    is.pressure_point.z};
            CHECK(memcmp(got, pose + 7 * k, 7 * sizeof *got) == 0);
            CHECK(memcmp(got + 7, force + 3 * k, 3 * sizeof *got) == 0);
            CHECK(memcmp(got + 10, point + 3 * k, 3 * sizeof *got) == 0);
            CHECK(is.touching == touching[k]);
        }
    }
    dp_motion_destroy(motion);
}

// each number of a pose and of a force, spoilt on its own
TEST(each_number_is_looked_at)
{
    DpMesh              sole[PARTS];
    const DpGait        gait = cast_of(sole);
    const DpLoadedPoses loads = {pose, touching, force, point};
    for (int d = 0; d < 10; ++d)
        for (int how = 0; how < 3; ++how) {
            DpMotion* motion = NULL;
            cast_of(sole);
            const int k = (d + 2 * how) % (PARTS * T);
            double*   number = d < 7 ? &pose[7 * k + d] : &force[3 * k + d - 7];
            *number = how == 0 ? (double)NAN : how == 1 ? (double)INFINITY : d < 3 ? -2e9 : 3.0;
            const DpStatus want = how == 2 && d >= 7 ? DP_OK : DP_BAD_ARGUMENT;
            CHECK(dp_motion_record(&motion, &gait, &loads) == want);
            dp_motion_destroy(motion);
        }
}

int main(void)
{
    RUN(who_walks_is_kept);
    RUN(each_number_is_looked_at);
    return check_done();
}
