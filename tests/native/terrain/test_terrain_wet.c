// tests of terrain_wet.c: MODEL 6.13
//
// Angles are held against Culmann's cut, MODEL 6.13, read from the side of heights: a wall at the angle that is found
// stands 0.1 m high, a steeper one less.
#include "terrain/ground.h"
#include "terrain/terrain_inside.h"

static DpSoil sand(double wet, double wall)
{
    DpSoil soil = ground_soils[0];
    soil.rest_angle = 0.5585f, soil.wall_angle = (float)wall, soil.wetness = (float)wet;
    return soil;
}

// 4 c / gamma sin(b) cos(f) / (1 - cos(b - f)), by the suction of fine sand at a saturation [m]
static double height_of(double wet, double angle)
{
    const double friction = (double)0.5585f;
    const double suction = wet * 3000.0 * pow(pow(wet, -4.0 / 3.0) - 1.0, 0.25);
    return 4.0 * suction * tan(friction) / 16e3 * sin(angle) * cos(friction) /
           (1.0 - cos(angle - friction));
}

TEST(dry_soil_is_what_it_was)
{
    const DpSoil soil = sand(0.0, 0.7), wet = dp_wet_soil(&soil);
    CHECK(memcmp(&soil, &wet, sizeof wet) == 0);
}

TEST(damp_walls_stand_as_steep_as_their_height_allows)
{
    // nearly dry, and nearly full, suction is so small that walls of 0.1 m do not stand upright
    const double flat[3] = {0.002, 0.01, 0.03};
    for (int k = 0; k < 3; ++k) {
        const DpSoil soil = sand(flat[k], 0.5585), wet = dp_wet_soil(&soil);
        const double found = (double)wet.wall_angle;
        CHECK(found > 0.57 && found < 1.55);
        CHECK_CLOSE(height_of((double)soil.wetness, found), 0.1, 1e-4);
        CHECK(wet.rest_angle == soil.rest_angle && wet.young_modulus == soil.young_modulus);
    }
    for (int k = 2; k <= 8; ++k) {
        const DpSoil soil = sand(0.1 * k, 0.5585), wet = dp_wet_soil(&soil);
        CHECK(height_of((double)soil.wetness, 0.5 * DP_PI) > 0.1);
        CHECK_NEAR(wet.wall_angle, 0.5 * DP_PI, 1e-6);
        CHECK_NEAR(wet.rest_angle, soil.rest_angle, 0.0);
    }
}

// what stands by itself gains only what is steeper than that
TEST(walls_are_no_flatter_than_they_were_dry)
{
    const double free_angle = (double)dp_wet_soil(&(DpSoil){.wetness = 0.01f,
                                                            .rest_angle = 0.5585f,
                                                            .wall_angle = 0.5585f,
                                                            .young_modulus = 1e6f})
                                  .wall_angle;
    const double dry[3] = {0.6, free_angle + 0.1, 1.5};
    for (int k = 0; k < 3; ++k) {
        const DpSoil soil = sand(0.01, dry[k]);
        CHECK_NEAR(dp_wet_soil(&soil).wall_angle, fmax(dry[k], free_angle), 1e-6);
    }
}

// from four fifths on water bears up to half of the weight
TEST(soaked_soil_floats)
{
    for (int k = 0; k <= 4; ++k) {
        const DpSoil soil = sand(0.8 + 0.05 * k, 0.7), wet = dp_wet_soil(&soil);
        const double lifted = 0.5 * k / 4.0, slope = (1.0 - lifted) * tan((double)soil.rest_angle);
        CHECK_CLOSE(tan((double)wet.rest_angle), slope, 1e-5);
        CHECK_CLOSE(wet.young_modulus, (double)soil.young_modulus * sqrt(1.0 - lifted), 1e-5);
        // walls come down evenly from upright, where suction still holds them up, to where loose soil rests
        if (k == 0 || k == 2)
            CHECK_CLOSE(wet.wall_angle, (1.0 - 0.25 * k) * 0.5 * DP_PI + 0.25 * k * atan(slope),
                        1e-5);
        if (k == 4) CHECK_NEAR(wet.wall_angle, wet.rest_angle, 1e-6);
    }
}

int main(void)
{
    RUN(dry_soil_is_what_it_was);
    RUN(damp_walls_stand_as_steep_as_their_height_allows);
    RUN(walls_are_no_flatter_than_they_were_dry);
    RUN(soaked_soil_floats);
    return check_done();
}
