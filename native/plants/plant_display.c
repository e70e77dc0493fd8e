// plants/plant_display.c - stems as they are shown: down for as long as the lean at their foot says.
//
// A stem that was simulated swings up as soon as nothing holds it, and that is how it wears; what
// was trodden stays down until its strength is back, and the lean knows how long. Shown is
//   what the stem does, where that is as low as the lean says: near a foot, or limp;
//   else the stem as a sole laid it, risen towards what it does until it is as high as the lean
//   says; one that no sole laid, as beside it, is bent down so far, the way of the lean.
// Heights are those of a stem's highest point over its foot and the ground's slope. Near a foot,
// the lower a stem is, the more is shown of what it does, so that nothing jumps. Shown stems are as
// long as what they do.
#include "base/alloc.h"
#include "plants/plant_laid.h"
#include "plants/plant_stem.h"

#define NEARLY 0.85    // under a sole a stem may lie so much less low than the lean
#define TURNS 0.8      // from this share of it on, what a stem does shows in how it lies
#define SLIGHT 0.2     // below this it goes over into what the stem does
#define UNFOLDS 0.8    // how far folds are drawn out once a stem stands up
#define PASSES 6       // in which a piece finds its place on the ground
#define MIN_LIFT 0.3f  // of the radius: lying stems are so high, or up to the whole radius
#define LIFT_OF 64     // what its chance is called, for the first stem

DpStatus dp_plant_display_create(DpPlantDisplay** display, const DpPlants* plants,
                                 DpStemLeanAt lean_at, const void* context)
{
    if (!display || !plants || !lean_at) return DP_BAD_ARGUMENT;
    DpPlantDisplay* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    created->plants = plants, created->lean_at = lean_at, created->context = context;
    *display = created;
    return DP_OK;
}

void dp_plant_display_destroy(DpPlantDisplay* display)
{
    if (!display) return;
    dp_plant_laid_drop(&display->laid, display->plants);
    dp_free(display);
}

// ---- stems -----------------------------------------------------------------------------------

static DpVec3 particle_at(const PlantStand* stand, const PlantBlock* block, int particle, int l)
{
    if (!block->state) return dp_plant_rest_at(stand, block, particle, l);
    const int at = particle * DP_LANES + l;
    return dp_vec3((double)block->state->at[0][at], (double)block->state->at[1][at],
                   (double)block->state->at[2][at]);
}

// a stem as it is, from the block's origin
static Stem stem_of(const PlantStand* stand, const PlantBlock* block, int stem, int l)
{
    const int first = stem * stand->shape.rows + 1;
    Stem      own = {.foot = particle_at(stand, block, first, l),
                     .pieces = stand->shape.rows - DP_PLANT_HELD,
                     .slope = {(double)block->slope[0][l], (double)block->slope[1][l]}};
    DpVec3    from = own.foot;
    for (int k = 0; k < own.pieces; ++k) {
        const DpVec3 to = particle_at(stand, block, first + k + 1, l);
        own.segment[k] = dp_sub(to, from), from = to;
    }
    return own;
}

// highest point over the foot of a stem in its rest shape on level ground [m]
static double rest_height(const PlantStand* stand, int stem)
{
    const int    rows = stand->shape.rows;
    const float* foot = stand->rest + 3 * (stem * rows + 1);
    float        max = 0.0f;
    for (int r = 0; r + 1 < rows; ++r) max = fmaxf(max, foot[3 * r + 2] - foot[2]);
    return (double)max;
}

// ---- what is remembered ------------------------------------------------------------------------

static Stem recall(const LaidBlock* kept, const Stem* own, int stem, int l)
{
    Stem out = *own;
    for (int k = 0; k < own->pieces; ++k) {
        const int at = (stem * own->pieces + k) * DP_LANES + l;
        out.segment[k] = dp_vec3((double)kept->segment[0][at], (double)kept->segment[1][at],
                                 (double)kept->segment[2][at]);
    }
    return out;
}

