// refine/refine.h - faces cut along a trail until they are fine enough to show it. PEYRAT11 3.2, MODEL 8.2
//
//   triangles ---wishes: how long edges may be where---> triangles without gaps, coarse elsewhere
//
// Longest edges are halved, and with them whoever shares them, so that no point ever lies within an
// edge. Whatever no wish reaches stays as it is. Only midpoints are made: every new point is a known
// share of the three points of the triangle it lies in, and so is all that is interpolated.
#pragma once
#include <stdbool.h>
#include <stdint.h>

#include "base/number.h"
#include "base/status.h"

// Squares of one size, parallel to x and y, and how long edges that reach into them may be.
typedef struct DpWishes
{
    const double* corner;  // least x and y of each square                       [m]  (count, 2)
    const double* size;    // how long the legs of a triangle may be there      [m]  > 0 (count)
    int           count;
    double        block;  // edge of the squares                                 [m]  > 0
} DpWishes;

// What became of the triangles. Zero it before; dp_refined_free gives it back.
typedef struct DpRefined
{
    double*        point;         // the given points, then new ones            [m]  (points, 3)
    int            points;        //
    int            given;         // how many of them were given
    int*           point_source;  // a given triangle each new point lies in     (points - given)
    float*         point_weight;  // shares of that triangle's three points      (points - given, 3)
    int*           triangle;      // points of the triangles                     (triangles, 3)
    int*           source;        // the given triangle each one lies in         (triangles)
    float*         weight;  // for each of its points, shares of that triangle's (triangles, 3, 3)
    int            triangles;  //
    unsigned char* cut;        // 1 where a given triangle was cut            (given triangles)
    bool           valid;      // every wish was met; false: max_triangles came first
} DpRefined;

// Cut triangles until no edge within a square is, seen from above, longer than sqrt(2) times its size, or
// hardly longer.
// @param point          (points, 3) [m], finite
// @param triangle       (triangles, 3) indices into them; more than two may share an edge
// @param max_triangles  stop before more than about these; what is there by then has no gaps
// DP_BAD_ARGUMENT: an index out of range, a size or block that is not above zero or finite, or so
// many squares side by side that they cannot be counted. On failure `out` stays empty.
DpStatus dp_refine(const double* point, int points, const int* triangle, int triangles,
                   const DpWishes* wishes, int max_triangles, DpRefined* out);
void     dp_refined_free(DpRefined* refined);

// ---- what is finer than a cell. MODEL 8.3 -----------------------------------------------------------

// What ground is like where it was disturbed, at a size that cells do not hold. Only shown: nothing is fed back.
// X(name, unit, low, high, usual, meaning), as base/number.h has them
// clang-format off
#define DP_DETAIL_NUMBERS(X) \
    X(grit_height, "m", 0.0, 1.0, 0.0, "deviation of grains that are seen") \
    X(grit_size, "m", 1e-4, 1.0, 0.005, "how long they are") \
    X(crumb_share, "-", 0.0, 0.5, 0.0, "share of a heap that lies under crumbs") \
    X(min_crumb, "m", 1e-4, 1.0, 0.002, "radius of the smallest, at most max_crumb") \
    X(max_crumb, "m", 1e-4, 1.0, 0.004, "and of the largest") \
    X(vein_height, "m", 0.0, 1.0, 0.0, "of what a sole sucks up when it is lifted") \
    X(vein_size, "m", 1e-4, 1.0, 0.02, "how far veins lie apart") \
    X(fray, "m", 0.0, 1.0, 0.0, "deviation by which edges of prints stray, each way") \
    X(fray_size, "m", 1e-4, 1.0, 0.02, "over which length")
// clang-format on

typedef struct DpDetail
{
    DP_DETAIL_NUMBERS(DP_DOUBLE_MEMBER)
} DpDetail;

// Their table, from which panels, files and bindings read them.
const DpNumber* dp_detail_numbers(int* count);
DpDetail        dp_detail_default(void);

// What points are like by where they are, whatever was pressed, the cells, the order, or the threads.
// @param point  (points, 3) [m], finite; height does not count
// @param shown  (points, 6): heights [m] of veins, crumbs and grit, each of mean 0; how far prints are seen aside,
//               x and y [m], of mean 0; how high a heap has to be for the crumb there to show [m]
// DP_BAD_ARGUMENT: a number out of range, a point farther out than 1e9 m; nothing is written.
DpStatus dp_refine_detail(const double* point, int points, const DpDetail* detail, uint32_t seed,
                          float* shown);
