// tests of soil_columns.c: MODEL 6.2
#include "check.h"
#include "ground.h"
#include "soil/soil_columns.h"

#define NX 90
#define NY 60
#define CELL 0.01

static DpSoil firm(void)
{
    DpSoil soil = dp_soil_default();
    soil.layer_depth = 0.2f, soil.young_modulus = 4e5f;
    return soil;
}

// what a sole's columns hold, by the cell of the patch; those beyond the ground in the order they come
typedef struct Seen
{
    double gap[NX * NY], pressed[NX * NY], share[NX * NY], spring[NX * NY], rigid[NX * NY];
    int    times[NX * NY], beyond, columns, rounds;
    double beyond_gap[NX * NY], beyond_spring;
} Seen;

static Seen look(Sole* sole)
{
    static Seen seen;
    memset(&seen, 0, sizeof seen);
    for (dp_columns_rewind(sole); dp_columns_next(sole); ++seen.rounds)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < LANES; ++k) {
                const Columns* columns = &sole->chunk[c];
                const size_t   p = columns->cell[k];
                if (k >= columns->count) {
                    CHECK(columns->share[k] == 0.0 && columns->spring[k] == 0.0);
                    continue;
                }
                ++seen.columns;
                if (p == NOWHERE) {
                    seen.beyond_gap[seen.beyond++] = columns->gap[k];
                    seen.beyond_spring = columns->spring[k];
                    continue;
                }
                ++seen.times[p];
                seen.gap[p] = columns->gap[k], seen.pressed[p] = columns->pressed[k];
                seen.share[p] = columns->share[k], seen.spring[p] = columns->spring[k];
                seen.rigid[p] = columns->rigid[k];
            }
    return seen;
}

static const DpVec3 up = {0.0, 0.0, 1.0};

TEST(a_column_is_what_the_patch_says_of_its_cell)
{
    static Sole sole;
    static Seen seen;
    Ground      ground = ground_make(NX, NY, CELL, firm());
    float       met[NX * NY];
    ground_sole(&ground, (BoxSole){.length = 0.205, .width = 0.1, .z = 0.04, .pitch = 0.1});
    for (int k = 0; k < NX * NY; ++k) {
        ground.base_height[k] = 0.002f * (float)(k % NX) - 0.05f;
        ground.compression[k] = 0.001f * (float)(k / NX), ground.heap[k] = 0.0005f * (float)(k % 7);
        met[k] = 0.25f;
    }
    for (int as_met = 0; as_met < 2; ++as_met) {
        ground.imprint.met = as_met ? met : NULL;
        dp_columns_begin(&sole, &ground.patch, &ground.imprint, up);
        seen = look(&sole);
        for (int k = 0; k < NX * NY; ++k) {
            const double cover = (double)ground.imprint.cover[k];
            CHECK(seen.times[k] == (cover > 0.0));
            if (!(cover > 0.0)) continue;
            const double lies = (double)ground.compression[k] - (double)ground.heap[k];
            CHECK_NEAR(seen.gap[k],
                       (double)ground.base_height[k] - (double)ground.imprint.bottom[k], 1e-15);
            CHECK_NEAR(seen.pressed[k], as_met ? -0.25 : lies, 1e-15);
            CHECK_NEAR(seen.share[k], cover, 0.0);
            CHECK_CLOSE(seen.spring[k], cover * 4e5 / 0.2 * CELL * CELL, 1e-6);
            CHECK_CLOSE(seen.rigid[k], 0.95 * 0.2, 1e-6);
        }
        CHECK(seen.rounds == 1 && seen.beyond == 0);
    }
    ground_free(&ground);
}

