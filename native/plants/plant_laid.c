// plants/plant_laid.c - what stems looked like when soles laid them: kept in memory, and from one run
// to the next.
#include "plants/plant_laid.h"

#include "base/alloc.h"
#include "base/assert.h"

#define NAME "laid"
#define VERSION 1
#define MIN_BLOCK 40  // bytes of a block are no fewer

struct DpPlantDisplayState
{
    const DpPlantDisplay* display;
    LaidStems             laid;
};

static size_t stems_of(const DpPlantShape* shape)
{
    return (size_t)shape->stems * DP_LANES;
}

static size_t segments_of(const DpPlantShape* shape)
{
    return stems_of(shape) * (size_t)(shape->rows - DP_PLANT_HELD);
}

LaidBlock* dp_plant_laid_create(const DpPlantShape* shape)
{
    const size_t head = (sizeof(LaidBlock) + 15) / 16 * 16;
    const size_t stems = stems_of(shape), segments = segments_of(shape);
    char*        memory = dp_alloc(1, head + (3 * segments + stems) * sizeof(float) + stems);
    if (!memory) return NULL;
    LaidBlock* block = (LaidBlock*)(void*)memory;
    float*     grid = (float*)(void*)(memory + head);
    for (int d = 0; d < 3; ++d, grid += segments) block->segment[d] = grid;
    block->share = grid;
    block->laid = (uint8_t*)(grid + stems);
    return block;
}

bool dp_plant_laid_fit(LaidStems* laid, const DpPlants* plants)
{
    const int count = plants->stands;
    if (count == laid->stands) return true;
    LaidBlock*** more = dp_realloc(laid->stand, (size_t)count, sizeof *more);
    if (!more) return false;
    laid->stand = more;
    for (; laid->stands < count; ++laid->stands) {
        const size_t blocks = (size_t)plants->stand[laid->stands].blocks;
        more[laid->stands] = dp_alloc(blocks, sizeof(LaidBlock*));
        if (!more[laid->stands]) return false;
    }
    return true;
}

void dp_plant_laid_drop(LaidStems* laid, const DpPlants* plants)
{
    for (int s = 0; s < laid->stands; ++s) {
        for (int b = 0; b < plants->stand[s].blocks; ++b) dp_free(laid->stand[s][b]);
        dp_free(laid->stand[s]);
    }
    dp_free(laid->stand);
    *laid = (LaidStems){0};
}

// ---- saving --------------------------------------------------------------------------------------

static bool is_laid(const LaidBlock* block, size_t stems)
{
    bool laid = false;
    for (size_t k = 0; block && k < stems; ++k) laid = laid || block->laid[k];
    return laid;
}

void dp_plant_display_save(const DpPlantDisplay* display, DpStateWriter* writer)
{
    const LaidStems* laid = &display->laid;
    dp_write_chunk(writer, NAME, VERSION);
    dp_write_u64(writer, (uint64_t)laid->stands);
    for (int s = 0; s < laid->stands; ++s) {
        const PlantStand* stand = &display->plants->stand[s];
        const size_t      stems = stems_of(&stand->shape), segments = segments_of(&stand->shape);
        uint64_t          count = 0;
        for (int b = 0; b < stand->blocks; ++b) count += is_laid(laid->stand[s][b], stems);
        dp_write_u64(writer, stems), dp_write_u64(writer, segments);
        dp_write_u64(writer, count);
        for (int b = 0; b < stand->blocks; ++b) {
            const LaidBlock* block = laid->stand[s][b];
            if (!is_laid(block, stems)) continue;
            dp_write_i64(writer, b);
            dp_write_bytes(writer, block->laid, stems);
            dp_write_runs(writer, block->share, stems);
            for (int d = 0; d < 3; ++d) dp_write_runs(writer, block->segment[d], segments);
        }
    }
    dp_write_end(writer);
}

// ---- loading -------------------------------------------------------------------------------------

static void read_within(DpStateReader* reader, float* value, size_t count, float min, float max)
{
    bool holds = true;
    dp_read_runs(reader, value, count);
    for (size_t k = 0; k < count; ++k) holds = holds && value[k] >= min && value[k] <= max;
    dp_read_check(reader, holds);
}

// the blocks of one stand; false without memory
static bool read_stand(DpStateReader* reader, const PlantStand* stand, LaidBlock** blocks)
{
    const size_t stems = stems_of(&stand->shape), segments = segments_of(&stand->shape);
    dp_read_check(reader, dp_read_u64(reader) == stems);
    dp_read_check(reader, dp_read_u64(reader) == segments);
    const size_t count = dp_read_count(reader, (size_t)stand->blocks, MIN_BLOCK);
    int          after = -1;
    for (size_t k = 0; k < count && reader->status == DP_OK; ++k) {
        after = (int)dp_read_int(reader, after + 1, stand->blocks - 1);
        if (reader->status != DP_OK) break;
        LaidBlock* block = blocks[after] = dp_plant_laid_create(&stand->shape);
        if (!block) return false;
        bool holds = true;
        dp_read_bytes(reader, block->laid, stems);
        for (size_t n = 0; n < stems; ++n) holds = holds && block->laid[n] <= 1;
        dp_read_check(reader, holds);
        read_within(reader, block->share, stems, 0.0f, 1.0f);
        for (int d = 0; d < 3; ++d)
            read_within(reader, block->segment[d], segments, -100.0f, 100.0f);
    }
    return true;
}

void dp_plant_display_state_destroy(DpPlantDisplayState* state)
{
    if (!state) return;
    dp_plant_laid_drop(&state->laid, state->display->plants);
    dp_free(state);
}

DpStatus dp_plant_display_load(const DpPlantDisplay* display, DpStateReader* reader,
                               DpPlantDisplayState** state)
{
    if (!display || !reader || !state) return DP_BAD_ARGUMENT;
    DpPlantDisplayState* read = dp_alloc(1, sizeof *read);
    if (!read) return DP_NO_MEMORY;
    read->display = display;
    dp_read_chunk(reader, NAME, VERSION);
    const int stands = (int)dp_read_int(reader, 0, display->plants->stands);
    bool      room = stands == 0 || dp_plant_laid_fit(&read->laid, display->plants);
    for (int s = 0; room && s < stands && reader->status == DP_OK; ++s)
        room = read_stand(reader, &display->plants->stand[s], read->laid.stand[s]);
    if (room) dp_read_end(reader);
    if (!room || reader->status != DP_OK) {
        dp_plant_display_state_destroy(read);
        return room ? reader->status : DP_NO_MEMORY;
    }
    *state = read;
    return DP_OK;
}

void dp_plant_display_restore(DpPlantDisplay* display, DpPlantDisplayState* state)
{
    DP_ASSERT(state->display == display);
    dp_plant_laid_drop(&display->laid, display->plants);
    display->laid = state->laid;
    state->laid = (LaidStems){0};  // they are the display's now
    dp_plant_display_state_destroy(state);
}
