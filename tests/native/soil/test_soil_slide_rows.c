// tests of the two stencils by which soil slides, soil_slide_rows.c and soil_slide_walls.c, against what the model says
// word by word. TRAIL (14)-(16), MODEL 6.8
#include "check.h"
#include "soil/soil_slide.h"

#define WIDE 37  // cells of a row, no multiple of a wide register
#define ROW (WIDE + 4)
#define HIGH 5
#define CELLS (ROW * HIGH)
#define FILM 2e-5f
#define HELD 0.25

static float firm[CELLS], height[CELLS], heap[CELLS], fall[CELLS], slack[CELLS], share[CELLS],
    give[CELLS];
static float  base[CELLS], steep[CELLS];
static double sum[CELLS], floor_at[CELLS];

static const int    OFFSET[8] = {1, -1, ROW, -ROW, ROW + 1, -ROW - 1, ROW - 1, -ROW + 1};
static const double FAR[8] = {1.0,
                              1.0,
                              1.0,
                              1.0,
                              1.4142135623730951,
                              1.4142135623730951,
                              1.4142135623730951,
                              1.4142135623730951};

static size_t cell_at(int i, int j)
{
    return (size_t)((j + 1) * ROW + i + 2);
}

// cells of all kinds: bare, under a film, thick; gentle, steep; beside ground nobody can go to
static void lay(unsigned* seed)
{
    for (int k = 0; k < CELLS; ++k) {
        const double kind = check_random(seed), rough = kind < 0.3 ? 5e-4 : 2e-2;
        firm[k] = (float)(rough * check_random(seed));
        heap[k] = (float)(kind < 0.2   ? 0.0
                          : kind < 0.5 ? 2.0 * (double)FILM * check_random(seed)
                                       : 0.02 * check_random(seed));
        if (check_random(seed) < 0.05) firm[k] = BARRIER, heap[k] = 0.0f;
        height[k] = firm[k] + heap[k];
        fall[k] = (float)(0.004 + 0.004 * check_random(seed));
        slack[k] = (float)(check_random(seed) < 0.5 ? 2e-4 : 6e-3);
        base[k] = firm[k] < BARRIER ? (float)(0.01 * check_random(seed)) : 0.0f;
        steep[k] = check_random(seed) < 0.2 ? INFINITY : (float)(0.01 * check_random(seed));
        sum[k] = (double)heap[k], floor_at[k] = (double)firm[k];
    }
}

static double least(double a, double b)
{
    return a < b ? a : b;
}

// how much of its excess a cell gives of it all, by how far the steepest neighbour is beyond rest
static double eagerness(double worst, double slack_of)
{
    return least(1.0, fmax(0.0, worst - HELD * slack_of) / (HELD * slack_of));
}

// TRAIL (14): by how much a cell is higher than it may be over its q-th neighbour
static double excess(size_t k, int q)
{
    return fmax(
        0.0, (double)height[k] - (double)height[k + (size_t)OFFSET[q]] - (double)fall[k] * FAR[q]);
}

TEST(a_row_gives_what_the_model_says)
{
    unsigned seed = 7;
    int      moved = 0, stood = 0, restless_rows = 0;
    for (int turn = 0; turn < 60; ++turn) {
        lay(&seed);
        if (turn % 3 == 0)  // rows that are nearly at rest
            for (int k = 0; k < CELLS; ++k)
                height[k] = firm[k] = 0.0f,
                heap[k] = (float)(turn % 2 ? 4.5e-3 * check_random(&seed) : 0.4 * (double)FILM),
                height[k] = heap[k], slack[k] = 1e-3f;
        const float most = turn % 4 == 3 ? 2e-3f : BARRIER;
        int         want_moves = 0, want_restless = 0, close = 0;
        const int   told =
            dp_slide_decide(share + cell_at(0, 1), give + cell_at(0, 1), height + cell_at(0, 1),
                            heap + cell_at(0, 1), fall + cell_at(0, 1), slack + cell_at(0, 1), ROW,
                            WIDE, FILM, most);
        for (int i = 0; i < WIDE; ++i) {
            const size_t k = cell_at(i, 1);
            double       all = 0.0, counted = 0.0, worst = 0.0;
            for (int q = 0; q < 8; ++q) {
                const double e = excess(k, q);
                all += e, counted += least(1.0, e / (double)FILM), worst = fmax(worst, e / FAR[q]);
            }
            const double part = 1.0 / (1.0 + counted),
                         has = least(1.0,
                                     least((double)heap[k], (double)most) / (all * part + 1e-35));
            const double thin =
                least(1.0, (double)heap[k] / (double)FILM);  // less of what is hardly there
            const double want =
                has * part * eagerness(worst, (double)slack[k]) * thin;  // TRAIL (15)
            if (firm[k] < BARRIER) {
                CHECK_NEAR(share[k], want, 2e-3 * want + 1e-6);
                CHECK_NEAR(give[k], (double)share[k] * all, 1e-5 * all + 1e-9);
                CHECK((double)give[k] <= least((double)heap[k], (double)most) * (1.0 + 1e-6));
            }
            want_moves |= give[k] > 0.0f;
            want_restless |= heap[k] > FILM && worst > (double)slack[k];
            float     its_share, its_give;  // a row of this cell alone says what it does to the row
            const int alone = dp_slide_decide(&its_share, &its_give, height + k, heap + k, fall + k,
                                              slack + k, ROW, 1, FILM, most);
            if (fabs(worst - (double)slack[k]) > 1e-6 && firm[k] < BARRIER)
                CHECK(((alone & ROW_RESTLESS) != 0) ==
                      (heap[k] > FILM && worst > (double)slack[k]));
            close |= heap[k] > FILM && fabs(worst - (double)slack[k]) < 1e-6;
        }
        if (!close) {
            CHECK(((told & ROW_MOVES) != 0) == want_moves);
            CHECK(((told & ROW_RESTLESS) != 0) == want_restless);
        }
        moved += want_moves, stood += !want_restless, restless_rows += want_restless;
    }
    printf("  %d rows moved, %d had to, %d need not\n", moved, restless_rows, stood);
    CHECK(moved > 10 && restless_rows > 10 && stood > 5);
}

