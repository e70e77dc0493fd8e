// tests of imprint_foot.c against asking every sample, one by one
#include "print.h"

// what the headers say, said again: every sample, every triangle
typedef struct Slow
{
    double mean, sure, unsure;  // mean height over sure samples; how many are, or may be, covered
} Slow;

static Slow slow_cell(const Ground* ground, const DpMesh* sole, DpPose pose, int i, int j,
                      int samples)
{
    Slow         slow = {0.0, 0.0, 0.0};
    const double cell = ground->patch.cell;
    for (int q = 0; q < samples; ++q)
        for (int p = 0; p < samples; ++p) {
            const double x = ground->patch.x0 + (i + (p + 0.5) / samples - 0.5) * cell;
            const double y = ground->patch.y0 + (j + (q + 0.5) / samples - 0.5) * cell;
            double       low = INFINITY;
            bool         near_edge = false;
            for (int t = 0; t < sole->triangle_count; ++t) {
                DpVec3 c[3];
                for (int k = 0; k < 3; ++k) {
                    const float* v = sole->vertex + 3 * sole->triangle[3 * t + k];
                    c[k] = dp_place(pose, dp_vec3((double)v[0], (double)v[1], (double)v[2]));
                }
                double side[3], whole = 0.0;
                for (int k = 0; k < 3; ++k) {
                    const DpVec3 a = c[(k + 1) % 3], b = c[(k + 2) % 3];
                    side[k] = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
                    whole += side[k];
                }
                if (whole == 0.0) continue;
                bool in = true, maybe = true;
                for (int k = 0; k < 3; ++k) {
                    in = in && side[k] / whole > 1e-7;
                    maybe = maybe && side[k] / whole > -1e-7;
                }
                near_edge = near_edge || (maybe && !in);
                const double z = (side[0] * c[0].z + side[1] * c[1].z + side[2] * c[2].z) / whole;
                if (in && z < low) low = z;
            }
            if (near_edge) {
                slow.unsure += 1.0;
            } else if (low < INFINITY) {
                slow.sure += 1.0;
                slow.mean += low;
            }
        }
    if (slow.sure > 0.0) slow.mean /= slow.sure;
    return slow;
}

static void check_slow(const Ground* ground, const DpMesh* sole, DpPose pose, int samples)
{
    const double most = (double)(samples * samples);
    for (int j = 0; j < ground->patch.ny; ++j)
        for (int i = 0; i < ground->patch.nx; ++i) {
            const int    at = j * ground->patch.row + i;
            const Slow   slow = slow_cell(ground, sole, pose, i, j, samples);
            const double got = (double)ground->cover[at] * most;
            if (slow.unsure > 0.0) {
                CHECK(got > slow.sure - 0.5 && got < slow.sure + slow.unsure + 0.5);
                continue;
            }
            CHECK_NEAR(got, slow.sure, 1e-4);
            if (slow.sure > 0.0)
                CHECK_NEAR(ground->bottom[at], slow.mean, 2e-6);
            else
                CHECK(ground->bottom[at] == INFINITY);
        }
}

TEST(agrees_with_asking_every_sample)
{
    static Ground  ground;
    static float   vertex[900];
    static int32_t triangle[300];
    unsigned       seed = 3;
    for (int round = 0; round < 24; ++round) {
        const int    triangles = 1 + round;
        const DpMesh mesh = random_mesh(&seed, vertex, triangle, triangles, round % 2 ? 0.5 : 0.15);
        const DpPose pose = turned(6.0 * check_random(&seed),
                                   dp_vec3(check_random(&seed), check_random(&seed), 1.0),
                                   dp_vec3(0.1 * check_random(&seed), 0.05, 2.0));
        lay(&ground, 23, 31, 0.0125, -0.13, -0.21);  // parts of the larger ones lie outside
        const int samples = 1 + round % 4;
        CHECK(press(&ground, &mesh, &pose, 1, samples) == DP_OK);
        check_slow(&ground, &mesh, pose, samples);
    }
}

