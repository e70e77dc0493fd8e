// terrain/terrain_facet.h - one triangle of the ground, seen from above.
//
// It reaches a hair beyond its edges: a point on an edge, or on a needle too thin to be kept, is never
// lost between two.
#pragma once
#include <math.h>

#include "base/vec.h"
#include "terrain/terrain_inside.h"

#define NEEDLE 1e-10          // twice the area seen from above, over the longest edge squared
#define SLACK (2.0 * NEEDLE)  // how far it reaches beyond its edges, over the longest edge

// a triangle seen from above
typedef struct Facet
{
    double x[3], y[3], z[3];
    double x_min, x_max, y_min, y_max;  // with slack
    double sign;                        // +1 counter-clockwise, -1 clockwise, 0 not ground
    double slack;                       // least value of a side [m^2] < 0
} Facet;

static inline double min3(const double* v)
{
    const double low = v[0] < v[1] ? v[0] : v[1];
    return low < v[2] ? low : v[2];
}

static inline double max3(const double* v)
{
    const double high = v[0] > v[1] ? v[0] : v[1];
    return high > v[2] ? high : v[2];
}

// its corners and its box
static inline Facet facet_box(const MeshGround* mesh, int32_t triangle)
{
    Facet          facet;
    const int32_t* of = mesh->triangle + 3 * (size_t)triangle;
    for (int k = 0; k < 3; ++k) {
        const double* at = mesh->vertex + 3 * (size_t)of[k];
        facet.x[k] = at[0], facet.y[k] = at[1], facet.z[k] = at[2];
    }
    const double x_min = min3(facet.x), x_max = max3(facet.x);
    const double y_min = min3(facet.y), y_max = max3(facet.y);
    const double spare = SLACK * ((x_max - x_min) + (y_max - y_min));
    facet.x_min = x_min - spare, facet.x_max = x_max + spare;
    facet.y_min = y_min - spare, facet.y_max = y_max + spare;
    facet.sign = facet.slack = 0.0;
    return facet;
}

// its orientation and how far it reaches beyond its edges
static inline void facet_finish(Facet* facet)
{
    double longest = 0.0;  // squared
    for (int k = 0; k < 3; ++k) {
        const int    n = (k + 1) % 3;
        const double dx = facet->x[n] - facet->x[k], dy = facet->y[n] - facet->y[k];
        const double squared = dx * dx + dy * dy;
        longest = squared > longest ? squared : longest;
    }
    const double twice = (facet->x[1] - facet->x[0]) * (facet->y[2] - facet->y[0]) -
                         (facet->x[2] - facet->x[0]) * (facet->y[1] - facet->y[0]);
    facet->sign = twice > NEEDLE * longest ? 1.0 : twice < -NEEDLE * longest ? -1.0 : 0.0;
    facet->slack = -SLACK * longest;
}

static inline Facet facet_of(const MeshGround* mesh, int32_t triangle)
{
    Facet facet = facet_box(mesh, triangle);
    facet_finish(&facet);
    return facet;
}

static inline bool in_box(const Facet* facet, double x, double y)
{
    return x >= facet->x_min && x <= facet->x_max && y >= facet->y_min && y <= facet->y_max;
}

// height of a triangle over (x, y) and the shares of its corners; false where it is not
static inline bool facet_at(const Facet* facet, double x, double y, double* z, double share[3])
{
    if (!in_box(facet, x, y)) return false;
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int    a = (k + 1) % 3, b = (k + 2) % 3;
        const double side = facet->sign * ((facet->x[b] - facet->x[a]) * (y - facet->y[a]) -
                                           (facet->y[b] - facet->y[a]) * (x - facet->x[a]));
        if (!(side >= facet->slack)) return false;
        share[k] = side > 0.0 ? side : 0.0;
        sum += share[k];
    }
    for (int k = 0; k < 3; ++k) share[k] /= sum;
    const double height = share[0] * facet->z[0] + share[1] * facet->z[1] + share[2] * facet->z[2];
    *z = dp_clamp(height, min3(facet->z), max3(facet->z));  // level ground stays level to the bit
    return true;
}