static void keep(LaidBlock* kept, const Stem* shown, int stem, int l, double share)
{
    for (int k = 0; k < shown->pieces; ++k) {
        const int at = (stem * shown->pieces + k) * DP_LANES + l;
        kept->segment[0][at] = (float)shown->segment[k].x,
        kept->segment[1][at] = (float)shown->segment[k].y,
        kept->segment[2][at] = (float)shown->segment[k].z;
    }
    kept->share[stem * DP_LANES + l] = (float)share;
    kept->laid[stem * DP_LANES + l] = 1;
}

// ---- a stem and its cell -----------------------------------------------------------------------

// How a stem is shown: as it is, or not.
typedef struct Look
{
    Stem   shown;
    bool   as_it_is;
    double share;  // how low it lies, of what the lean says
} Look;

// whole and far from feet: it lies low only where it swings through
static bool swings(const PlantStand* stand, const PlantBlock* block, int stem, int l)
{
    const int tip = ((stem + 1) * stand->shape.rows - 1) * DP_LANES + l;
    return !block->touched_lane[l] && !(block->state && block->state->limp[tip] > 0.0f);
}

static double low_of(const Stem* stem, double tall)
{
    return dp_clamp(1.0 - dp_stem_high(stem) / tall, 0.0, 1.0);
}

static Look look_at(const Stem* own, const LaidBlock* kept, const DpStemLean* cell, double tall,
                    bool free, int stem, int l)
{
    const int  at = stem * DP_LANES + l;
    const bool was_laid = kept && kept->laid[at];
    Look       look = {.shown = *own, .as_it_is = true, .share = 1.0};
    if (!(cell->down > 0.0 && tall > 0.0)) return look;
    const double share = low_of(own, tall) / cell->down;
    look.share = was_laid ? (double)kept->share[at] : 1.0;
    if (cell->pressed)  // the less a sole laid it, the more the lean does
        look.share = fmin(1.0, fmax(share, 1.0 - share * (1.0 / NEARLY - 1.0)));
    if (share >= look.share && !free) {
        look.share = fmin(share, 1.0);
        return look;
    }
    const double down = look.share * cell->down,
                 turns = free ? 0.0 : dp_stem_smooth(TURNS, 1.0, share / look.share);
    look.as_it_is = false;
    if (was_laid) {
        const Stem was = recall(kept, own, stem, l);
        const Stem laid =
            dp_stem_unfolded(&was, UNFOLDS * dp_stem_smooth(0.0, 1.0, 1.0 - share / look.share));
        const double up = dp_stem_risen_by(&laid, own, (1.0 - down) * tall);
        const double more = fmax(turns, 1.0 - dp_stem_smooth(0.0, SLIGHT, down));
        look.shown = dp_stem_risen(&laid, own, up + (1.0 - up) * more);
    } else {
        look.shown =
            dp_stem_bent(own, cell->lean, dp_stem_bent_by(own, cell->lean, down) * (1.0 - turns));
    }
    return look;
}

static DpStemLean cell_of(const DpPlantDisplay* display, const PlantBlock* block, const Stem* stem)
{
    return display->lean_at(display->context, block->origin[0] + stem->foot.x,
                            block->origin[1] + stem->foot.y);
}

static bool step_block(DpPlantDisplay* display, const PlantStand* stand, const PlantBlock* block,
                       LaidBlock** kept)
{
    for (int stem = 0; stem < stand->shape.stems; ++stem) {
        const double tall = rest_height(stand, stem);
        for (int l = 0; l < block->count; ++l) {
            const Stem foot = {.foot = particle_at(stand, block, stem * stand->shape.rows + 1, l)};
            const DpStemLean cell = cell_of(display, block, &foot);
            if (!(cell.down > 0.0) && *kept) (*kept)->laid[stem * DP_LANES + l] = 0;
            if (!(cell.down > 0.0) || !(cell.pressed || block->touched_lane[l])) continue;
            if (!*kept && !(*kept = dp_plant_laid_create(&stand->shape))) return false;
            const Stem own = stem_of(stand, block, stem, l);
            const Look look = look_at(&own, *kept, &cell, tall, false, stem, l);
            if (cell.pressed || look.as_it_is) keep(*kept, &look.shown, stem, l, look.share);
        }
    }
    return true;
}