TEST(what_is_given_is_taken)
{
    unsigned seed = 3;
    for (int turn = 0; turn < 20; ++turn) {
        lay(&seed);
        for (int k = 0; k < CELLS; ++k)
            if (firm[k] >= BARRIER || k < 2 * ROW || k >= CELLS - 2 * ROW || k % ROW < 3 ||
                k % ROW >= ROW - 3)
                heap[k] = 0.0f, height[k] = firm[k], sum[k] = 0.0;  // nothing leaves
        memset(share, 0, sizeof share), memset(give, 0, sizeof give);
        double before = 0.0, after = 0.0, want[CELLS];
        for (int j = 0; j < HIGH - 2; ++j)
            dp_slide_decide(share + cell_at(0, j), give + cell_at(0, j), height + cell_at(0, j),
                            heap + cell_at(0, j), fall + cell_at(0, j), slack + cell_at(0, j), ROW,
                            WIDE, FILM, BARRIER);
        for (int j = 0; j < HIGH - 2; ++j)
            for (int i = 0; i < WIDE; ++i) {
                const size_t k = cell_at(i, j);
                want[k] = fmax(0.0, sum[k] - (double)give[k]);
                for (int q = 0; q < 8; ++q) {
                    const size_t from = k + (size_t)OFFSET[q];
                    want[k] +=
                        (double)share[from] * fmax(0.0, (double)height[from] - (double)height[k] -
                                                            (double)fall[from] * FAR[q]);
                }
                before += sum[k];
            }
        for (int j = 0; j < HIGH - 2; ++j)
            dp_slide_take(sum + cell_at(0, j), give + cell_at(0, j), height + cell_at(0, j),
                          share + cell_at(0, j), fall + cell_at(0, j), ROW, WIDE);
        for (int j = 0; j < HIGH - 2; ++j) {
            dp_slide_raise(height + cell_at(0, j), heap + cell_at(0, j), firm + cell_at(0, j),
                           sum + cell_at(0, j), WIDE);
            for (int i = 0; i < WIDE; ++i) {
                const size_t k = cell_at(i, j);
                CHECK_NEAR(sum[k], want[k], 1e-5 * want[k] + 1e-9);  // TRAIL (16)
                CHECK(heap[k] == (float)sum[k] && height[k] == firm[k] + heap[k]);
                after += sum[k];
            }
        }
        CHECK_CLOSE(after, before, 1e-6);
    }
}

// by how much firm ground stands higher over its q-th neighbour than its wall, and the ground of before, let it
static double wall_over(size_t k, int q)
{
    const size_t n = k + (size_t)OFFSET[q];
    const double may = fmax((double)steep[k] * FAR[q], (double)base[k] - (double)base[n]);
    return isinf(may) ? 0.0 : fmax(0.0, (double)firm[k] - (double)height[n] - may);
}

