// how far a sole slips before the soil carries it sideways
#include <math.h>

#include "base/vec.h"
#include "check.h"
#include "soil/soil.h"

static DpSoil sand(float shear_modulus)
{
    DpSoil soil = dp_soil_default();
    soil.rest_angle = (float)(32.0 * DP_PI / 180.0);
    soil.shear_modulus = shear_modulus;
    return soil;
}

TEST(a_push_of_a_quarter_of_the_weight_slips_a_centimetre)
{
    const DpSoil soil = sand(0.02f);
    CHECK_NEAR(dp_soil_slip(&soil, 150.0, 600.0), 0.0102, 0.0001);
    CHECK_NEAR(dp_soil_slip(&soil, 300.0, 1200.0), dp_soil_slip(&soil, 150.0, 600.0), 1e-12);
}

TEST(no_push_no_slip)
{
    const DpSoil soil = sand(0.02f), hard = sand(0.0f);
    CHECK(dp_soil_slip(&soil, 0.0, 600.0) <= 0.0);
    CHECK(dp_soil_slip(&soil, 150.0, 0.0) <= 0.0);
    CHECK(dp_soil_slip(&hard, 150.0, 600.0) <= 0.0);
}

TEST(it_carries_what_it_can_once_it_has_slipped_so_far)
{
    const DpSoil soil = sand(0.02f);
    for (double push = 20.0; push < 340.0; push += 20.0) {
        const double j = dp_soil_slip(&soil, push, 600.0);
        const double carried = 600.0 * tan(32.0 * DP_PI / 180.0) * (1.0 - exp(-j / 0.02));
        CHECK_NEAR(carried, push, 0.01);
    }
    CHECK_NEAR(dp_soil_slip(&soil, 1e6, 600.0), DP_MAX_SLIP, 1e-9);  // beyond: no farther
    // and on soil that gives way sooner no farther than where it carries 0.95 of what it can
    const DpSoil soon = sand(0.01f);
    CHECK_CLOSE(dp_soil_slip(&soon, 1e6, 600.0), -0.01 * log(0.05), 1e-6);
}

int main(void)
{
    RUN(a_push_of_a_quarter_of_the_weight_slips_a_centimetre);
    RUN(no_push_no_slip);
    RUN(it_carries_what_it_can_once_it_has_slipped_so_far);
    return check_done();
}
