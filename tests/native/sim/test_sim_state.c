// Stop and go on: run to the end is run to any step, save, load elsewhere, run on, to the bit; what is
// damaged or of another simulation changes nothing.
#include "base/digest.h"
#include "base/stream.h"
#include "check.h"
#include "sim/planted.h"

enum
{
    LEFT = -48,
    LOW = -48,
    SIDE = 192,
    FIELDS = 4
};

static const DpField FIELD[FIELDS] = {DP_FIELD_COMPRESSION, DP_FIELD_HEAP, DP_FIELD_PRESSURE_TIME,
                                      DP_FIELD_PLANT_STRENGTH};

typedef struct Case
{
    bool         planted, shown;
    DpContactLaw law;
    DpHeapLaw    heap;
} Case;

static DpStatus world_open(World* world, const Case* is, int workers)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 0.6e6f, soil.shear_modulus = 0.02f;
    const DpTerrainOptions options = {{0.02, 0.1, 0.2}, &soil, 1, workers, 0, NULL};
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    DpSimOptions           sim = dp_sim_options_default();
    sim.workers = workers, sim.law = is->law, sim.heap_law = is->heap;
    *world = (World){.stand = -1};
    DpStatus status = dp_terrain_create(&world->terrain, &options, &flat);
    if (status == DP_OK) status = dp_sim_create(&world->sim, world->terrain, &sim);
    if (status != DP_OK || !is->planted) return status;
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.5f, kind.break_angle = 0.6f;
    world->plants = dp_plants_create(3);
    if (!world->plants) return DP_NO_MEMORY;
    status = dp_sim_plant(world->sim, world->plants);
    float xy[2 * 256];
    for (int k = 0; k < 256; ++k)
        xy[2 * k] = 0.1f * (float)(k % 16), xy[2 * k + 1] = 0.05f * (float)(k / 16) - 0.4f;
    if (status == DP_OK)
        status = dp_sim_grow(world->sim, &kind, xy, 256, &world->stand, &world->grown);
    return status == DP_OK && is->shown ? dp_sim_lay(world->sim) : status;
}

static DpStatus open_and_load(World* world, const Case* is, const Stride* s, int workers)
{
    const DpStatus status = world_open(world, is, workers);
    return status == DP_OK ? dp_sim_load(world->sim, &s->gait, s->touching, s->force, s->point)
                           : status;
}

// a digest of all that is seen of a world
static uint64_t seen(const World* world)
{
    const size_t cells = (size_t)SIDE * SIDE;
    float*       out = dp_alloc((FIELDS + 4) * cells, sizeof *out);
    uint64_t     words[DP_DIGEST_WORDS], sum = 0;
    size_t       count = (FIELDS + 1) * cells;
    for (size_t f = 0; f < FIELDS; ++f)
        CHECK(dp_terrain_read(world->terrain, FIELD[f], LEFT, LOW, SIDE, SIDE, out + f * cells) ==
              DP_OK);
    dp_sim_pressure(world->sim, LEFT, LOW, SIDE, SIDE, out + FIELDS * cells);
    if (world->plants) {
        dp_grass_read(dp_sim_grass(world->sim), LEFT, LOW, SIDE, SIDE, out + count,
                      out + count + cells, out + count + 2 * cells);
        count += 3 * cells;
    }
    dp_digest(out, count * sizeof *out, words);
    for (int k = 0; k < DP_DIGEST_WORDS; ++k) sum = sum * 31 + words[k];
    for (int k = 0; world->plants && k < world->grown; ++k) {
        const size_t particles = (size_t)dp_plants_shape(world->plants, 0).particles;
        CHECK(dp_sim_stands(world->sim, 0, k, out) == DP_OK);
        CHECK(dp_sim_shown(world->sim, 0, k, out + 3 * particles) == DP_OK);
        dp_digest(out, 6 * particles * sizeof *out, words);
        for (int w = 0; w < DP_DIGEST_WORDS; ++w) sum = sum * 31 + words[w];
    }
    dp_free(out);
    const DpSimReport r = dp_sim_report(world->sim);
    const double numbers[] = {r.contacts,  r.off_ground, r.deepest,       r.pressed, r.pressed_heap,
                              r.displaced, r.heaped,     (double)r.broke, r.awake};
    dp_digest(numbers, sizeof numbers, words);
    for (int w = 0; w < DP_DIGEST_WORDS; ++w) sum = sum * 31 + words[w];
    return sum;
}

