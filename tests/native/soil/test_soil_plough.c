// a sole that slides while it presses cuts what is in its way. MODEL 6.18
#include "check.h"
#include "ground.h"

#define NX 120
#define NY 60
#define LENGTH 0.3
#define WIDTH 0.2
#define DEPTH 0.03

static DpSoil sand(void)
{
    DpSoil soil = dp_soil_default();
    soil.poisson_ratio = 0.3f;
    return soil;
}

// what presses DEPTH deep, by either law
static double load_of(const DpSoil* soil)
{
    return DEPTH * (double)soil->young_modulus / (double)soil->layer_depth * LENGTH * WIDTH;
}

static const BoxSole SOLE = {.x = -0.3, .z = 0.0, .length = LENGTH, .width = WIDTH};

// one step of a sole that presses `heavier` times as hard
static DpPressed stamp(Ground* ground, BoxSole sole, DpContactLaw law, DpSlide* slide, double dt,
                       double heavier)
{
    static const float met[NX * NY];  // level ground, as it was when the sole came
    float              goal[NX * NY];
    DpPressed          pressed;
    const DpFootForce  foot = ground_load(heavier * load_of(&ground->soil[0]));
    ground_sole(ground, sole);
    ground->imprint.slide = slide;
    ground->imprint.goal = goal;
    ground->imprint.met = law == DP_CONTACT_UNIFORM ? met : NULL;
    CHECK(dp_soil_compress(&ground->patch, &ground->imprint, &foot, law, dt, &pressed) == DP_OK);
    ground->imprint.slide = NULL;
    return pressed;
}

static DpPressed step(Ground* ground, BoxSole sole, DpContactLaw law, DpSlide* slide, double dt)
{
    return stamp(ground, sole, law, slide, dt, 1.0);
}

static void add(DpPressed* sum, DpPressed one)
{
    sum->firm += one.firm, sum->loose += one.loose, sum->displaced += one.displaced;
    sum->cut_firm += one.cut_firm, sum->cut_loose += one.cut_loose;
    sum->cut_x += one.cut_x, sum->cut_y += one.cut_y;
}

// stands until it has sunk, then slides `far` in so many steps along its heading
static DpPressed drag(Ground* ground, BoxSole sole, DpContactLaw law, double far, int steps)
{
    const double tau = (double)ground->soil[0].settle_time, way = far / steps;
    const double x = cos(sole.heading), y = sin(sole.heading);
    DpSlide      slide = {.at = {way * x, way * y}};
    DpPressed    sum = {0};
    step(ground, sole, law, NULL, 2.0 * tau);
    for (int k = 0; k < steps; ++k) {
        sole.x += way * x, sole.y += way * y;
        add(&sum, step(ground, sole, law, &slide, 0.02 * tau));
    }
    return sum;
}

TEST(all_that_it_slides_over_is_cut_and_little_of_it_pressed)
{
    for (int law = 0; law < 2; ++law)
        for (int steps = 20; steps <= 320; steps *= 4) {  // up to a cell, and a sixteenth of one
            Ground          g = ground_make(NX, NY, 0.01, sand());
            const DpPressed p = drag(&g, SOLE, (DpContactLaw)law, 0.2, steps);
            const double    track = DEPTH * WIDTH * 0.2;
            CHECK_CLOSE(p.cut_firm, track, 0.05);
            CHECK_CLOSE(p.cut_firm + p.firm, track, 0.03);
            CHECK_NEAR(p.cut_loose, 0.0, 1e-12);
            CHECK_CLOSE(p.cut_x, p.cut_firm, 1e-6);
            CHECK_NEAR(p.cut_y, 0.0, 1e-9);
            CHECK_NEAR(ground_max(&g, g.compression), DEPTH, 1e-4);
            ground_free(&g);
        }
}

// at no moment is more cut than was slid over by then, though cells are covered by leaps
TEST(nothing_is_cut_ahead_of_time)
{
    Ground       g = ground_make(NX, NY, 0.01, sand());
    const double tau = (double)g.soil[0].settle_time, by = 0.01 / 16.0;
    BoxSole      sole = SOLE;
    DpSlide      slide = {.at = {by, 0.0}};
    double       cut = 0.0;
    step(&g, sole, DP_CONTACT_SOLE, NULL, 2.0 * tau);
    for (int k = 1; k <= 64; ++k) {
        sole.x += by;
        cut += step(&g, sole, DP_CONTACT_SOLE, &slide, 0.02 * tau).cut_firm;
        CHECK(cut <= 1.02 * k * by * DEPTH * WIDTH);
    }
    CHECK(cut > 0.8 * 64.0 * by * DEPTH * WIDTH);
    ground_free(&g);
}

