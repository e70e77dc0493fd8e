// tests of walker_numbers.c: what is out of its range is named
#include "check.h"
#include "walker/walker.h"

// every number of a record, a little beyond each of its ends
#define BEYOND_EACH_END(record, table, count, check)                                  \
    for (int k = 0; k < (count); ++k)                                                 \
        for (int end = 0; end < 2; ++end) {                                           \
            const double was = dp_number_get(&(record), &(table)[k]);                 \
            const double limit = end ? (table)[k].high : (table)[k].low;              \
            const double step = fabs(limit) > 0.0 ? 1e-6 * fabs(limit) : 1e-6;        \
            DpReason     reason = {""};                                               \
            dp_number_set(&(record), &(table)[k], end ? limit + step : limit - step); \
            CHECK(check(&(record), &reason) == DP_BAD_ARGUMENT);                      \
            CHECK(strstr(reason.text, (table)[k].name) != NULL);                      \
            dp_number_set(&(record), &(table)[k], NAN);                               \
            CHECK(check(&(record), NULL) == DP_BAD_ARGUMENT);                         \
            dp_number_set(&(record), &(table)[k], was);                               \
            CHECK(check(&(record), NULL) == DP_OK);                                   \
        }

TEST(defaults_can_be_worked_with_and_nothing_beyond_its_range)
{
    int             places, contacts, loads;
    const DpNumber* place = dp_place_numbers(&places);
    const DpNumber* contact = dp_contact_numbers(&contacts);
    const DpNumber* load = dp_load_numbers(&loads);
    DpPlaceOptions  placing = dp_place_options_default();
    DpContactLimits limits = dp_contact_limits_default();
    DpLoadOptions   options = dp_load_options_default();
    CHECK(places > 0 && contacts == 12 && loads == 13);
    BEYOND_EACH_END(placing, place, places, dp_place_options_check)
    BEYOND_EACH_END(limits, contact, contacts, dp_contact_limits_check)
    BEYOND_EACH_END(options, load, loads, dp_load_options_check)
    CHECK_NEAR(limits.touch_height, 0.03, 0.0);  // MODEL 4.2
    CHECK_NEAR(options.cutoff_level, 2.0 / 3.0, 1e-15);
}

TEST(what_does_not_go_together_is_told)
{
    DpReason      reason;
    DpLoadOptions options = dp_load_options_default();
    options.cutoff_low = 12.0;  // over cutoff_high
    CHECK(dp_load_options_check(&options, &reason) == DP_BAD_ARGUMENT);
    CHECK(strstr(reason.text, "cutoff_high of 11 Hz") != NULL);
    options = dp_load_options_default();
    options.model = (DpLoadModel)7;
    CHECK(dp_load_options_check(&options, &reason) == DP_BAD_ARGUMENT);
    CHECK(strstr(reason.text, "model of 7") != NULL);
    const double times[3] = {0.0, NAN, INFINITY};
    for (int k = 0; k < 3; ++k) {
        options = dp_load_options_default();
        options.settle_time = times[k];
        CHECK(dp_load_options_check(&options, &reason) == DP_BAD_ARGUMENT);
        CHECK(strstr(reason.text, "settle_time") != NULL);
    }
    CHECK(dp_place_options_check(NULL, &reason) == DP_BAD_ARGUMENT);
    CHECK(dp_contact_limits_check(NULL, &reason) == DP_BAD_ARGUMENT);
    CHECK(dp_load_options_check(NULL, &reason) == DP_BAD_ARGUMENT);
}

int main(void)
{
    RUN(defaults_can_be_worked_with_and_nothing_beyond_its_range);
    RUN(what_does_not_go_together_is_told);
    return check_done();
}
