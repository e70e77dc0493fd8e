// what is taken off a column, cut or pressed
#include "check.h"
#include "ground.h"
#include "soil/soil_law.h"

static Ground column(float rebound)
{
    DpSoil soil = dp_soil_default();
    soil.poisson_ratio = 0.35f;
    soil.rebound = rebound;
    Ground g = ground_make(4, 4, 0.01, soil);
    g.patch.soils = g.soil;
    g.heap[5] = 0.03f, g.compression[5] = 0.01f;
    return g;
}

TEST(what_is_cut_is_whole_and_what_is_pressed_displaces_its_share)
{
    Ground    g = column(0.0f);
    const Cut cut = dp_cut_cell(&g.patch, 5, 0.02, 0.005, 1.0);
    CHECK_NEAR(g.heap[5], 0.01, 1e-8);
    CHECK_NEAR(g.compression[5], 0.015, 1e-8);
    CHECK_NEAR(cut.loose, 0.02, 1e-8);
    CHECK_NEAR(cut.firm, 0.005, 1e-8);
    CHECK_NEAR(cut.firm_pressed + cut.loose_pressed + cut.displaced, 0.0, 1e-12);
    const Cut half = dp_cut_cell(&g.patch, 5, 0.01, 0.01, 0.25);
    CHECK_NEAR(half.loose, 0.0025, 1e-8);
    CHECK_NEAR(half.firm, 0.0025, 1e-8);
    CHECK_NEAR(half.displaced, half.loose_pressed + 0.7 * half.firm_pressed, 1e-9);
    CHECK_NEAR(half.firm + half.firm_pressed, 0.01, 1e-8);
    CHECK_NEAR(g.heap[5], 0.0, 1e-8);
    ground_free(&g);
}

TEST(the_spring_of_what_is_cut_goes_with_it)
{
    for (int cut = 0; cut < 2; ++cut) {
        Ground g = column(0.2f);
        float  spring[16] = {0};
        g.patch.spring = spring;
        dp_cut_cell(&g.patch, 5, 0.0, 0.01, cut);
        CHECK_NEAR(spring[5], cut ? 0.0 : -(double)g.compression[5], 1e-8);
        ground_free(&g);
    }
}

int main(void)
{
    RUN(what_is_cut_is_whole_and_what_is_pressed_displaces_its_share);
    RUN(the_spring_of_what_is_cut_goes_with_it);
    return check_done();
}
