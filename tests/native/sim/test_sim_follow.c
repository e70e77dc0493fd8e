// One walk leaves the same ground, to the bit, wherever its poses come from; and what fails to load
// leaves what was followed.
#include "base/vec.h"
#include "check.h"
#include "sim/planted.h"
#include "sim/sim_inside.h"

enum
{
    LEFT = -32,
    LOW = -32,
    SIDE = 160
};

static const DpField FIELDS[] = {DP_FIELD_COMPRESSION, DP_FIELD_HEAP, DP_FIELD_PRESSURE_TIME,
                                 DP_FIELD_PLANT_STRENGTH};

// four fields of the world and how its grass lies, for dp_free
static float* ground_of(const World* world)
{
    const size_t cells = (size_t)SIDE * SIDE;
    float*       out = dp_alloc(5 * cells, sizeof *out);
    for (size_t f = 0; out && f < 4; ++f)
        CHECK(dp_terrain_read(world->terrain, FIELDS[f], LEFT, LOW, SIDE, SIDE, out + f * cells) ==
              DP_OK);
    if (out && world->plants)
        dp_grass_read(dp_sim_grass(world->sim), LEFT, LOW, SIDE, SIDE, NULL, NULL, out + 4 * cells);
    return out;
}

static bool same(const float* a, const float* b)
{
    return memcmp(a, b, 5 * (size_t)SIDE * SIDE * sizeof *a) == 0;
}

static World lawn(int workers)
{
    World       world;
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.5f, kind.break_angle = 0.6f;
    CHECK(world_make(&world, &kind, -0.2, -0.4, 1.6, 0.1, 0.02, workers) == DP_OK);
    return world;
}

static DpLoadedPoses poses_of(const Stride* s)
{
    return (DpLoadedPoses){s->pose, s->touching, s->force, s->point};
}

// samples of one walker's parts, cut out of a recording of one walker
static DpTrack cut(const Stride* s, int first, int count, int walker)
{
    const size_t parts = (size_t)s->gait.parts, times = (size_t)s->gait.times;
    const size_t n = (size_t)count, from = (size_t)first;
    double*      pose = dp_alloc(13 * parts * n, sizeof *pose);
    double *     force = pose + 7 * parts * n, *point = force + 3 * parts * n;
    uint8_t*     touching = dp_alloc(parts * n, 1);
    for (size_t p = 0; p < parts; ++p) {
        memcpy(pose + 7 * p * n, s->pose + 7 * (p * times + from), 7 * n * sizeof *pose);
        memcpy(force + 3 * p * n, s->force + 3 * (p * times + from), 3 * n * sizeof *pose);
        memcpy(point + 3 * p * n, s->point + 3 * (p * times + from), 3 * n * sizeof *pose);
        memcpy(touching + p * n, s->touching + p * times + from, n);
    }
    return (DpTrack){walker, first, count, {pose, touching, force, point}};
}

static void cut_drop(DpTrack* track)
{
    dp_free((void*)(uintptr_t)track->poses.pose);
    dp_free((void*)(uintptr_t)track->poses.touching);
}

// as recorded, as one track, as three tracks without a gap, and pushed step by step. MODEL 11.15
TEST(every_source_leaves_the_same_bits)
{
    Stride    s = stride_make(1, 3, 80.0, STRIDE_RATE);
    const int T = s.gait.times;
    float*    ground[4] = {NULL};
    for (int source = 0; source < 4; ++source) {
        World     world = lawn(source == 1 ? 3 : 1);
        DpMotion* motion = NULL;
        DpTrack   track[3];
        if (source == 0) {
            CHECK(walk(&world, &s) == DP_OK);
        } else if (source < 3) {
            const int pieces = source == 1 ? 1 : 3;
            for (int n = 0; n < pieces; ++n)
                track[n] = cut(&s, n * T / pieces, (n + 1) * T / pieces - n * T / pieces, 0);
            CHECK(dp_motion_tracks(&motion, &s.gait, track, pieces) == DP_OK);
            for (int n = 0; n < pieces; ++n) cut_drop(&track[n]);
            CHECK(dp_sim_follow(world.sim, motion) == DP_OK);
            CHECK(dp_sim_run(world.sim, T - 1) == DP_OK && dp_sim_settle(world.sim) == DP_OK);
        } else {
            CHECK(dp_motion_live(&motion, &s.gait) == DP_OK);
            CHECK(dp_sim_follow(world.sim, motion) == DP_OK);
            for (int t = 0; t < T; ++t) {
                DpTrack now = cut(&s, t, 1, 0);
                CHECK(dp_sim_push(world.sim, s.time[t], NULL, &now.poses) == DP_OK);
                CHECK(dp_sim_run(world.sim, t) == DP_OK);
                cut_drop(&now);
            }
            CHECK(dp_motion_bytes(motion) < 5 * 4 * (13 * sizeof(double) + 1));
            CHECK(dp_sim_settle(world.sim) == DP_OK);
        }
        ground[source] = ground_of(&world);
        CHECK(dp_sim_report(world.sim).contacts == 3 && dp_sim_report(world.sim).broke > 0);
        world_drop(&world);
        if (source > 0) CHECK(same(ground[0], ground[source]));
    }
    for (int source = 0; source < 4; ++source) dp_free(ground[source]);
    stride_drop(&s);
    CHECK(dp_bytes_live() == 0);
}

