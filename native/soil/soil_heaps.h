// soil/soil_heaps.h - the two ways of laying soil down, as soil_accumulate.c calls them.
#pragma once
#include "soil/soil_inside.h"

// Shares asked for around a sole. TRAIL (11)-(13).
typedef struct HeapShares
{
    double           beta;            // anisotropy, TRAIL (13)             [-] 0..1
    double           dir_x, dir_y;    // of the push                      [-]
    double           from_x, from_y;  // centre of pressure, in cells of the patch
    bool             even;            // no border cell lies ahead: all share alike
    double           cut;  // of what is laid, the share that was cut and goes one way [-] 0..1
    double           cut_x, cut_y;  // .. that way, away from the touched cells [-]
    double           left, right;   // sides of the touched cells across it [cells]
    const DpImprint* imprint;
} HeapShares;

// omega of cell (i, j), not yet normalised, in steps of 2^-30. TRAIL (11), TRAIL (12); MODEL 6.7.
double dp_soil_heap_share(const HeapShares* shares, const DpSoilPatch* patch, int i, int j);

// How far a cell lies within the sides of what has cut, 0 beside them [cells].
double dp_soil_heap_within(const HeapShares* shares, int i, int j);

// Lay `volume` [m^3] > 0 in its resting shape; slope = tan(gamma_r).
DpStatus dp_soil_heap_rest(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                           double volume, double slope, double* height, DpSoilScratch* scratch);

// How deep an untouched cell must be pressed to count as the hollow that a sole has left [m].
float dp_soil_hollow(const DpSoilPatch* patch, const DpImprint* imprint);

// Lay `volume` [m^3] > 0 as a bulge `width` [m] wide, none of it in the hollow.
DpStatus dp_soil_heap_bulge(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                            double volume, double width, DpSoilScratch* scratch);

// Lay `volume` [m^3] > 0 on a rim `width` [m] wide.
DpStatus dp_soil_heap_paper(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                            double volume, double width, DpSoilScratch* scratch);
