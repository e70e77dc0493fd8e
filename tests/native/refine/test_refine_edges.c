// tests of refine_edges.c: the edges of triangles, each once, against all pairs of sides
#include "refine/refine_inside.h"

#include "../check.h"

#define MAX_FACES 800

static int face[3 * MAX_FACES], of[3 * MAX_FACES];

// every side lies on the edge of its two points, every edge has a side, and no two are of the same points
static void holds(int triangles, int expected)
{
    DpEdge* edge = NULL;
    int     count = -1;
    CHECK(dp_edges_find(face, triangles, of, &edge, &count) == DP_OK);
    CHECK(count == expected);
    unsigned char* used = calloc((size_t)count + 1, 1);
    for (int side = 0; side < 3 * triangles; ++side) {
        const int* own = face + (side - side % 3);
        const int  a = own[(side % 3 + 1) % 3], b = own[(side % 3 + 2) % 3];
        CHECK(of[side] >= 0 && of[side] < count);
        const DpEdge* at = &edge[of[side]];
        CHECK(at->point[0] == (a < b ? a : b) && at->point[1] == (a < b ? b : a));
        used[of[side]] = 1;
    }
    for (int k = 0; k < count; ++k) {
        CHECK(used[k]);
        CHECK(edge[k].head == -1 && edge[k].mid == DP_EDGE_PLAIN);
        CHECK(edge[k].half[0] == -1 && edge[k].half[1] == -1);
        for (int n = 0; n < k; ++n)
            CHECK(edge[n].point[0] != edge[k].point[0] || edge[n].point[1] != edge[k].point[1]);
    }
    free(used);
    dp_free(edge);
}

TEST(two_triangles_share_an_edge)
{
    const int square[6] = {0, 1, 2, 2, 3, 0};
    memcpy(face, square, sizeof square);
    holds(1, 3);
    holds(2, 5);
    CHECK(of[1] == of[4]);  // 2-0, across from 1 and from 3
}

// a grid of squares, halved now this way, now that, its points numbered far apart: V - E + F = 1 (Euler)
TEST(a_grid_has_as_many_edges_as_euler_says)
{
    const int side = 20;
    int       faces = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const int p[4] = {1000003 * j + 17 * i, 1000003 * j + 17 * (i + 1),
                              1000003 * (j + 1) + 17 * (i + 1), 1000003 * (j + 1) + 17 * i};
            const int turn = (i + j) % 2, back = i % 3 == 0;
            const int at[2][3] = {{0, 1, 2}, {0, 2, 3}};
            for (int t = 0; t < 2; ++t, ++faces)
                for (int k = 0; k < 3; ++k)
                    face[3 * faces + (back ? 2 - k : k)] = p[(at[t][k] + turn) % 4];
        }
    CHECK(faces == 2 * side * side);
    holds(faces, (side + 1) * (side + 1) + faces - 1);
}

// edges of three and more triangles, as a fan and a book have them, are one edge each
TEST(many_triangles_may_have_one_edge)
{
    for (int t = 0; t < 100; ++t) {
        face[3 * t] = 7, face[3 * t + 1] = 3, face[3 * t + 2] = 50 + t;
        if (t % 2) face[3 * t] = 3, face[3 * t + 1] = 7;
    }
    holds(100, 1 + 2 * 100);
    for (int t = 1; t < 100; ++t) CHECK(of[3 * t + 2] == of[2]);
}

TEST(without_memory_there_are_none)
{
    const int square[6] = {0, 1, 2, 2, 3, 0};
    memcpy(face, square, sizeof square);
    for (long k = 0; k < 2; ++k) {
        DpEdge* edge = NULL;
        int     count = -1;
        dp_alloc_fail_after(k);
        CHECK(dp_edges_find(face, 2, of, &edge, &count) == DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
        CHECK(!edge && count == 0);
    }
}

int main(void)
{
    RUN(two_triangles_share_an_edge);
    RUN(a_grid_has_as_many_edges_as_euler_says);
    RUN(many_triangles_may_have_one_edge);
    RUN(without_memory_there_are_none);
    return check_done();
}