// more columns than are kept ready come in rounds, each of them once, and again when they are asked for again
TEST(a_large_sole_comes_in_rounds)
{
    static Sole sole;
    static Seen seen;
    Ground      ground = ground_make(NX, NY, CELL, firm());
    ground_sole(&ground, (BoxSole){.length = 0.8, .width = 0.5});
    dp_columns_begin(&sole, &ground.patch, &ground.imprint, up);
    for (int again = 0; again < 2; ++again) {
        seen = look(&sole);
        CHECK(seen.columns == 80 * 50 && seen.rounds == (4000 + 1279) / 1280);
        for (int k = 0; k < NX * NY; ++k) CHECK(seen.times[k] == (ground.imprint.cover[k] > 0.0f));
    }
    ground_free(&ground);
}

// ground that ends under the sole goes on as the plane it lies in, whose normal is given, as firm as what there is
TEST(beyond_its_edge_the_ground_goes_on_in_its_plane)
{
    static Sole  sole;
    static Seen  seen;
    Ground       ground = ground_make(NX, NY, CELL, firm());
    const double a = 0.3, b = -0.2, long_ = sqrt(1.0 + a * a + b * b);
    ground_sole(&ground, (BoxSole){.length = 0.2, .width = 0.1});
    double want[NX * NY];
    int    count = 0;
    for (int k = 0; k < NX * NY; ++k) {
        const double x = (k % NX) * CELL, y = (k / NX) * CELL;
        ground.base_height[k] = (float)(0.1 + a * x + b * y);
        if (ground.imprint.cover[k] > 0.0f && k % NX >= 48 && k / NX < 33) {
            want[count++] = (double)ground.base_height[k] - (double)ground.imprint.bottom[k];
            ground.base_height[k] = NAN;
        }
    }
    const DpVec3 normal = {-a / long_, -b / long_, 1.0 / long_};
    dp_columns_begin(&sole, &ground.patch, &ground.imprint, normal);
    seen = look(&sole);
    CHECK(count > 20 && seen.beyond == count);
    for (int k = 0; k < count; ++k) CHECK_NEAR(seen.beyond_gap[k], want[k], 1e-6);
    CHECK_CLOSE(seen.beyond_spring, 4e5 / 0.2 * CELL * CELL, 1e-6);
    for (int k = 0; k < NX * NY; ++k) ground.base_height[k] = NAN;
    dp_columns_begin(&sole, &ground.patch, &ground.imprint, normal);
    CHECK(!sole.beyond.is_there);
    ground_free(&ground);
}

// what of a sole lies over no ground is met where the ground under the rest of it was met on average
TEST(beyond_an_edge_the_mean_goes_on)
{
    Ground ground = ground_make(NX, NY, CELL, firm());
    Sole*  sole = dp_alloc(1, sizeof *sole);
    double met = 0.0, cover = 0.0;
    ground_sole(&ground, (BoxSole){.z = -0.05, .length = 0.3, .width = 0.137});
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i) {
            const int k = j * NX + i;
            ground.compression[k] = 0.001f * (float)(j % 5),
            ground.heap[k] = 0.002f * (float)(i % 3);
            if (i >= NX / 2) {
                ground.base_height[k] = NAN;
                continue;
            }
            const double a = (double)ground.imprint.cover[k];
            met += a * (double)(ground.compression[k] - ground.heap[k]), cover += a;
        }
    dp_columns_begin(sole, &ground.patch, &ground.imprint, dp_vec3(0, 0, 1));
    CHECK(sole->beyond.is_there && cover > 100.0);
    CHECK_NEAR(sole->beyond.met, met / cover, 1e-9);
    CHECK_NEAR(sole->beyond.depth, 0.2, 1e-7);
    CHECK_CLOSE(sole->beyond.stiffness, 4e5 / 0.2, 1e-6);
    CHECK_NEAR(sole->beyond.base_height, 0.0, 0.0);
    dp_free(sole);
    ground_free(&ground);
}

int main(void)
{
    RUN(a_column_is_what_the_patch_says_of_its_cell);
    RUN(a_large_sole_comes_in_rounds);
    RUN(beyond_its_edge_the_ground_goes_on_in_its_plane);
    RUN(beyond_an_edge_the_mean_goes_on);
    return check_done();
}
