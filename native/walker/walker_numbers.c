// walker/walker_numbers.c - the numbers of placing, contacts and loads: their tables, defaults and checks.
#include <math.h>

#include "walker/walker.h"

#define PLACE(...) DP_NUMBER_ROW(DpPlaceOptions, __VA_ARGS__)
#define CONTACT(...) DP_NUMBER_ROW(DpContactLimits, __VA_ARGS__)
#define LOAD(...) DP_NUMBER_ROW(DpLoadOptions, __VA_ARGS__)
static const DpNumber places[] = {DP_PLACE_NUMBERS(PLACE)};
static const DpNumber contacts[] = {DP_CONTACT_NUMBERS(CONTACT)};
static const DpNumber loads[] = {DP_LOAD_NUMBERS(LOAD)};
#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

const DpNumber* dp_place_numbers(int* count)
{
    *count = COUNT(places);
    return places;
}

const DpNumber* dp_contact_numbers(int* count)
{
    *count = COUNT(contacts);
    return contacts;
}

const DpNumber* dp_load_numbers(int* count)
{
    *count = COUNT(loads);
    return loads;
}

DpPlaceOptions dp_place_options_default(void)
{
    DpPlaceOptions options = {.flat = false};
    dp_numbers_usual(&options, places, COUNT(places));
    return options;
}

DpContactLimits dp_contact_limits_default(void)
{
    DpContactLimits limits;
    dp_numbers_usual(&limits, contacts, COUNT(contacts));
    return limits;
}

DpLoadOptions dp_load_options_default(void)
{
    DpLoadOptions options = {.model = DP_LOAD_INERTIA, .settle_time = 0.2};
    dp_numbers_usual(&options, loads, COUNT(loads));
    return options;
}

DpStatus dp_place_options_check(const DpPlaceOptions* options, DpReason* reason)
{
    if (options) return dp_numbers_check(options, places, COUNT(places), reason);
    dp_reason(reason, "there are no options");
    return DP_BAD_ARGUMENT;
}

DpStatus dp_contact_limits_check(const DpContactLimits* limits, DpReason* reason)
{
    if (limits) return dp_numbers_check(limits, contacts, COUNT(contacts), reason);
    dp_reason(reason, "there are no limits");
    return DP_BAD_ARGUMENT;
}

DpStatus dp_load_options_check(const DpLoadOptions* options, DpReason* reason)
{
    if (!options) {
        dp_reason(reason, "there are no options");
    } else if (options->model != DP_LOAD_INERTIA && options->model != DP_LOAD_IMPULSE) {
        dp_reason(reason, "model of %d is neither inertia nor impulse", (int)options->model);
    } else if (!(options->settle_time > 0.0) || isinf(options->settle_time)) {
        dp_reason(reason, "settle_time of %g s is not above 0", options->settle_time);
    } else if (options->cutoff_high < options->cutoff_low) {
        dp_reason(reason, "cutoff_high of %g Hz lies below cutoff_low, %g", options->cutoff_high,
                  options->cutoff_low);
    } else {
        return dp_numbers_check(options, loads, COUNT(loads), reason);
    }
    return DP_BAD_ARGUMENT;
}
