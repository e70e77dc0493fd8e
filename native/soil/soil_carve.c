// soil/soil_carve.c - a body goes where it is moved to, and the ground makes way. SUMNER99, MODEL 6.11
//
//   surface over underside --(body came down)--> pressed, 2 nu of it displaced
//                          `--(rest)-----------> cut, all of it laid ahead
//
// Departures
//   SUMNER99: there alpha of what is in a body's way is displaced, however it came there. What a body meets from the side
//     is not compressed: it is carried along. test_soil_carve.c, what_comes_from_the_side_is_cut
//   Heaped soil is not compressed again: all of it is pushed aside. A body that widens as it sinks presses what it has just
//     displaced, the oftener the smaller its steps. test_carve.py, test_volume_and_rim_do_not_depend_on_the_cell
//   A cell that the body covers by the share a is lowered by a times its column, as under a sole; heaped soil that it
//     covers in part is cut down to 1/a of its height over the base ground, so that no step takes it twice.
//     test_soil_carve.c, cells_do_not_matter
#include <string.h>

#include "soil/soil_law.h"

#define TOUCHES 5e-4  // a surface that is so close below the underside touches it [m]
#define NOISE 1e-7    // less than this is not cut, but pressed [m]

// depth below h0 to which a cell's column is lowered, of which the body covers the share a [m]
static double goal_of(double underside, double share)
{
    return underside > 0.0 ? share * underside : underside / share;
}

// how much of what a column loses was cut, 0..1
static double cut_share(const DpDescent* descent, double x, double y, double z, double share,
                        double over)
{
    const double came = soil_on_grid(
        descent->at + descent->along_x * x + descent->along_y * y + descent->along_z * z,
        ldexp(1.5, 52 - 30));
    const double pressed = share * soil_max(came, 0.0);
    return over - pressed > NOISE ? (over - pressed) / over : 0.0;
}

// lower one column by `over` [m]
static void lower(DpSoilPatch* patch, size_t p, double over, double cut, DpCarved* carved)
{
    const double loose = soil_min(over, (double)patch->heap[p]);
    const Cut    taken = dp_cut_cell(patch, p, loose, over - loose, cut);
    DpPressed*   pressed = &carved->pressed;
    carved->cut_loose += taken.loose;
    carved->cut_firm += taken.firm;
    pressed->loose += taken.loose_pressed;
    pressed->firm += taken.firm_pressed;
    pressed->elastic += taken.elastic;
    pressed->displaced += taken.displaced;
}

// the pressure of a column under the body, as if it was a spring [Pa]
static void note_pressure(DpSoilPatch* patch, size_t p, double depth, double share, double width,
                          double dt)
{
    const DpSoil* soil = &patch->soils[patch->kind[p]];
    const double  layer = (double)soil->layer_depth;
    const double  pressed = soil_max(soil_min(depth, SOIL_RIGID * layer), TOUCHES);
    const double  stress = dp_law_own(soil) || patch->layers
                               ? dp_law_firmness(patch, p) *
                                    dp_law_kind_pressure(patch, patch->kind[p], width, pressed)
                               : (double)patch->modulus[p] / layer * pressed;
    if (patch->pressure_time)
        patch->pressure_time[p] += (float)(stress * share * dt);  // TRAIL (17)
    if (patch->pressure) patch->pressure[p] = (float)(stress * share);
}

// What the columns that touch add up to.
typedef struct Contact
{
    double share, i, j;
    double width;  // of what may carry, the smaller one [m]
} Contact;

static void carve_cell(DpSoilPatch* patch, DpImprint* imprint, const DpDescent* descent, int i,
                       int j, double dt, DpCarved* carved, Contact* contact)
{
    const size_t p = soil_at(patch, i, j);
    const double share = (double)imprint->cover[p];
    if (!(share > 0.0) || !soil_is_ground(patch->base_height[p])) return;
    const double bottom = (double)imprint->bottom[p];
    const double depth = (double)patch->base_height[p] - bottom;
    const double over =
        goal_of(depth, share) - ((double)patch->compression[p] - (double)patch->heap[p]);
    if (!(over > -TOUCHES)) return;
    imprint->ring[p] = 0;
    contact->share += share, contact->i += share * i, contact->j += share * j;
    if (over > 0.0) {
        const double x = ((double)i - 0.5 * (double)(patch->nx - 1)) * patch->cell;
        const double y = ((double)j - 0.5 * (double)(patch->ny - 1)) * patch->cell;
        lower(patch, p, over, cut_share(descent, x, y, bottom, share, over), carved);
    }
    note_pressure(patch, p, depth, share, contact->width, dt);
    carved->pressed.deepest = soil_max(carved->pressed.deepest, (double)patch->compression[p]);
}

DpStatus dp_soil_carve(DpSoilPatch* patch, DpImprint* imprint, const DpDescent* descent, double dt,
                       DpCarved* carved)
{
    if (!soil_patch_ok(patch) || !imprint || !descent || !carved || !(dt > 0.0) || !isfinite(dt))
        return DP_BAD_ARGUMENT;
    memset(carved, 0, sizeof *carved);
    for (int j = 0; j < patch->ny; ++j) {
        int32_t* ring = imprint->ring + soil_at(patch, 0, j);
        for (int i = 0; i < patch->nx; ++i) ring[i] = DP_RING_FAR;
    }
    Contact contact = {.width = dp_law_on(patch) ? dp_law_width(patch, imprint) : patch->cell};
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i)
            carve_cell(patch, imprint, descent, i, j, dt, carved, &contact);
    const double area = patch->cell * patch->cell;
    carved->pressed.area = contact.share * area;
    carved->pressed.firm *= area, carved->pressed.elastic *= area, carved->pressed.loose *= area;
    carved->pressed.displaced *= area;
    carved->cut_firm *= area, carved->cut_loose *= area;
    if (contact.share > 0.0) {
        carved->x = patch->x0 + contact.i / contact.share * patch->cell;
        carved->y = patch->y0 + contact.j / contact.share * patch->cell;
    }
    return DP_OK;
}
