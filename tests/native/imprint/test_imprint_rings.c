#include "check.h"
#include "imprint/imprint.h"

#define MAX_CELLS 4096

static int32_t ring[MAX_CELLS], want[MAX_CELLS];

// ring numbers by looking at every pair of cells
static void slow_rings(const DpSoilPatch* patch, int rings)
{
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            int best = DP_RING_FAR;
            for (int b = 0; b < patch->ny; ++b)
                for (int a = 0; a < patch->nx; ++a) {
                    if (ring[b * patch->row + a] != 0) continue;
                    const int dx = abs(a - i), dy = abs(b - j), steps = dx > dy ? dx : dy;
                    if (steps < best) best = steps;
                }
            want[j * patch->row + i] = best <= rings ? best : DP_RING_FAR;
        }
}

static void compare(int nx, int ny, int rings, double density, unsigned* seed)
{
    DpSoilPatch patch = {0};
    patch.nx = nx, patch.ny = ny, patch.row = nx + 2;
    DpImprint imprint = {0};
    imprint.ring = ring;
    for (int n = 0; n < MAX_CELLS; ++n)
        ring[n] = check_random(seed) < density ? 0 : n % 3 ? -5 : 12345;
    for (int j = 0; j < ny; ++j) ring[j * patch.row + nx] = -99;
    slow_rings(&patch, rings);
    dp_imprint_rings(&imprint, &patch, rings);
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) CHECK(ring[j * patch.row + i] == want[j * patch.row + i]);
        CHECK(ring[j * patch.row + nx] == -99);
    }
}

TEST(count_steps_of_8_neighbours)
{
    unsigned seed = 17;
    for (int round = 0; round < 30; ++round)
        compare(1 + (int)(28.0 * check_random(&seed)), 1 + (int)(30.0 * check_random(&seed)),
                round % 9, round % 3 ? 0.01 : 0.1, &seed);
    compare(30, 1, 40, 0.1, &seed);
    compare(1, 30, 40, 0.1, &seed);
}

TEST(untouched_patch_is_far)
{
    unsigned seed = 1;
    compare(9, 7, 3, -1.0, &seed);
    CHECK(ring[0] == DP_RING_FAR);
}

int main(void)
{
    RUN(count_steps_of_8_neighbours);
    RUN(untouched_patch_is_far);
    return check_done();
}
