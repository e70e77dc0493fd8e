// base/soil_numbers.h - the numbers of a soil, each declared once: a new one is a line here.
//
// DpSoil, dp_soil_default, dp_soil_check and Python's Soil come from this table, base/number.h.
#pragma once

// (name, unit, lowest, highest, default, meaning); both ends are possible
#define DP_SOIL_NUMBERS(X)                                                                         \
    X(layer_depth, "m", 1e-4, 100.0, 0.3, "L0, loose layer over rigid ground")                     \
    X(young_modulus, "Pa", 1.0, 1e12, 1.0e6, "E_g, without roots")                                 \
    X(poisson_ratio, "-", 0.0, 0.5, 0.35, "nu, share pushed sideways, SOFT22 (12)")                \
    X(settle_time, "s", 1e-5, 1e4, 0.1, "tau, time to yield fully, SOFT22 (11)")                   \
    X(rest_angle, "rad", 1e-3, 1.5533430342749532, 0.5235987755982988,                             \
      "gamma_r, steepest slope that stays; up to 89 degrees")                                      \
    X(push_threshold, "N", 0.0, 1e15, 0.0,                                                         \
      "F_threshold, TRAIL (13); 0 = half the walker's weight")                                     \
    X(shear_modulus, "m", 0.0, 0.1, 0.0,                                                           \
      "K, shear before it carries sideways; 0 = soles do not slip")                                \
    X(wall_angle, "rad", 1e-3, 1.5707963705062866, 1.5707963705062866,                             \
      "gamma_w, steepest firm wall that stands once it is cut; 90 degrees = all")                  \
    X(roughness, "-", 0.0, 1.0, 0.0,                                                               \
      "rho, by how much walls, rest and rims differ from place to place")                          \
    X(grain_size, "m", 1e-4, 10.0, 0.012, "how far apart such places are")                         \
    X(rebound, "-", 0.0, 0.9, 0.0, "share of the depth that comes back when a sole lifts")         \
    X(heave, "m", 0.0, 10.0, 0.0, "w, how wide it bulges around a print; 0 = loose soil in cones") \
    X(flow_time, "s", 0.0, 1e4, 0.0, "T, in which what slides goes 0.1 m; 0 = at once")            \
    X(crust_depth, "m", 0.0, 1.0, 0.0, "h, plate on top that carries until it breaks; 0 = none")   \
    X(crust_strength, "Pa", 0.0, 1e9, 0.0, "bending stress at which the plate breaks")             \
    X(wetness, "-", 0.0, 1.0, 0.0, "S, share of the pores full of water; 0 = dry, 1 = it flows")   \
    X(snow_density, "kg/m3", 0.0, 490.0, 0.0, "rho_0, of snow that packs under a load; 0 = none")  \
    X(bekker_friction, "N/m^(n+2)", 0.0, 1e12, 0.0,                                                \
      "k_phi, of ground measured by plates, in place of E_g; 0 = none")                            \
    X(bekker_cohesion, "N/m^(n+1)", 0.0, 1e12, 0.0, "k_c, of the same, over the contact's width")  \
    X(bekker_power, "-", 0.05, 4.0, 1.0, "n, of the same, of the depth")                           \
    X(clod_size, "m", 0.0, 0.2, 0.0, "width of the largest crumbs shown; 0 = as of its look")      \
    X(adhesion, "m", 0.0, 0.05, 0.0, "how thick it sticks to a sole that lifts; 0 = not at all")   \
    X(release_pressure, "Pa", 1.0, 1e9, 1.5e5, "p0, under which 63 % of what sticks is left")      \
    X(water_depth, "m", 0.0, 100.0, 0.0,                                                           \
      "w, of water that stands below the ground as it lay, and is shown in prints; 0 = none")      \
    X(flow_shear, "m", 0.0, 1.0, 0.0,                                                              \
      "K_f, shear before it flows off ahead of a sole that slides; 0 = at once")
