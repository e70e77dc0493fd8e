// bench_paths.c - arrival times over 2,000 x 2,000 cells: even ground, ground of worn lines, ground with obstacles.
//
//   scripts/bench paths
#include <math.h>

#include "base/alloc.h"
#include "paths/paths.h"
#include "timing.h"

#define N 2000

int main(void)
{
    static const char* const what[] = {"even ground", "worn lines", "worn lines and obstacles"};
    float*                   cost = dp_alloc((size_t)N * N, sizeof *cost);
    float*                   time = dp_alloc((size_t)N * N, sizeof *time);
    const DpPathField        field = {N, N, 0.25, cost};
    const int32_t            goal = (N / 3) * N + 250;
    for (int kind = 0; cost && time && kind < 3; ++kind) {
        for (int j = 0; j < N; ++j)
            for (int i = 0; i < N; ++i) {
                const double line =
                    fmin(fabs(sin(0.01 * i + 0.004 * j)), fabs(cos(0.006 * i - 0.013 * j)));
                float* const c = &cost[(size_t)j * N + (size_t)i];
                *c = kind ? (float)(1.3 - 0.3 * exp(-20.0 * line)) : 1.0f;
                if (kind == 2 && hypot(i % 250 - 125, j % 250 - 125) < 50.0) *c = INFINITY;
            }
        double best = INFINITY;
        for (int n = 0; n < 3; ++n) {
            const double begun = bench_now();
            if (dp_paths_arrival(time, &field, &(DpGoals){1, &goal, NULL}) != DP_OK) return 1;
            best = fmin(best, bench_now() - begun);
        }
        printf("%-26s %.3f s\n", what[kind], best);
        bench_keep("paths", what[kind], best);
    }
    dp_free(cost), dp_free(time);
    return 0;
}
