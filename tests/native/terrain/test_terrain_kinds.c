// Which soil lies where: the heaviest that was painted there, the first of equals.
#include "terrain/ground.h"

#define SIDE 5

static float weight[3 * SIDE * SIDE], height[SIDE * SIDE];

// the soil at the cell of a sample of painted heights, a metre apart
static int kind_at(int i, int j)
{
    DpGround ground = ground_heights(SIDE, SIDE, 0.25, 0.25, 1.0, height);
    ground.kind_count = 3, ground.kind_weight = weight;
    DpTerrain* terrain = ground_terrain(&ground, 0.5, 0.0, 0.0);
    float      kind = -1.0f;
    CHECK(dp_terrain_read(terrain, DP_FIELD_KIND, 2 * i, 2 * j, 1, 1, &kind) == DP_OK);
    dp_terrain_destroy(terrain);
    return (int)kind;
}

static void paint(int soil, int i, int j, float how)
{
    weight[(soil * SIDE + j) * SIDE + i] = how;
}

TEST(the_heaviest_lies_there)
{
    for (int k = 0; k < SIDE * SIDE; ++k) weight[k] = 0.5f, weight[SIDE * SIDE + k] = 0.25f;
    paint(1, 2, 3, 0.75f);
    paint(2, 4, 1, 0.6f);
    CHECK(kind_at(0, 0) == 0);
    CHECK(kind_at(2, 3) == 1);
    CHECK(kind_at(3, 2) == 0);
    CHECK(kind_at(4, 1) == 2);
}

TEST(the_first_of_equals_lies_there)
{
    for (int k = 0; k < 3 * SIDE * SIDE; ++k) weight[k] = 0.5f;
    CHECK(kind_at(1, 1) == 0);
    paint(0, 1, 1, 0.25f);
    CHECK(kind_at(1, 1) == 1);
    for (int k = 0; k < 3 * SIDE * SIDE; ++k) weight[k] = 0.0f;  // nobody painted here
    CHECK(kind_at(1, 1) == 0);
}

TEST(paint_that_is_none_is_refused)
{
    DpGround               ground = ground_heights(SIDE, SIDE, 0.25, 0.25, 1.0, height);
    DpTerrain*             terrain = NULL;
    const DpTerrainOptions options = ground_options(0.5, 0.0, 0.0);
    ground.kind_count = 3, ground.kind_weight = weight;
    const float bad[] = {-0.1f, NAN, INFINITY};
    for (int k = 0; k < 3; ++k) {
        weight[3 * SIDE * SIDE - 1] = bad[k];
        CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_BAD_ARGUMENT);
    }
    weight[3 * SIDE * SIDE - 1] = 0.0f;
    ground.kind_weight = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_BAD_ARGUMENT);
    ground.kind_count = 4, ground.kind_weight = weight;  // there are three soils
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_BAD_ARGUMENT);
}

int main(void)
{
    RUN(the_heaviest_lies_there);
    RUN(the_first_of_equals_lies_there);
    RUN(paint_that_is_none_is_refused);
    return check_done();
}
