// Rings around the touched cells. TRAIL 4.2.2.
//
// Steps over 8 neighbours are the chessboard distance, which two passes over the grid give exactly.
#include "base/assert.h"
#include "base/grid.h"
#include "base/wide.h"
#include "imprint/imprint.h"
#include "imprint/imprint_raster.h"

// are any cells of a row touched? Every other one becomes far
DP_CLONES static int any_touched(int32_t* row, int width)
{
    int any = 0;
    for (int i = 0; i < width; ++i) {
        any |= row[i] == 0;
        row[i] = row[i] == 0 ? 0 : DP_RING_FAR;
    }
    return any;
}

// the rectangle about the touched cells; every other cell becomes far
static DpCellRect touched_box(int32_t* ring, const DpSoilPatch* patch)
{
    DpCellRect box = {patch->nx, 0, patch->ny, 0};
    for (int j = 0; j < patch->ny; ++j) {
        int32_t* row = ring + (size_t)j * (size_t)patch->row;
        if (!any_touched(row, patch->nx)) continue;
        int first = 0, last = patch->nx;
        while (row[first] != 0) ++first;
        while (row[last - 1] != 0) --last;
        box.i0 = first < box.i0 ? first : box.i0;
        box.i1 = last > box.i1 ? last : box.i1;
        box.j0 = j < box.j0 ? j : box.j0;
        box.j1 = j + 1;
    }
    return box;
}

DP_INLINE int32_t nearer(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

// one row learns from the row before it: straight and slanting steps
DP_INLINE void from_row(int32_t* restrict row, const int32_t* restrict past, int width)
{
    if (width == 1) {
        row[0] = nearer(row[0], past[0] + 1);
        return;
    }
    row[0] = nearer(row[0], nearer(past[0], past[1]) + 1);
    for (int i = 1; i < width - 1; ++i)
        row[i] = nearer(row[i], nearer(nearer(past[i - 1], past[i]), past[i + 1]) + 1);
    row[width - 1] = nearer(row[width - 1], nearer(past[width - 1], past[width - 2]) + 1);
}

DP_INLINE void along_row(int32_t* row, int width)
{
    for (int i = 1; i < width; ++i) row[i] = nearer(row[i], row[i - 1] + 1);
    for (int i = width - 2; i >= 0; --i) row[i] = nearer(row[i], row[i + 1] + 1);
}

DP_CLONES static void number(int32_t* ring, int row, int width, int height, int rings)
{
    along_row(ring, width);
    for (int j = 1; j < height; ++j) {
        int32_t* here = ring + (size_t)j * (size_t)row;
        along_row(here, width);
        from_row(here, here - row, width);
    }
    for (int j = height - 1; j >= 0; --j) {
        int32_t* here = ring + (size_t)j * (size_t)row;
        if (j < height - 1) from_row(here, here + row, width);
        for (int i = 0; i < width; ++i) here[i] = here[i] <= rings ? here[i] : DP_RING_FAR;
    }
}

void dp_imprint_rings(DpImprint* imprint, const DpSoilPatch* patch, int rings)
{
    DP_ASSERT(rings >= 0 && rings < DP_RING_FAR);
    const DpCellRect touched = touched_box(imprint->ring, patch);
    if (dp_cells_empty(touched)) return;
    const DpCellRect at =
        dp_cells_common(dp_cells_grown(touched, rings), dp_cells(0, 0, patch->nx, patch->ny));
    int32_t* from = imprint->ring + (size_t)at.j0 * (size_t)patch->row + (size_t)at.i0;
    number(from, patch->row, (int)(at.i1 - at.i0), (int)(at.j1 - at.j0), rings);
}