// what was slid over where nothing was in the way is no debt: who stamps afterwards presses
TEST(trenches_leave_nothing_to_be_cut_later)
{
    Ground       g = ground_make(NX, NY, 0.01, sand());
    const double tau = (double)g.soil[0].settle_time, by = 0.01 / 4.0, pitch = 0.1;
    BoxSole      sole = SOLE;
    DpSlide      slide = {.at = {by, 0.0}};
    sole.pitch = pitch;  // all of its underside is lower than what was there before
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX / 2; ++i) g.compression[j * NX + i] = 0.08f;
    for (int k = 0; k < 120; ++k) {
        sole.x += by;
        step(&g, sole, DP_CONTACT_SOLE, &slide, 0.02 * tau);
    }
    sole.x += by;  // half of it is beyond the trench
    const DpPressed p = stamp(&g, sole, DP_CONTACT_SOLE, &slide, 0.02 * tau, 3.0);
    CHECK(p.cut_firm > 0.0);
    // no more than of one cell's way, by the underside and at the front; the trench would be ten times that
    CHECK(p.cut_firm <= 2.0 * pitch * (0.01 + by) * LENGTH * WIDTH);
    ground_free(&g);
}

// soil that yields late under the middle of a flat sole, which slides by cells, is pressed and not cut
TEST(the_middle_of_a_fast_sole_is_pressed)
{
    Ground       g = ground_make(NX, NY, 0.01, sand());
    const double tau = (double)g.soil[0].settle_time;
    BoxSole      sole = SOLE;
    DpSlide      slide = {.at = {0.02, 0.0}};
    const int    middle = NY / 2 * NX + (int)((sole.x - g.patch.x0) / 0.01);
    g.soil[1].settle_time *= 10.0f;
    for (int k = -3; k < 4; ++k) g.kind[middle + k] = 1;
    step(&g, sole, DP_CONTACT_SOLE, NULL, 0.5 * tau);
    const double before = (double)g.compression[middle];
    sole.x += 0.02;
    const DpPressed p = step(&g, sole, DP_CONTACT_SOLE, &slide, 0.02 * tau);
    CHECK(p.cut_firm > 0.0);
    CHECK_NEAR((double)g.compression[middle] - before, 0.002 * DEPTH, 0.0005 * DEPTH);
    ground_free(&g);
}

// what only hovers over loose soil has not come over it: it is swept where the sole comes down to it
TEST(a_raised_front_sweeps_where_it_touches)
{
    Ground       g = ground_make(NX, NY, 0.01, sand());
    const double tau = (double)g.soil[0].settle_time;
    BoxSole      sole = SOLE;
    DpSlide      slide = {.at = {0.01, 0.0}};
    double       loose = 0.0;
    sole.pitch = 0.8;
    for (int k = 0; k < NX * NY; ++k) g.compression[k] = 0.1f, g.heap[k] = 0.09f;
    step(&g, sole, DP_CONTACT_SOLE, NULL, 2.0 * tau);
    for (int k = 0; k < 10; ++k) {
        sole.x += 0.01;
        loose += step(&g, sole, DP_CONTACT_SOLE, &slide, 0.02 * tau).cut_loose;
    }
    CHECK_CLOSE(loose, 0.09 * WIDTH * 0.1, 0.05);
    ground_free(&g);
}

// as much in cells of any size and aslant
TEST(cells_and_headings_do_not_matter)
{
    for (int k = 0; k < 3; ++k) {
        const double cell[] = {0.02, 0.01, 0.01}, heading[] = {0.0, 0.0, 0.6};
        Ground       g = ground_make(k ? NX : NX / 2, k ? NY : NY / 2, cell[k], sand());
        BoxSole      sole = SOLE;
        sole.heading = heading[k];
        sole.y = k == 2 ? -0.1 : 0.003;
        sole.x = k == 2 ? -0.15 : -0.3;
        const DpPressed p = drag(&g, sole, DP_CONTACT_SOLE, 0.15, 40);
        CHECK_CLOSE(p.cut_firm, DEPTH * WIDTH * 0.15, 0.07);
        CHECK_CLOSE(p.cut_x, p.cut_firm * cos(heading[k]), 1e-5);
        ground_free(&g);
    }
}

// a sole that does not slide has cut nothing, and one that hardly does hardly anything though it has yet to sink
TEST(who_stands_cuts_nothing)
{
    Ground  g = ground_make(NX, NY, 0.01, sand());
    DpSlide stands = {.owed = 0.0};
    for (int k = 0; k < 20; ++k) {
        const DpPressed p = step(&g, SOLE, DP_CONTACT_SOLE, &stands, 0.001);
        CHECK(p.cut_firm <= 0.0 && p.cut_loose <= 0.0 && p.firm > 0.0);
    }
    DpSlide         slides = {.at = {1e-4, 0.0}};
    const DpPressed p = step(&g, SOLE, DP_CONTACT_SOLE, &slides, 0.001);
    CHECK(p.cut_firm <= 1e-4 * WIDTH * DEPTH);
    ground_free(&g);
}

