// Records by their tables: members of both sizes are set, read, defaulted and held to their ranges.
#include "base/number.h"

#include "check.h"

#define NUMBERS(X)                                    \
    X(height, "m", 0.0, 0.1, 0.05, "over the ground") \
    X(speed, "m/s", -1.0, 1.0, 0.25, "of the swing")  \
    X(share, "-", 0.5, 0.5, 0.5, "of what there is")

typedef struct Record
{
    int    before;
    double height;
    float  speed;
    double share;
    int    behind;
} Record;

#define ROW(...) DP_NUMBER_ROW(Record, __VA_ARGS__)
static const DpNumber table[] = {NUMBERS(ROW)};

TEST(members_are_as_usual_and_the_rest_stays)
{
    Record record = {.before = 7, .behind = 9};
    dp_numbers_usual(&record, table, 3);
    CHECK(record.height == 0.05 && record.speed == 0.25f && record.share == 0.5);
    CHECK(record.before == 7 && record.behind == 9);
    dp_number_set(&record, &table[0], 0.1), dp_number_set(&record, &table[1], -0.1);
    CHECK(record.height == 0.1 && record.speed == -0.1f);
    CHECK(dp_number_get(&record, &table[0]) == 0.1);
    CHECK(dp_number_get(&record, &table[1]) == (double)-0.1f);
}

// a float may be what rounding makes of an end, a double may not
TEST(ranges_are_those_of_the_member)
{
    const DpNumber single = {"a", "-", 0.1, 0.3, 0.2, "", 0, sizeof(float)};
    const DpNumber twice = {"a", "-", 0.1, 0.3, 0.2, "", 0, sizeof(double)};
    CHECK((double)0.3f > 0.3 && dp_number_holds(&single, (double)0.3f));
    CHECK(!dp_number_holds(&twice, (double)0.3f) && dp_number_holds(&twice, 0.3));
    CHECK(dp_number_holds(&twice, 0.1) && !dp_number_holds(&twice, nextafter(0.1, 0.0)));
    CHECK(!dp_number_holds(&single, NAN) && !dp_number_holds(&twice, NAN));
    CHECK(!dp_number_holds(&single, 1e300) && !dp_number_holds(&single, -1e300));
}

TEST(the_first_that_does_not_hold_is_named)
{
    Record   record = {0};
    DpReason reason = {""};
    dp_numbers_usual(&record, table, 3);
    CHECK(dp_numbers_check(&record, table, 3, &reason) == DP_OK && reason.text[0] == 0);
    record.speed = 2.0f, record.share = NAN;
    CHECK(dp_numbers_check(&record, table, 3, &reason) == DP_BAD_ARGUMENT);
    CHECK(strcmp(reason.text, "speed of 2 m/s is out of its range, -1 to 1") == 0);
    record.speed = 0.0f;
    CHECK(dp_numbers_check(&record, table, 3, &reason) == DP_BAD_ARGUMENT);
    CHECK(strncmp(reason.text, "share of ", 9) == 0);
    CHECK(dp_numbers_check(&record, table, 3, NULL) == DP_BAD_ARGUMENT);
    dp_reason(&reason, "%0200d", 1);  // what is too long is cut
    CHECK(strlen(reason.text) == sizeof reason.text - 1);
}

int main(void)
{
    RUN(members_are_as_usual_and_the_rest_stays);
    RUN(ranges_are_those_of_the_member);
    RUN(the_first_that_does_not_hold_is_named);
    return check_done();
}
