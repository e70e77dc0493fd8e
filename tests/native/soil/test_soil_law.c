// ground that is no spring: snow that packs, and ground that was measured
#include "check.h"
#include "ground.h"
#include "law.h"
#include "soil/soil_law.h"

TEST(what_it_presses_back_with_grows_and_the_depth_is_its_inverse)
{
    const DpSoil soils[] = {snow(60.0f),
                            snow(450.0f),
                            measured(2e3f, 5e5f, 0.4f),
                            measured(0.0f, 2e6f, 1.6f),
                            measured(1e5f, 0.0f, 1.0f),
                            dp_soil_default()};
    for (size_t k = 0; k < sizeof soils / sizeof *soils; ++k) {
        double last = 0.0;
        CHECK(dp_law_pressure(&soils[k], 0.1, 0.0) <= 0.0 &&
              dp_law_pressure(&soils[k], 0.1, -1.0) <= 0.0);
        for (int n = 1; n <= 40; ++n) {
            const double depth = 0.3 * n / 41.0, pressure = dp_law_pressure(&soils[k], 0.1, depth);
            CHECK(pressure > last);
            if (depth < 0.95 * 0.3 && pressure < 1e7)
                CHECK_CLOSE(dp_law_depth(&soils[k], 0.1, pressure), depth, 1e-9);
            last = pressure;
        }
        CHECK(dp_law_depth(&soils[k], 0.1, 1e15) <= 0.95 * 0.3 + 1e-6);
    }
}

TEST(snow_is_packed_as_crrel_says)
{
    const double pressure[] = {35e3, 100e3, 300e3, 800e3}, density[] = {500.0, 500.0, 550.0, 650.0};
    for (int k = 0; k < 4; ++k) {
        const DpSoil soil = snow(100.0f);
        CHECK_CLOSE(dp_law_depth(&soil, 0.1, pressure[k]), 0.3 * (1.0 - 100.0 / density[k]), 0.02);
    }
}

TEST(the_width_is_the_smaller_one_however_it_is_turned)
{
    for (int turn = 0; turn < 4; ++turn) {
        Ground g = ground_make(60, 60, 0.01, snow(100.0f));
        ground_sole(&g, (BoxSole){.x = 0.003, .length = 0.3, .width = 0.1, .heading = 0.5 * turn});
        CHECK_CLOSE(dp_law_width(&g.patch, &g.imprint), 0.1, 0.05);
        ground_free(&g);
    }
    Ground g = ground_make(40, 40, 0.01, snow(100.0f));
    CHECK_NEAR(dp_law_width(&g.patch, &g.imprint), 0.01, 1e-12);  // no sole: a cell
    ground_free(&g);
}

int main(void)
{
    RUN(what_it_presses_back_with_grows_and_the_depth_is_its_inverse);
    RUN(snow_is_packed_as_crrel_says);
    RUN(the_width_is_the_smaller_one_however_it_is_turned);
    return check_done();
}
