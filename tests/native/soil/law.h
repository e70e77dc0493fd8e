// tests/native/soil/law.h - soils that are no springs: snow that packs, and ground that was measured
#pragma once
#include "soil/soil.h"

// density [kg/m^3]
static inline DpSoil snow(float density)
{
    DpSoil soil = dp_soil_default();
    soil.snow_density = density;
    return soil;
}

// cohesion, friction, power: of Bekker's law, in SI units
static inline DpSoil measured(float cohesion, float friction, float power)
{
    DpSoil soil = dp_soil_default();
    soil.bekker_cohesion = cohesion, soil.bekker_friction = friction, soil.bekker_power = power;
    return soil;
}
