// A sole in the grass: flat under it, away from it beside, its way where it goes, mirrored when it
// is.
#include "grass/grass.h"
#include "plants/lawn.h"

#define CELL 0.01
#define N 96  // cells read, about the origin

static float bottom[SOLE_SIDE * SOLE_SIDE];

typedef struct Field
{
    float x[N * N], y[N * N], crushed[N * N];
} Field;

static double level(const void* context, double x, double y)
{
    (void)context, (void)x, (void)y;
    return 0.0;
}

static const DpPlantGround ground = {.cell = CELL, .at = level};

// what one sole does to a wide lawn; the cells' corner lies at the origin
static void print_of(const DpPlantCollider* foot, double height, Field* field)
{
    DpPlantKind kind = dp_plant_kind_default();
    float       root[3] = {0.0f, 0.0f, 0.0f};
    int         stand;
    DpGrass*    grass;
    DpPlants*   plants = dp_plants_create(1);
    kind.height = (float)height, kind.root_radius = 2.0f;  // one plant grows on all cells
    CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_OK);
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_grass_step(grass, &ground, foot, 1, 0.01) == DP_OK);
    dp_grass_read(grass, -N / 2, -N / 2, N, N, field->x, field->y, field->crushed);
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

static int at(double x, double y)
{
    return ((int)floor(y / CELL) + N / 2) * N + (int)floor(x / CELL) + N / 2;
}

// the sole of lawn.h on cells whose centres are cells' centres
static DpPlantCollider foot_at(double z, double tilt)
{
    return sole(bottom, CELL, 0.005, 0.005, z, 0.285, 0.105, tilt);
}

TEST(flat_under_it_away_beside_it_untouched_beyond)
{
    Field                 field;
    const double          height = 0.1;
    const DpPlantCollider foot = foot_at(0.0, 0.0);
    print_of(&foot, height, &field);
    for (double x = -0.10; x < 0.11; x += 0.05) {
        CHECK_NEAR(field.crushed[at(x, 0.005)], 1.0, 1e-6);
        CHECK(field.y[at(x, 0.045)] > 0.95f && field.y[at(x, -0.035)] < -0.95f);
        double before = 1.0;
        for (double d = 0.065; d < 0.13; d += CELL) {  // the edge lies at 0.06
            const double size = (double)field.y[at(x, d)];
            CHECK(size <= before && (d < 0.06 + 0.4 * height ? size > 0.0 : true));
            CHECK(d < 0.06 + 0.5 * height + CELL || !(size > 0.0));
            CHECK_NEAR(field.crushed[at(x, d)], 1.0 - sqrt(1.0 - size * size), 1e-5);
            before = size;
        }
    }
    CHECK(field.x[at(0.165, 0.005)] > 0.1f && field.x[at(-0.155, 0.005)] < -0.1f);
}

// how far it leans: all the way at the edge, nothing at half its height beside it, as the square between
TEST(beside_a_sole_the_lean_falls_as_the_square)
{
    Field                 field;
    const double          height = 0.2;
    const DpPlantCollider foot = foot_at(0.0, 0.0);
    print_of(&foot, height, &field);
    for (int k = 1; k < 14; ++k) {  // cells from the edge at 0.06
        const double near = fmax(0.0, 1.0 - (k - 0.5) * CELL / (0.5 * height));
        CHECK_NEAR(field.y[at(0.005, 0.055 + k * CELL)], near * near > 0.002 ? near * near : 0.0,
                   1e-5);
    }
}

TEST(a_sole_in_the_air_presses_to_its_height)
{
    Field                 field;
    const DpPlantCollider foot = foot_at(0.05, 0.2);  // rises along x, 5 cm up in its middle
    print_of(&foot, 0.1, &field);
    for (double x = -0.105; x < 0.12; x += 0.03) {
        const double gap = 0.05 + 0.2 * (floor(x / CELL) * CELL);
        const double crushed = 1.0 - gap / 0.1;
        CHECK_NEAR(field.crushed[at(x, 0.005)], crushed, 1e-5);
        CHECK_NEAR(hypot((double)field.x[at(x, 0.005)], (double)field.y[at(x, 0.005)]),
                   sqrt(crushed * (2.0 - crushed)), 1e-5);
    }
}

TEST(grass_goes_where_the_foot_goes)
{
    Field           field;
    DpPlantCollider foot = foot_at(0.0, 0.0);
    foot.velocity = dp_vec3(-3.0, 0.0, 0.0);
    print_of(&foot, 0.02, &field);
    CHECK(field.x[at(0.005, 0.005)] < -0.95f);
    CHECK_NEAR(field.y[at(0.005, 0.005)], 0.0, 0.05);
    CHECK(field.y[at(0.005, 0.055)] > 0.3f && field.x[at(0.005, 0.055)] < 0.0f);
}

// mirrored about y = 0, to the bit: cells at y mirror those at -y
TEST(a_mirrored_sole_parts_the_grass_mirrored)
{
    Field           one, two;
    DpPlantCollider foot = sole(bottom, CELL, 0.005, 0.105, 0.01, 0.285, 0.105, 0.05);
    foot.velocity = dp_vec3(0.5, 0.3, 0.0);
    print_of(&foot, 0.1, &one);
    foot = sole(bottom, CELL, 0.005, -0.105, 0.01, 0.285, 0.105, 0.05);
    foot.velocity = dp_vec3(0.5, -0.3, 0.0);
    print_of(&foot, 0.1, &two);
    double worst = 0.0;
    for (int j = 0; j < N; ++j)
        for (int i = 0; i < N; ++i) {
            const int a = j * N + i, b = (N - 1 - j) * N + i;
            worst = fmax(worst, fabs((double)(one.crushed[a] - two.crushed[b])));
            worst = fmax(worst, fabs((double)(one.y[a] + two.y[b])));
        }
    printf("  differ by %.2g\n", worst);
    CHECK(worst < 1e-6);
}

int main(void)
{
    RUN(flat_under_it_away_beside_it_untouched_beyond);
    RUN(beside_a_sole_the_lean_falls_as_the_square);
    RUN(a_sole_in_the_air_presses_to_its_height);
    RUN(grass_goes_where_the_foot_goes);
    RUN(a_mirrored_sole_parts_the_grass_mirrored);
    return check_done();
}
