// soil/soil_slip.c - a sole gives way along the ground before it is carried. MODEL 6.5
//
// Departures
//   The papers' feet stay where they land. TRAIL Fig. 12 has longer prints downhill: there the soles
//   slide. A recording knows nothing of it, since its floor was hard. test_soil_slip.c
#include <math.h>

#include "base/vec.h"
#include "soil/soil.h"

#define MAX_SHARE 0.95  // of what the soil can carry: beyond it would slide without end

double dp_soil_slip(const DpSoil* soil, double along, double weight)
{
    if (!(soil->shear_modulus > 0.0f) || !(weight > 0.0) || !(along > 0.0)) return 0.0;
    const double share = fmin(along / (weight * tan((double)soil->rest_angle)), MAX_SHARE);
    return fmin(-(double)soil->shear_modulus * log(1.0 - share), DP_MAX_SLIP);  // MODEL 6.5
}