static const Case CASES[] = {
    {false, false, DP_CONTACT_SOLE, DP_HEAP_REST},
    {false, false, DP_CONTACT_UNIFORM, DP_HEAP_PAPER},
    {true, false, DP_CONTACT_SOLE, DP_HEAP_REST},
    {true, true, DP_CONTACT_UNIFORM, DP_HEAP_REST},
};

TEST(it_goes_on_to_the_bit)
{
    Stride s = stride_make(1, 3, 80.0, STRIDE_RATE);
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        const int T = s.gait.times;
        World     whole;
        CHECK(open_and_load(&whole, &CASES[c], &s, 1) == DP_OK);
        for (int stop = 0; stop < T; stop += stop < 40 ? 7 : 31) {
            World         half, other;
            DpStateWriter writer = {0};
            CHECK(dp_sim_run(whole.sim, stop) == DP_OK);
            CHECK(dp_sim_save_state(whole.sim, &writer) == DP_OK);
            CHECK(open_and_load(&half, &CASES[c], &s, 3) == DP_OK);
            CHECK(dp_sim_load_state(half.sim, writer.bytes, writer.size) == DP_OK);
            CHECK(seen(&half) == seen(&whole));
            dp_write_drop(&writer);
            // and from there: the same whether it stopped or not
            CHECK(open_and_load(&other, &CASES[c], &s, 1) == DP_OK);
            CHECK(dp_sim_run(other.sim, T - 1) == DP_OK && dp_sim_settle(other.sim) == DP_OK);
            CHECK(dp_sim_run(half.sim, T - 1) == DP_OK && dp_sim_settle(half.sim) == DP_OK);
            CHECK(seen(&half) == seen(&other));
            world_drop(&half), world_drop(&other);
        }
        world_drop(&whole);
    }
    stride_drop(&s);
    CHECK(dp_bytes_live() == 0);
}

TEST(what_is_damaged_changes_nothing)
{
    Stride        s = stride_make(1, 3, 80.0, STRIDE_RATE), longer = stride_make(1, 4, 80.0, 100.0);
    const Case    is = CASES[3];
    World         from, to, fresh;
    DpStateWriter writer = {0};
    CHECK(open_and_load(&from, &is, &s, 1) == DP_OK && dp_sim_run(from.sim, 60) == DP_OK);
    CHECK(dp_sim_save_state(from.sim, &writer) == DP_OK);
    CHECK(open_and_load(&to, &is, &s, 1) == DP_OK && open_and_load(&fresh, &is, &s, 1) == DP_OK);
    const uint64_t before = seen(&to);
    const size_t   live = dp_bytes_live(), step = writer.size / 97 + 1;
    for (size_t n = 0; n < writer.size; n += step) {  // cut off, and one bit turned
        CHECK(dp_sim_load_state(to.sim, writer.bytes, n) == DP_BAD_FILE);
        writer.bytes[n] ^= 4;
        CHECK(dp_sim_load_state(to.sim, writer.bytes, writer.size) == DP_BAD_FILE);
        writer.bytes[n] ^= 4;
        CHECK(dp_bytes_live() == live);
    }
    bool taken = false;
    for (long n = 0; !taken; n += 1 + n / 8) {
        dp_alloc_fail_after(n);
        const DpStatus status = dp_sim_load_state(to.sim, writer.bytes, writer.size);
        dp_alloc_fail_after(-1);
        taken = status == DP_OK;
        CHECK(taken || status == DP_NO_MEMORY);
        CHECK(taken || dp_bytes_live() == live);
        CHECK(taken || n % 8 || seen(&to) == before);
        if (n > 5000) break;
    }
    CHECK(seen(&to) == seen(&from));
    CHECK(dp_sim_load_state(from.sim, writer.bytes, writer.size) == DP_BAD_ARGUMENT);  // it stepped
    // of another walk, other options, other plants
    Case bare = is, paper = is;
    bare.planted = false, paper.heap = DP_HEAP_PAPER;
    const Case*   cases[] = {&is, &bare, &paper};
    const Stride* walks[] = {&longer, &s, &s};
    for (int k = 0; k < 3; ++k) {
        World other;
        CHECK(open_and_load(&other, cases[k], walks[k], 1) == DP_OK);
        CHECK(dp_sim_load_state(other.sim, writer.bytes, writer.size) == DP_BAD_FILE);
        world_drop(&other);
    }
    dp_write_drop(&writer);
    world_drop(&from), world_drop(&to), world_drop(&fresh);
    stride_drop(&s), stride_drop(&longer);
    CHECK(dp_bytes_live() == 0);
}

int main(void)
{
    RUN(it_goes_on_to_the_bit);
    RUN(what_is_damaged_changes_nothing);
    return check_done();
}
