// tests of soil_slide_walls.c and of what soil_stabilize.c does with it: MODEL 6.8
#include "check.h"
#include "ground.h"
#include "soil/soil_slide.h"

#define DEGREE (DP_PI / 180.0)
#define TENTH (0.1 * DEGREE)
#define SIDE 60

static float wall_slope[SIDE * SIDE];

// level ground with a pit of 20 x 10 cells, `deep` [m], whose walls stand up to `degrees`
static Ground pit(double degrees, double deep, double shift)
{
    DpSoil soil = dp_soil_default();
    soil.rest_angle = (float)(31.0 * DEGREE);
    Ground ground = ground_make(SIDE, SIDE, 0.01, soil);
    for (int k = 0; k < SIDE * SIDE; ++k) wall_slope[k] = (float)tan(degrees * DEGREE);
    for (int j = 25; j < 35; ++j)
        for (int i = 20; i < 40; ++i)
            ground.compression[j * SIDE + i] = (float)(deep + shift * (i - 29.5));
    ground.patch.wall_slope = wall_slope;
    return ground;
}

static DpSettled settle(Ground* ground, const DpImprint* imprint, int most)
{
    DpSoilScratch* scratch = dp_soil_scratch_create();
    DpSettled      settled;
    ground->patch.soils = ground->soil;
    CHECK(dp_soil_stabilize(&ground->patch, imprint, NULL, TENTH, most, scratch, &settled) ==
          DP_OK);
    dp_soil_scratch_destroy(scratch);
    return settled;
}

TEST(walls_fall_to_their_angle_and_volume_is_kept)
{
    const double degrees[3] = {35.0, 50.0, 70.0};
    for (int d = 0; d < 3; ++d) {
        Ground          ground = pit(degrees[d], 0.08, 0.0);
        const double    before = ground_sum(&ground, ground.compression);
        const DpSettled settled = settle(&ground, NULL, 100000);
        CHECK(settled.at_rest && settled.loosened > 0.0);
        CHECK_CLOSE(ground_sum(&ground, ground.heap), settled.loosened, 1e-6);
        CHECK_CLOSE(ground_sum(&ground, ground.compression), before + settled.loosened, 1e-6);
        double steepest = 0.0;
        for (int j = 1; j < SIDE - 1; ++j)
            for (int i = 1; i < SIDE - 1; ++i)
                for (int q = 0; q < 9; ++q) {
                    const int    p = j * SIDE + i, n = p + (q / 3 - 1) * SIDE + q % 3 - 1;
                    const double far = 0.01 * (q % 2 ? 1.0 : sqrt(2.0));
                    const double to = (double)ground.heap[n] - (double)ground.compression[n];
                    if (q != 4)
                        steepest = fmax(steepest, (-(double)ground.compression[p] - to) / far);
                }
        CHECK(steepest < tan(degrees[d] * DEGREE + TENTH));
        CHECK(steepest > tan((degrees[d] - 0.5) * DEGREE));
        CHECK(settle(&ground, NULL, 100).sweeps == 0);
        ground_free(&ground);
    }
}

TEST(walls_that_may_stand_do)
{
    Ground ground = pit(83.0, 0.08, 0.0);
    CHECK(settle(&ground, NULL, 1000).sweeps == 0);
    for (int k = 0; k < SIDE * SIDE; ++k) wall_slope[k] = INFINITY;
    for (int k = 0; k < SIDE * SIDE; ++k) ground.compression[k] *= 90.0f;
    CHECK(settle(&ground, NULL, 1000).sweeps == 0);
    ground_free(&ground);
}

// a wall may be as high as the ground was before any walker, and holds what a sole holds
TEST(ground_nobody_cut_and_walls_beside_a_sole_stand)
{
    Ground ground = pit(40.0, 0.0, 0.0);
    for (int k = 0; k < SIDE * SIDE; ++k) ground.base_height[k] = k % SIDE < 30 ? 0.3f : 0.0f;
    ground.compression[30 * SIDE + 50] = 1e-4f;
    ground.compression[30 * SIDE + 29] = 1e-4f;
    CHECK(settle(&ground, NULL, 1000).sweeps == 0);
    ground_free(&ground);

    ground = pit(40.0, 0.08, 0.0);
    for (int k = 0; k < SIDE * SIDE; ++k)
        ground.imprint.ring[k] = ground.compression[k] > 0.0f ? 0 : DP_RING_FAR;
    CHECK(settle(&ground, &ground.imprint, 1000).sweeps == 0);
    CHECK(settle(&ground, NULL, 1000).loosened > 0.0);
    ground_free(&ground);
}

