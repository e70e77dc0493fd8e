// plants/plant_kind.c - one kind of plant: its numbers, what it is made of, how fast it swings.
#include "plants/plant_inside.h"

#define MAX_STEMS 96

#define NUMBER(...) DP_NUMBER_ROW(DpPlantKind, __VA_ARGS__)
static const DpNumber numbers[] = {DP_PLANT_NUMBERS(NUMBER)};
#define COUNT ((int)(sizeof numbers / sizeof *numbers))

const DpNumber* dp_plant_numbers(int* count)
{
    *count = COUNT;
    return numbers;
}

DpPlantKind dp_plant_kind_default(void)
{
    DpPlantKind kind = {.form = DP_PLANT_SURFACE, .sheets = 2};
    dp_numbers_usual(&kind, numbers, COUNT);
    return kind;
}

static bool form_holds(const DpPlantKind* kind)
{
    return kind->form == DP_PLANT_SURFACE ||
           (kind->form == DP_PLANT_TUFT && kind->sheets >= 2 && kind->sheets <= 3);
}

DpStatus dp_plant_kind_check(const DpPlantKind* kind, DpReason* reason)
{
    if (!kind || !form_holds(kind)) {
        dp_reason(reason, "a plant is a surface, or a tuft of 2 or 3 sheets");
        return DP_BAD_ARGUMENT;
    }
    if (dp_numbers_check(kind, numbers, COUNT, reason) != DP_OK) return DP_BAD_ARGUMENT;
    if (kind->break_angle < kind->degrade_angle) {
        dp_reason(reason, "break_angle of %g is out of its range: it lies below degrade_angle, %g",
                  (double)kind->break_angle, (double)kind->degrade_angle);
        return DP_BAD_ARGUMENT;
    }
    const DpPlantShape shape = dp_plant_shape(kind);
    if (shape.rows <= DP_PLANT_MAX_ROWS && shape.stems <= MAX_STEMS) return DP_OK;
    dp_reason(reason, "%d stems of %d particles are more than %d of %d: raise the spacing",
              shape.stems, shape.rows, MAX_STEMS, DP_PLANT_MAX_ROWS);
    return DP_BAD_ARGUMENT;
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
