// Kinds by their table of numbers: defaults, ranges, and what is said of those out of them.
#include "lawn.h"
#include "plants/plant_inside.h"

static const char* why(const DpPlantKind* kind)
{
    static DpReason reason;
    reason.text[0] = 0;
    CHECK(dp_plant_kind_check(kind, &reason) == (reason.text[0] ? DP_BAD_ARGUMENT : DP_OK));
    return reason.text;
}

TEST(numbers_are_the_members_in_order)
{
    int             count;
    DpPlantKind     kind = dp_plant_kind_default();
    const DpNumber* number = dp_plant_numbers(&count);
    CHECK(sizeof kind == 2 * sizeof(int) + (size_t)count * sizeof(float));
    CHECK(strcmp(number[0].name, "height") == 0 &&
          number[0].offset == offsetof(DpPlantKind, height));
    CHECK(strcmp(number[count - 1].name, "modulus") == 0);
    CHECK(number[count - 1].offset == offsetof(DpPlantKind, modulus));
    CHECK(kind.form == DP_PLANT_SURFACE && kind.height == 0.10f && kind.modulus == 10e6f);
    for (int k = 0; k < count; ++k) {
        CHECK(dp_number_get(&kind, &number[k]) == (double)(float)number[k].usual);
        CHECK(number[k].low < number[k].high && number[k].unit[0] && number[k].meaning[0]);
    }
}

// each number as low and as high as it may be, and beyond
TEST(ranges_hold_their_ends_and_no_more)
{
    int             count;
    const DpNumber* number = dp_plant_numbers(&count);
    for (int k = 0; k < count; ++k) {
        char words[64];
        snprintf(words, sizeof words, "%s of ", number[k].name);
        for (int end = 0; end < 3; ++end) {
            DpPlantKind kind = dp_plant_kind_default();
            const float at = (float)(end ? number[k].high : number[k].low);
            dp_number_set(&kind, &number[k], (double)at);
            CHECK(!strstr(why(&kind), words) || strstr(why(&kind), "lies below"));
            dp_number_set(&kind, &number[k],
                          end == 2 ? NAN : (double)nextafterf(at, end ? INFINITY : -INFINITY));
            CHECK(strstr(why(&kind), words) == why(&kind) &&
                  strstr(why(&kind), "out of its range"));
        }
    }
}

TEST(what_is_wrong_is_said)
{
    DpPlantKind kind = dp_plant_kind_default();
    CHECK(strcmp(why(&kind), "") == 0);
    kind.sway = 0.0f;
    CHECK(strcmp(why(&kind), "sway of 0 Hz is out of its range, 0.001 to 1000") == 0);
    kind = dp_plant_kind_default(), kind.break_angle = 0.1f;
    CHECK(strstr(why(&kind), "below degrade_angle"));
    kind = dp_plant_kind_default(), kind.height = 9.0f;
    CHECK(strstr(why(&kind), "raise the spacing"));
    kind = dp_plant_kind_default(), kind.form = DP_PLANT_TUFT, kind.sheets = 4;
    CHECK(strstr(why(&kind), "2 or 3 sheets"));
    CHECK(strstr(why(NULL), "2 or 3 sheets"));
}

TEST(roots_that_cannot_be_planted_are_named)
{
    const DpPlantKind kind = dp_plant_kind_default();
    float             root[6] = {0.0f, 0.0f, 0.0f, 0.0f, NAN, 0.0f}, heading[2] = {0.0f, 1e7f};
    DpReason          reason;
    CHECK(dp_plants_check(&kind, root, NULL, 2, &reason) == DP_BAD_ARGUMENT);
    CHECK(strncmp(reason.text, "y of root 1 is ", 15) == 0);
    root[4] = 0.0f;
    CHECK(dp_plants_check(&kind, root, NULL, 2, &reason) == DP_OK);
    CHECK(dp_plants_check(&kind, root, heading, 2, &reason) == DP_BAD_ARGUMENT);
    CHECK(strncmp(reason.text, "heading 1 is ", 13) == 0);
    CHECK(dp_plants_check(&kind, root, NULL, 0, &reason) == DP_BAD_ARGUMENT);
    CHECK(strncmp(reason.text, "there are 0 roots", 17) == 0);
    CHECK(dp_plants_check(&kind, NULL, NULL, 2, &reason) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_check(NULL, root, NULL, 2, &reason) == DP_BAD_ARGUMENT);
}

// x'' + damping x' + swing^2 x = 0: it swings, or creeps at swing^2 / damping where damping is large
TEST(stems_swing_or_creep_back)
{
    DpPlantKind  kind = dp_plant_kind_default();
    const double swing = 2.0 * DP_PI * 1.5;
    kind.sway = 1.5f, kind.damping = 4.0f;
    CHECK_CLOSE(dp_plant_return_rate(&kind), swing, 1e-6);
    CHECK_CLOSE(dp_plant_rise_rate(&kind), 2.0, 1e-6);  // swings die away as exp(-damping t / 2)
    kind.damping = 200.0f;
    CHECK_CLOSE(dp_plant_return_rate(&kind), swing * swing / 200.0, 1e-6);
    CHECK_CLOSE(dp_plant_rise_rate(&kind), swing * swing / 200.0, 1e-6);
    kind.damping = 0.0f;
    CHECK_CLOSE(dp_plant_rise_rate(&kind), 0.3, 1e-6);
}

int main(void)
{
    RUN(numbers_are_the_members_in_order);
    RUN(ranges_hold_their_ends_and_no_more);
    RUN(what_is_wrong_is_said);
    RUN(roots_that_cannot_be_planted_are_named);
    RUN(stems_swing_or_creep_back);
    return check_done();
}