// a triangle that stands on its edge: its lowest corners stand for it, not its tip
TEST(what_is_seen_edge_on_is_as_low_as_its_lowest)
{
    static Ground ground;
    const float   vertex[9] = {-0.05f, 0.0f, 0.2f, 0.05f, 0.0f, 0.2f, 0.0f, 1e-8f, 1.2f};
    const int32_t triangle[3] = {0, 1, 2};
    const DpMesh  mesh = {3, 1, vertex, triangle};
    lay_centred(&ground, 33, 33, 0.01);
    CHECK(press(&ground, &mesh, &stand, 1, 1) == DP_OK);
    int covered = 0;
    for (int n = 0; n < 33 * ground.patch.row; ++n) {
        if (n % ground.patch.row >= 33 || !(ground.cover[n] > 0.0f)) continue;
        CHECK_NEAR(ground.bottom[n], 0.2, 1e-6);
        ++covered;
    }
    CHECK(covered >= 9);
}

TEST(the_underside_counts_not_the_top)
{
    static Ground ground;
    for (int round = 0; round < 8; ++round) {
        const DpPose pose = turned(0.7 * round, dp_vec3(1.0, 0.5 * round, 0.3), dp_vec3(0, 0, 1.0));
        lay_centred(&ground, 33, 33, 0.01);
        CHECK(press(&ground, &box, &pose, 1, 3) == DP_OK);
        check_slow(&ground, &box, pose, 3);
    }
}

#define SIDE 12  // corners along one side of a sheet

// a sheet of triangles over the whole patch, corners shaken; height is a plane
static DpMesh sheet(unsigned* seed, double shake, float* vertex, int32_t* triangle)
{
    int t = 0;
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const bool   inner = i > 0 && j > 0 && i < SIDE - 1 && j < SIDE - 1;
            const double dx = inner ? shake * (check_random(seed) - 0.5) : 0.0;
            const double dy = inner ? shake * (check_random(seed) - 0.5) : 0.0;
            float*       v = vertex + 3 * (j * SIDE + i);
            v[0] = (float)((i + dx) / (SIDE - 1) - 0.5);
            v[1] = (float)((j + dy) / (SIDE - 1) - 0.5);
            v[2] = 0.0f;
        }
    for (int j = 0; j + 1 < SIDE; ++j)
        for (int i = 0; i + 1 < SIDE; ++i) {
            const int32_t a = j * SIDE + i, b = a + 1, c = a + SIDE, d = c + 1;
            const bool    slash = check_random(seed) < 0.5;
            const int32_t two[6] = {a, b, slash ? d : c, slash ? a : b, d, c};
            memcpy(triangle + t, two, sizeof two);
            t += 6;
        }
    const DpMesh mesh = {SIDE * SIDE, t / 3, vertex, triangle};
    return mesh;
}

TEST(shared_edges_do_not_leak)
{
    static Ground  ground;
    static float   vertex[3 * SIDE * SIDE];
    static int32_t triangle[6 * SIDE * SIDE];
    unsigned       seed = 11;
    for (int round = 0; round < 40; ++round) {
        const DpMesh mesh = sheet(&seed, round < 20 ? 0.9 : 0.0, vertex, triangle);
        // first turned and tilted, then with corners and edges exactly on samples
        const double angle = round < 20 ? 0.157 * round : 0.0;
        DpPose       pose = turned(angle, dp_vec3(0.0, 0.0, 1.0), dp_vec3(0.0, 0.0, 3.0));
        const double cell = round < 20 ? 0.01 : 1.0 / (4.0 * (SIDE - 1) * (1 + round % 3));
        const int    side = round < 20 ? 61 : 4 * (SIDE - 1) * (1 + round % 3) - 1;
        lay_centred(&ground, side > 150 ? 150 : side, side > 150 ? 150 : side, cell);
        const int samples = 1 + round % 4;
        CHECK(press(&ground, &mesh, &pose, 1, samples) == DP_OK);
        for (int j = 0; j < ground.patch.ny; ++j)
            for (int i = 0; i < ground.patch.nx; ++i) {
                const int at = j * ground.patch.row + i;
                CHECK(ground.cover[at] == 1.0f);
                CHECK_NEAR(ground.bottom[at], 3.0, 0.0);
            }
    }
}

int main(void)
{
    RUN(agrees_with_asking_every_sample);
    RUN(what_is_seen_edge_on_is_as_low_as_its_lowest);
    RUN(the_underside_counts_not_the_top);
    RUN(shared_edges_do_not_leak);
    return check_done();
}
