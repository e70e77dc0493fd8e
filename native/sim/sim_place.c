// sim/sim_place.c - introduces a walker's feet to the ground they are placed on. TRAIL (1) (2)
#include "sim/sim.h"

static double height(const void* ground, double x, double y)
{
    const double xy[2] = {x, y};
    double       z;
    dp_terrain_base_height((const DpTerrain*)ground, 1, xy, &z);
    return z;
}

static DpVec3 normal(const void* ground, double x, double y, double radius)
{
    return dp_terrain_normal((const DpTerrain*)ground, x, y, radius);
}

DpStatus dp_sim_place(const DpTerrain* terrain, const DpGait* gait, int walker,
                      const DpPlaceOptions* options, const double* clearance, double* pose,
                      double* com)
{
    if (!terrain || !gait) return DP_BAD_ARGUMENT;
    const DpGroundBelow below = {terrain, height, normal};
    return dp_foot_place(gait, walker, &below, options, clearance, pose, com);
}
