// tests of soil_defaults.c: the numbers of a soil, their ranges, and memory to work in
#include <stdint.h>

#include "check.h"
#include "soil/soil_inside.h"

TEST(a_soil_is_made_of_its_numbers)
{
    int             count = 0;
    const DpNumber* number = dp_soil_numbers(&count);
    const DpSoil    usual = dp_soil_default();
    DpReason        reason;
    CHECK(sizeof usual == (size_t)count * sizeof(float));
    CHECK(dp_soil_check(&usual, &reason) == DP_OK);
    for (int n = 0; n < count; ++n) {
        CHECK(number[n].offset == (size_t)n * sizeof(float));
        CHECK(dp_number_get(&usual, &number[n]) == (double)(float)number[n].usual);
        for (int end = 0; end < 2; ++end) {
            const double edge = end ? number[n].high : number[n].low;
            DpSoil       soil = usual;
            dp_number_set(&soil, &number[n], edge);
            CHECK(dp_soil_check(&soil, &reason) == DP_OK);
            dp_number_set(&soil, &number[n], end ? edge + 1e-3 * (1.0 + fabs(edge)) : edge - 1e-3);
            CHECK(dp_soil_check(&soil, &reason) == DP_BAD_ARGUMENT);
            CHECK(strncmp(reason.text, number[n].name, strlen(number[n].name)) == 0);
            dp_number_set(&soil, &number[n], (double)NAN);
            CHECK(dp_soil_check(&soil, NULL) == DP_BAD_ARGUMENT);
        }
    }
    CHECK(dp_soil_check(NULL, &reason) == DP_BAD_ARGUMENT);
    CHECK(strcmp(reason.text, "there is no soil") == 0);
}

TEST(memory_to_work_in_grows_and_is_given_back)
{
    DpSoilScratch* scratch = dp_soil_scratch_create();
    for (size_t bytes = 1; bytes < 100000; bytes *= 7) {
        unsigned char* block = dp_soil_scratch_block(scratch, bytes);
        CHECK(block && (uintptr_t)block % 64 == 0);
        if (block) memset(block, 0x5a, bytes);
    }
    const size_t before = dp_bytes_live();
    CHECK(dp_soil_scratch_block(scratch, 100) != NULL);  // there is more than that
    CHECK(dp_bytes_live() == before);
    dp_alloc_fail_after(0);
    CHECK(dp_soil_scratch_block(scratch, 10000000) == NULL);
    CHECK(dp_soil_scratch_create() == NULL);
    dp_alloc_fail_after(-1);
    dp_soil_scratch_destroy(scratch);
    dp_soil_scratch_destroy(NULL);
}

int main(void)
{
    RUN(a_soil_is_made_of_its_numbers);
    RUN(memory_to_work_in_grows_and_is_given_back);
    return check_done();
}
