// base/noise.h - chance by place: what a point of the ground is like, whatever the cells, the order or the threads.
// MODEL 6.7
//
// Integer hashes of places in metres and own arithmetic: the same bits on every machine. Waves that cells cannot
// hold, shorter than two of them, are left out; those that are left are the same for any cell.
#pragma once
#include "base/grid.h"

// 32 bits of chance for the corner (i, j) of a lattice.
uint32_t dp_noise_bits(int64_t i, int64_t j, uint32_t seed);

// Evenly spread in 0..1, of the lower 16 of some bits.
double dp_noise_unit(uint32_t bits);

// Gradient noise at (u, v) on a lattice of squares 1 wide, of mean 0 and variance 1.
double dp_noise_wave(double u, double v, uint32_t seed);

// e^x, within 1e-5 of it for |x| <= 8; beyond 16 as at 16.
double dp_noise_growth(double x);

// Waves from `longest` down by halves to `shortest` [m], each 0.6 as high as the one before; of mean 0, and of
// variance 1 where cells can hold all of them.
// @param cells  of `grid`, whose middles are asked; out (ny, nx), row 0 the lowest y
void dp_noise_waves(const DpGrid* grid, DpCellRect cells, double longest, double shortest,
                    uint32_t seed, float* out);

// One number for each piece of a ground that is broken into pieces about `size` [m] wide (Voronoi's, of a lattice
// whose points stray), evenly spread with mean 0 and variance 1; 0 where cells cannot hold them.
void dp_noise_pieces(const DpGrid* grid, DpCellRect cells, double size, uint32_t seed, float* out);

// A name of the piece in which each cell's middle lies, never 0; whatever the cells.
void dp_noise_plates(const DpGrid* grid, DpCellRect cells, double size, uint32_t seed,
                     uint32_t* out);
