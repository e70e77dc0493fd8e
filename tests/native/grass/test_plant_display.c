// Stems as they are shown: down where the lean is, as they are elsewhere, never below the ground.
#include "grass/grass.h"
#include "plants/lawn.h"

#define CELL 0.01
#define SIDE 13  // plants along a side, 5 cm apart

static float bottom[SOLE_SIDE * SOLE_SIDE];

// ground that rises along x by `slope`
static double slanted(const void* slope, double x, double y)
{
    (void)y;
    return *(const double*)slope * x;
}

typedef struct Bed
{
    DpPlants*       plants;
    DpGrass*        grass;
    DpPlantDisplay* display;
    double          rise;
    DpPlantGround   ground;
} Bed;

static DpStemLean lean_at(const void* grass, double x, double y)
{
    return dp_grass_stem_at(grass, x, y);
}

static void make(Bed* bed, const DpPlantKind* kind, double rise)
{
    float root[3 * SIDE * SIDE], slope[2 * SIDE * SIDE];
    int   stand;
    for (int k = 0; k < SIDE * SIDE; ++k) {
        root[3 * k] = (float)(0.05 * (k % SIDE - SIDE / 2)),
                 root[3 * k + 1] = (float)(0.05 * (k / SIDE - SIDE / 2));
        root[3 * k + 2] = (float)(rise * (double)root[3 * k]);
        slope[2 * k] = (float)rise, slope[2 * k + 1] = 0.0f;
    }
    bed->rise = rise;
    bed->ground = (DpPlantGround){.cell = CELL, .at = slanted, .context = &bed->rise};
    bed->plants = dp_plants_create(3);
    CHECK(dp_plants_add(bed->plants, kind, root, NULL, SIDE * SIDE, &stand) == DP_OK);
    CHECK(dp_plants_slope(bed->plants, stand, slope) == DP_OK);
    CHECK(dp_grass_create(&bed->grass, bed->plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_plant_display_create(&bed->display, bed->plants, lean_at, bed->grass) == DP_OK);
}

static void unmake(Bed* bed)
{
    dp_plant_display_destroy(bed->display);
    dp_grass_destroy(bed->grass);
    dp_plants_destroy(bed->plants);
}

static void live(Bed* bed, const DpPlantCollider* foot, int count, double dt)
{
    DpPlantsReport told;
    CHECK(dp_plants_step(bed->plants, &bed->ground, foot, count, dt, 1, &told) == DP_OK);
    CHECK(dp_grass_step(bed->grass, &bed->ground, foot, count, dt) == DP_OK);
    CHECK(dp_plant_display_step(bed->display) == DP_OK);
}

// a sole of 28 x 10 cm comes down on the origin, stands and is lifted again, along the slope
static void tread(Bed* bed)
{
    const double dt = 1.0 / 120;
    for (int k = 0; k < 90; ++k) {
        const double    high = k < 30 ? 0.01 * (30 - k) : k < 60 ? 0.0 : 0.01 * (k - 60);
        DpPlantCollider foot = sole(bottom, CELL, 0.0, 0.0, high, 0.28, 0.1, bed->rise);
        foot.velocity.z = k < 30 ? -0.01 / dt : k < 60 ? 0.0 : 0.01 / dt;
        live(bed, &foot, 1, dt);
    }
}

static DpPlantKind tough(void)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.break_angle = 10.0f, kind.strength = 1e6f;
    return kind;
}

// what is shown of all plants, against what they do
typedef struct Seen
{
    double down;              // height of the tips of stems that stand under the sole, shown
    double up;                // the same of what they do
    double lowest, shortest;  // of shown stems: over the ground [m], an edge over its rest length
    double longest, away;     // and how far from what they do, beside the sole's reach [m]
    bool   finite;
} Seen;

static Seen look(const Bed* bed, const DpPlantKind* kind)
{
    const DpPlantShape shape = dp_plant_shape(kind);
    const double       gap = (double)kind->height / (shape.rows - 2);
    float*             at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    float*             own = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    Seen               seen = {0.0, 0.0, 1.0, 9.0, 0.0, 0.0, true};
    int                under = 0;
    for (int k = 0; k < SIDE * SIDE; ++k) {
        CHECK(dp_plant_display_read(bed->display, &bed->ground, 0, k, at) == DP_OK);
        CHECK(dp_plants_read(bed->plants, 0, k, own, NULL, NULL) == DP_OK);
        for (int p = 0; p < shape.particles; ++p) {
            const float *a = at + 3 * p, *b = own + 3 * p,
                        *foot = at + 3 * (p / shape.rows * shape.rows + 1);
            const double x = (double)foot[0], y = (double)foot[1];
            const double floor = bed->rise * (double)a[0];
            seen.finite = seen.finite && isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
            if (p % shape.rows >= 1) seen.lowest = fmin(seen.lowest, (double)a[2] - floor);
            if (p % shape.rows >= 2) {
                const double edge = dp_length(dp_vec3(
                    (double)(a[0] - a[-3]), (double)(a[1] - a[-2]), (double)(a[2] - a[-1])));
                seen.shortest = fmin(seen.shortest, edge / gap);
                seen.longest = fmax(seen.longest, edge / gap);
            }
            if (p % shape.rows == shape.rows - 1 && fabs(x) < 0.12 && fabs(y) < 0.04) {
                seen.down += (double)a[2] - floor;
                seen.up += (double)b[2] - bed->rise * (double)b[0];
                ++under;
            }
            if (fabs(x) > 0.22 || fabs(y) > 0.13)
                for (int d = 0; d < 3; ++d)
                    seen.away = fmax(seen.away, fabs((double)(a[d] - b[d])));
        }
    }
    seen.down /= under, seen.up /= under;
    dp_free(at), dp_free(own);
    return seen;
}

