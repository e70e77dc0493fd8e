// plants/plant_kind.c - one kind of plant: its numbers, what it is made of, how fast it swings.
#include "plants/plant_inside.h"

#define MAX_STEMS 96

DpPlantKind dp_plant_kind_default(void)
{
    return (DpPlantKind){
        .form = DP_PLANT_SURFACE,
        .sheets = 2,
        .height = 0.10f,
        .width = 0.05f,
        .depth = 0.05f,
        .spacing = 0.015f,
        .radius = 0.005f,
        .curl = 0.0f,
        .sway = 3.0f,
        .across = 20.0f,
        .damping = 6.0f,
        .strength = 0.1f,
        .degrade_angle = (float)(10.0 * DP_PI / 180.0),
        .break_angle = (float)(70.0 * DP_PI / 180.0),
        .degrade_rate = 0.1f,
        .recover_rate = 0.1f,
        .spread = 0.0f,
        .regrow_rate = (float)(1.02 / (365.25 * 86400.0)),
        .seed_share = 0.0f,
        .root_radius = 0.15f,
        .full_density = 40.0f,
        .modulus = 10e6f,
    };
}

// low <= value <= high, and a number
static bool within(float value, double low, double high)
{
    return (double)value >= low && (double)value <= high;
}

DpStatus dp_plant_kind_check(const DpPlantKind* kind)
{
    if (!kind) return DP_BAD_ARGUMENT;
    const bool form = kind->form == DP_PLANT_SURFACE ||
                      (kind->form == DP_PLANT_TUFT && kind->sheets >= 2 && kind->sheets <= 3);
    const bool size = within(kind->height, 0.0, 10.0) && within(kind->width, 0.0, 10.0) &&
                      within(kind->depth, 0.0, 10.0) && within(kind->spacing, 1e-4, 10.0) &&
                      within(kind->radius, 0.0, 1.0);
    const bool swing = within(kind->curl, 0.0, 0.5 * DP_PI + 1e-6) &&
                       within(kind->sway, 1e-3, 1e3) && within(kind->across, 1e-3, 1e4) &&
                       within(kind->damping, 0.0, 1e4);
    const bool wear = within(kind->strength, 1e-9, 1e9) &&
                      within(kind->degrade_angle, 0.0, DP_PI + 1e-6) &&
                      within(kind->break_angle, kind->degrade_angle, 1e3) &&
                      within(kind->degrade_rate, 0.0, 1e9) &&
                      within(kind->recover_rate, 0.0, 1e9) && within(kind->spread, 0.0, 4.0) &&
                      within(kind->regrow_rate, 0.0, 1e3) && within(kind->seed_share, 0.0, 1.0);
    const bool roots = within(kind->root_radius, 1e-3, 100.0) &&
                       within(kind->full_density, 1e-6, 1e9) && within(kind->modulus, 0.0, 1e12);
    if (!form || !size || !swing || !wear || !roots) return DP_BAD_ARGUMENT;
    const DpPlantShape shape = dp_plant_shape(kind);
    return shape.rows > DP_PLANT_MAX_ROWS || shape.stems > MAX_STEMS ? DP_BAD_ARGUMENT : DP_OK;
}

// steps of `spacing` that fit in `length`, and the one they start from
static int grid_count(float length, float spacing)
{
    const double steps = floor((double)length / (double)spacing + 1e-4);
    return steps < 1000.0 ? (int)steps + 1 : 1001;
}

DpPlantShape dp_plant_shape(const DpPlantKind* kind)
{
    DpPlantShape shape;
    const int    sheets = kind->form == DP_PLANT_TUFT ? kind->sheets : 1;
    shape.rows = grid_count(kind->height, kind->spacing);
    if (shape.rows < DP_PLANT_HELD + 1) shape.rows = DP_PLANT_HELD + 1;
    shape.stems_a_sheet = grid_count(kind->width, kind->spacing);
    shape.stems = sheets * shape.stems_a_sheet;
    shape.particles = shape.stems * shape.rows;
    shape.bends = shape.stems * (shape.rows - 2);
    return shape;
}

double dp_plant_return_rate(const DpPlantKind* kind)
{
    const double swing = 2.0 * DP_PI * (double)kind->sway, damping = (double)kind->damping;
    return damping > 2.0 * swing ? swing * swing / damping : swing;
}

double dp_plant_rise_rate(const DpPlantKind* kind)
{
    const double rate = fmin(0.5 * (double)kind->damping, dp_plant_return_rate(kind));
    return fmax(rate, 0.2 * (double)kind->sway);  // without damping, too
}
