// soil/soil_layers.c - ground of several layers: each yields to the same pressure. PEYRAT11 3.1, MODEL 6.17
//
//   pressure --(every layer by its own law)--> sum of their depths       depth --(regula falsi)--> pressure
//
// Departures
//   PEYRAT11 3.3: there load presses the top layer first, and what is left of it the next. Layers that lie on each other
//     bear the same load: here the softest yields most, wherever it lies. test_soil_layers.c, the_softest_yields_most
#include "soil/soil_law.h"

#define STIFFER 100.0  // as one soil below SOIL_RIGID
#define MAX_ROUNDS 200
#define CLOSE 1e-13      // of the depth is near enough
#define USUAL_WIDTH 0.1  // of a contact, where nobody tells of one [m]

// how deep one layer is pressed, by what its soil would be were it as thick as its own L0 [m]
static double yields(const DpLayer* layer, double width, double pressure)
{
    return layer->thickness / (double)layer->soil.layer_depth *
           dp_law_depth(&layer->soil, width, pressure);
}

static double depth_of(const DpLayer* layers, int count, double width, double pressure)
{
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += yields(&layers[k], width, pressure);  // MODEL 6.17
    return sum;
}

static double rigid_of(const DpLayer* layers, int count)
{
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += SOIL_RIGID * layers[k].thickness;
    return sum;
}

// A pressure under which they yield as far as `depth` at least: any of them alone would, or all as far as they can.
static double upper(const DpLayer* layers, int count, double width, double depth)
{
    double alone = INFINITY, all = 0.0;
    for (int k = 0; k < count; ++k) {
        const DpSoil* soil = &layers[k].soil;
        const double  layer = (double)soil->layer_depth;
        const double  strained = depth * layer / layers[k].thickness;
        if (strained < SOIL_RIGID * layer)
            alone = soil_min(alone, dp_law_pressure(soil, width, strained));
        all = soil_max(all, dp_law_pressure(soil, width, SOIL_RIGID * layer));
    }
    return soil_min(alone, all);
}

static double yielding(const DpLayer* layers, int count, double width, double depth)
{
    double low = 0.0, high = upper(layers, count, width, depth), below = -depth;
    double above = depth_of(layers, count, width, high) - depth, s = high;
    for (int round = 1; round < MAX_ROUNDS && above > CLOSE * depth; ++round) {
        s = round % 3 ? low + (high - low) * (below / (below - above)) : 0.5 * (low + high);
        if (!(s > low && s < high)) break;
        const double over = depth_of(layers, count, width, s) - depth;
        if (fabs(over) <= CLOSE * depth) return s;
        if (over < 0.0)
            low = s, below = over;
        else
            high = s, above = over;
    }
    return high;
}

static double pressure_of(const DpLayer* layers, int count, double width, double depth)
{
    const double rigid = rigid_of(layers, count);
    if (!(depth > 0.0)) return 0.0;
    if (depth <= rigid) return yielding(layers, count, width, depth);
    return yielding(layers, count, width, rigid) * (1.0 + STIFFER * (depth - rigid) / rigid);
}

// the layers of a kind of ground, NULL where it is one soil
static const DpLayer* layers_of(const DpSoilPatch* patch, int kind, int* count)
{
    *count = patch->layers ? patch->layer_start[kind + 1] - patch->layer_start[kind] : 0;
    return *count > 0 ? patch->layers + patch->layer_start[kind] : NULL;
}

double dp_law_kind_pressure(const DpSoilPatch* patch, int kind, double width, double depth)
{
    int            count;
    const DpLayer* layers = layers_of(patch, kind, &count);
    return layers ? pressure_of(layers, count, width, depth)
                  : dp_law_pressure(&patch->soils[kind], width, depth);
}

double dp_law_kind_depth(const DpSoilPatch* patch, int kind, double width, double pressure)
{
    int            count;
    const DpLayer* layers = layers_of(patch, kind, &count);
    return layers ? depth_of(layers, count, width, pressure)
                  : dp_law_depth(&patch->soils[kind], width, pressure);
}

bool dp_law_unloads(const DpSoilPatch* patch, int kind)
{
    int            count;
    const DpLayer* layers = layers_of(patch, kind, &count);
    for (int k = 0; layers && k < count; ++k)
        if (dp_law_own(&layers[k].soil)) return true;
    return !layers && dp_law_own(&patch->soils[kind]);
}

double dp_soil_layer_pressed(const DpLayer* layers, int count, int layer, double depth)
{
    const double held = soil_min(depth, rigid_of(layers, count));
    if (!(held > 0.0)) return 0.0;
    const double pressure = yielding(layers, count, USUAL_WIDTH, held);
    return yields(&layers[layer], USUAL_WIDTH, pressure);
}

double dp_law_poisson(const DpSoilPatch* patch, size_t p, double before, double after)
{
    const int      kind = patch->kind[p];
    int            count;
    const DpLayer* layers = layers_of(patch, kind, &count);
    double         aside = 0.0, pressed = 0.0;
    for (int k = 0; layers && k < count; ++k) {
        const double yielded = dp_soil_layer_pressed(layers, count, k, after) -
                               dp_soil_layer_pressed(layers, count, k, before);
        aside += (double)layers[k].soil.poisson_ratio * yielded;
        pressed += yielded;
    }
    return pressed > 0.0 ? aside / pressed : (double)patch->soils[kind].poisson_ratio;
}
