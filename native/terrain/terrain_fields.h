// terrain/terrain_fields.h - the fields of the ground, each declared once: add a line here.
//
// KEPT fields are what kernels change: every tile has a grid of them, 0 where nobody walked; leases
// lend and commit them, states keep them. OTHER fields follow from the ground, its soils and plants.
// sim/sim_film.h has those that only a simulation knows.
#pragma once

// (number's name, name, number, unit, equation, meaning)
// clang-format off
#define DP_TERRAIN_FIELDS(KEPT, OTHER) \
    KEPT(COMPRESSION, compression, 0, "m", "TRAIL (10)", "pressed below the first height, >= 0") \
    KEPT(HEAP, heap, 1, "m", "TRAIL (12)", "loose soil piled on top, >= 0") \
    KEPT(PRESSURE_TIME, pressure_time, 2, "Pa s", "TRAIL (17)", "stress summed over the walk, >= 0") \
    OTHER(BASE_HEIGHT, rest, 3, "m", "", "height before anybody walked; NaN = no ground") \
    OTHER(MODULUS, young_modulus, 4, "Pa", "TRAIL (9)", "E = E_g + E_v") \
    OTHER(KIND, soil, 5, "-", "", "index of the soil") \
    OTHER(PLANT_STRENGTH, plant_strength, 6, "-", "TRAIL (7)", "alpha_veg, 1 = whole stand, 0 = bare") \
    OTHER(HEIGHT_CHANGE, height_change, 7, "m", "", "heap - compression")
// clang-format on

#define DP_FIELD_NONE(ID, name, number, unit, equation, meaning)
