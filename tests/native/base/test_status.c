// tests of status.c: each outcome has a clause of its own, as people write them within a sentence
#include "base/status.h"

#include <ctype.h>

#include "check.h"

TEST(each_outcome_has_a_clause_of_its_own)
{
    for (int k = DP_OK; k <= DP_BAD_PACKING; ++k) {
        const char*  text = dp_status_text((DpStatus)k);
        const size_t length = strlen(text);
        CHECK(length > 8 && islower((unsigned char)text[0]) && text[length - 1] != '.');
        CHECK(strcmp(text, "unknown status") != 0);
        for (int n = DP_OK; n < k; ++n) CHECK(strcmp(text, dp_status_text((DpStatus)n)) != 0);
    }
    CHECK(strstr(dp_status_text(DP_DISK_FULL), "full") != NULL);
    CHECK(strstr(dp_status_text(DP_NO_GROUND), "ground") != NULL);
    CHECK(strcmp(dp_status_text((DpStatus)(DP_BAD_PACKING + 1)), "unknown status") == 0);
}

int main(void)
{
    RUN(each_outcome_has_a_clause_of_its_own);
    return check_done();
}
