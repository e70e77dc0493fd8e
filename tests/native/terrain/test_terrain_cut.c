#include "terrain/ground.h"

static const double as_it_is[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

TEST(faces_of_three_and_four_corners_become_triangles)
{
    // a triangle, a quad, a dented quad whose fourth corner lies inside
    const float   point[] = {0, 0, 0, 1, 0, 1, 0, 1, 2, 5, 0, 0, 7, 0, 0, 7, 1,
                             0, 5, 1, 0, 0, 5, 0, 4, 5, 0, 0, 9, 0, 1, 6, 0};
    const int32_t corner[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 9}, start[] = {0, 3, 7, 11};
    const double  place[12] = {2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 30};
    const DpFaces faces = {11, 3, 11, point, corner, start, 0};
    DpCut         cut;
    CHECK(dp_mesh_cut(&faces, place, NULL, 1, &cut) == DP_OK);
    CHECK(cut.bad == -1 && cut.point_count == 11 && cut.triangle_count == 5);
    const int32_t want[] = {0, 1, 2, 3, 4, 5, 3, 5, 6, 7, 8, 10, 7, 10, 9};
    CHECK(memcmp(cut.triangle, want, 9 * sizeof *want) == 0);
    // the dent: no triangle spans 7, 8, 9 beyond the corner 10
    double area = 0.0;
    for (int t = 3; t < 5; ++t) {
        const double* p[3];
        for (int k = 0; k < 3; ++k) p[k] = cut.vertex + 3 * cut.triangle[3 * t + k];
        const double twice =
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        CHECK(twice > 0.0);
        area += 0.5 * twice;
    }
    CHECK_NEAR(area, 4.0 * 4.0, 1e-12);  // in own space 0.5 (4 * 1 + 4 * 1)
    CHECK(cut.vertex[3] == 12.0 && cut.vertex[4] == 20.0 && cut.vertex[5] == 32.0);
    CHECK(cut.low[0] == 0.0f && cut.high[0] == 7.0f && cut.high[1] == 9.0f && cut.high[2] == 2.0f);
    dp_cut_free(&cut);
}

#define SIDE 700  // more than one worker's share of points and of faces

static float   grid_point[3 * SIDE * SIDE];
static int32_t grid_corner[4 * (SIDE - 1) * (SIDE - 1)];

static DpFaces grid(void)
{
    for (int n = 0; n < SIDE * SIDE; ++n) {
        grid_point[3 * n] = (float)(n % SIDE);
        grid_point[3 * n + 1] = (float)(n / SIDE);
        grid_point[3 * n + 2] = (float)(n % 7);
    }
    int32_t* corner = grid_corner;
    for (int j = 0; j + 1 < SIDE; ++j)
        for (int i = 0; i + 1 < SIDE; ++i, corner += 4) {
            const int32_t a = j * SIDE + i;
            corner[0] = a, corner[1] = a + 1, corner[2] = a + SIDE + 1, corner[3] = a + SIDE;
        }
    const int     faces = (SIDE - 1) * (SIDE - 1);
    const DpFaces made = {SIDE * SIDE, faces, 4 * faces, grid_point, grid_corner, NULL, 4};
    return made;
}

TEST(only_what_reaches_into_the_box_is_left)
{
    const DpFaces faces = grid();
    const double  box[4] = {99.5, 200.25, 301.5, 500.75};
    DpCut         first, other;
    CHECK(dp_mesh_cut(&faces, as_it_is, box, 1, &first) == DP_OK);
    // squares 99..301 by 200..500, and their corners
    CHECK(first.triangle_count == 2 * 203 * 301 && first.point_count == 204 * 302);
    CHECK(first.high[0] == (float)(SIDE - 1));  // of all of it
    for (int n = 0; n < first.point_count; ++n) {
        const float* point = grid_point + 3 * first.of[n];
        for (int k = 0; k < 3; ++k) CHECK(first.vertex[3 * n + k] == (double)point[k]);
        CHECK(point[0] >= 99.0f && point[0] <= 302.0f && point[1] >= 200.0f && point[1] <= 501.0f);
        CHECK(n == 0 || first.of[n] > first.of[n - 1]);
    }
    CHECK(dp_mesh_cut(&faces, as_it_is, box, 5, &other) == DP_OK);
    const size_t points = (size_t)first.point_count, corners = 3 * (size_t)first.triangle_count;
    CHECK(other.point_count == first.point_count && other.triangle_count == first.triangle_count);
    CHECK(memcmp(first.of, other.of, points * sizeof *first.of) == 0);
    CHECK(memcmp(first.vertex, other.vertex, points * 3 * sizeof *first.vertex) == 0);
    CHECK(memcmp(first.triangle, other.triangle, corners * sizeof *first.triangle) == 0);
    dp_cut_free(&first);
    dp_cut_free(&other);
    const double far[4] = {-9.0, -9.0, -8.0, -8.0};
    CHECK(dp_mesh_cut(&faces, as_it_is, far, 2, &first) == DP_OK);
    CHECK(first.triangle_count == 0 && first.point_count == 0);
    dp_cut_free(&first);
}

TEST(bad_meshes_are_told)
{
    DpFaces faces = grid();
    DpCut   cut;
    grid_point[3 * 400000 + 1] = NAN;
    grid_point[3 * 450000] = INFINITY;
    CHECK(dp_mesh_cut(&faces, as_it_is, NULL, 3, &cut) == DP_OK);
    CHECK(cut.bad == 400000 && !cut.vertex && !cut.triangle && !cut.of);
    dp_cut_free(&cut);
    faces = grid();
    grid_corner[1234567] = SIDE * SIDE;
    CHECK(dp_mesh_cut(&faces, as_it_is, NULL, 3, &cut) == DP_BAD_ARGUMENT);
    grid_corner[1234567] = -1;
    CHECK(dp_mesh_cut(&faces, as_it_is, NULL, 1, &cut) == DP_BAD_ARGUMENT);
    const int32_t five[] = {0, 5}, beyond[] = {0, 4, 7};
    faces = grid();
    faces.start = five, faces.face_count = 1;
    CHECK(dp_mesh_cut(&faces, as_it_is, NULL, 1, &cut) == DP_BAD_ARGUMENT);
    faces.start = beyond, faces.face_count = 2, faces.corner_count = 6;
    CHECK(dp_mesh_cut(&faces, as_it_is, NULL, 1, &cut) == DP_BAD_ARGUMENT);
}

// corners, their edges, and edges of faces given by their sizes
typedef struct Ring
{
    int32_t corner[64], corner_edge[64], edge[64][2];
    int     corners, edges;
} Ring;

static void add_face(Ring* ring, int sides, const int32_t* of)
{
    for (int k = 0; k < sides; ++k) {
        const int32_t a = of[k], b = of[(k + 1) % sides];
        int           e = 0;
        while (e < ring->edges && !((ring->edge[e][0] == a && ring->edge[e][1] == b) ||
                                    (ring->edge[e][0] == b && ring->edge[e][1] == a)))
            ++e;
        if (e == ring->edges) {
            ring->edge[e][0] = a, ring->edge[e][1] = b;
            ++ring->edges;
        }
        ring->corner[ring->corners] = a;
        ring->corner_edge[ring->corners++] = e;
    }
}

static bool are_quads(const Ring* ring)
{
    return dp_are_quads(ring->corners, ring->corner, ring->corner_edge, ring->edges,
                        &ring->edge[0][0], 2);
}

TEST(quads_are_known_by_their_edges)
{
    const int32_t quad[4] = {0, 1, 2, 3}, next[4] = {3, 2, 4, 5}, three[3] = {2, 6, 4};
    const int32_t five[5] = {4, 6, 7, 8, 5}, back[5] = {2, 9, 10, 11, 12};
    Ring          quads = {.corners = 0}, mixed = {.corners = 0}, turned = {.corners = 0};
    add_face(&quads, 4, quad);
    add_face(&quads, 4, next);
    CHECK(are_quads(&quads));
    // as many corners as quads would have
    add_face(&mixed, 4, quad);
    add_face(&mixed, 3, three);
    add_face(&mixed, 5, five);
    CHECK(mixed.corners == 12 && !are_quads(&mixed));
    add_face(&turned, 5, five);
    add_face(&turned, 3, three);
    CHECK(turned.corners == 8 && !are_quads(&turned));
    Ring meeting = {.corners = 0};  // the pentagon begins where the triangle does
    add_face(&meeting, 3, three);
    add_face(&meeting, 5, back);
    CHECK(!are_quads(&meeting));
    quads.corner_edge[7] = 99;
    CHECK(!are_quads(&quads));
}

TEST(points_off_the_centres_of_cells)
{
    const double vertex[] = {0.05, 0.15, 9.0, 1.05, -0.65, 0.0, 0.25, 0.36, 0.0};
    const double corner[2] = {0.0, 0.0}, shifted[2] = {0.05, 0.1};
    CHECK(dp_are_centres(2, vertex, 0.1, corner, 1e-9, 1));
    CHECK(dp_are_centres(3, vertex, 0.1, corner, 0.11, 1));
    CHECK(!dp_are_centres(3, vertex, 0.1, corner, 0.09, 1));
    CHECK(!dp_are_centres(2, vertex, 0.1, shifted, 0.45, 1));
    CHECK(dp_are_centres(2, vertex, 0.1, shifted, 0.51, 1));
    CHECK(dp_are_centres(0, vertex, 0.1, corner, 0.0, 1));
    double* many = malloc(3 * 100000 * sizeof *many);
    for (int n = 0; n < 100000; ++n) many[3 * n] = many[3 * n + 1] = (n - 50000 + 0.5) * 0.1;
    CHECK(dp_are_centres(100000, many, 0.1, corner, 1e-6, 4));
    many[3 * 99999 + 1] += 0.003;
    CHECK(!dp_are_centres(100000, many, 0.1, corner, 0.02, 4));
    free(many);
}

// a quad whose corner `dent` lies inside, in each of the planes and either way round, with points before and between
// its own: both triangles face as the quad does, and leave nothing out
TEST(any_corner_of_a_quad_may_be_dented)
{
    static const float shape[4][2] = {
        {4, 0}, {1, 1}, {0, 4}, {0, 0}};  // corner 1 is the dent; area 4
    for (int n = 0; n < 24; ++n) {
        const int dent = n % 4, plane = n / 4 % 3, back = n / 12;
        float     point[3 * 10];
        int32_t   corner[4];
        const int own[4] = {7, 2, 9, 4};
        double    sum[3] = {0.0}, size = 0.0, normal[2][3];
        for (int k = 0; k < 30; ++k) point[k] = (float)(k * k % 17) - 8.0f;
        for (int k = 0; k < 4; ++k) {
            const int from = (k - dent + 5) % 4, at = back ? 3 - k : k;
            corner[at] = own[k];
            for (int d = 0; d < 2; ++d)
                point[3 * own[k] + (plane + d) % 3] = shape[from][d] + 0.25f;
            point[3 * own[k] + (plane + 2) % 3] = 3.0f;
        }
        const DpFaces faces = {10, 1, 4, point, corner, NULL, 4};
        DpCut         cut;
        CHECK(dp_mesh_cut(&faces, as_it_is, NULL, 1, &cut) == DP_OK);
        CHECK(cut.triangle_count == 2);
        for (int t = 0; t < 2; ++t) {
            const double *a = cut.vertex + 3 * cut.triangle[3 * t],
                         *b = cut.vertex + 3 * cut.triangle[3 * t + 1],
                         *c = cut.vertex + 3 * cut.triangle[3 * t + 2];
            for (int k = 0; k < 3; ++k) {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                normal[t][k] =
                    0.5 * ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
                sum[k] += normal[t][k];
            }
            size += sqrt(normal[t][0] * normal[t][0] + normal[t][1] * normal[t][1] +
                         normal[t][2] * normal[t][2]);
        }
        CHECK_NEAR(fabs(sum[(plane + 2) % 3]), 4.0, 1e-9);
        CHECK_NEAR(size, 4.0, 1e-9);
        dp_cut_free(&cut);
    }
}

int main(void)
{
    RUN(faces_of_three_and_four_corners_become_triangles);
    RUN(only_what_reaches_into_the_box_is_left);
    RUN(bad_meshes_are_told);
    RUN(quads_are_known_by_their_edges);
    RUN(points_off_the_centres_of_cells);
    RUN(any_corner_of_a_quad_may_be_dented);
    return check_done();
}
