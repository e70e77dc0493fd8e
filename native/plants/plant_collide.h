// plants/plant_collide.h - what a particle meets in a sub-step, and how it comes out.
#pragma once
#include "plants/plant_inside.h"

// What surrounds the plants of one lane of a block, `left` seconds before the end of a step.
typedef struct PlantProbe
{
    const PlantPush*     push;
    int                  count;
    const DpPlantGround* ground;
    const PlantBlock*    block;
    int                  lane;
    double               radius, left;
    bool                 only_down;  // no leaving by the side
} PlantProbe;

// the ground below a point [m]
double dp_plant_ground_below(const PlantProbe* probe, double x, double y);
// underside of the lowest sole whose column holds (x, y, z): +inf if none [m]
double dp_plant_sole_over(const PlantProbe* probe, const DpVec3* p, const PlantPush** which);
// bring a particle out of everything; returns how far it was pushed [m], and by what if by anything
double dp_plant_clear(const PlantProbe* probe, DpVec3* p, const DpPlantCollider** by);
