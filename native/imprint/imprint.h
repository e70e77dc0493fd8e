// imprint/imprint.h - the underside of a posed limb, one column per cell.
//
//   sole meshes of a limb's parts ---lower envelope---> bottom, cover ---touched cells---> rings
//   TRAIL 4.2.1, MODEL 5.1
//
// A triangle mesh is all it takes: feet, hooves, wheels, stamps. Each cell is looked at in
// samples x samples points, so that cover tells how much of it lies under the sole: print edges are
// smooth and volumes do not change with the cell.
#pragma once
#include "base/status.h"
#include "base/types.h"

// Scratch memory of one rasteriser. Make one per thread; it grows and is kept.
typedef struct DpImprintScratch DpImprintScratch;
DpImprintScratch*               dp_imprint_scratch_create(void);
void                            dp_imprint_scratch_destroy(DpImprintScratch* scratch);

// World box of a posed mesh, x0 <= x <= x1 and so on [m].
typedef struct DpBox
{
    double x0, y0, z0, x1, y1, z1;
} DpBox;
DpBox dp_imprint_box(const DpMesh* sole, DpPose pose);

// How many samples a side a cell gets, 1..4: about 2.5 mm apart, or a hundredth of the length of
// what presses where that is shorter than 25 cm, so that prints of any size are the same print.
// @param length  of what presses [m]
int dp_imprint_samples(double cell, double length);

// Rasterise the lower envelope of `count` posed meshes into imprint->bottom and imprint->cover, and
// set i0..j1. bottom is the mean height over the covered samples of the cell; +inf and cover 0 where
// there is no sole. What lies outside the patch is left out. ring is not touched.
DpStatus dp_imprint_foot(DpImprint* imprint, const DpSoilPatch* patch, const DpMesh* soles,
                         const DpPose* poses, int count, int samples, DpImprintScratch* scratch);

// Number the rings outward from the touched cells (ring == 0 on entry, all others any value but 0):
// ring k is k steps of 8-neighbourhood away, up to `rings`; DP_RING_FAR beyond. TRAIL 4.2.2.
void dp_imprint_rings(DpImprint* imprint, const DpSoilPatch* patch, int rings);
