#include "refine/refine_inside.h"

#include "../check.h"

#define SQUARES 300
#define BLOCK 0.5

// numbers that look like chance, the same everywhere
static unsigned seed;
static double   next(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / 16777216.0;
}

// the least size of the squares that come within `around` of a box
static double min_near(const DpWishes* wishes, const double low[2], const double high[2],
                       double around)
{
    double least = INFINITY;
    for (int k = 0; k < wishes->count; ++k) {
        int near = 1;
        for (int axis = 0; axis < 2; ++axis) {
            const double at = wishes->corner[2 * k + axis];
            near &= at < high[axis] + around && at + wishes->block > low[axis] - around;
        }
        if (near) least = fmin(least, wishes->size[k]);
    }
    return least;
}

TEST(no_wish_is_missed_and_none_comes_from_afar)
{
    double corner[2 * SQUARES], size[SQUARES];
    seed = 7;
    for (int k = 0; k < SQUARES; ++k) {
        corner[2 * k] = BLOCK * floor(next(-40.0, 200.0));  // some lie in the same place
        corner[2 * k + 1] = BLOCK * floor(next(-9.0, 9.0));
        size[k] = next(0.01, 1.0);
    }
    const DpWishes wishes = {corner, size, SQUARES, BLOCK};
    DpWishTree*    tree;
    CHECK(dp_wish_create(&wishes, &tree) == DP_OK);
    for (int n = 0; n < 3000; ++n) {
        const double extent = pow(2.0, next(-6.0, 6.0));
        const double low[2] = {next(-60.0, 120.0), next(-20.0, 20.0)};
        const double high[2] = {low[0] + extent, low[1] + next(0.0, 1.0) * extent};
        const double found = dp_wish_within(tree, low, high);
        CHECK(found <= min_near(&wishes, low, high, 0.0));
        if (extent < 32.0)  // beyond, all wishes are one square's
            CHECK(found >= min_near(&wishes, low, high, 2.0 * fmax(extent, BLOCK) + 1e-9));
    }
    dp_wish_destroy(tree);
}

TEST(of_wishes_for_one_square_the_least_counts)
{
    const double   corner[] = {1.0, 2.0, 1.0, 2.0, 1.0, 2.0}, size[] = {0.3, 0.1, 0.2};
    const DpWishes wishes = {corner, size, 3, BLOCK};
    const double   low[2] = {1.1, 2.1}, high[2] = {1.2, 2.2}, far[2] = {9.0, 9.0};
    DpWishTree*    tree;
    CHECK(dp_wish_create(&wishes, &tree) == DP_OK);
    CHECK(dp_wish_within(tree, low, high) == 0.1);
    CHECK(dp_wish_within(tree, far, far) == INFINITY);
    dp_wish_destroy(tree);
}

int main(void)
{
    RUN(no_wish_is_missed_and_none_comes_from_afar);
    RUN(of_wishes_for_one_square_the_least_counts);
    return check_done();
}
