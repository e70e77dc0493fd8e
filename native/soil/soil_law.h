// soil/soil_law.h - ground that is no spring: snow that packs, and ground whose sinkage was measured; not a door.
#pragma once
#include "soil/soil_columns.h"

// Does a soil press back by its own law, and not by E/L0 times its depth? Does any of the patch's?
bool dp_law_own(const DpSoil* soil);
bool dp_law_on(const DpSoilPatch* patch);

// What a soil without roots presses back with at a depth below h0 [Pa] >= 0, by whatever law.
// @param width  w, of the contact, the smaller one [m] > 0
double dp_law_pressure(const DpSoil* soil, double width, double depth);

// How deep it is pressed by a pressure, as far as it yields [m] >= 0.
double dp_law_depth(const DpSoil* soil, double width, double pressure);

// soil_layers.c: the same of a kind of ground, which may have layers
double dp_law_kind_pressure(const DpSoilPatch* patch, int kind, double width, double depth);
double dp_law_kind_depth(const DpSoilPatch* patch, int kind, double width, double pressure);

// .. whether what was pressed carries nothing above that depth, as measured ground does; springs always press back
bool dp_law_unloads(const DpSoilPatch* patch, int kind);

// .. nu of a cell that is pressed from one depth to another: of its layers, by what each of them yields.
double dp_law_poisson(const DpSoilPatch* patch, size_t p, double before, double after);

// How many times as hard a cell is as its soil, by roots [-].
double dp_law_firmness(const DpSoilPatch* patch, size_t p);

// The smaller width of what of a sole may carry, its 2 cm from the lowest point up [m].
double dp_law_width(const DpSoilPatch* patch, const DpImprint* imprint);

// The law `sole` on such ground: balance, then press what carries, as dp_soil_compress does on springs.
void dp_law_press(DpSoilPatch* patch, DpImprint* imprint, Sole* sole, double load, double dt,
                  DpPressed* pressed);
