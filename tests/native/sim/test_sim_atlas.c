// tests of sim_atlas.c: which pages of a sparse picture show a tile of ground. MODEL 8.4
#include "sim/sim_atlas.h"

#include "base/alloc.h"
#include "base/grid.h"
#include "check.h"

#define TILES_X 34  // so many that pages, which are narrower, fall on all places of a tile
#define TILES_Y 2
#define PAGES_X 37  // of 60 cells over 34 * 64
#define PAGES_Y 3

static const DpFilmOptions film = {
    .tile_x = -5, .tile_y = 3, .tiles_x = TILES_X, .tiles_y = TILES_Y};

static Atlas* with_pages(const int32_t* page, int pages, int columns, int rows, DpStatus* status)
{
    const DpAtlas wanted = {columns, rows, pages, page};
    DpFilmOptions options = film;
    options.atlas = &wanted;
    return dp_atlas_create(&options, status);
}

// all pages but every seventh
static int most_pages(int32_t* page)
{
    int count = 0;
    for (int k = 0; k < PAGES_X * PAGES_Y; ++k)
        if (k % 7) page[2 * count] = k % PAGES_X, page[2 * count++ + 1] = k / PAGES_X;
    return count;
}

TEST(pages_that_show_a_tile_are_marked_and_no_others)
{
    int32_t   page[2 * PAGES_X * PAGES_Y];
    const int count = most_pages(page);
    DpStatus  status;
    Atlas*    atlas = with_pages(page, count, 12, 10, &status);
    CHECK(status == DP_OK && atlas);
    for (long ty = -2; ty < TILES_Y + 2; ++ty)
        for (long tx = -2; tx < TILES_X + 2; ++tx) {
            uint8_t          changed[PAGES_X * PAGES_Y] = {0};
            const DpCellRect tile = dp_cells((film.tile_x + tx) * DP_TILE,
                                             (film.tile_y + ty) * DP_TILE, DP_TILE, DP_TILE);
            dp_atlas_mark(atlas, tx, ty, changed);
            for (int k = 0; k < count; ++k) {
                DpCellRect cells;
                CHECK(dp_atlas_cells(atlas, k, &cells));
                CHECK(changed[k] == !dp_cells_empty(dp_cells_common(cells, tile)));
            }
        }
    dp_atlas_destroy(atlas);
    CHECK(dp_bytes_live() == 0);
}

TEST(a_page_has_its_own_cells_and_two_of_its_neighbours)
{
    const int32_t page[] = {4, 1, 0, 0};
    DpStatus      status;
    Atlas*        atlas = with_pages(page, 2, 2, 1, &status);
    DpCellRect    cells;
    CHECK(status == DP_OK && dp_atlas_cells(atlas, 0, &cells));
    CHECK(cells.i0 == film.tile_x * DP_TILE + 4 * DP_PAGE - DP_PAGE_EDGE);
    CHECK(cells.j0 == film.tile_y * DP_TILE + DP_PAGE - DP_PAGE_EDGE);
    CHECK(cells.i1 - cells.i0 == DP_TILE && cells.j1 - cells.j0 == DP_TILE);
    CHECK(!dp_atlas_cells(atlas, 2, &cells));  // no page lies there
    dp_atlas_destroy(atlas);
}

TEST(pages_that_are_none_come_twice_or_do_not_fit_are_refused)
{
    const int32_t        twice[] = {1, 1, 1, 1}, left[] = {-1, 0}, beyond[] = {PAGES_X, 0};
    const int32_t        below[] = {0, -1}, above[] = {0, PAGES_Y};
    const int32_t* const one[] = {left, beyond, below, above};
    DpStatus             status;
    CHECK(!with_pages(twice, 2, 2, 1, &status) && status == DP_BAD_ARGUMENT);
    CHECK(!with_pages(twice, 2, 1, 1, &status) && status == DP_BAD_ARGUMENT);
    CHECK(!with_pages(twice, 0, 1, 1, &status) && status == DP_BAD_ARGUMENT);
    for (int k = 0; k < 4; ++k)
        CHECK(!with_pages(one[k], 1, 1, 1, &status) && status == DP_BAD_ARGUMENT);
    for (int n = 0; n < 3; ++n) {
        dp_alloc_fail_after(n);
        CHECK(!with_pages(twice, 1, 1, 1, &status) && status == DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
    }
    CHECK(dp_bytes_live() == 0);
}

int main(void)
{
    RUN(pages_that_show_a_tile_are_marked_and_no_others);
    RUN(a_page_has_its_own_cells_and_two_of_its_neighbours);
    RUN(pages_that_are_none_come_twice_or_do_not_fit_are_refused);
    return check_done();
}
