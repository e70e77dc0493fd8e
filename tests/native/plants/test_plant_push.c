// soles and legs push plants; plants stay whole, above the ground and out of the sole.
#include "lawn.h"

// how deep particles are inside a sole: the worst over all plants
static double inside(const DpPlants* plants, const DpPlantKind* kind, int count,
                     const DpPlantCollider* c)
{
    const DpPlantShape shape = dp_plant_shape(kind);
    float*             at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    double             worst = 0.0;
    for (int k = 0; k < count; ++k) {
        dp_plants_read(plants, 0, k, at, NULL, NULL);
        for (int p = 0; p < shape.particles; ++p) {
            if (p % shape.rows == 0) continue;  // the root, in the ground
            const int i = (int)floor(((double)at[3 * p] - c->x0) / c->cell + 0.5);
            const int j = (int)floor(((double)at[3 * p + 1] - c->y0) / c->cell + 0.5);
            if (i < 0 || j < 0 || i >= c->nx || j >= c->ny) continue;
            const double b = (double)c->bottom[j * c->row + i], z = (double)at[3 * p + 2];
            if (isfinite(b) && z < b + c->thickness) worst = fmax(worst, z - b);
        }
    }
    dp_free(at);
    return worst;
}

// a boot comes down, stands, rolls and leaves, at this frame rate
static Strain footfall(DpPlantKind kind, double rate)
{
    DpPlants* plants = lawn(&kind, 8, 6, 0.08, 9);
    float     bottom[SOLE_SIDE * SOLE_SIDE];
    Strain    worst = {0.0, 0.0, 0.0, 1e9, true, 1e9};
    double    was_x = -0.4, was_z = 0.08, in = 0.0;
    for (int f = 1; f <= (int)(1.2 * rate); ++f) {
        const double    t = f / rate;
        const double    x = t < 0.3 ? -0.4 + 2.0 * t : t < 0.8 ? 0.2 : 0.2 + 2.0 * (t - 0.8);
        const double    z = t < 0.3 ? 0.08 * (1.0 - t / 0.3) : t < 0.8 ? 0.0 : 0.4 * (t - 0.8);
        const double    tilt = t < 0.4 ? 0.1 : t > 0.7 ? -0.1 : 0.0;
        DpPlantCollider c = sole(bottom, 0.01, x, 0.2, z + 0.14 * fabs(tilt), 0.28, 0.10, tilt);
        c.velocity = dp_vec3((x - was_x) * rate, 0.0, (z - was_z) * rate);
        was_x = x, was_z = z;
        step(plants, &c, 1, 1.0 / rate);
        const Strain s = strain_of(plants, &kind, 48);
        worst.stem = fmax(worst.stem, s.stem), worst.across = fmax(worst.across, s.across);
        worst.away = fmax(worst.away, s.away), worst.lowest = fmin(worst.lowest, s.lowest);
        worst.finite = worst.finite && s.finite;
        worst.shortest = fmin(worst.shortest, s.shortest);
        in = fmax(in, inside(plants, &kind, 48, &c));
    }
    CHECK(in <= 1e-6);
    dp_plants_destroy(plants);
    return worst;
}

TEST(a_boot_stretches_nothing_and_crushes_no_stem)
{
    const double rates[3] = {24.0, 60.0, 240.0};
    for (int form = 0; form < 2; ++form)
        for (int r = 0; r < 3; ++r) {
            DpPlantKind kind = dp_plant_kind_default();
            kind.form = form;
            CHECK(footfall(kind, rates[r]).stem <= 1.05 + 1e-5);  // stems that may break
            kind.break_angle = 10.0f, kind.degrade_rate = 0.0f;
            const Strain s = footfall(kind, rates[r]);  // and those that hold together
            CHECK(s.finite);
            CHECK(s.stem <= 1.05 + 1e-5);
            CHECK(s.across <= 1.05 + 1e-5);
            CHECK(s.lowest >= -1e-6);
            CHECK(s.away > 0.05);
            CHECK(s.shortest > 0.02);  // who has to make way goes aside, and not into the one below
            printf("    form %d, %3.0f Hz: stems %.3f to %.3f, across %.3f\n", form, rates[r],
                   s.shortest, s.stem, s.across);
        }
}

TEST(under_a_boot_grass_lies_flat_beside_it_it_leans_away_farther_it_stands)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.break_angle = 10.0f;  // never
    DpPlants* plants = lawn(&kind, 25, 9, 0.05, 3);
    float     bottom[SOLE_SIDE * SOLE_SIDE], at[84];
    for (int f = 0; f <= 30; ++f) {
        const double    z = fmax(0.12 - 0.006 * f, 0.0);
        DpPlantCollider c = sole(bottom, 0.01, 0.6, 0.2, z, 0.28, 0.10, 0.0);
        c.velocity = dp_vec3(0, 0, f <= 20 ? -0.36 : 0.0);
        step(plants, &c, 1, 1.0 / 60);
    }
    double pressed = 0.0, standing = 1.0;
    for (int k = 0; k < 225; ++k) {
        dp_plants_read(plants, 0, k, at, NULL, NULL);
        const double x = 0.05 * (k % 25) - 0.6, y = 0.05 * (k / 25) - 0.2;
        double       top = 0.0;
        for (int s = 0; s < 4; ++s) top = fmax(top, (double)at[3 * (7 * s + 6) + 2]);
        if (fabs(x) < 0.06 && fabs(y) < 0.01) pressed = fmax(pressed, top);
        if (fabs(x) > 0.40) standing = fmin(standing, top);
    }
    CHECK(pressed < 0.06);
    CHECK_NEAR(standing, 0.10, 1e-4);
    dp_plants_destroy(plants);
}