TEST(mirrored_to_the_bit)
{
    Ground one = pit(45.0, 0.08, 0.002), other = pit(45.0, 0.08, -0.002);
    Ground turned = pit(45.0, 0.08, 0.002);
    for (int k = 0; k < SIDE * SIDE; ++k)
        turned.compression[k % SIDE * SIDE + k / SIDE] = one.compression[k];
    (void)settle(&one, NULL, 1000), (void)settle(&other, NULL, 1000);
    (void)settle(&turned, NULL, 1000);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const int mirrored = k / SIDE * SIDE + SIDE - 1 - k % SIDE;
        const int across = k % SIDE * SIDE + k / SIDE;
        CHECK(one.heap[k] == other.heap[mirrored]);
        CHECK(one.compression[k] == other.compression[mirrored]);
        CHECK(one.heap[k] == turned.heap[across]);
        CHECK(one.compression[k] == turned.compression[across]);
    }
    ground_free(&one), ground_free(&other), ground_free(&turned);
}

#define ROW 24  // floats from one row to the next; its cells are 4 to 19 of three rows
#define FIRST (ROW + 4)
#define CELLS 16

typedef struct Rows
{
    float firm[3 * ROW], height[3 * ROW], base[3 * ROW], steep[3 * ROW], slack[3 * ROW];
} Rows;

static int falls(Rows* rows)
{
    const Walls walls = {rows->base + FIRST, rows->steep + FIRST, rows->slack + FIRST};
    return dp_walls_fall(&walls, rows->firm + FIRST, rows->height + FIRST, ROW, CELLS);
}

// level firm ground whose walls may be `steep` high
static Rows level(float steep)
{
    Rows rows;
    memset(&rows, 0, sizeof rows);
    for (int k = 0; k < 3 * ROW; ++k) rows.steep[k] = steep, rows.slack[k] = 1e-4f;
    return rows;
}

TEST(a_wall_falls_to_any_of_its_eight_neighbours)
{
    for (int i = 0; i < CELLS; ++i)
        for (int q = 0; q < 9; ++q) {
            if (q == 4) continue;
            const int   low = FIRST + i + (q / 3 - 1) * ROW + q % 3 - 1;
            const float far = q % 2 ? 1.0f : (float)sqrt(2.0);
            Rows        rows = level(0.02f);
            for (int k = 0; k < 3 * ROW; ++k) rows.firm[k] = k == FIRST + i ? 0.0f : -1.0f;
            rows.base[low] = rows.height[low] =
                -0.1f;  // ground lay so before anybody came: it stands
            CHECK(!falls(&rows));
            rows.base[low] = 0.0f;
            CHECK(falls(&rows));
            rows.height[low] = -0.0199f * far;
            CHECK(!falls(&rows));
            rows.height[low] = -0.0203f * far;
            CHECK(falls(&rows));
        }
}

TEST(a_row_of_which_nothing_may_fall_gives_nothing)
{
    float    share[CELLS], give[CELLS];
    uint32_t state = 1;
    int      fell = 0, stood = 0;
    for (int k = 0; k < 4000; ++k) {
        Rows rows = level(0.01f);
        for (int c = 0; c < 3 * ROW; ++c)
            for (int f = 0; f < 3; ++f) {
                float* const fields[3] = {rows.firm, rows.height, rows.base};
                state = state * 1664525u + 1013904223u;
                fields[f][c] = (float)(state >> 8) * 0x1p-24f * 0.004f * (float)(k % 5);
            }
        const Walls walls = {rows.base + FIRST, rows.steep + FIRST, rows.slack + FIRST};
        (void)dp_walls_decide(&walls, share, give, rows.firm + FIRST, rows.height + FIRST, ROW,
                              CELLS, 1e-4f, 1.0f);
        int gives = 0;
        for (int c = 0; c < CELLS; ++c) gives |= give[c] > 0.0f;
        CHECK(!gives == !falls(&rows));
        fell += gives, stood += !gives;
    }
    CHECK(fell > 400 && stood > 400);
}

int main(void)
{
    RUN(walls_fall_to_their_angle_and_volume_is_kept);
    RUN(walls_that_may_stand_do);
    RUN(ground_nobody_cut_and_walls_beside_a_sole_stand);
    RUN(mirrored_to_the_bit);
    RUN(a_wall_falls_to_any_of_its_eight_neighbours);
    RUN(a_row_of_which_nothing_may_fall_gives_nothing);
    return check_done();
}