DpStatus dp_plant_display_step(DpPlantDisplay* display)
{
    if (!display) return DP_BAD_ARGUMENT;
    if (!dp_plant_laid_fit(&display->laid, display->plants)) return DP_NO_MEMORY;
    for (int s = 0; s < display->laid.stands; ++s) {
        const PlantStand* stand = &display->plants->stand[s];
        for (int b = 0; b < stand->blocks; ++b)
            if (stand->up[b] &&
                !step_block(display, stand, &stand->block[b], &display->laid.stand[s][b]))
                return DP_NO_MEMORY;
    }
    return DP_OK;
}

// ---- reading -----------------------------------------------------------------------------------

// whereto a stem leans, seen from above
static DpVec3 away(const Stem* stem)
{
    DpVec3 sum = dp_vec3(0, 0, 0);
    for (int k = 0; k < stem->pieces; ++k) sum = dp_add(sum, stem->segment[k]);
    sum.z = 0.0;
    return dp_length(sum) > 1e-9 ? dp_unit(sum) : dp_vec3(1, 0, 0);
}

// the stem's particles in the world, none below the ground
static void put_down(const Stem* stem, const PlantBlock* block, const DpPlantGround* ground, int l,
                     double lift, float* out)
{
    const DpVec3 aside = away(stem);
    DpVec3 at = dp_add(stem->foot, dp_vec3(block->origin[0], block->origin[1], block->origin[2]));
    double along = 0.0;
    for (int k = 0; k < stem->pieces; ++k, out += 3) {
        const double length = dp_length(stem->segment[k]);
        DpVec3       to = dp_add(at, stem->segment[k]);
        along += length;
        for (int pass = 0; pass < PASSES; ++pass) {
            const double lowest =
                dp_plant_floor_at(block, ground, l, to.x, to.y) + fmin(lift, along);
            if (to.z >= lowest) break;
            to.z = lowest;
            if (pass + 1 == PASSES) break;
            DpVec3 arm = dp_sub(to, at);
            if (dp_length(arm) < 0.5 * length)  // it stood on its head
                arm = dp_add(arm, dp_scale(aside, length));
            to = dp_add(at, dp_scale(dp_unit(arm), length));
        }
        out[0] = (float)to.x, out[1] = (float)to.y, out[2] = (float)to.z;
        at = to;
    }
}

DpStatus dp_plant_display_read(const DpPlantDisplay* display, const DpPlantGround* ground,
                               int stand_name, int plant, float* position)
{
    if (!display || !position || !dp_plant_ground_ok(ground)) return DP_BAD_ARGUMENT;
    const DpStatus status =
        dp_plants_read(display->plants, stand_name, plant, position, NULL, NULL);
    if (status != DP_OK) return status;
    const PlantStand* stand = &display->plants->stand[stand_name];
    const int         slot = stand->where[plant], l = slot % DP_LANES, rows = stand->shape.rows;
    const PlantBlock* block = &stand->block[slot / DP_LANES];
    const LaidBlock*  kept =
        stand_name < display->laid.stands ? display->laid.stand[stand_name][slot / DP_LANES] : NULL;
    const uint64_t name = dp_plant_name(block->root[0][l], block->root[1][l]);
    for (int stem = 0; stem < stand->shape.stems; ++stem) {
        const Stem       foot = {.foot = particle_at(stand, block, stem * rows + 1, l)};
        const DpStemLean cell = cell_of(display, block, &foot);
        if (!(cell.down > 0.0)) continue;
        const Stem own = stem_of(stand, block, stem, l);
        const Look look = look_at(&own, kept, &cell, rest_height(stand, stem),
                                  swings(stand, block, stem, l), stem, l);
        if (look.as_it_is) continue;
        const float chance =
            (float)dp_plant_hash(display->plants->seed, name, LIFT_OF + (uint64_t)stem);
        const float lift = (MIN_LIFT + (1.0f - MIN_LIFT) * chance) * stand->kind.radius;
        put_down(&look.shown, block, ground, l, (double)lift,
                 position + 3 * (stem * rows + DP_PLANT_HELD));
    }
    return DP_OK;
}
