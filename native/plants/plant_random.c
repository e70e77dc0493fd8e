// plants/plant_random.c - what differs from plant to plant: chances that hang on names alone.
#include <string.h>

#include "plants/plant_inside.h"

// splitmix64 over the three names
double dp_plant_hash(uint64_t seed, uint64_t a, uint64_t b)
{
    uint64_t z = seed ^ (a + 1) * 0x9E3779B97F4A7C15u ^ (b + 1) * 0xC2B2AE3D27D4EB4Fu;
    for (int k = 0; k < 2; ++k) {
        z += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        z ^= z >> 31;
    }
    return (double)(z >> 11) / 9007199254740992.0;
}

double dp_plant_vigour(uint64_t seed, uint64_t a, uint64_t b)
{
    const double max = 8.0, min = 1e-12;
    const double t =
        -log((dp_plant_hash(seed, a, 3 * b) + min) *
             (dp_plant_hash(seed, a, 3 * b + 1) + min));  // sum of two exponential ones
    const double z = fmin(fmax(t, 0.0) * t / sqrt(120.0), max);
    return dp_plant_hash(seed, a, 3 * b + 2) < 0.5 ? -z : z;
}

uint64_t dp_plant_name(float x, float y)
{
    uint32_t    bits[2];
    const float at[2] = {x + 0.0f, y + 0.0f};  // -0 is 0
    memcpy(bits, at, sizeof bits);
    return (uint64_t)bits[0] << 32 | bits[1];
}
