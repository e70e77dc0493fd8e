// sim/sim_atlas.h - which cells the tiles of a sparse picture show. Only the files of this room come in here.
//
//   tiles of ground, all of a rectangle ---pages that are wanted---> a picture of these alone, DP_TILE a side
//
// A page shows DP_PAGE x DP_PAGE cells and DP_PAGE_EDGE more all round, those of its neighbours, so that whoever looks
// between cells need not look for another page. MODEL 8.1
#pragma once
#include "sim/sim_film.h"

typedef struct Atlas
{
    long     i0, j0;            // cell at the lower left corner of page (0, 0), without its edge
    int      pages_x, pages_y;  // over the whole rectangle
    int      columns, rows;     // of the picture
    int      pages;             // that are in it
    int32_t* page;              // x and y of each (pages, 2)
    int32_t* slot;  // number of a page in the picture, -1 = not in it (pages_y, pages_x)
} Atlas;

// NULL without memory, or *status DP_BAD_ARGUMENT: pages that are none, come twice, or do not fit.
Atlas* dp_atlas_create(const DpFilmOptions* options, DpStatus* status);
void   dp_atlas_destroy(Atlas* atlas);
// The cells of a tile of the picture; false: no page lies there.
bool dp_atlas_cells(const Atlas* atlas, int index, DpCellRect* cells);
// Mark the tiles of the picture that show a part of a tile of ground, by its place in the rectangle.
void dp_atlas_mark(const Atlas* atlas, long tx, long ty, uint8_t* changed);
