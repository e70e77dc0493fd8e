// soil/soil_slide.h - the two stencils of soil that slides, and how a row of cells is read for them.
#pragma once
#include "soil/soil_inside.h"

#define BARRIER 1e30f  // height of what soil cannot go to
#define ROOT2 1.41421356f
#define HOLD \
    0.25f  // share of the tolerance below which a cell, or a wall, gives nothing; twice that: all

// What one row wants, as bits.
#define ROW_MOVES 1     // a cell gives something
#define ROW_RESTLESS 2  // .. and one must: it stands steeper than gamma_r + tolerance

// A row of a window as it is read; what no soil can go to stays a barrier without any.
typedef struct Row
{
    float * firm, *height, *heap, *fall, *slack;
    double* sum;
} Row;

static inline float above_zero(float x)
{
    return x > 0.0f ? x : 0.0f;
}

static inline float at_most_one(float x)
{
    return x < 1.0f ? x : 1.0f;
}

// First stencil: what each cell of a row gives away, TRAIL (14) (15); returns ROW_ bits.
// @param film  an excess as large counts as one neighbour [m]
// @param most  a cell gives at most so much [m]
int dp_slide_decide(float* restrict share, float* restrict give, const float* restrict h,
                    const float* restrict heap, const float* restrict fall,
                    const float* restrict slack, ptrdiff_t row, int count, float film, float most);

// Second stencil: each cell of a row takes what its neighbours give, TRAIL (16).
void dp_slide_take(double* restrict sum, const float* restrict give, const float* restrict h,
                   const float* restrict share, const float* restrict fall, ptrdiff_t row,
                   int count);

// Heaps and heights of a row as their sums say.
void dp_slide_raise(float* restrict height, float* restrict heap, const float* restrict firm,
                    const double* restrict sum, int count);

// Firm walls of a row, or of a window: soil_slide_walls.c.
typedef struct Walls
{
    float* base;   // ground before any walker; 0 where a sole stands or none is        [m]
    float* steep;  // tan(gamma_w) cell >= 0: by how much a wall may be higher; BARRIER: any [m]
    float* slack;  // what may stand above that                                         [m]
} Walls;

// Does any firm cell of a row let something fall? Of most rows none does, and this is half the work.
int dp_walls_fall(const Walls* walls, const float* restrict firm, const float* restrict height,
                  ptrdiff_t row, int count);

// First stencil: what each firm cell of a row lets fall, MODEL 6.8; returns ROW_ bits.
// @param most  a cell lets fall at most so much [m]
int dp_walls_decide(const Walls* walls, float* restrict share, float* restrict give,
                    const float* restrict firm, const float* restrict height, ptrdiff_t row,
                    int count, float film, float most);

// Second stencil: it falls from the firm ground, `floor`, on the heaps of the neighbours, `sum`.
void dp_walls_take(const Walls* walls, double* restrict sum, double* restrict floor,
                   const float* restrict share, const float* restrict give,
                   const float* restrict firm, const float* restrict height, ptrdiff_t row,
                   int count);

// Firm ground of a row as its floors say.
void dp_walls_lower(float* restrict firm, const double* restrict floor, int count);

// ---- soil_slide_read.c --------------------------------------------------------------------------

// A height near the ground of a box, so that floats are small; the same for mirrored ground [m].
double dp_slide_level(const DpSoilPatch* patch, DpCellRect box);

// The cells of a box that can move: loose soil, and firm ground beside what was pressed; empty without any.
DpCellRect dp_slide_movable(const DpSoilPatch* patch, DpCellRect box);

// Read the walls of a row of a patch.
void dp_walls_fill(const Walls* to, const float* restrict base_height,
                   const float* restrict wall_slope, const int32_t* restrict ring, int count,
                   double cell, double level, double tan_slack);

// Read a row of a patch; `ring` tells where a sole stands (0, or DP_RING_HELD).
void dp_slide_fill(const Row* to, const float* restrict base_height,
                   const float* restrict compression, const float* restrict loose,
                   const float* restrict rest_slope, const int32_t* restrict ring, int count,
                   double cell, double level, double tan_slack);
