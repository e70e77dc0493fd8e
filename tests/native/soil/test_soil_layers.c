// ground of several layers: each yields to the same pressure
#include "check.h"
#include "soil/soil_law.h"

static DpSoil spring(float modulus, float depth)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = modulus, soil.layer_depth = depth;
    return soil;
}

static double pressure(const DpLayer* layers, int count, double depth)
{
    const int         start[2] = {0, count};
    const DpSoilPatch patch = {
        .soils = &layers->soil, .soil_count = 1, .layers = layers, .layer_start = start};
    return dp_law_kind_pressure(&patch, 0, 0.1, depth);
}

static double depth_under(const DpLayer* layers, int count, double load)
{
    const int         start[2] = {0, count};
    const DpSoilPatch patch = {
        .soils = &layers->soil, .soil_count = 1, .layers = layers, .layer_start = start};
    return dp_law_kind_depth(&patch, 0, 0.1, load);
}

TEST(layers_of_one_soil_are_one)
{
    const DpSoil  soil = spring(1e6f, 0.3f);
    const DpLayer layers[3] = {{soil, 0.05, 0, 0}, {soil, 0.15, 0, 0}, {soil, 0.1, 0, 0}};
    for (double depth = 0.0; depth < 0.34; depth += 0.013)  // and deeper than soil can be pressed
        CHECK_CLOSE(pressure(layers, 3, depth), dp_law_pressure(&soil, 0.1, depth), 1e-5);
    CHECK_CLOSE(depth_under(layers, 3, 5e4), dp_law_depth(&soil, 0.1, 5e4), 1e-6);
}

// springs in series, MODEL 6.17
TEST(the_softest_yields_most)
{
    const DpLayer layers[2] = {{spring(2e5f, 0.3f), 0.05, 0, 0}, {spring(1e6f, 0.2f), 0.2, 0, 0}};
    const double  depth = 0.02, share = 0.05 / 2e5 / (0.05 / 2e5 + 0.2 / 1e6);
    CHECK_CLOSE(dp_soil_layer_pressed(layers, 2, 0, depth), share * depth, 1e-6);
    CHECK_CLOSE(dp_soil_layer_pressed(layers, 2, 1, depth), (1.0 - share) * depth, 1e-6);
    CHECK_CLOSE(pressure(layers, 2, depth), depth / (0.05 / 2e5 + 0.2 / 1e6), 1e-6);
}

TEST(a_layer_is_pressed_no_deeper_than_it_is)
{
    const DpLayer layers[2] = {{spring(1e4f, 0.3f), 0.01, 0, 0}, {spring(1e11f, 1.0f), 1.0, 0, 0}};
    CHECK_CLOSE(depth_under(layers, 2, 1e5), SOIL_RIGID * 0.01 + 1e5 / 1e11, 1e-5);
    CHECK_CLOSE(dp_soil_layer_pressed(layers, 2, 0, 0.02), SOIL_RIGID * 0.01, 1e-6);
    CHECK(pressure(layers, 2, 0.02) > 1e8);
}

TEST(depth_and_pressure_are_inverse_on_any_soils)
{
    DpSoil snow = spring(1e5f, 0.3f), measured = spring(1e6f, 0.3f);
    snow.snow_density = 200.0f;
    measured.bekker_friction = 8e5f, measured.bekker_power = 0.4f;
    const DpLayer layers[3] = {
        {snow, 0.1, 0, 0}, {measured, 0.2, 0, 0}, {spring(2e6f, 0.3f), 0.3, 0, 0}};
    double before = 0.0;
    for (double depth = 0.001; depth < 0.5; depth *= 1.3) {
        const double load = pressure(layers, 3, depth);
        CHECK(load > before);
        CHECK_CLOSE(depth_under(layers, 3, load), depth, 1e-9);
        before = load;
    }
    CHECK(pressure(layers, 3, 0.0) <= 0.0 && pressure(layers, 3, -1.0) <= 0.0);
}

int main(void)
{
    RUN(layers_of_one_soil_are_one);
    RUN(the_softest_yields_most);
    RUN(a_layer_is_pressed_no_deeper_than_it_is);
    RUN(depth_and_pressure_are_inverse_on_any_soils);
    return check_done();
}
