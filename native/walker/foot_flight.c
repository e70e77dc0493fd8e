// walker/foot_flight.c - smoothing a body that flies: between two contacts it falls freely.
//
//   min  sum (x - recorded)^2 + a sum (x''')^2 + b sum over flights (x'' - fall)^2
//
// A low-pass knows nothing of the ground: it smears a stance of a tenth of a second into the
// flights around it and gives half of what it carried away. But who touches nothing is carried by
// nothing, which is known without any recording. The first weight gives stances the bandwidth of
// the low-pass, the second holds flights to the parabola; force comes and goes from nothing.
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define FREE 0.3  // slower than this a flight may stray from the parabola [Hz]
#define BAND 4    // the matrix's diagonal and the three beside it

// add weight * row^T row of a difference that begins at sample k
static void add_row(double* band, int k, const double* row, int size, double weight)
{
    for (int i = 0; i < size; ++i)
        for (int j = 0; j <= i; ++j) band[BAND * (k + i) + i - j] += weight * row[i] * row[j];
}

// band (count, 4) holds A(k, k - j); value becomes A^-1 value. Cholesky without roots.
static void solve(double* band, double* value, int count)
{
    for (int k = 0; k < count; ++k) {
        double* row = band + BAND * k;
        for (int j = k < 3 ? k : 3; j > 0; --j) {
            const double* other = band + BAND * (k - j);
            for (int m = j + 1; m <= 3 && m <= k; ++m)
                row[j] -= row[m] * other[m - j] * band[BAND * (k - m)];
            row[j] /= other[0];
        }
        for (int j = 1; j <= 3 && j <= k; ++j) row[0] -= row[j] * row[j] * band[BAND * (k - j)];
        for (int j = 1; j <= 3 && j <= k; ++j) value[k] -= row[j] * value[k - j];
    }
    for (int k = 0; k < count; ++k) value[k] /= band[BAND * k];
    for (int k = count - 1; k >= 0; --k)
        for (int j = 1; j <= 3 && j <= k; ++j) value[k - j] -= band[BAND * k + j] * value[k];
}

size_t dp_walker_fly_scratch(int count)
{
    return BAND * (size_t)count;
}

void dp_walker_fly(double* value, const uint8_t* air, int count, double rate, double cutoff,
                   double fall, double* scratch)
{
    static const double third[4] = {-1.0, 3.0, -3.0, 1.0}, second[3] = {1.0, -2.0, 1.0};
    if (count < 4 || !(cutoff < 0.45 * rate)) return;
    const double carried = pow(rate / (2.0 * DP_PI * cutoff), 6.0);
    const double free = pow(rate / (2.0 * DP_PI * FREE), 4.0);
    const double start = value[0], slope = (value[count - 1] - start) / (double)(count - 1);
    // about the line between the ends, so that nothing is lost to rounding far from the origin
    for (int k = 0; k < count; ++k) value[k] -= start + slope * (double)k;
    memset(scratch, 0, dp_walker_fly_scratch(count) * sizeof *scratch);
    for (int k = 0; k < count; ++k) scratch[BAND * k] = 1.0;
    for (int k = 0; k + 3 < count; ++k) add_row(scratch, k, third, 4, carried);
    for (int k = 0; k + 2 < count; ++k) {
        if (!air[k + 1]) continue;
        add_row(scratch, k, second, 3, free);
        for (int i = 0; i < 3; ++i) value[k + i] += free * second[i] * fall / rate / rate;
    }
    solve(scratch, value, count);
    for (int k = 0; k < count; ++k) value[k] += start + slope * (double)k;
}