// who is not there is as one who was far up in the meantime, where nothing meets him
TEST(who_comes_and_goes_meets_nothing_on_the_way)
{
    Stride       s = stride_make(1, 3, 80.0, STRIDE_RATE);
    const int    T = s.gait.times, parts = s.gait.parts, gone = 76, back = 130;
    float*       ground[2] = {NULL};
    const double x = s.pose[7 * back], y = s.pose[7 * back + 1];
    for (int k = 0; k < parts * T; ++k) {  // he comes back where nobody was: at the origin
        s.pose[7 * k] -= x - 0.05, s.point[3 * k] -= x - 0.05;
        s.pose[7 * k + 1] -= y, s.point[3 * k + 1] -= y;
    }
    for (int p = 0; p < parts; ++p)  // nothing presses beside a gap
        s.touching[p * T + gone - 1] = s.touching[p * T + back] = 0;
    for (int run = 0; run < 2; ++run) {
        World     world = lawn(1);
        DpMotion* motion = NULL;
        if (run == 0) {
            DpTrack track[2] = {cut(&s, 0, gone, 0), cut(&s, back, T - back, 0)};
            CHECK(dp_motion_tracks(&motion, &s.gait, track, 2) == DP_OK);
            cut_drop(&track[0]), cut_drop(&track[1]);
        } else {
            for (int p = 0; p < parts; ++p)
                for (int t = gone; t < back; ++t)
                    s.pose[7 * (p * T + t) + 2] += 1e4, s.touching[p * T + t] = 0;
            const DpLoadedPoses poses = poses_of(&s);
            CHECK(dp_motion_record(&motion, &s.gait, &poses) == DP_OK);
        }
        CHECK(dp_sim_follow(world.sim, motion) == DP_OK);
        CHECK(dp_sim_run(world.sim, T - 1) == DP_OK && dp_sim_settle(world.sim) == DP_OK);
        ground[run] = ground_of(&world);
        CHECK(dp_sim_report(world.sim).broke > 0);
        world_drop(&world);
    }
    CHECK(same(ground[0], ground[1]));
    dp_free(ground[0]), dp_free(ground[1]);
    stride_drop(&s);
    CHECK(dp_bytes_live() == 0);
}