TEST(trodden_stems_stay_down_while_they_swing_up)
{
    const DpPlantKind kind = tough();
    for (int k = 0; k < 3; ++k) {
        Bed bed;
        make(&bed, &kind, k == 0 ? 0.0 : k == 1 ? 0.3 : -0.6);
        const Seen before = look(&bed, &kind);
        CHECK_CLOSE(before.down, (double)kind.height, 1e-3);
        tread(&bed);
        for (int n = 0; n < 180; ++n) live(&bed, NULL, 0, 1.0 / 120);
        const Seen seen = look(&bed, &kind);
        CHECK(seen.up > 0.9 * (double)kind.height);
        CHECK(seen.down < 0.15 * (double)kind.height);
        CHECK(seen.lowest > -1e-6 && seen.shortest > 0.95 && seen.longest < 1.05 && seen.finite);
        CHECK(!(seen.away > 0.0));
        unmake(&bed);
    }
}

TEST(they_rise_as_the_lean_does)
{
    DpPlantKind kind = tough();
    kind.strength = 1e3f, kind.recover_rate = 5e2f;  // half of it is back every 1.4 s
    Bed bed;
    make(&bed, &kind, 0.0);
    tread(&bed);
    double was = 0.0;
    for (int n = 0; n < 40; ++n) {
        for (int k = 0; k < 12; ++k) live(&bed, NULL, 0, 1.0 / 120);
        const Seen seen = look(&bed, &kind);
        float      crushed;
        dp_grass_read(bed.grass, 5, 0, 1, 1, NULL, NULL, &crushed);
        if (n >= 5) CHECK_NEAR(seen.down / (double)kind.height, 1.0 - (double)crushed, 0.15);
        if (n >= 10) CHECK(seen.down > was - 1e-3 * (double)kind.height);
        was = seen.down;
    }
    CHECK(was > 0.8 * (double)kind.height);
    for (int k = 0; k < 2400; ++k) live(&bed, NULL, 0, 1.0 / 120);
    CHECK_CLOSE(look(&bed, &kind).down, (double)kind.height, 0.01);
    unmake(&bed);
}

static double step_of(const float* a, const float* b, int p)
{
    const float *to = a + 3 * p, *from = b + 3 * p;
    return dp_length(
        dp_vec3((double)(to[0] - from[0]), (double)(to[1] - from[1]), (double)(to[2] - from[2])));
}

TEST(what_is_let_go_does_not_jump)
{
    const DpPlantKind kind = tough();
    const int         many = dp_plant_shape(&kind).particles;
    float             was[3 * 64], at[3 * 64], own_was[3 * 64], own[3 * 64];
    Bed               bed;
    CHECK(many <= 64);
    for (int plant = 81; plant <= 87; ++plant) {
        double most = 0.0;
        make(&bed, &kind, 0.0);
        for (int k = 0; k < 240; ++k) {
            const double    high = k < 30 ? 0.01 * (30 - k) : k < 60 ? 0.0 : 0.01 * (k - 60);
            DpPlantCollider foot = sole(bottom, CELL, 0.0, 0.0, high, 0.28, 0.1, 0.0);
            foot.velocity.z = k < 30 ? -1.2 : k < 60 ? 0.0 : 1.2;
            live(&bed, &foot, 1, 1.0 / 120);
            CHECK(dp_plant_display_read(bed.display, &bed.ground, 0, plant, at) == DP_OK);
            CHECK(dp_plants_read(bed.plants, 0, plant, own, NULL, NULL) == DP_OK);
            for (int p = 0; p < many && k > 45; ++p)
                most = fmax(most, step_of(at, was, p) - step_of(own, own_was, p));
            memcpy(was, at, sizeof at), memcpy(own_was, own, sizeof own);
        }
        CHECK(most < 0.3 * (double)kind.height);  // in one step, more than what it does
        unmake(&bed);
    }
}

TEST(limp_stems_lie_as_they_do)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.break_angle = kind.degrade_angle;  // what bends breaks
    kind.root_radius = 0.03f;
    Bed bed;
    make(&bed, &kind, 0.0);
    tread(&bed);
    for (int n = 0; n < 600; ++n) live(&bed, NULL, 0, 1.0 / 120);
    const Seen seen = look(&bed, &kind);
    CHECK(seen.up < 0.5 * (double)kind.height);
    CHECK_NEAR(seen.down, seen.up, 0.05 * (double)kind.height);
    unmake(&bed);
}

