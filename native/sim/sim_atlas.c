// sim/sim_atlas.c - the pages of a sparse picture: where each lies on the ground, and in the picture.
#include "sim/sim_atlas.h"

#include "base/alloc.h"
#include "base/grid.h"

static int pages_along(int tiles)
{
    return (tiles * DP_TILE + DP_PAGE - 1) / DP_PAGE;
}

static bool place_pages(Atlas* atlas)
{
    const int count = atlas->pages_x * atlas->pages_y;
    for (int k = 0; k < count; ++k) atlas->slot[k] = -1;
    for (int k = 0; k < atlas->pages; ++k) {
        const int32_t x = atlas->page[2 * k], y = atlas->page[2 * k + 1];
        if (x < 0 || y < 0 || x >= atlas->pages_x || y >= atlas->pages_y) return false;
        int32_t* slot = &atlas->slot[y * atlas->pages_x + x];
        if (*slot >= 0) return false;
        *slot = k;
    }
    return true;
}

Atlas* dp_atlas_create(const DpFilmOptions* options, DpStatus* status)
{
    const DpAtlas* wanted = options->atlas;
    *status = DP_BAD_ARGUMENT;
    if (wanted->pages < 1 || wanted->columns < 1 || wanted->rows < 1 ||
        wanted->pages > (int64_t)wanted->columns * wanted->rows)
        return NULL;
    *status = DP_NO_MEMORY;
    Atlas* atlas = dp_alloc(1, sizeof *atlas);
    if (!atlas) return NULL;
    atlas->i0 = options->tile_x * DP_TILE, atlas->j0 = options->tile_y * DP_TILE;
    atlas->pages_x = pages_along(options->tiles_x), atlas->pages_y = pages_along(options->tiles_y);
    atlas->columns = wanted->columns, atlas->rows = wanted->rows;
    atlas->pages = wanted->pages;
    atlas->page = dp_alloc((size_t)wanted->pages * 2, sizeof *atlas->page);
    atlas->slot = dp_alloc((size_t)atlas->pages_x * (size_t)atlas->pages_y, sizeof *atlas->slot);
    if (atlas->page && atlas->slot) {
        for (int k = 0; k < 2 * wanted->pages; ++k) atlas->page[k] = wanted->page[k];
        *status = place_pages(atlas) ? DP_OK : DP_BAD_ARGUMENT;
    }
    if (*status == DP_OK) return atlas;
    dp_atlas_destroy(atlas);
    return NULL;
}

void dp_atlas_destroy(Atlas* atlas)
{
    if (!atlas) return;
    dp_free(atlas->page);
    dp_free(atlas->slot);
    dp_free(atlas);
}

bool dp_atlas_cells(const Atlas* atlas, int index, DpCellRect* cells)
{
    if (index >= atlas->pages) return false;
    *cells = dp_cells(atlas->i0 + (long)atlas->page[2 * index] * DP_PAGE - DP_PAGE_EDGE,
                      atlas->j0 + (long)atlas->page[2 * index + 1] * DP_PAGE - DP_PAGE_EDGE,
                      DP_TILE, DP_TILE);
    return true;
}

// first and last page along one side that show cells of a tile
static void pages_over(long tile, int pages, int* first, int* last)
{
    const long low = tile * DP_TILE - (DP_PAGE + DP_PAGE_EDGE - 1), high = (tile + 1) * DP_TILE - 1;
    *first = low <= 0 ? 0 : (int)((low + DP_PAGE - 1) / DP_PAGE);
    *last = high + DP_PAGE_EDGE < 0 ? -1 : (int)((high + DP_PAGE_EDGE) / DP_PAGE);
    if (*last > pages - 1) *last = pages - 1;
}

void dp_atlas_mark(const Atlas* atlas, long tx, long ty, uint8_t* changed)
{
    const long far_x = atlas->pages_x, far_y = atlas->pages_y;  // tiles are wider than pages
    if (tx < -1 || ty < -1 || tx > far_x || ty > far_y) return;
    int x0, x1, y0, y1;
    pages_over(tx, atlas->pages_x, &x0, &x1);
    pages_over(ty, atlas->pages_y, &y0, &y1);
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const int32_t slot = atlas->slot[y * atlas->pages_x + x];
            if (slot >= 0) changed[slot] = 1;
        }
}