// one that comes down on its front, as a foot that rolls, meets nothing from the side
TEST(what_only_comes_down_presses)
{
    Ground    g = ground_make(NX, NY, 0.01, sand());
    DpPressed sum = {0};
    BoxSole   sole = SOLE;
    for (int k = 0; k <= 40; ++k) {
        DpSlide turns = {.by_z = {-0.005, 0.0}};
        sole.pitch = 0.2 - 0.005 * k;
        sole.z = 0.15 * sole.pitch;
        add(&sum, step(&g, sole, DP_CONTACT_SOLE, &turns, 0.01));
    }
    CHECK(sum.cut_firm < 0.01 * sum.firm);
    ground_free(&g);
}

// loose soil in the way is taken along, however deep
TEST(heaps_ahead_are_taken_along)
{
    Ground g = ground_make(NX, NY, 0.01, sand());
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i)
            g.heap[j * NX + i] = g.patch.x0 + i * 0.01 > -0.14 ? 0.04f : 0.0f;
    const double    before = ground_sum(&g, g.heap) - ground_sum(&g, g.compression);
    const DpPressed p = drag(&g, SOLE, DP_CONTACT_SOLE, 0.2, 40);
    const double    loose = 0.04 * WIDTH * 0.19;
    CHECK(p.cut_loose > 0.8 * loose && p.cut_loose < 1.05 * loose);
    CHECK_CLOSE(p.cut_loose + p.loose, loose, 0.05);
    CHECK_CLOSE(p.cut_firm, DEPTH * WIDTH * 0.2, 0.05);
    const double stood = DEPTH * WIDTH * LENGTH;
    CHECK_NEAR(before - (ground_sum(&g, g.heap) - ground_sum(&g, g.compression)),
               p.cut_firm + p.cut_loose + p.firm + p.loose + stood, 2e-4 * stood);
    ground_free(&g);
}

// what shears along with it is pressed, firm or loose
TEST(what_is_held_does_not_flow)
{
    Ground g = ground_make(NX, NY, 0.01, sand());
    for (int k = 0; k < NX * NY; ++k) g.heap[k] = 0.04f;
    DpSlide slide = {.at = {0.005, 0.0}, .held = 1.0};
    BoxSole sole = SOLE;
    for (int k = 0; k < 8; ++k) {
        const DpPressed p = step(&g, sole, DP_CONTACT_SOLE, &slide, 0.05);
        CHECK(p.cut_firm <= 0.0 && p.cut_loose <= 0.0 && p.loose > 0.0);
        sole.x += 0.005;
    }
    slide.held = 0.0;
    const DpPressed p = step(&g, sole, DP_CONTACT_SOLE, &slide, 0.05);
    CHECK(p.cut_firm > 0.0 && p.cut_loose > 0.0);
    ground_free(&g);
}

// two that go to either side leave mirrored ground, to the bit
TEST(mirrored_to_the_bit)
{
    Ground        g[2] = {ground_make(NX, NY, 0.01, sand()), ground_make(NX, NY, 0.01, sand())};
    const double  side[2] = {1.0, -1.0};
    DpPressed     p[2];
    const BoxSole sole = {.x = 0.0, .z = 0.0, .length = 0.205, .width = 0.105};
    for (int m = 0; m < 2; ++m) {
        DpSlide slide = {.at = {0.0037 * side[m], 0.0}, .by_y = {0.0021 * side[m], 0.0}};
        step(&g[m], sole, DP_CONTACT_SOLE, NULL, 1.0);
        BoxSole on = sole;
        on.x += 0.004 * side[m];
        p[m] = step(&g[m], on, DP_CONTACT_SOLE, &slide, 0.001);
    }
    CHECK(p[0].cut_firm > 0.0);
    CHECK_NEAR(p[0].cut_firm, p[1].cut_firm, 0.0);
    CHECK_NEAR(p[0].cut_x, -p[1].cut_x, 0.0);
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i)
            CHECK(memcmp(&g[0].compression[j * NX + i], &g[1].compression[j * NX + NX - 1 - i],
                         sizeof(float)) == 0);
    ground_free(&g[0]), ground_free(&g[1]);
}

int main(void)
{
    RUN(all_that_it_slides_over_is_cut_and_little_of_it_pressed);
    RUN(nothing_is_cut_ahead_of_time);
    RUN(trenches_leave_nothing_to_be_cut_later);
    RUN(the_middle_of_a_fast_sole_is_pressed);
    RUN(a_raised_front_sweeps_where_it_touches);
    RUN(cells_and_headings_do_not_matter);
    RUN(who_stands_cuts_nothing);
    RUN(what_only_comes_down_presses);
    RUN(heaps_ahead_are_taken_along);
    RUN(what_is_held_does_not_flow);
    RUN(mirrored_to_the_bit);
    return check_done();
}
