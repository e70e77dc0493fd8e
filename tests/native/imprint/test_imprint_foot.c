#include "print.h"

TEST(a_box_covers_its_cells_and_no_others)
{
    static Ground ground;
    for (int samples = 1; samples <= 4; ++samples) {
        lay_centred(&ground, 40, 30, 0.01);
        const DpPose pose = {{0.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 0.0}};
        CHECK(press(&ground, &box, &pose, 1, samples) == DP_OK);
        CHECK(ground.imprint.i0 == 10 && ground.imprint.i1 == 30);
        CHECK(ground.imprint.j0 == 10 && ground.imprint.j1 == 20);
        for (int j = 0; j < 30; ++j)
            for (int i = 0; i < 40; ++i) {
                const int  at = j * ground.patch.row + i;
                const bool under = i >= 10 && i < 30 && j >= 10 && j < 20;
                CHECK(ground.cover[at] == (under ? 1.0f : 0.0f));
                CHECK(ground.bottom[at] == (under ? 0.5f : INFINITY));
            }
        for (int n = 0; n < MAX_CELLS; ++n) {
            const int i = n % ground.patch.row;
            if (i >= 40 || n >= 30 * ground.patch.row) CHECK(ground.cover[n] == -7.0f);
            CHECK(ground.ring[n] == -7);  // rings are not its business
        }
    }
}

