// soil/soil_accumulate.c - what was pushed aside is laid around the sole. TRAIL (11)-(13), MODEL 6.3
//
//   push --> anisotropy beta (13) --> share of each border cell (11)(12) --> heap: rest | paper
#include "base/vec.h"
#include "soil/soil_heaps.h"

double dp_soil_anisotropy(DpVec3 push, double threshold)
{
    if (!(threshold > 0.0)) return 1.0;
    return fmin(dp_length(push) / threshold, 1.0);  // TRAIL (13)
}

// the sides of the touched cells across the way of what has cut
static void find_sides(const DpSoilPatch* patch, const DpImprint* imprint, HeapShares* shares)
{
    shares->left = INFINITY, shares->right = -INFINITY;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            if (imprint->ring[soil_at(patch, i, j)] != 0) continue;
            const double across = shares->cut_x * j - shares->cut_y * i;
            shares->left = soil_min(shares->left, across - 0.5);
            shares->right = soil_max(shares->right, across + 0.5);
        }
}

// is there a border cell at all, and one that gets something?
static bool look_at_border(const DpSoilPatch* patch, const DpImprint* imprint, HeapShares* shares)
{
    const int i0 = imprint->i0 > 0 ? imprint->i0 - 1 : 0,
              j0 = imprint->j0 > 0 ? imprint->j0 - 1 : 0;
    bool any = false, ahead = false;
    for (int j = j0; j < patch->ny && j <= imprint->j1; ++j)
        for (int i = i0; i < patch->nx && i <= imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (imprint->ring[p] != 1 || !soil_is_ground(patch->base_height[p])) continue;
            any = true;
            ahead = ahead || dp_soil_heap_share(shares, patch, i, j) > 0.0;
        }
    shares->even = !ahead;
    return any;
}

// the cell under the centre of pressure, or that of the patch that is nearest to it
static size_t cell_under(const DpSoilPatch* patch, const HeapShares* shares)
{
    const double i = fmin(fmax(floor(shares->from_x + 0.5), 0.0), patch->nx - 1.0);
    const double j = fmin(fmax(floor(shares->from_y + 0.5), 0.0), patch->ny - 1.0);
    return soil_at(patch, (int)i, (int)j);
}

// tan(gamma_r) of a cell
static double slope_under(const DpSoilPatch* patch, size_t p)
{
    if (patch->uneven)  // not that of the place, which differs from step to step
        return (double)(float)tan((double)patch->soils[patch->kind[p]].rest_angle);
    return (double)patch->rest_slope[p];
}

DpStatus dp_soil_accumulate(DpSoilPatch* patch, const DpImprint* imprint, const DpFootForce* foot,
                            double volume, const DpHeapOptions* options, double* height,
                            DpSoilScratch* scratch)
{
    if (!soil_patch_ok(patch) || !imprint || !foot || !options || !height || !scratch)
        return DP_BAD_ARGUMENT;
    if (!(volume >= 0.0) || !isfinite(volume) || !(*height >= 0.0)) return DP_BAD_ARGUMENT;

    const DpVec3 press = dp_scale(foot->normal, dp_dot(foot->force, foot->normal));
    const DpVec3 push = dp_sub(foot->force, press);
    const DpVec3 dir = dp_unit(push), cut_dir = dp_unit(options->cut);
    HeapShares   shares = {
          .beta = dp_soil_anisotropy(push, options->threshold),
          .dir_x = dir.x,
          .dir_y = dir.y,
          .from_x = (foot->point.x - patch->x0) / patch->cell,
          .from_y = (foot->point.y - patch->y0) / patch->cell,
          .cut = fmin(dp_length(options->cut), 1.0),
          .cut_x = cut_dir.x,
          .cut_y = cut_dir.y,
          .imprint = imprint,
    };
    if (!isfinite(shares.beta) || !isfinite(shares.cut) || !isfinite(shares.from_x) ||
        !isfinite(shares.from_y))
        return DP_BAD_ARGUMENT;
    if (!look_at_border(patch, imprint, &shares)) return DP_NO_GROUND;
    if (volume <= 0.0) return DP_OK;
    if (shares.cut > 0.0) find_sides(patch, imprint, &shares);

    if (options->law == DP_HEAP_PAPER)
        return dp_soil_heap_paper(patch, imprint, &shares, volume, options->rim_width, scratch);
    const size_t under = cell_under(patch, &shares);
    const double heave = (double)patch->soils[patch->kind[under]].heave;
    if (heave > 0.0) return dp_soil_heap_bulge(patch, imprint, &shares, volume, heave, scratch);
    const double slope = slope_under(patch, under);
    return dp_soil_heap_rest(patch, imprint, &shares, volume, slope, height, scratch);
}
