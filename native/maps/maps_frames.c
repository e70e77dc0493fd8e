// maps/maps_frames.c - tiled files of one picture as it changes, whose unchanged tiles stay packed.
//
// A frame of 1024^2 would take 44 ms to encode whole. A walker changes a tile or two of it, so
// every tile's packed bytes are kept, and a frame is its header and those bytes in a row. Tiles
// that never changed share one packed tile of zeros.
#include <libdeflate.h>
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "maps/maps_exr.h"

#define WORKERS 64
#define MAX_TILES (DP_MAPS_PIXELS / (DP_TILE * DP_TILE))
#define MAX_CHANNELS 16
#define TILE_CELLS (DP_TILE * DP_TILE)

typedef struct Tile
{
    unsigned char* packed;  // NULL = zeros
    size_t         size;    // [bytes]
} Tile;

// scratch memory of one worker, lent when it packs its first tile
typedef struct PackScratch
{
    struct libdeflate_compressor* zip;
    unsigned char* byte;  // planes, those before, their differences, the packed tile: 4 of its size
    unsigned char* plane;   // of the tile that was packed last, in `byte`; NULL = none was
    unsigned char* packed;  // .. and what came of it
    size_t         size;    // [bytes]
} PackScratch;

struct DpFrames
{
    int         tiles_x, tiles_y;
    int         channel_count;
    const char* channel[MAX_CHANNELS];  // names, own copies
    int         order[MAX_CHANNELS];    // channels as the file keeps them, sorted by name
    DpNote*     notes;
    int         note_count;

    Tile        zero;
    Tile*       tile;  // (tiles_y, tiles_x), ty = 0 lowest
    PackScratch scratch[WORKERS];
    DpBytes     file;  // the frame being written
    char*       list;  // path of the list of the files; NULL = none
};

// ---- packing one tile, OpenEXR's ZIP ------------------------------------------------------------
// Departures
//   OpenEXR's own encode pipeline makes a new compressor for every tile, which costs as much as the
//   compressing. The format is short enough to be written here; test_maps_frames.c reads it with
//   OpenEXR, tests/core/test_maps.py with other programs.

static size_t tile_bytes(const DpFrames* frames)
{
    return (size_t)TILE_CELLS * sizeof(float) * (size_t)frames->channel_count;
}

// little-endian floats line by line, highest row first, and in a line channel by channel
static void lay_out(const DpFrames* frames, const float* value, unsigned char* byte)
{
    const int count = frames->channel_count;
    for (int j = DP_TILE - 1; j >= 0; --j) {
        const float* row = value + j * DP_TILE * count;
        for (int c = 0; c < count; ++c) {
            const float* from = row + frames->order[c];
            for (int i = 0; i < DP_TILE; ++i) {
                uint32_t bits;
                memcpy(&bits, &from[i * count], 4);
                byte[4 * i] = (unsigned char)bits;
                byte[4 * i + 1] = (unsigned char)(bits >> 8);
                byte[4 * i + 2] = (unsigned char)(bits >> 16);
                byte[4 * i + 3] = (unsigned char)(bits >> 24);
            }
            byte += 4 * DP_TILE;
        }
    }
}

// even bytes first, then the odd ones, each as its step from the one before
static void difference(const unsigned char* byte, size_t size, unsigned char* step)
{
    const size_t half = size / 2;
    step[0] = byte[0];
    step[half] = (unsigned char)(byte[1] - byte[size - 2] + 128);
    for (size_t k = 1; k < half; ++k) {
        step[k] = (unsigned char)(byte[2 * k] - byte[2 * k - 2] + 128);
        step[half + k] = (unsigned char)(byte[2 * k + 1] - byte[2 * k - 1] + 128);
    }
}

static bool is_set_up(const DpFrames* frames, PackScratch* scratch)
{
    if (!scratch->byte) scratch->byte = dp_alloc(tile_bytes(frames), 4);
    if (!scratch->zip) {
        const exr_context_initializer_t setup = dp_exr_setup(NULL);
        libdeflate_set_memory_allocator(setup.alloc_fn, setup.free_fn);
        scratch->zip = libdeflate_alloc_compressor(DP_ZIP_LEVEL);
    }
    return scratch->byte && scratch->zip;
}