TEST(walls_fall_as_the_model_says)
{
    const double most = 1.5e-3;
    unsigned     seed = 11;
    int          fell = 0, stood = 0, may_fall = 0, may_stand = 0;
    for (int turn = 0; turn < 60; ++turn) {
        lay(&seed);
        if (turn % 3 == 0)  // rows whose walls are about as steep as they may be
            for (int k = 0; k < CELLS; ++k)
                firm[k] = (float)(turn % 2 ? 3e-3 * check_random(&seed) : 1e-4),
                height[k] = firm[k] + heap[k], slack[k] = 2e-3f;
        const size_t at = cell_at(0, 1);
        const Walls  walls = {base + at, steep + at, slack + at};
        int          want_moves = 0, want_restless = 0, close = 0;
        const int told = dp_walls_decide(&walls, share + at, give + at, firm + at, height + at, ROW,
                                         WIDE, FILM, (float)most);
        for (int i = 0; i < WIDE; ++i) {
            const size_t k = cell_at(i, 1);
            double       all = 0.0, counted = 0.0, worst = 0.0;
            for (int q = 0; q < 8; ++q) {
                const double e = wall_over(k, q);
                all += e, counted += least(1.0, e / (double)FILM), worst = fmax(worst, e / FAR[q]);
            }
            const double even = 0.5 * eagerness(worst, (double)slack[k]) / (1.0 + counted);
            if (firm[k] < BARRIER) {
                CHECK_NEAR(share[k], least(even, most / (all + 1e-35)), 2e-3);
                CHECK_NEAR(give[k], (double)share[k] * all, 1e-5 * all + 1e-9);
                CHECK((double)give[k] <= most * (1.0 + 1e-6));
            }
            want_moves |= give[k] > 0.0f;
            want_restless |= worst > (double)slack[k];
            float       its_share, its_give;
            const Walls its = {base + k, steep + k, slack + k};
            const int   alone = dp_walls_decide(&its, &its_share, &its_give, firm + k, height + k,
                                                ROW, 1, FILM, (float)most);
            CHECK(dp_walls_fall(&its, firm + k, height + k, ROW, 1) == (its_share > 0.0f));
            may_fall += its_share > 0.0f, may_stand += !(its_share > 0.0f);
            if (fabs(worst - (double)slack[k]) > 1e-6 && firm[k] < BARRIER)
                CHECK(((alone & ROW_RESTLESS) != 0) == (worst > (double)slack[k]));
            close |= fabs(worst - (double)slack[k]) < 1e-6;
        }
        if (!close) {
            CHECK(((told & ROW_MOVES) != 0) == want_moves);
            CHECK(((told & ROW_RESTLESS) != 0) == want_restless);
        }
        CHECK(dp_walls_fall(&walls, firm + at, height + at, ROW, WIDE) == want_moves);
        fell += want_restless, stood += !want_restless;
    }
    printf("  walls of %d rows had to fall, of %d not\n", fell, stood);
    CHECK(fell > 10 && stood > 5 && may_fall > 100 && may_stand > 100);
}

TEST(what_falls_lies_on_the_neighbours_heaps)
{
    unsigned seed = 13;
    lay(&seed);
    for (int k = 0; k < CELLS; ++k)
        if (firm[k] >= BARRIER || k < 2 * ROW || k >= CELLS - 2 * ROW || k % ROW < 3 ||
            k % ROW >= ROW - 3)
            firm[k] = 0.0f, height[k] = heap[k], base[k] = 0.0f, steep[k] = INFINITY,
            floor_at[k] = 0.0;
    memset(share, 0, sizeof share), memset(give, 0, sizeof give);
    for (int j = 0; j < HIGH - 2; ++j) {
        const size_t at = cell_at(0, j);
        const Walls  walls = {base + at, steep + at, slack + at};
        dp_walls_decide(&walls, share + at, give + at, firm + at, height + at, ROW, WIDE, FILM,
                        1.0f);
    }
    double before = 0.0, after = 0.0, fell = 0.0;
    for (int k = 0; k < CELLS; ++k) before += sum[k] + floor_at[k];
    for (int j = 0; j < HIGH - 2; ++j) {
        const size_t at = cell_at(0, j);
        const Walls  walls = {base + at, steep + at, slack + at};
        double       want[WIDE];
        for (int i = 0; i < WIDE; ++i) {
            want[i] = sum[at + (size_t)i];
            for (int q = 0; q < 8; ++q) {
                const size_t from = at + (size_t)i + (size_t)OFFSET[q];
                want[i] += (double)share[from] * wall_over(from, q ^ 1);
            }
            fell += (double)give[at + (size_t)i];
        }
        dp_walls_take(&walls, sum + at, floor_at + at, share + at, give + at, firm + at,
                      height + at, ROW, WIDE);
        for (int i = 0; i < WIDE; ++i)
            CHECK_NEAR(sum[at + (size_t)i], want[i], 1e-5 * want[i] + 1e-9);
    }
    for (int k = 0; k < CELLS; ++k) after += sum[k] + floor_at[k];
    CHECK(fell > 1e-3);
    CHECK_NEAR(after, before, 1e-6 * fell);
    dp_walls_lower(firm, floor_at, CELLS);
    for (int k = 0; k < CELLS; ++k) CHECK(firm[k] == (float)floor_at[k]);
}

int main(void)
{
    RUN(a_row_gives_what_the_model_says);
    RUN(what_is_given_is_taken);
    RUN(walls_fall_as_the_model_says);
    RUN(what_falls_lies_on_the_neighbours_heaps);
    return check_done();
}
