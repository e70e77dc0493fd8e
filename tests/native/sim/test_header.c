// tests of desire_path.h: a C program has all rooms by one header, and no two of them claim a name
#include "desire_path.h"

#include "check.h"

TEST(all_rooms_come_by_one_header)
{
    const DpPathField cost = {.nx = 1, .ny = 1, .cell = 1.0};
    const DpField     height = DP_FIELD_BASE_HEIGHT;
    CHECK(cost.nx == 1 && (int)height >= 0);
    CHECK(dp_soil_default().grain_size >= 0.0f);
}

int main(void)
{
    RUN(all_rooms_come_by_one_header);
    return check_done();
}
