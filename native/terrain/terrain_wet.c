// What water between its grains makes of a soil: damp it stands, soaked it flows. MODEL 6.13
#include <math.h>

#include "terrain/terrain_inside.h"

#define SUCTION 3000.0  // of sand, 1/alpha of van Genuchten                              [Pa]
#define SHAPE 4.0       // .. and its n
#define WALL 0.1        // walls of prints are so high                                     [m]
#define WEIGHT \
    (4.0 / 16e3)    // 4 over the unit weight of soil                                  [m^3/N]
#define SOAKED 0.8  // from here on pores are full and water bears load, Newitt and Conway-Jones
#define LIFTED 0.5  // share of the weight that water bears where all pores are full

// suction stress at a saturation, Lu, Godt and Wu 2010 [Pa]
static double suction(double wet)
{
    const double pull = pow(wet, SHAPE / (1.0 - SHAPE)) - 1.0;
    return SUCTION * wet * pow(fmax(pull, 0.0), 1.0 / SHAPE);  // MODEL 6.13
}

// steepest wall that stands as high as those of prints, Culmann 1866 [rad]
static double steepest(double cohesion, double friction)
{
    const double right = 0.5 * DP_PI;
    double       low = friction, high = right;
    for (int k = 0; k < 60; ++k) {
        const double at = 0.5 * (low + high);
        const double stands =
            WEIGHT * cohesion * sin(at) * cos(friction) / (1.0 - cos(at - friction));
        if (stands >= WALL)
            low = at;
        else
            high = at;
    }
    return high >= right ? right : low;
}

DpSoil dp_wet_soil(const DpSoil* soil)
{
    DpSoil       wet = *soil;
    const double share = (double)soil->wetness;
    if (!(share > 0.0)) return wet;
    const double repose = (double)soil->rest_angle, wall = (double)soil->wall_angle;
    const double lifted = LIFTED * fmax(share - SOAKED, 0.0) / (1.0 - SOAKED);
    const double slides = atan((1.0 - lifted) * tan(repose));
    const double stands =
        wall + fmax(steepest(suction(share) * tan(repose), repose) - fmax(wall, repose), 0.0);
    const double flows = lifted / LIFTED;
    wet.rest_angle = (float)slides;
    wet.wall_angle = (float)((1.0 - flows) * fmin(stands, 0.5 * DP_PI) + flows * slides);
    wet.young_modulus = (float)((double)soil->young_modulus * sqrt(1.0 - lifted));
    return wet;
}
