// grass/grass.h - how grass lies between the plants, cell by cell: pressed flat under soles, parted at
// their edge, standing up again as far as its stems are unbroken. MODEL 7.6
//
// Plants are sparse, soles have edges: every planted cell that was touched keeps the lean of one
// stem. It takes memory and time where something touched the grass, and nowhere else.
#pragma once
#include "base/grid.h"
#include "plants/plants.h"

typedef struct DpGrass DpGrass;

// Cell (i, j) has its centre at origin + (i + 0.5, j + 0.5) cell [m]; plants are borrowed.
DpStatus dp_grass_create(DpGrass** grass, const DpPlants* plants, DpGrid grid);
void     dp_grass_destroy(DpGrass* grass);

// Make room where soles can meet grass: reads the plants, which a step does not.
DpStatus dp_grass_ready(DpGrass* grass, const DpPlantCollider* colliders, int count);

// dt seconds: soles (colliders with a bottom) press and part the grass, what nothing holds stands
// up to the share of its stems that is broken. Grass is met on the ground that is given. Once it is
// ready for the same soles, the step may run while the plants move.
DpStatus dp_grass_step(DpGrass* grass, const DpPlantGround* ground,
                       const DpPlantCollider* colliders, int count, double dt);

// Plants have worn within x0..x1, y0..y1 [m].
DpStatus dp_grass_worn(DpGrass* grass, double x0, double y0, double x1, double y1);
// Plants have come or grown there: cells that nothing touched yet will see for themselves.
void dp_grass_grown(DpGrass* grass, double x0, double y0, double x1, double y1);

// Cells (ny, nx) from cell (i0, j0) on: (tip - root) / height sideways, |lean| <= 1, and the share
// of height that is lost, 0..1; 0 where nothing grows or nobody went. NULL is left out.
void dp_grass_read(const DpGrass* grass, long i0, long j0, int nx, int ny, float* lean_x,
                   float* lean_y, float* crushed);
// How the unbroken stems of the cell at a point lie.
DpStemLean dp_grass_stem_at(const DpGrass* grass, double x, double y);

// Tiles of DP_TILE x DP_TILE cells that changed since the last call, in ascending (ty, tx) order.
void dp_grass_changed(DpGrass* grass, void (*visit)(void* context, long tx, long ty),
                      void*    context);

// ---- kept from one run to the next --------------------------------------------------------------

// Write the tiles that something touched, as one chunk of a stream.
void dp_grass_save(const DpGrass* grass, DpStateWriter* writer);

// What was read, until grass takes it in place of what it was.
typedef struct DpGrassState DpGrassState;
// Damaged bytes, and those of cells elsewhere: DP_BAD_FILE.
DpStatus dp_grass_load(const DpGrass* grass, DpStateReader* reader, DpGrassState** state);
// It goes on from there, to the bit; the state is gone afterwards. It cannot fail.
void dp_grass_restore(DpGrass* grass, DpGrassState* state);
void dp_grass_state_destroy(DpGrassState* state);  // not taken; NULL is fine
