// The shape of one stem: as high as asked for, and as long as it was.
#include "check.h"
#include "plants/plant_stem.h"

#define PIECES 6

// a stem whose piece k goes along (x, y, z), on a slope along x
static Stem made(double slope)
{
    Stem stem = {.pieces = PIECES, .slope = {slope, 0.0}};
    return stem;
}

static Stem upright(double slope)
{
    Stem stem = made(slope);
    for (int k = 0; k < PIECES; ++k) stem.segment[k] = dp_vec3(0, 0, 0.02);
    return stem;
}

// folds up and down along y
static Stem folded(double slope)
{
    Stem stem = made(slope);
    for (int k = 0; k < PIECES; ++k)
        stem.segment[k] = dp_scale(dp_unit(dp_vec3(0, 1.0, k % 2 ? -0.7 : 0.9)), 0.02);
    return stem;
}

static void check_lengths(const Stem* stem)
{
    for (int k = 0; k < PIECES; ++k) CHECK_CLOSE(dp_length(stem->segment[k]), 0.02, 1e-9);
}

TEST(heights_are_over_the_slope)
{
    Stem stem = upright(0.5);
    CHECK_CLOSE(dp_stem_high(&stem), 0.12, 1e-12);
    for (int k = 0; k < PIECES; ++k) stem.segment[k] = dp_vec3(0.02, 0.0, 0.01);
    CHECK_NEAR(dp_stem_high(&stem), 0.0, 1e-12);
    for (int k = 0; k < PIECES; ++k) stem.segment[k] = dp_vec3(0.0, 0.0, k < 3 ? 0.02 : -0.02);
    CHECK_CLOSE(dp_stem_high(&stem), 0.06, 1e-12);  // its highest point, not its tip
}

TEST(a_bent_stem_loses_what_it_is_told_to)
{
    const double lean[2] = {0.0, -0.4};
    for (int k = 0; k <= 10; ++k) {
        const Stem   own = upright(0.0);
        const double lost = 0.1 * k;
        const Stem   stem = dp_stem_bent(&own, lean, dp_stem_bent_by(&own, lean, lost));
        CHECK_NEAR(dp_stem_high(&stem), (1.0 - lost) * 0.12, 1e-5);
        check_lengths(&stem);
        for (int p = 0; p < PIECES; ++p)
            CHECK(k == 0 || (stem.segment[p].y < 0.0 && !(fabs(stem.segment[p].x) > 0.0)));
    }
    const Stem own = upright(0.3), flat = dp_stem_bent(&own, (const double[2]){1.0, 0.0}, 1.0);
    CHECK_NEAR(dp_stem_high(&flat), 0.0, 1e-9);
    CHECK(flat.segment[0].z > 0.005);  // up the slope
}

TEST(a_stem_rises_to_a_height)
{
    const Stem own = upright(0.2), laid = dp_stem_bent(&own, (const double[2]){0.0, 1.0}, 1.0);
    for (int k = 1; k < 10; ++k) {
        const Stem stem = dp_stem_risen(&laid, &own, dp_stem_risen_by(&laid, &own, 0.012 * k));
        CHECK_NEAR(dp_stem_high(&stem), 0.012 * k, 1e-5);
        check_lengths(&stem);
    }
    CHECK(!(dp_stem_risen_by(&own, &own, 0.01) > 0.0));  // it is higher already
}

TEST(folds_are_drawn_out_and_nothing_rises)
{
    for (int k = 0; k < 3; ++k) {
        const Stem stem = folded(0.3 * k - 0.3), out = dp_stem_unfolded(&stem, 1.0);
        double     least = 1.0;
        CHECK(dp_stem_high(&out) < 1.05 * dp_stem_high(&stem));
        check_lengths(&out);
        for (int p = 0; p + 1 < PIECES; ++p)
            least = fmin(least, dp_dot(dp_unit(out.segment[p]), dp_unit(out.segment[p + 1])));
        CHECK(least > 0.98);
        const Stem same = dp_stem_unfolded(&stem, 0.0);
        for (int p = 0; p < PIECES; ++p)
            CHECK(dp_length(dp_sub(same.segment[p], stem.segment[p])) < 1e-12);
    }
    Stem back = upright(0.0);
    for (int p = 0; p < PIECES; ++p) back.segment[p].z = p < 3 ? 0.02 : -0.02;
    const Stem out = dp_stem_unfolded(&back, 1.0);  // goes nowhere
    check_lengths(&out);
    CHECK_CLOSE(dp_stem_high(&out), 0.06, 1e-9);
}

// a zigzag beside the way it climbs: drawn out it is longer, and is laid over until it is as high as it was
TEST(what_is_drawn_out_is_laid_over)
{
    for (int k = 0; k < 3; ++k) {
        const double slope = 0.2 * k - 0.2;
        Stem         stem = made(slope);
        for (int p = 0; p < PIECES; ++p)
            stem.segment[p] = dp_scale(dp_unit(dp_vec3(p % 2 ? -1.0 : 1.0, 0.6, 0.5)), 0.02);
        const Stem   out = dp_stem_unfolded(&stem, 1.0);
        const double high = dp_stem_high(&stem), risen = dp_stem_high(&out) / high;
        double       before = 0.0, after = 0.0;
        for (int p = 0; p < PIECES; ++p) before += stem.segment[p].y, after += out.segment[p].y;
        CHECK(risen > 0.95 && risen < 1.02);
        CHECK(after > 1.4 * before);  // farther, at the same height
        check_lengths(&out);
    }
}

int main(void)
{
    RUN(heights_are_over_the_slope);
    RUN(a_bent_stem_loses_what_it_is_told_to);
    RUN(a_stem_rises_to_a_height);
    RUN(folds_are_drawn_out_and_nothing_rises);
    RUN(what_is_drawn_out_is_laid_over);
    return check_done();
}