// A thousand walkers, one after the other: poses of those who are there, and the prints that each
// leaves alone on its own ground.
TEST(a_thousand_walkers_in_turn)
{
    enum
    {
        MANY = 1000
    };
    Stride    s = stride_make(1, 1, 80.0, 30.0);
    const int n = s.gait.times, parts = s.gait.parts, limbs = s.gait.limbs;
    double *time = dp_alloc((size_t)(MANY * n), sizeof *time), *mass = dp_alloc(MANY, sizeof *mass);
    int32_t*  owner = dp_alloc((size_t)(MANY * (limbs + parts)), sizeof *owner);
    DpMesh*   sole = dp_alloc((size_t)(MANY * parts), sizeof *sole);
    DpTrack*  track = dp_alloc(MANY, sizeof *track);
    DpMotion* motion = NULL;
    World     world;
    for (int t = 0; t < MANY * n; ++t) time[t] = t / 30.0;
    for (int w = 0; w < MANY; ++w) {
        mass[w] = 80.0;
        for (int l = 0; l < limbs; ++l) owner[w * limbs + l] = w;
        for (int p = 0; p < parts; ++p) {
            owner[MANY * limbs + w * parts + p] = w * limbs + s.part_limb[p];
            sole[w * parts + p] = s.sole[p];
        }
        track[w] = (DpTrack){w, w * n, n, poses_of(&s)};
    }
    const DpGait cast = {.times = MANY * n,
                         .walkers = MANY,
                         .limbs = MANY * limbs,
                         .parts = MANY * parts,
                         .time = time,
                         .mass = mass,
                         .limb_walker = owner,
                         .part_limb = owner + MANY * limbs,
                         .sole = sole};
    CHECK(dp_motion_tracks(&motion, &cast, track, MANY) == DP_OK);
    const size_t present = (size_t)(MANY * n * parts) * (13 * sizeof(double) + 1);
    CHECK(dp_motion_bytes(motion) == present);
    CHECK(world_make(&world, NULL, 0.0, 0.0, 0.0, 1.0, 0.02, 1) == DP_OK);
    CHECK(dp_sim_follow(world.sim, motion) == DP_OK);
    CHECK(dp_bytes_live() < present + present / 5 + (size_t)(MANY * parts * 1500));
    CHECK(dp_sim_run(world.sim, MANY * n - 1) == DP_OK);
    CHECK(dp_sim_report(world.sim).contacts == MANY);
    long bounds[4];
    dp_sim_bounds(world.sim, bounds);
    CHECK(bounds[1] - bounds[0] > 10 && bounds[1] - bounds[0] < 100);
    world_drop(&world);
    dp_free(time), dp_free(mass), dp_free(owner), dp_free(sole), dp_free(track);
    stride_drop(&s);
    CHECK(dp_bytes_live() == 0);
}

TEST(what_fails_to_load_leaves_what_was_followed)
{
    Stride s = stride_make(1, 3, 80.0, STRIDE_RATE), other = stride_make(2, 2, 60.0, STRIDE_RATE);
    float* ground[2] = {NULL};
    for (int run = 0; run < 2; ++run) {
        World world = lawn(1);
        CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
        CHECK(dp_sim_run(world.sim, 40) == DP_OK);
        for (long n = 0; run == 1; ++n) {
            const size_t live = dp_bytes_live();
            dp_alloc_fail_after(n);
            const double was = other.pose[3];
            DpStatus     status = DP_NO_MEMORY;
            if (n == 0) other.pose[3] = 7.0;
            status = dp_sim_load(world.sim, &other.gait, other.touching, other.force, other.point);
            other.pose[3] = was;
            dp_alloc_fail_after(-1);
            CHECK(status == (n == 0 ? DP_BAD_ARGUMENT : DP_NO_MEMORY));
            CHECK(dp_bytes_live() == live);
            if (n == 30) break;
        }
        CHECK(dp_sim_run(world.sim, s.gait.times - 1) == DP_OK);
        ground[run] = ground_of(&world);
        world_drop(&world);
    }
    CHECK(same(ground[0], ground[1]));
    for (int run = 0; run < 2; ++run) dp_free(ground[run]);
    stride_drop(&s), stride_drop(&other);
    CHECK(dp_bytes_live() == 0);
}

// who comes, or has gone, sweeps nothing: there is no way from where it was
TEST(who_comes_sweeps_nothing)
{
    Stride    s = stride_make(1, 2, 80.0, STRIDE_RATE);
    World     world = lawn(1);
    DpMotion* motion = NULL;
    DpTrack   track = cut(&s, 10, 20, 0);
    CHECK(dp_motion_tracks(&motion, &s.gait, &track, 1) == DP_OK);
    cut_drop(&track);
    CHECK(dp_sim_follow(world.sim, motion) == DP_OK);
    for (int sample = 6; sample < 34; ++sample) {
        const SweptSole* swept = dp_sweep_path(world.sim, 0, sample);
        const bool       there = sample + 1 >= 10 && sample + 1 < 30;
        CHECK(swept->jumps == !(sample >= 10 && there));
        CHECK(isfinite(swept->low) == there && isfinite(swept->ground) == there);
        if (swept->jumps) CHECK(memcmp(&swept->from, &swept->to, sizeof swept->to) == 0);
        if (swept->jumps) CHECK(!(dp_length(swept->displacement) > 0.0));
    }
    world_drop(&world);
    stride_drop(&s);
}

int main(void)
{
    RUN(every_source_leaves_the_same_bits);
    RUN(who_comes_and_goes_meets_nothing_on_the_way);
    RUN(a_thousand_walkers_in_turn);
    RUN(what_fails_to_load_leaves_what_was_followed);
    RUN(who_comes_sweeps_nothing);
    return check_done();
}
