// carry/carry.h - what sticks to a sole, is carried on, and is left along the path. PEYRAT11 3.4, MODEL 6.16
//
//   cell lets go of the sole ---takes---> store of the limb ---leaves---> coat of the cells it presses next
//
// A store is a body's surface in blocks of its own frame, so that a boot that trod half into mud leaves half a print, and a
// wheel leaves once a turn what it took up. Cells hold what was left as coats: they lie still, are too thin to carry, and
// count in the height that is shown. What goes from ground to store to ground is kept to the bit of the float grids.
#pragma once
#include "base/grid.h"
#include "base/status.h"
#include "base/stream.h"
#include "base/types.h"

// What sticks to one limb.
typedef struct DpCarry DpCarry;

// @param coats  soils that stick, as many as the patches' coats >= 1; cell  [m]
DpStatus dp_carry_create(DpCarry** carry, int coats, double cell);
void     dp_carry_destroy(DpCarry* carry);  // NULL is fine

// The poses in which a limb pressed a patch, part by part: pose[k] is of part k % parts.
typedef struct DpCarrying
{
    const DpPose* pose;  // (count)
    int           count, parts;
    long          i0, j0;  // world cell of the patch's cell (0, 0)
} DpCarrying;

// What one step has moved.
typedef struct DpCarried
{
    double firm, loose;  // taken out of firm ground, and out of heaps [m^3] >= 0
    double left;         // left on the ground [m^3] >= 0
} DpCarried;

// A limb has pressed: cells with ring 0 under its sole are touched, by patch->pressure [Pa]. Of what the sole has brought over
// a cell 1 - exp(-p / p0) is left, where the ground is less sticky; cells of the patch that were touched
// and are no more give up to `adhesion` of heap and of what was pressed, as far as there is room on the sole.
DpStatus dp_carry_step(DpCarry* carry, DpSoilPatch* patch, const DpImprint* imprint,
                       const DpCarrying* by, DpCarried* carried);

// It lifts: all cells of the patch that were touched let go.
DpStatus dp_carry_lift(DpCarry* carry, DpSoilPatch* patch, long i0, long j0, DpCarried* carried);

// The cells that are touched; empty: none.
DpCellRect dp_carry_cells(const DpCarry* carry);

// How much of a soil it carries now, and has taken up since it was created [m^3].
double dp_carry_volume(const DpCarry* carry, int coat);
double dp_carry_taken(const DpCarry* carry, int coat);

// Part of a chunk of the state; to be read for a store created alike.
void     dp_carry_save(const DpCarry* carry, DpStateWriter* writer);
DpStatus dp_carry_load(DpCarry* carry, DpStateReader* reader);