TEST(odd_kinds_and_steps_are_shown_too)
{
    DpPlantKind kinds[3] = {tough(), tough(), tough()};
    kinds[0].height = 0.0f;
    kinds[1].curl = 0.5f, kinds[1].form = DP_PLANT_TUFT, kinds[1].sheets = 3;
    kinds[2].height = 0.9f, kinds[2].spacing = 0.02f;
    for (int k = 0; k < 3; ++k) {
        Bed bed;
        make(&bed, &kinds[k], 0.2);
        tread(&bed);
        DpPlantCollider foot = sole(bottom, CELL, 0.1, 0.05, 0.0, 0.28, 0.1, 0.2);
        live(&bed, &foot, 1, 1.0 / 120);  // put elsewhere
        live(&bed, NULL, 0, 1.0);
        CHECK(look(&bed, &kinds[k]).finite);
        unmake(&bed);
    }
}

static DpStemLean pressed_at(const void* lean, double x, double y)
{
    (void)x, (void)y;
    return *(const DpStemLean*)lean;
}

// Under a sole the lean lays a stem the lower the less the sole did: 1 - share (1 / 0.85 - 1) of what it says, of a
// stem that lies at a share of it; and one that lies lower than that is shown as it is.
TEST(under_a_sole_the_lean_does_what_the_sole_did_not)
{
    const DpPlantKind  kind = tough();
    const DpPlantShape shape = dp_plant_shape(&kind);
    const int          tip = 3 * (shape.rows - 1);
    const DpStemLean   lean = {.lean = {0.9, 0.0}, .down = 0.8, .pressed = true};
    for (int k = 0; k < 4; ++k) {
        const double    share = 0.25 * k + 0.2, lost = share * lean.down;
        const float     root[3] = {0};
        float           at[3 * 64];
        int             stand;
        DpPlantsReport  told;
        DpPlantDisplay* display;
        DpPlants*       plants = dp_plants_create(3);
        CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_OK);
        CHECK(dp_plant_display_create(&display, plants, pressed_at, &lean) == DP_OK);
        CHECK(dp_plants_read(plants, stand, 0, at, NULL, NULL) == DP_OK);
        const double tall = (double)(at[tip + 2] - at[5]);
        for (int p = 0; p < shape.particles; ++p) {  // tilted along x, the foot where it is
            const int    row = p % shape.rows;
            const double along = row > 1 ? tall * (row - 1) / (shape.rows - 2) : 0.0;
            if (row < 2) continue;
            at[3 * p] += (float)(along * sqrt(1.0 - (1.0 - lost) * (1.0 - lost)));
            at[3 * p + 2] = at[5] + (float)(along * (1.0 - lost));
        }
        CHECK(dp_plants_write(plants, stand, 0, at, NULL, NULL) == DP_OK);
        CHECK(dp_plants_step(plants, NULL, NULL, 0, 1e-5, 1, &told) == DP_OK);
        for (int n = 0; n < 3; ++n) CHECK(dp_plant_display_step(display) == DP_OK);
        CHECK(dp_plant_display_read(display, NULL, stand, 0, at) == DP_OK);
        const double low = fmax(share, 1.0 - share * (1.0 / 0.85 - 1.0));
        CHECK_NEAR((double)(at[tip + 2] - at[5]) / tall, 1.0 - low * lean.down, 0.02);
        dp_plant_display_destroy(display);
        dp_plants_destroy(plants);
    }
}

TEST(bad_arguments_are_refused)
{
    const DpPlantKind kind = tough();
    Bed               bed;
    float             at[3 * 1024];
    DpPlantDisplay*   display = NULL;
    make(&bed, &kind, 0.0);
    CHECK(dp_plant_display_create(NULL, bed.plants, lean_at, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_display_create(&display, NULL, lean_at, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_display_create(&display, bed.plants, NULL, NULL) == DP_BAD_ARGUMENT && !display);
    CHECK(dp_plant_display_step(NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_display_read(bed.display, NULL, 0, 0, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_display_read(bed.display, NULL, 1, 0, at) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_display_read(bed.display, NULL, 0, SIDE * SIDE, at) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_display_read(bed.display, NULL, 0, 0, at) == DP_OK);
    dp_plant_display_destroy(NULL);
    unmake(&bed);
}

int main(void)
{
    RUN(trodden_stems_stay_down_while_they_swing_up);
    RUN(they_rise_as_the_lean_does);
    RUN(what_is_let_go_does_not_jump);
    RUN(limp_stems_lie_as_they_do);
    RUN(odd_kinds_and_steps_are_shown_too);
    RUN(under_a_sole_the_lean_does_what_the_sole_did_not);
    RUN(bad_arguments_are_refused);
    return check_done();
}