TEST(a_leg_pushes_stems_aside)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.height = 0.6f, kind.spacing = 0.05f, kind.width = 0.0f;
    const DpPlantShape shape = dp_plant_shape(&kind);
    DpPlants*          plants = lawn(&kind, 1, 1, 1.0, 3);
    float*             at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    double             deepest = 0.0, moved = 0.0;
    for (int f = 0; f < 60; ++f) {
        const double    x = -0.3 + 0.005 * f;
        DpPlantCollider c = {.from = {x, 0.0, 0.1},
                             .to = {x, 0.0, 0.9},
                             .radius = 0.06,
                             .velocity = {0.3, 0.0, 0.0},
                             .friction = 0.2};
        step(plants, &c, 1, 1.0 / 60);
        dp_plants_read(plants, 0, 0, at, NULL, NULL);
        for (int r = 2; r < shape.rows; ++r) {
            const double z = (double)at[3 * r + 2];
            if (z < 0.1 || z > 0.9) continue;
            deepest = fmax(deepest, 0.06 - hypot((double)at[3 * r] - x, (double)at[3 * r + 1]));
            moved = fmax(moved, (double)at[3 * r]);
        }
    }
    CHECK(deepest < 1e-4);
    CHECK(moved > 0.03);
    const Strain s = strain_of(plants, &kind, 1);
    CHECK(s.stem < 1.05);
    dp_free(at);
    dp_plants_destroy(plants);
}

// a heel as narrow as one stem comes down on each of them: it pushes that one, wherever it stands in its row
TEST(each_stem_of_a_row_is_pushed)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.width = 0.09f, kind.radius = 0.002f;
    const DpPlantShape shape = dp_plant_shape(&kind);
    const float        root[3] = {0.0f, 0.0f, 0.0f}, heading = 0.0f;
    float              at[3 * 96], bottom[SOLE_SIDE * SOLE_SIDE];
    CHECK(shape.stems > 3 && shape.particles <= 96);
    for (int stem = 0; stem < shape.stems; ++stem) {
        DpPlants* plants = dp_plants_create(3);
        int       stand = -1;
        CHECK(dp_plants_add(plants, &kind, root, &heading, 1, &stand) == DP_OK);
        CHECK(dp_plants_read(plants, 0, 0, at, NULL, NULL) == DP_OK);
        const float*    foot = at + 3 * (stem * shape.rows + 1);
        DpPlantCollider heel =
            sole(bottom, 0.001, (double)foot[0], (double)foot[1], 0.08, 0.006, 0.006, 0.0);
        heel.velocity = dp_vec3(0.0, 0.0, -0.5);
        for (int f = 0; f < 4; ++f) {
            for (int k = 0; k < SOLE_SIDE * SOLE_SIDE; ++k) bottom[k] -= 0.005f;
            step(plants, &heel, 1, 0.01);
            CHECK(inside(plants, &kind, 1, &heel) <= 1e-6);
        }
        dp_plants_destroy(plants);
    }
}

// how far the piece of a stem below a particle has turned since the step before, as a cosine
static double turned(const float* now, const float* was)
{
    const DpVec3 a =
        dp_vec3((double)(now[0] - now[-3]), (double)(now[1] - now[-2]), (double)(now[2] - now[-1]));
    const DpVec3 b =
        dp_vec3((double)(was[0] - was[-3]), (double)(was[1] - was[-2]), (double)(was[2] - was[-1]));
    return dp_dot(a, b) / fmax(dp_length(a) * dp_length(b), 1e-12);
}

// while a boot comes down no piece of a stem turns over within 1/240 s: who has no room makes way on its own side
TEST(no_stem_turns_over_in_a_step)
{
    for (int form = 0; form < 2; ++form) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.form = form;
        const DpPlantShape shape = dp_plant_shape(&kind);
        const size_t       size = 3 * (size_t)shape.particles;
        float *   now = dp_alloc(48 * size, sizeof *now), *was = dp_alloc(48 * size, sizeof *was);
        float     bottom[SOLE_SIDE * SOLE_SIDE];
        DpPlants* plants = lawn(&kind, 8, 6, 0.08, 9);
        double    least = 1.0;
        for (int f = 1; f < 72; ++f) {
            const double    t = f / 240.0, x = -0.4 + 2.0 * t, z = 0.08 * (1.0 - t / 0.3);
            DpPlantCollider c = sole(bottom, 0.01, x, 0.2, z + 0.014, 0.28, 0.10, 0.1);
            c.velocity = dp_vec3(2.0, 0.0, f > 1 ? -0.08 / 0.3 : -0.08 / 72);
            step(plants, &c, 1, 1.0 / 240);
            memcpy(was, now, 48 * size * sizeof *now);
            for (int k = 0; k < 48; ++k)
                CHECK(dp_plants_read(plants, 0, k, now + (size_t)k * size, NULL, NULL) == DP_OK);
            for (int p = 0; p < 48 * shape.particles && f > 1; ++p)
                if (p % shape.particles % shape.rows >= 2)
                    least = fmin(least, turned(now + 3 * p, was + 3 * p));
        }
        printf("    form %d: cosine %.3f\n", form, least);
        CHECK(least > 0.0);
        dp_plants_destroy(plants);
        dp_free(now), dp_free(was);
    }
}

int main(void)
{
    RUN(a_boot_stretches_nothing_and_crushes_no_stem);
    RUN(under_a_boot_grass_lies_flat_beside_it_it_leans_away_farther_it_stands);
    RUN(a_leg_pushes_stems_aside);
    RUN(each_stem_of_a_row_is_pushed);
    RUN(no_stem_turns_over_in_a_step);
    return check_done();
}
