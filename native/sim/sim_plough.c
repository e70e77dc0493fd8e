// sim/sim_plough.c - what a sole that slides while it presses pushes ahead. MODEL 6.18
//
//   poses of its parts, by what they bear, and slip --> how its points go --(soil_plough.c)--> cut --> laid ahead
#include "base/vec.h"
#include "sim/sim_inside.h"

#define STILL 1e-4  // of a cell's side: what goes no farther along the ground in a step stands

// what a part bears at fraction `w` of an interval [N]
static double borne(const DpSim* sim, int part, int sample, double w)
{
    double sum = 0.0;
    for (int end = 0; end < 2; ++end) {
        DpPartState state;
        if (dp_motion_part(sim->motion, part, sample + end, &state))
            sum += (end ? w : 1.0 - w) * fmax(0.0, -state.force.z);
    }
    return sum;
}

static void add(DpSlide* slide, const Moved* m, DpVec3 middle, double share)
{
    const DpVec3 at = dp_sub(dp_sub(middle, m->from), dp_turn(m->turn, dp_sub(middle, m->to)));
    const DpVec3 x = dp_turn(m->turn, dp_vec3(1.0, 0.0, 0.0));
    const DpVec3 y = dp_turn(m->turn, dp_vec3(0.0, 1.0, 0.0));
    const DpVec3 z = dp_turn(m->turn, dp_vec3(0.0, 0.0, 1.0));
    slide->at[0] += share * at.x, slide->at[1] += share * at.y;
    slide->by_x[0] += share * (1.0 - x.x), slide->by_x[1] -= share * x.y;
    slide->by_y[0] -= share * y.x, slide->by_y[1] += share * (1.0 - y.y);
    slide->by_z[0] -= share * z.x, slide->by_z[1] -= share * z.y;
}

static bool stands(const DpSlide* slide, double wide, double cell)
{
    double farthest = 0.0;
    for (int k = 0; k < 2; ++k)
        farthest += fabs(slide->at[k]) +
                    (fabs(slide->by_x[k]) + fabs(slide->by_y[k]) + fabs(slide->by_z[k])) * wide;
    return !(farthest > STILL * cell);
}

bool dp_limb_slides(const DpSim* sim, const Limb* limb, const DpSoilPatch* patch, int sample,
                    double w0, double w1, DpVec3 slipped, DpSlide* slide)
{
    const double w = 0.5 * (w0 + w1);
    const DpVec3 middle = dp_vec3(patch->x0 + 0.5 * (double)(patch->nx - 1) * patch->cell,
                                  patch->y0 + 0.5 * (double)(patch->ny - 1) * patch->cell, 0.0);
    double       all = 0.0;
    for (int p = 0; p < limb->part_count; ++p) all += borne(sim, limb->part[p], sample, w);
    *slide = (DpSlide){.at = {slipped.x, slipped.y}, .owed = limb->owed};
    if (!(all > 0.0)) return false;
    for (int p = 0; p < limb->part_count; ++p) {
        const double share = borne(sim, limb->part[p], sample, w) / all;
        if (!(share > 0.0)) continue;
        const Moved m = dp_limb_moved(sim, limb->part[p], sample, w0, w1);
        add(slide, &m, middle, share);
    }
    return !stands(slide, limb->length, patch->cell);
}

// A slide or a shear over a disc half as wide as the sole is long: the mean of the product of two of them.
static double mean_product(const double a[6], const double b[6], double radius)
{
    const double around = 0.25 * radius * radius;
    return a[0] * b[0] + a[1] * b[1] +
           around * ((a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5]));
}

// A slide d shears what has sheared by s to K d/|d| + (s - K d/|d|) e^(-|d|/K); the share s d/(K |d|) flows on the way.
bool dp_limb_shears(Limb* limb, const DpSoilPatch* patch, const DpSoil* soil, DpVec3 place,
                    DpSlide* slide)
{
    const double most = (double)soil->flow_shear, radius = 0.5 * limb->length;
    if (!(most > 0.0)) return true;
    const double x = place.x - (patch->x0 + 0.5 * (double)(patch->nx - 1) * patch->cell);
    const double y = place.y - (patch->y0 + 0.5 * (double)(patch->ny - 1) * patch->cell);
    const Shear* was = &limb->shear;
    const double dx = place.x - was->place.x, dy = place.y - was->place.y;
    double       displacement[6], shear[6];
    for (int k = 0; k < 2; ++k) {
        displacement[k] =
            slide->at[k] + slide->by_x[k] * x + slide->by_y[k] * y + slide->by_z[k] * place.z;
        displacement[2 + k] = slide->by_x[k], displacement[4 + k] = slide->by_y[k];
        shear[2 + k] = was->field[2 + k], shear[4 + k] = was->field[4 + k];
        shear[k] = was->field[k] + shear[2 + k] * dx + shear[4 + k] * dy;
    }
    const double far = sqrt(mean_product(displacement, displacement, radius)), path = far / most;
    if (!(far > 0.0)) return false;
    const double goes = -expm1(-path), stays = goes / path;  // of s, and its mean on the way
    const double along = mean_product(shear, displacement, radius) / (most * far);
    limb->shear.place = place;
    for (int k = 0; k < 6; ++k)
        limb->shear.field[k] = shear[k] + goes * (most * displacement[k] / far - shear[k]);
    slide->held = 1.0 - dp_clamp(1.0 - stays + along * stays, 0.0, 1.0);
    return slide->held < 1.0;
}

void dp_shear_save(DpStateWriter* writer, const Shear* shear)
{
    dp_write_f64(writer, shear->place.x), dp_write_f64(writer, shear->place.y);
    for (int k = 0; k < 6; ++k) dp_write_f64(writer, shear->field[k]);
}

void dp_shear_load(DpStateReader* reader, Shear* shear)
{
    shear->place.x = dp_read_number(reader, -1e9, 1e9);
    shear->place.y = dp_read_number(reader, -1e9, 1e9);
    for (int k = 0; k < 6; ++k) shear->field[k] = dp_read_number(reader, -1e9, 1e9);
}

void dp_plough_count(Limb* limb, const DpPressed* pressed)
{
    const double cut = pressed->cut_firm + pressed->cut_loose;
    limb->ploughs = limb->ploughs || cut > 0.0;
    limb->loosened += pressed->cut_firm;
    limb->laid -= cut;  // what is laid of it was not displaced
}