static DpStatus pack(const DpFrames* frames, PackScratch* scratch, const float* value, Tile* into)
{
    if (!is_set_up(frames, scratch)) return DP_NO_MEMORY;
    const size_t   bytes = tile_bytes(frames);
    unsigned char* byte = scratch->byte + (scratch->plane == scratch->byte ? bytes : 0);
    unsigned char* step = scratch->byte + 2 * bytes;
    unsigned char* packed = step + bytes;
    lay_out(frames, value, byte);
    if (!scratch->plane ||
        memcmp(byte, scratch->plane, bytes) != 0) {  // ground far from walkers is alike
        difference(byte, bytes, step);
        const size_t size = libdeflate_zlib_compress(scratch->zip, step, bytes, packed, bytes - 1);
        scratch->plane = byte;
        scratch->packed =
            size ? packed : byte;  // it would not get smaller: readers know by the size
        scratch->size = size ? size : bytes;
    }
    into->packed = dp_alloc(scratch->size, 1);
    if (!into->packed) return DP_NO_MEMORY;
    memcpy(into->packed, scratch->packed, scratch->size);
    into->size = scratch->size;
    return DP_OK;
}

DpStatus dp_frames_set_tile(DpFrames* frames, int tx, int ty, const float* value, int worker)
{
    if (!frames || !value || tx < 0 || ty < 0 || tx >= frames->tiles_x || ty >= frames->tiles_y ||
        worker < 0 || worker >= WORKERS)
        return DP_BAD_ARGUMENT;
    Tile fresh = {NULL, 0};
    dp_memory_ease(tile_bytes(frames));
    const DpStatus status = pack(frames, &frames->scratch[worker], value, &fresh);
    if (status != DP_OK) return status;
    Tile* tile = &frames->tile[ty * frames->tiles_x + tx];
    dp_free(tile->packed);
    *tile = fresh;
    return DP_OK;
}

// ---- a whole frame -----------------------------------------------------------------------------

DpStatus dp_frames_write(DpFrames* frames, const char* path, double time)
{
    if (!frames || !path || !*path) return DP_BAD_ARGUMENT;
    exr_context_t context;
    DpStatus      status = dp_exr_begin(&context, &frames->file, frames->tiles_x * DP_TILE,
                                        frames->tiles_y * DP_TILE, true, frames->channel,
                                        frames->channel_count, frames->notes, frames->note_count, &time);
    if (status != DP_OK) return status;
    exr_result_t done = EXR_ERR_SUCCESS;
    for (int row = 0; !done && row < frames->tiles_y; ++row) {
        for (int tx = 0; !done && tx < frames->tiles_x; ++tx) {
            const Tile* tile = &frames->tile[(frames->tiles_y - 1 - row) * frames->tiles_x + tx];
            if (!tile->packed) tile = &frames->zero;
            dp_memory_ease(2 * tile->size);
            done = exr_write_tile_chunk(context, 0, tx, row, 0, 0, tile->packed, tile->size);
        }
    }
    if (exr_finish(&context) != EXR_ERR_SUCCESS || done) return DP_NO_MEMORY;
    status = dp_file_save(path, frames->file.at, frames->file.size);
    if (status == DP_OK && frames->list)
        status = dp_list_add(frames->list, path, frames->file.at, frames->file.size);
    return status;
}

// ---- a life ------------------------------------------------------------------------------------

static char* copy_text(const char* text)
{
    const size_t size = strlen(text) + 1;
    char*        copy = dp_alloc(size, 1);
    return copy ? memcpy(copy, text, size) : NULL;
}

DpStatus dp_frames_list(DpFrames* frames, const char* path)
{
    if (!frames || !path) return DP_BAD_ARGUMENT;
    DpFile         list;
    const DpStatus status = dp_file_append(path, &list);
    if (status != DP_OK) return status;
    dp_file_close(list);  // opened for each line: Windows lets nobody replace a file that is open
    char* copy = copy_text(path);
    if (!copy) return DP_NO_MEMORY;
    dp_free(frames->list);
    frames->list = copy;
    return DP_OK;
}

