// refine/refine_wish.c - how fine a box has to be: squares in levels, each twice as large as below.
#include <math.h>

#include "base/alloc.h"
#include "refine/refine_inside.h"

#define MAX_LEVELS 32
#define MAX_SPAN 1073741824.0  // squares side by side, 2^30

typedef struct Square
{
    uint64_t key;  // column and row at its level; EMPTY: no square
    double   size;
} Square;

#define EMPTY UINT64_MAX

typedef struct Level
{
    Square* place;
    size_t  places;  // a power of two
    size_t  used;
} Level;

struct DpWishTree
{
    Level  level[MAX_LEVELS];
    int    levels;
    double low[2];
    double block;
};

static size_t slot_of(const Level* level, uint64_t key)
{
    uint64_t hash = key * UINT64_C(0x9E3779B97F4A7C15);
    hash ^= hash >> 31;
    size_t at = (size_t)hash & (level->places - 1);
    while (level->place[at].key != key && level->place[at].key != EMPTY)
        at = (at + 1) & (level->places - 1);
    return at;
}

static DpStatus level_create(Level* level, size_t expected)
{
    level->places = 16;
    while (level->places < 2 * expected) level->places *= 2;
    level->place = dp_alloc(level->places, sizeof *level->place);
    if (!level->place) return DP_NO_MEMORY;
    for (size_t k = 0; k < level->places; ++k) level->place[k].key = EMPTY;
    return DP_OK;
}

static void level_wish(Level* level, uint64_t column, uint64_t row, double size)
{
    const uint64_t key = column << 32 | row;
    Square*        square = &level->place[slot_of(level, key)];
    if (square->key == EMPTY) {
        *square = (Square){key, size};
        level->used += 1;
    } else if (size < square->size)
        square->size = size;
}

// the level above: every square of twice the edge wishes for the least of its four
static DpStatus level_above(const Level* below, Level* level)
{
    const DpStatus status = level_create(level, below->used);
    if (status != DP_OK) return status;
    for (size_t k = 0; k < below->places; ++k) {
        const Square* square = &below->place[k];
        if (square->key != EMPTY)
            level_wish(level, (square->key >> 32) / 2, (square->key & UINT32_MAX) / 2,
                       square->size);
    }
    return DP_OK;
}

static DpStatus check(const DpWishes* wishes, double low[2])
{
    if (wishes->count < 0 || !(wishes->block > 0.0) || !isfinite(wishes->block))
        return DP_BAD_ARGUMENT;
    double high[2] = {-INFINITY, -INFINITY};
    low[0] = low[1] = INFINITY;
    for (int k = 0; k < wishes->count; ++k) {
        if (!(wishes->size[k] > 0.0) || !isfinite(wishes->size[k])) return DP_BAD_ARGUMENT;
        for (int axis = 0; axis < 2; ++axis) {
            const double at = wishes->corner[2 * k + axis];
            if (!isfinite(at)) return DP_BAD_ARGUMENT;
            low[axis] = fmin(low[axis], at);
            high[axis] = fmax(high[axis], at);
        }
    }
    for (int axis = 0; axis < 2 && wishes->count > 0; ++axis)
        if (!((high[axis] - low[axis]) / wishes->block < MAX_SPAN)) return DP_BAD_ARGUMENT;
    return DP_OK;
}

DpStatus dp_wish_create(const DpWishes* wishes, DpWishTree** out)
{
    *out = NULL;
    DpWishTree* tree = dp_alloc(1, sizeof *tree);
    if (!tree) return DP_NO_MEMORY;
    tree->block = wishes->block;
    DpStatus status = check(wishes, tree->low);
    if (status == DP_OK && wishes->count > 0) {
        status = level_create(&tree->level[0], (size_t)wishes->count);
        tree->levels = 1;
    }
    for (int k = 0; k < wishes->count && status == DP_OK; ++k) {
        const double column = (wishes->corner[2 * k] - tree->low[0]) / wishes->block;
        const double row = (wishes->corner[2 * k + 1] - tree->low[1]) / wishes->block;
        level_wish(&tree->level[0], (uint64_t)(column + 0.5), (uint64_t)(row + 0.5),
                   wishes->size[k]);
    }
    while (status == DP_OK && tree->levels > 0 && tree->level[tree->levels - 1].used > 1) {
        status = level_above(&tree->level[tree->levels - 1], &tree->level[tree->levels]);
        tree->levels += 1;
    }
    if (status != DP_OK) {
        dp_wish_destroy(tree);
        return status;
    }
    *out = tree;
    return DP_OK;
}

void dp_wish_destroy(DpWishTree* tree)
{
    if (!tree) return;
    for (int k = 0; k < tree->levels; ++k) dp_free(tree->level[k].place);
    dp_free(tree);
}

// the squares of a level that the span from low to high reaches into, none below 0
static int64_t square_at(double at, double edge)
{
    return (int64_t)fmax(-1.0, fmin(floor(at / edge), MAX_SPAN));
}

double dp_wish_within(const DpWishTree* tree, const double low[2], const double high[2])
{
    double least = INFINITY;
    if (tree->levels == 0) return least;
    const double extent = fmax(high[0] - low[0], high[1] - low[1]);
    double       edge = tree->block;
    int          k = 0;
    for (; k < tree->levels - 1 && edge < extent; ++k) edge *= 2.0;
    const Level*  level = &tree->level[k];
    const int64_t i0 = square_at(low[0] - tree->low[0], edge);
    const int64_t j0 = square_at(low[1] - tree->low[1], edge);
    const int64_t i1 = square_at(high[0] - tree->low[0], edge);
    const int64_t j1 = square_at(high[1] - tree->low[1], edge);
    if (k == tree->levels - 1)  // one square, in the corner
        return i0 <= 0 && j0 <= 0 && i1 >= 0 && j1 >= 0 ? level->place[slot_of(level, 0)].size
                                                        : INFINITY;
    for (int64_t j = j0 < 0 ? 0 : j0; j <= j1; ++j)
        for (int64_t i = i0 < 0 ? 0 : i0; i <= i1; ++i) {
            const Square* square = &level->place[slot_of(level, (uint64_t)i << 32 | (uint64_t)j)];
            if (square->key != EMPTY) least = fmin(least, square->size);
        }
    return least;
}
