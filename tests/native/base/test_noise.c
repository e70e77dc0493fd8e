// tests of base/noise.c: MODEL 6.7; tests/core/test_rough.py holds it to its twin
#include "base/noise.h"

#include "check.h"

TEST(growth_is_e_to_the_x)
{
    for (double x = -8.0; x < 8.0; x += 0.173) CHECK_CLOSE(dp_noise_growth(x), exp(x), 1e-5);
    CHECK(dp_noise_growth(0.0) == 1.0);
    CHECK(dp_noise_growth(99.0) == dp_noise_growth(16.0));
    CHECK(dp_noise_growth(-99.0) == dp_noise_growth(-16.0));
}

// a piece of a window reads what the window reads there, wherever cells are counted from
TEST(a_place_is_a_place)
{
    const DpGrid grid = {0.004, 1.0, -2.0}, shifted = {0.004, 1.4, -2.2};
    float        all[64 * 64], part[16 * 8], same[16 * 8];
    for (int pieces = 0; pieces < 2; ++pieces) {
        if (pieces) {
            dp_noise_pieces(&grid, dp_cells(-32, -32, 64, 64), 0.024, 7, all);
            dp_noise_pieces(&grid, dp_cells(5, -20, 16, 8), 0.024, 7, part);
            dp_noise_pieces(&shifted, dp_cells(-95, 30, 16, 8), 0.024, 7, same);
        } else {
            dp_noise_waves(&grid, dp_cells(-32, -32, 64, 64), 0.024, 0.006, 7, all);
            dp_noise_waves(&grid, dp_cells(5, -20, 16, 8), 0.024, 0.006, 7, part);
            dp_noise_waves(&shifted, dp_cells(-95, 30, 16, 8), 0.024, 0.006, 7, same);
        }
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 16; ++i) {
                CHECK(part[16 * j + i] == all[64 * (j + 12) + i + 37]);
                CHECK_NEAR(part[16 * j + i], same[16 * j + i], 1e-5);
            }
    }
}

TEST(what_cells_cannot_hold_is_left_out)
{
    const DpGrid coarse = {0.013, 0.0, 0.0};
    float        waves[100], pieces[100];
    dp_noise_waves(&coarse, dp_cells(0, 0, 10, 10), 0.024, 0.006, 7, waves);
    dp_noise_pieces(&coarse, dp_cells(0, 0, 10, 10), 0.024, 7, pieces);
    for (int k = 0; k < 100; ++k) CHECK(waves[k] == 0.0f && pieces[k] == 0.0f);
}

int main(void)
{
    RUN(growth_is_e_to_the_x);
    RUN(a_place_is_a_place);
    RUN(what_cells_cannot_hold_is_left_out);
    return check_done();
}
