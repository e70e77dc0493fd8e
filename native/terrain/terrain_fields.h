// terrain/terrain_fields.h - the fields of the ground, each told once: add a line here.
//
// KEPT fields are what kernels change: every tile has a grid of them, 0 where nobody walked; leases
// lend and commit them, states keep them. OTHER fields follow from the ground, its soils and plants.
#pragma once

// (number's name, name, number, unit, meaning)
#define DP_TERRAIN_FIELDS(KEPT, OTHER)                                                         \
    KEPT(COMPRESSION, compression, 0, "m", "pressed below the first height, >= 0")             \
    KEPT(HEAP, heap, 1, "m", "loose soil piled on top, >= 0")                                  \
    KEPT(PRESSURE_TIME, pressure_time, 2, "Pa s", "stress summed over time, TRAIL (17), >= 0") \
    OTHER(BASE_HEIGHT, rest, 3, "m", "height before any walker; NaN = no ground")              \
    OTHER(MODULUS, young_modulus, 4, "Pa", "E = E_g + E_v, TRAIL (9)")                         \
    OTHER(KIND, soil, 5, "-", "index of the soil")                                             \
    OTHER(PLANT_STRENGTH, plant_strength, 6, "-", "alpha_veg, TRAIL (7); 0 without plants")    \
    OTHER(HEIGHT_CHANGE, height_change, 7, "m", "heap - compression")

#define DP_FIELD_NONE(ID, name, number, unit, meaning)
