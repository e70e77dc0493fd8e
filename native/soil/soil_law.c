// soil/soil_law.c - how hard ground presses back that is no spring. MODEL 6.14
//
//   depth z --(snow: as dense as that packs it)--> p        depth z --(Bekker: measured by a plate)--> p
#include "soil/soil_law.h"

#define STIFFER 100.0  // how much harder ground is below SOIL_RIGID
#define CARRIES 0.02   // above the lowest point of a sole: what may carry [m]

// What wheels and feet pack snow to under a pressure, CRREL 95-7: 500 kg/m^3 up to 210 kPa, 550 above, 600 above 350,
// 650 above 700; the steps are joined by slopes.
typedef struct Packed
{
    double density, pressure;  // [kg/m^3], [Pa]
} Packed;
static const Packed packed[] = {{499.5, 35e3},  {500.5, 190e3}, {549.5, 230e3},
                                {550.5, 320e3}, {599.5, 380e3}, {600.5, 650e3},
                                {649.5, 750e3}, {650.5, 1e6},   {917.0, 1e7}};
#define PACKED_COUNT ((int)(sizeof packed / sizeof *packed))

static double cube(double x)
{
    return x * x * x;
}

// below that of the first row of `packed` snow is as strong as the cube of its density
static double snow_pressure(double fresh, double density)
{
    const Packed* row = packed;
    if (density <= row->density)
        return row->pressure * (cube(density) - cube(fresh)) / (cube(row->density) - cube(fresh));
    while (row + 2 < packed + PACKED_COUNT && density > row[1].density) ++row;
    return row->pressure + (row[1].pressure - row->pressure) * (density - row->density) /
                               (row[1].density - row->density);
}

static double snow_density(double fresh, double pressure)
{
    const Packed* row = packed;
    if (pressure <= row->pressure)
        return cbrt(cube(fresh) + pressure / row->pressure * (cube(row->density) - cube(fresh)));
    while (row + 2 < packed + PACKED_COUNT && pressure > row[1].pressure) ++row;
    return row->density + (row[1].density - row->density) * (pressure - row->pressure) /
                              (row[1].pressure - row->pressure);
}

// k_c/w + k_phi [Pa/m^n]
static double bekker(const DpSoil* soil, double width)
{
    return (double)soil->bekker_cohesion / width + (double)soil->bekker_friction;
}

static bool is_snow(const DpSoil* soil)
{
    return soil->snow_density > 0.0f;
}

bool dp_law_own(const DpSoil* soil)
{
    return is_snow(soil) || soil->bekker_friction > 0.0f || soil->bekker_cohesion > 0.0f;
}

bool dp_law_on(const DpSoilPatch* patch)
{
    if (patch->layers) return true;
    for (int k = 0; k < patch->soil_count; ++k)
        if (dp_law_own(&patch->soils[k])) return true;
    return false;
}

// .. at a depth to which it yields
static double yielding_pressure(const DpSoil* soil, double width, double depth)
{
    const double layer = (double)soil->layer_depth, fresh = (double)soil->snow_density;
    if (is_snow(soil)) return snow_pressure(fresh, fresh * layer / (layer - depth));
    if (dp_law_own(soil)) return bekker(soil, width) * pow(depth, (double)soil->bekker_power);
    return (double)soil->young_modulus / layer * depth;
}

double dp_law_pressure(const DpSoil* soil, double width, double depth)
{
    const double rigid = SOIL_RIGID * (double)soil->layer_depth;
    if (!(depth > 0.0)) return 0.0;
    if (depth <= rigid) return yielding_pressure(soil, width, depth);
    return yielding_pressure(soil, width, rigid) * (1.0 + STIFFER * (depth - rigid) / rigid);
}

double dp_law_depth(const DpSoil* soil, double width, double pressure)
{
    const double layer = (double)soil->layer_depth, fresh = (double)soil->snow_density;
    double       depth;
    if (is_snow(soil))
        depth = layer * (1.0 - fresh / snow_density(fresh, pressure));
    else if (dp_law_own(soil))
        depth = pow(pressure / bekker(soil, width), 1.0 / (double)soil->bekker_power);
    else
        depth = pressure * layer / (double)soil->young_modulus;
    return soil_min(depth, SOIL_RIGID * layer);
}

double dp_law_firmness(const DpSoilPatch* patch, size_t p)
{
    return (double)patch->modulus[p] / (double)patch->soils[patch->kind[p]].young_modulus;
}

// ---- how wide a contact is ----------------------------------------------------------------------

static double gap_of(const DpSoilPatch* patch, const DpImprint* imprint, size_t p)
{
    return (double)patch->base_height[p] - (double)imprint->bottom[p];
}

static bool may_carry(const DpSoilPatch* patch, const DpImprint* imprint, size_t p)
{
    return imprint->cover[p] > 0.0f && soil_is_ground(patch->base_height[p]);
}

// That of the rectangle with the same second moments: exact for a rectangle, however it is turned.
double dp_law_width(const DpSoilPatch* patch, const DpImprint* imprint)
{
    const double grid = ldexp(1.5, 52 - 12);
    double       highest = -INFINITY, n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (may_carry(patch, imprint, p))
                highest = soil_max(highest, gap_of(patch, imprint, p));
        }
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (!may_carry(patch, imprint, p)) continue;
            if (gap_of(patch, imprint, p) < highest - CARRIES) continue;
            const double a = soil_on_grid((double)imprint->cover[p], grid);
            const double u = i - imprint->i0, v = j - imprint->j0;
            n += a, x += a * u, y += a * v, xx += a * u * u, xy += a * u * v, yy += a * v * v;
        }
    if (!(n > 0.0)) return patch->cell;
    const double vx = xx / n - x / n * (x / n), vy = yy / n - y / n * (y / n);
    const double vxy = xy / n - x / n * (y / n);
    const double least = 0.5 * (vx + vy) - hypot(0.5 * (vx - vy), vxy);
    const double cells = sqrt(12.0 * soil_max(least, 0.0) + 1.0);
    return patch->cell * soil_max(soil_on_grid(cells, ldexp(1.5, 52 - 20)), 1.0);
}
