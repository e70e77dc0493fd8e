// soil/soil_heap_share.c - how much of what is pushed aside each border cell asks for. TRAIL (11), (12).
//
// Departures
//   TRAIL (11)(12): where the push leaves no border cell ahead (a sole at the edge of the ground), all
//     border cells share alike; as printed the sum would be zero. test_soil_accumulate.c, nobody_ahead.
//   Shares are rounded to 2^-30, so that a mirrored foot gets mirrored shares even where its mirrored
//     coordinates differ in their last bits.
#include "base/noise.h"
#include "soil/soil_heaps.h"

#define RIM_SHARE 1.6  // how much rims differ from place to place, by the soil's roughness

// max(F_par . u, 0)/|F_par|, u the unit vector from the point of force to the cell
static double ahead_of(const HeapShares* shares, int i, int j)
{
    const double x = (double)i - shares->from_x, y = (double)j - shares->from_y;
    const double far = sqrt(x * x + y * y);
    if (!(far > 0.0)) return 0.0;
    return fmax((shares->dir_x * x + shares->dir_y * y) / far, 0.0);  // TRAIL (11)
}

// the same for what was cut, with u away from the touched cells around a border cell
static double outward_of(const HeapShares* shares, const DpSoilPatch* patch, int i, int j)
{
    int x = 0, y = 0;
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const bool inside =
                i + di >= 0 && i + di < patch->nx && j + dj >= 0 && j + dj < patch->ny;
            if (!inside || shares->imprint->ring[soil_at(patch, i + di, j + dj)] != 0) continue;
            x -= di, y -= dj;
        }
    if (x == 0 && y == 0) return 0.0;
    const double far = sqrt((double)(x * x + y * y));
    return fmax((shares->cut_x * x + shares->cut_y * y) / far, 0.0);  // TRAIL (11)
}

double dp_soil_heap_within(const HeapShares* shares, int i, int j)
{
    const double across = shares->cut_x * j - shares->cut_y * i;
    const double within = soil_min(across - shares->left, shares->right - across);
    return soil_on_grid(soil_max(within, 0.0), ldexp(1.5, 52 - 20));
}

double dp_soil_heap_share(const HeapShares* shares, const DpSoilPatch* patch, int i, int j)
{
    if (shares->even && !patch->uneven) return 1.0;
    const double coarse = ldexp(1.5, 52 - 30);
    double       share = 1.0;
    if (!shares->even) {
        share = shares->beta * ahead_of(shares, i, j) + (1.0 - shares->beta);  // TRAIL (12)
        if (shares->cut > 0.0)
            share = shares->cut * outward_of(shares, patch, i, j) + (1.0 - shares->cut) * share;
    }
    if (patch->uneven)
        share *= dp_noise_growth(RIM_SHARE * (double)patch->uneven[soil_at(patch, i, j)]);
    return soil_on_grid(share, coarse);
}
