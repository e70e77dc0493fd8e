// What plants are made of, and the shape they return to.
#include "lawn.h"
#include "plants/plant_inside.h"

TEST(the_papers_plant)
{
    const DpPlantKind  kind = dp_plant_kind_default();
    const DpPlantShape shape = dp_plant_shape(&kind);
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_OK);
    CHECK(shape.rows == 7 && shape.stems == 4 && shape.particles == 28 && shape.bends == 20);
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 1);
    float     at[84];
    CHECK(dp_plants_read(plants, 0, 0, at, NULL, NULL) == DP_OK);
    double top = 0.0, wide = 0.0;
    for (int p = 0; p < 28; ++p) {
        top = fmax(top, (double)at[3 * p + 2]);
        for (int q = 0; q < 28; ++q)
            wide = fmax(wide, hypot((double)(at[3 * p] - at[3 * q]),
                                    (double)(at[3 * p + 1] - at[3 * q + 1])));
    }
    CHECK_NEAR(top, 0.10, 1e-6);
    CHECK_NEAR(wide, 0.05, 1e-6);
    CHECK(dp_plants_count(plants, 0) == 1 && dp_plants_count(plants, -1) == 1);
    dp_plants_destroy(plants);
    dp_plants_destroy(NULL);
}

TEST(a_tuft_crosses)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.form = DP_PLANT_TUFT;
    kind.sheets = 3;
    const DpPlantShape shape = dp_plant_shape(&kind);
    CHECK(shape.stems == 12 && shape.particles == 84);
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 3);
    float*    at = dp_alloc(84, 3 * sizeof(float));
    dp_plants_read(plants, 0, 0, at, NULL, NULL);
    // sheets are turned by 60 degrees against each other
    double angle[3];
    for (int s = 0; s < 3; ++s) {
        const float *a = at + 3 * 28 * s, *b = a + 3 * 21;
        angle[s] = atan2((double)(b[1] - a[1]), (double)(b[0] - a[0]));
    }
    CHECK_NEAR(cos(angle[1] - angle[0]), 0.5, 1e-5);
    CHECK_NEAR(cos(angle[2] - angle[0]), -0.5, 1e-5);
    dp_free(at);
    dp_plants_destroy(plants);
}

// the outer stems of a tuft: each edge leans by curl more than the one below, up to 162 degrees
TEST(curled_stems_bend_outward_and_never_roll_up)
{
    for (int k = 0; k < 2; ++k) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.form = DP_PLANT_TUFT, kind.curl = k ? 1.0f : 0.2f;
        DpPlants* plants = lawn(&kind, 1, 1, 1.0, 3);
        float     at[3 * 56];
        CHECK(dp_plants_read(plants, 0, 0, at, NULL, NULL) == DP_OK);
        for (int r = 0; r < 4; ++r) {
            const float *a = at + 3 * r, *b = a + 3, *foot = at;
            const double x = (double)(b[0] - a[0]), y = (double)(b[1] - a[1]);
            const double out = sqrt(x * x + y * y), up = (double)(b[2] - a[2]);
            const double lean = fmin((double)kind.curl * r, 0.9 * DP_PI);
            CHECK_NEAR(out, 0.02 * sin(lean), 1e-5);
            if (b[2] > 0.0f) CHECK_NEAR(up, 0.02 * cos(lean), 1e-5);
            CHECK(b[2] >= foot[2]);
        }
        dp_plants_destroy(plants);
    }
}

// what keeps two particles apart moves the one that is free, both alike where both are, and none that the ground holds
TEST(the_ground_holds_what_it_holds)
{
    for (int form = 0; form < 2; ++form) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.form = form;
        DpPlants*         plants = lawn(&kind, 1, 1, 1.0, 1);
        const PlantStand* stand = &plants->stand[0];
        const int         rows = stand->shape.rows;
        int               hung = 0;
        for (int e = 0; e < stand->edges; ++e) {
            const PlantEdge* edge = &stand->edge[e];
            const bool       a = edge->a % rows < DP_PLANT_HELD, b = edge->b % rows < DP_PLANT_HELD;
            const float *    from = stand->rest + 3 * edge->a, *to = stand->rest + 3 * edge->b;
            CHECK(!b);
            CHECK_NEAR(edge->share_a, a ? 0.0 : 0.5, 0.0);
            CHECK_NEAR(edge->share_b, a ? 1.0 : 0.5, 0.0);
            CHECK_CLOSE(edge->rest,
                        dp_length(dp_vec3((double)(to[0] - from[0]), (double)(to[1] - from[1]),
                                          (double)(to[2] - from[2]))),
                        1e-6);
            hung += a;
        }
        CHECK(hung > stand->shape.stems);  // stems on their feet, and diagonals from them
        dp_plants_destroy(plants);
    }
}

int main(void)
{
    RUN(the_papers_plant);
    RUN(a_tuft_crosses);
    RUN(curled_stems_bend_outward_and_never_roll_up);
    RUN(the_ground_holds_what_it_holds);
    return check_done();
}