static DpStatus copy_notes(DpFrames* frames, const DpNote* notes, int note_count)
{
    if (note_count == 0) return DP_OK;
    frames->notes = dp_alloc((size_t)note_count, sizeof *notes);
    if (!frames->notes) return DP_NO_MEMORY;
    for (int k = 0; k < note_count; ++k) {
        if (!notes[k].name) return DP_BAD_ARGUMENT;
        DpNote* note = &frames->notes[frames->note_count++];
        note->name = copy_text(notes[k].name);
        note->text = notes[k].text ? copy_text(notes[k].text) : NULL;
        note->number = notes[k].number;
        if (!note->name || (notes[k].text && !note->text)) return DP_NO_MEMORY;
    }
    return DP_OK;
}

static DpStatus copy_channels(DpFrames* frames, const char* const* channel, int channel_count)
{
    for (int c = 0; c < channel_count; ++c) {
        if (!channel[c]) return DP_BAD_ARGUMENT;
        frames->channel[c] = copy_text(channel[c]);
        if (!frames->channel[c]) return DP_NO_MEMORY;
        frames->channel_count = c + 1;
        int at = c;
        for (; at > 0 && strcmp(channel[frames->order[at - 1]], channel[c]) > 0; --at)
            frames->order[at] = frames->order[at - 1];
        frames->order[at] = c;
    }
    return DP_OK;
}

// notes and names are tried out on a header before anything is written
static DpStatus fill(DpFrames* frames, const char* const* channel, int channel_count,
                     const DpNote* notes, int note_count)
{
    DpStatus status = copy_channels(frames, channel, channel_count);
    if (status == DP_OK) status = copy_notes(frames, notes, note_count);
    if (status != DP_OK) return status;
    const double  no_time = 0.0;
    exr_context_t trial;
    status = dp_exr_begin(&trial, &frames->file, frames->tiles_x * DP_TILE,
                          frames->tiles_y * DP_TILE, true, frames->channel, frames->channel_count,
                          frames->notes, frames->note_count, &no_time);
    if (status != DP_OK) return status;
    exr_finish(&trial);

    float* zeros = dp_alloc(tile_bytes(frames), 1);
    frames->tile = dp_alloc((size_t)(frames->tiles_x * frames->tiles_y), sizeof *frames->tile);
    status = zeros && frames->tile ? pack(frames, &frames->scratch[0], zeros, &frames->zero)
                                   : DP_NO_MEMORY;
    dp_free(zeros);
    return status;
}

DpStatus dp_frames_create(DpFrames** frames, int tiles_x, int tiles_y, const char* const* channel,
                          int channel_count, const DpNote* notes, int note_count)
{
    if (!channel || channel_count < 1 || channel_count > MAX_CHANNELS) return DP_BAD_ARGUMENT;
    if (!frames || tiles_x < 1 || tiles_y < 1 || (int64_t)tiles_x * tiles_y > MAX_TILES ||
        note_count < 0 || (note_count > 0 && !notes))
        return DP_BAD_ARGUMENT;
    DpFrames* fresh = dp_alloc(1, sizeof *fresh);
    if (!fresh) return DP_NO_MEMORY;
    fresh->tiles_x = tiles_x;
    fresh->tiles_y = tiles_y;
    const DpStatus status = fill(fresh, channel, channel_count, notes, note_count);
    if (status == DP_OK)
        *frames = fresh;
    else
        dp_frames_destroy(fresh);
    return status;
}

int dp_frames_channels(const DpFrames* frames)
{
    return frames->channel_count;
}

void dp_frames_destroy(DpFrames* frames)
{
    if (!frames) return;
    for (int w = 0; w < WORKERS; ++w) {
        if (frames->scratch[w].zip) libdeflate_free_compressor(frames->scratch[w].zip);
        dp_free(frames->scratch[w].byte);
    }
    for (int k = 0; frames->tile && k < frames->tiles_x * frames->tiles_y; ++k)
        dp_free(frames->tile[k].packed);
    for (int c = 0; c < frames->channel_count; ++c) dp_free((void*)frames->channel[c]);
    for (int k = 0; k < frames->note_count; ++k) {
        dp_free((void*)frames->notes[k].name);
        dp_free((void*)frames->notes[k].text);
    }
    dp_free(frames->notes);
    dp_free(frames->tile);
    dp_free(frames->zero.packed);
    dp_bytes_free(&frames->file);
    dp_free(frames->list);
    dp_free(frames);
}
