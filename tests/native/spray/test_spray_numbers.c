// tests of spray_numbers.c: MODEL 6.15
#include "check.h"
#include "spray/usual.h"

TEST(the_usual_numbers_hold)
{
    const DpSprayNumbers numbers = usual();
    CHECK(dp_spray_check(&numbers, NULL) == DP_OK);
    CHECK_CLOSE(dp_spray_volume(&numbers), 4.0 / 3.0 * DP_PI * 0.002 * 0.002 * 0.002, 1e-12);
}

TEST(what_cannot_be_is_refused_by_name)
{
    DpReason       reason;
    DpSprayNumbers numbers = usual();
    numbers.particle_size = 0.0;
    CHECK(dp_spray_check(&numbers, &reason) == DP_BAD_ARGUMENT);
    CHECK(strstr(reason.text, "particle_size") != NULL);
    numbers = usual();
    numbers.hold_time = NAN;
    CHECK(dp_spray_check(&numbers, NULL) == DP_BAD_ARGUMENT);
    numbers = usual();
    numbers.slow_speed = numbers.fast_speed;
    CHECK(dp_spray_check(&numbers, &reason) == DP_BAD_ARGUMENT);
    CHECK(strstr(reason.text, "slow_speed") != NULL);
}

int main(void)
{
    RUN(the_usual_numbers_hold);
    RUN(what_cannot_be_is_refused_by_name);
    return check_done();
}