TEST(half_covered_cells_count_half)
{
    static Ground ground;
    lay_centred(&ground, 40, 30, 0.01);
    const DpPose pose = {{0.005, 0.0025, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    CHECK(press(&ground, &box, &pose, 1, 4) == DP_OK);
    CHECK(ground.imprint.i0 == 10 && ground.imprint.i1 == 31 && ground.imprint.j1 == 21);
    CHECK_NEAR(ground.cover[15 * ground.patch.row + 10], 0.5, 0.0);
    CHECK_NEAR(ground.cover[15 * ground.patch.row + 30], 0.5, 0.0);
    CHECK_NEAR(ground.cover[20 * ground.patch.row + 20], 0.25, 0.0);
    CHECK_NEAR(ground.cover[10 * ground.patch.row + 10], 0.375, 0.0);
}

TEST(area_does_not_change_with_the_cell)
{
    static Ground ground;
    const DpPose  pose = turned(0.3, dp_vec3(0.0, 0.0, 1.0), dp_vec3(0.0031, -0.0017, 0.0));
    const double  cells[] = {0.04, 0.02, 0.01, 0.005};
    for (int n = 0; n < 4; ++n) {
        const int side = (int)(0.48 / cells[n]);
        lay_centred(&ground, side, side, cells[n]);
        CHECK(press(&ground, &box, &pose, 1, dp_imprint_samples(cells[n], 0.3)) == DP_OK);
        double area = 0.0;
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                area += (double)ground.cover[j * ground.patch.row + i] * cells[n] * cells[n];
        CHECK_CLOSE(area, 0.02, n == 0 ? 0.02 : 0.01);
    }
}

static bool same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

TEST(a_mirrored_sole_leaves_a_mirrored_print_to_the_bit)
{
    static Ground  left, right;
    static float   vertex[900], flipped[900];
    static int32_t triangle[300], wound[300];
    unsigned       seed = 29;
    for (int round = 0; round < 32; ++round) {
        const DpMesh mesh = random_mesh(&seed, vertex, triangle, 3 + 3 * round, 0.3);
        const bool   across = round % 2;  // mirror y, else x
        for (int n = 0; n < mesh.vertex_count; ++n) {
            flipped[3 * n] = across ? vertex[3 * n] : -vertex[3 * n];
            flipped[3 * n + 1] = across ? -vertex[3 * n + 1] : vertex[3 * n + 1];
            flipped[3 * n + 2] = vertex[3 * n + 2];
        }
        for (int t = 0; t < mesh.triangle_count; ++t) {  // a mirrored mesh is wound the other way
            wound[3 * t] = triangle[3 * t];
            wound[3 * t + 1] = triangle[3 * t + 2];
            wound[3 * t + 2] = triangle[3 * t + 1];
        }
        const DpMesh twin = {mesh.vertex_count, mesh.triangle_count, flipped, wound};
        const DpPose pose = turned(2.0 * check_random(&seed),
                                   dp_vec3(check_random(&seed), -check_random(&seed), 0.4),
                                   dp_vec3(0.03, 0.02, 0.1));
        DpPose       other = pose;
        if (across) {
            other.at.y = -pose.at.y;
            other.turn.x = -pose.turn.x, other.turn.z = -pose.turn.z;
        } else {
            other.at.x = -pose.at.x;
            other.turn.y = -pose.turn.y, other.turn.z = -pose.turn.z;
        }
        const int nx = 31 + round % 2, ny = 27 + round % 3, samples = 1 + round % 4;
        lay_centred(&left, nx, ny, 0.0117);
        lay_centred(&right, nx, ny, 0.0117);
        CHECK(press(&left, &mesh, &pose, 1, samples) == DP_OK);
        CHECK(press(&right, &twin, &other, 1, samples) == DP_OK);
        int touched = 0;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const int a = j * left.patch.row + i;
                const int b =
                    across ? (ny - 1 - j) * left.patch.row + i : j * left.patch.row + nx - 1 - i;
                CHECK(same(left.cover[a], right.cover[b]));
                CHECK(same(left.bottom[a], right.bottom[b]));
                touched += left.cover[a] > 0.0f;
            }
        CHECK(touched > 20);
        CHECK(across || left.imprint.i0 == nx - right.imprint.i1);
        CHECK(!across || left.imprint.j0 == ny - right.imprint.j1);
    }
}

TEST(what_lies_outside_is_left_out)
{
    static Ground whole, part;
    const DpPose  pose = turned(0.4, dp_vec3(0.2, 0.1, 1.0), dp_vec3(0.0, 0.0, 0.0));
    lay(&whole, 40, 40, 0.015625, -0.3125, -0.3125);
    lay(&part, 12, 11, 0.015625, -0.3125 + 17 * 0.015625, -0.3125 + 20 * 0.015625);
    CHECK(press(&whole, &box, &pose, 1, 4) == DP_OK);
    CHECK(press(&part, &box, &pose, 1, 4) == DP_OK);
    for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 12; ++i) {
            const int a = j * part.patch.row + i, b = (j + 20) * whole.patch.row + i + 17;
            CHECK(part.cover[a] == whole.cover[b]);
            if (part.cover[a] > 0.0f) CHECK_NEAR(part.bottom[a], whole.bottom[b], 1e-7);
        }
    CHECK(part.imprint.j0 == 0 && part.imprint.i0 == 0);

    const DpPose far_away = {{5.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    CHECK(press(&part, &box, &far_away, 1, 4) == DP_OK);
    CHECK(part.imprint.i0 >= part.imprint.i1);
    CHECK(part.bottom[5] == INFINITY && part.cover[5] == 0.0f);
    const DpPose farther = {{5e12, -3e15, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    CHECK(press(&part, &box, &farther, 1, 4) == DP_OK);
    CHECK(part.imprint.i0 >= part.imprint.i1);
}

TEST(parts_of_a_limb_are_one_sole)
{
    static Ground ground, one, two;
    const DpMesh  soles[2] = {box, box};
    const DpPose  poses[2] = {turned(0.2, dp_vec3(0.0, 1.0, 0.0), dp_vec3(-0.05, 0.0, 0.02)),
                              turned(-0.3, dp_vec3(0.0, 1.0, 0.2), dp_vec3(0.05, 0.01, 0.0))};
    lay_centred(&ground, 40, 40, 0.01);
    lay_centred(&one, 40, 40, 0.01);
    lay_centred(&two, 40, 40, 0.01);
    CHECK(press(&ground, soles, poses, 2, 1) == DP_OK);
    CHECK(press(&one, soles, poses, 1, 1) == DP_OK);
    CHECK(press(&two, soles + 1, poses + 1, 1, 1) == DP_OK);
    for (int n = 0; n < 40 * ground.patch.row; ++n) {
        if (n % ground.patch.row >= 40) continue;
        CHECK(ground.cover[n] == fmaxf(one.cover[n], two.cover[n]));
        const float low = fminf(one.bottom[n], two.bottom[n]);
        if (low < INFINITY)
            CHECK_NEAR(ground.bottom[n], low, 2e-8);
        else
            CHECK(ground.bottom[n] == INFINITY);
    }
}

TEST(triangles_without_area_leave_nothing)
{
    static Ground        ground;
    static const float   vertex[] = {-0.1f, 0.0f, 0.0f, 0.1f, 0.0f,  0.0f, 0.0f, 0.0f,
                                     0.0f,  0.1f, 0.0f, 0.2f, -0.1f, 0.0f, 0.2f};
    static const int32_t triangle[] = {0, 1, 2, 0, 0, 0, 1, 1, 2, 0, 1, 3, 0, 3, 4};
    const DpMesh         mesh = {5, 5, vertex, triangle};  // a line, points and an upright sheet
    lay_centred(&ground, 31, 31, 0.01);                    // samples lie on y = 0
    CHECK(press(&ground, &mesh, &stand, 1, 3) == DP_OK);
    CHECK(ground.imprint.i0 >= ground.imprint.i1);
    for (int n = 0; n < 31; ++n) CHECK(ground.cover[15 * ground.patch.row + n] == 0.0f);
}

TEST(needles_stay_within_their_heights)
{
    static Ground  ground;
    static float   vertex[900];
    static int32_t triangle[300];
    unsigned       seed = 5;
    for (int n = 0; n < 300; ++n) {  // nearly upright, all through the samples of x = 0
        vertex[3 * n] = (float)((check_random(&seed) - 0.5) * 1e-12);
        vertex[3 * n + 1] = (float)(0.3 * (check_random(&seed) - 0.5));
        vertex[3 * n + 2] = (float)(0.02 + 0.1 * check_random(&seed));
        triangle[n] = n;
    }
    const DpMesh mesh = {300, 100, vertex, triangle};
    lay_centred(&ground, 31, 31, 0.01);
    CHECK(press(&ground, &mesh, &stand, 1, 1) == DP_OK);
    int touched = 0;
    for (int n = 0; n < 31 * ground.patch.row; ++n) {
        if (n % ground.patch.row >= 31 || !(ground.cover[n] > 0.0f)) continue;
        ++touched;
        CHECK(ground.bottom[n] >= 0.02f - 1e-6f && ground.bottom[n] <= 0.12f + 1e-6f);
    }
    CHECK(touched > 0);
}

TEST(nothing_to_press_leaves_nothing)
{
    static Ground ground;
    const DpMesh  none = {0, 0, NULL, NULL}, corners = {8, 0, box_vertex, box_triangle};
    lay_centred(&ground, 10, 10, 0.01);
    CHECK(press(&ground, NULL, NULL, 0, 2) == DP_OK);
    CHECK(ground.imprint.i0 >= ground.imprint.i1 && ground.cover[3] == 0.0f);
    CHECK(press(&ground, &none, &stand, 1, 2) == DP_OK);
    CHECK(ground.imprint.i0 >= ground.imprint.i1);
    CHECK(press(&ground, &corners, &stand, 1, 2) == DP_OK);
    CHECK(ground.imprint.i0 >= ground.imprint.i1);
}

TEST(bad_soles_are_refused_and_leave_the_imprint)
{
    static Ground ground;
    lay_centred(&ground, 10, 10, 0.01);
    ground.imprint.i1 = 77;
    int32_t triangle[36];
    memcpy(triangle, box_triangle, sizeof triangle);
    const DpMesh mesh = {8, 12, box_vertex, triangle};
    triangle[7] = 8;
    CHECK(press(&ground, &mesh, &stand, 1, 2) == DP_BAD_ARGUMENT);
    triangle[7] = -1;
    CHECK(press(&ground, &mesh, &stand, 1, 2) == DP_BAD_ARGUMENT);
    triangle[7] = 5;
    CHECK(press(&ground, &mesh, &stand, 1, 0) == DP_BAD_ARGUMENT);
    CHECK(press(&ground, &mesh, &stand, 1, 5) == DP_BAD_ARGUMENT);
    float vertex[24];
    memcpy(vertex, box_vertex, sizeof vertex);
    vertex[4] = NAN;
    const DpMesh holed = {8, 12, vertex, box_triangle};
    CHECK(press(&ground, &holed, &stand, 1, 2) == DP_BAD_ARGUMENT);
    const DpPose lost = {{0.0, INFINITY, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    CHECK(press(&ground, &box, &lost, 1, 2) == DP_BAD_ARGUMENT);
    const double heights[2] = {INFINITY, NAN};
    for (int k = 0; k < 2; ++k) {
        const DpPose high = {{0.0, 0.0, heights[k]}, {1.0, 0.0, 0.0, 0.0}};
        CHECK(press(&ground, &box, &high, 1, 2) == DP_BAD_ARGUMENT);
    }
    ground.patch.cell = 0.0;
    CHECK(press(&ground, &box, &stand, 1, 2) == DP_BAD_ARGUMENT);
    ground.patch.cell = 0.01;

    for (int left = 0; left < 5; ++left) {  // after the scratch itself
        DpImprintScratch* scratch = dp_imprint_scratch_create();
        dp_alloc_fail_after(left);
        CHECK(dp_imprint_foot(&ground.imprint, &ground.patch, &box, &stand, 1, 2, scratch) ==
              DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
        dp_imprint_scratch_destroy(scratch);
    }
    for (int n = 0; n < MAX_CELLS; ++n)
        CHECK(ground.cover[n] == -7.0f && ground.bottom[n] == -7.0f);
    CHECK(ground.imprint.i1 == 77);
    dp_imprint_scratch_destroy(NULL);
}

TEST(box_holds_the_posed_mesh)
{
    const DpPose pose = turned(acos(-1.0) / 2.0, dp_vec3(0.0, 0.0, 1.0), dp_vec3(1.0, 2.0, 3.0));
    const DpBox  around = dp_imprint_box(&box, pose);
    CHECK_NEAR(around.x0, 0.95, 1e-8);
    CHECK_NEAR(around.x1, 1.05, 1e-8);
    CHECK_NEAR(around.y0, 1.9, 1e-8);
    CHECK_NEAR(around.y1, 2.1, 1e-8);
    CHECK_NEAR(around.z0, 3.0, 1e-8);
    CHECK_NEAR(around.z1, 3.03, 1e-8);
}

TEST(samples_are_about_2_5_mm_apart)
{
    CHECK(dp_imprint_samples(0.001, 0.3) == 1);
    CHECK(dp_imprint_samples(0.0025, 0.3) == 1);
    CHECK(dp_imprint_samples(0.005, 0.3) == 2);
    CHECK(dp_imprint_samples(0.0075, 0.3) == 3);
    CHECK(dp_imprint_samples(0.01, 0.3) == 4);
    CHECK(dp_imprint_samples(0.04, 0.3) == 4);
    CHECK(dp_imprint_samples(1e9, 30.0) == 4);
}

TEST(small_soles_are_looked_at_as_closely_as_those_of_people)
{
    for (int n = 1; n <= 4; ++n) {
        CHECK(dp_imprint_samples(0.0025 * n, 0.25) == n);
        CHECK(dp_imprint_samples(0.00025 * n, 0.025) == n);
        CHECK(dp_imprint_samples(0.001 * n, 0.1) == n);
    }
    CHECK(dp_imprint_samples(0.01, 0.0) == 4);  // without a sole
}

int main(void)
{
    RUN(a_box_covers_its_cells_and_no_others);
    RUN(half_covered_cells_count_half);
    RUN(area_does_not_change_with_the_cell);
    RUN(a_mirrored_sole_leaves_a_mirrored_print_to_the_bit);
    RUN(what_lies_outside_is_left_out);
    RUN(parts_of_a_limb_are_one_sole);
    RUN(triangles_without_area_leave_nothing);
    RUN(needles_stay_within_their_heights);
    RUN(nothing_to_press_leaves_nothing);
    RUN(bad_soles_are_refused_and_leave_the_imprint);
    RUN(box_holds_the_posed_mesh);
    RUN(samples_are_about_2_5_mm_apart);
    RUN(small_soles_are_looked_at_as_closely_as_those_of_people);
    return check_done();
}
