// maps/maps_frames.c - frames for playback: tiled RGBA files whose unchanged tiles stay packed.
//
// A frame of 1024^2 would take 44 ms to encode whole. A walker changes a tile or two of it, so every
// tile's packed bytes are kept, and a frame is its header and those bytes in a row. Tiles that never
// changed share one packed tile of zeros.
#include <string.h>

#include "base/alloc.h"
#include "maps/maps_exr.h"

#define WORKERS 64
#define MOST_TILES (DP_MAPS_PIXELS / (DP_TILE * DP_TILE))

typedef struct Tile
{
    unsigned char* packed;  // NULL = zeros
    size_t         size;    // [bytes]
} Tile;

struct DpFrames
{
    int     tiles_x, tiles_y;
    DpNote* notes;
    int     note_count;

    Tile  zero;
    Tile* tile;  // (tiles_y, tiles_x), ty = 0 lowest

    exr_context_t         encoder;  // packs tiles; its own file goes nowhere
    DpBytes               nowhere;
    exr_encode_pipeline_t pipe[WORKERS];
    bool                  ready[WORKERS];

    DpBytes file;  // the frame being written
};

static const char* const rgba_names[4] = {"R", "G", "B", "A"};

// ---- packing one tile --------------------------------------------------------------------------

// the end of the encode pipeline: keep the bytes instead of writing them
static exr_result_t keep_packed(exr_encode_pipeline_t* pipe)
{
    Tile* tile = pipe->encoding_user_data;
    tile->packed = dp_alloc(pipe->compressed_bytes, 1);
    if (!tile->packed) return EXR_ERR_OUT_OF_MEMORY;
    memcpy(tile->packed, pipe->compressed_buffer, pipe->compressed_bytes);
    tile->size = pipe->compressed_bytes;
    return EXR_ERR_SUCCESS;
}

// @param row  of tiles in the file, 0 = highest y
static exr_result_t pack(DpFrames* frames, int tx, int row, const float* rgba, int worker,
                         Tile* into)
{
    exr_encode_pipeline_t* pipe = &frames->pipe[worker];
    exr_chunk_info_t       chunk;
    exr_result_t done = exr_write_tile_chunk_info(frames->encoder, 0, tx, row, 0, 0, &chunk);
    if (!done)
        done = frames->ready[worker] ? exr_encoding_update(frames->encoder, 0, &chunk, pipe)
                                     : exr_encoding_initialize(frames->encoder, 0, &chunk, pipe);
    if (done) return done;
    const bool first = !frames->ready[worker];
    frames->ready[worker] = true;
    for (int c = 0; c < pipe->channel_count; ++c) {
        exr_coding_channel_info_t* from = &pipe->channels[c];
        const char*                name = from->channel_name;
        const int                  at = *name == 'R' ? 0 : *name == 'G' ? 1 : *name == 'B' ? 2 : 3;
        // the file stores the highest row first
        from->encode_from_ptr = (const uint8_t*)(rgba + (DP_TILE - 1) * DP_TILE * 4 + at);
        from->user_data_type = EXR_PIXEL_FLOAT;
        from->user_bytes_per_element = 4;
        from->user_pixel_stride = 16;
        from->user_line_stride = -16 * DP_TILE;
    }
    if (first) {
        done = exr_encoding_choose_default_routines(frames->encoder, 0, pipe);
        if (done) return done;
        pipe->yield_until_ready_fn = NULL;
        pipe->write_fn = keep_packed;
    }
    pipe->encoding_user_data = into;
    return exr_encoding_run(frames->encoder, 0, pipe);
}

DpStatus dp_frames_set_tile(DpFrames* frames, int tx, int ty, const float* rgba, int worker)
{
    if (!frames || !rgba || tx < 0 || ty < 0 || tx >= frames->tiles_x || ty >= frames->tiles_y ||
        worker < 0 || worker >= WORKERS)
        return DP_BAD_ARGUMENT;
    Tile fresh = {NULL, 0};
    if (pack(frames, tx, frames->tiles_y - 1 - ty, rgba, worker, &fresh)) {
        dp_free(fresh.packed);
        return DP_NO_MEMORY;  // nothing else can go wrong in memory
    }
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
                                        frames->tiles_y * DP_TILE, true, rgba_names, 4,
                                        frames->notes, frames->note_count, &time);
    if (status != DP_OK) return status;
    exr_result_t done = EXR_ERR_SUCCESS;
    for (int row = 0; !done && row < frames->tiles_y; ++row) {
        for (int tx = 0; !done && tx < frames->tiles_x; ++tx) {
            const Tile* tile = &frames->tile[(frames->tiles_y - 1 - row) * frames->tiles_x + tx];
            if (!tile->packed) tile = &frames->zero;
            done = exr_write_tile_chunk(context, 0, tx, row, 0, 0, tile->packed, tile->size);
        }
    }
    if (exr_finish(&context) != EXR_ERR_SUCCESS || done) return DP_NO_MEMORY;
    return dp_file_save(path, frames->file.at, frames->file.size);
}

// ---- a life ------------------------------------------------------------------------------------

static char* copy_text(const char* text)
{
    const size_t size = strlen(text) + 1;
    char*        copy = dp_alloc(size, 1);
    return copy ? memcpy(copy, text, size) : NULL;
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

static DpStatus fill(DpFrames* frames, const DpNote* notes, int note_count)
{
    DpStatus status = copy_notes(frames, notes, note_count);
    if (status != DP_OK) return status;
    const int count = frames->tiles_x * frames->tiles_y;
    float*    zeros = dp_alloc(DP_TILE * DP_TILE * 4, sizeof *zeros);
    frames->tile = dp_alloc((size_t)count, sizeof *frames->tile);
    const double no_time = 0.0;
    if (!zeros || !frames->tile) {
        status = DP_NO_MEMORY;
    } else {
        status = dp_exr_begin(&frames->encoder, &frames->nowhere, frames->tiles_x * DP_TILE,
                              frames->tiles_y * DP_TILE, true, rgba_names, 4, frames->notes,
                              frames->note_count, &no_time);
    }
    if (status == DP_OK && pack(frames, 0, 0, zeros, 0, &frames->zero)) status = DP_NO_MEMORY;
    dp_free(zeros);
    return status;
}

DpStatus dp_frames_create(DpFrames** frames, int tiles_x, int tiles_y, const DpNote* notes,
                          int note_count)
{
    if (!frames || tiles_x < 1 || tiles_y < 1 || (int64_t)tiles_x * tiles_y > MOST_TILES ||
        note_count < 0 || (note_count > 0 && !notes))
        return DP_BAD_ARGUMENT;
    DpFrames* fresh = dp_alloc(1, sizeof *fresh);
    if (!fresh) return DP_NO_MEMORY;
    fresh->tiles_x = tiles_x;
    fresh->tiles_y = tiles_y;
    const DpStatus status = fill(fresh, notes, note_count);
    if (status == DP_OK) *frames = fresh;
    else dp_frames_destroy(fresh);
    return status;
}

void dp_frames_destroy(DpFrames* frames)
{
    if (!frames) return;
    for (int w = 0; w < WORKERS; ++w)
        if (frames->ready[w]) exr_encoding_destroy(frames->encoder, &frames->pipe[w]);
    if (frames->encoder) exr_finish(&frames->encoder);
    for (int k = 0; frames->tile && k < frames->tiles_x * frames->tiles_y; ++k)
        dp_free(frames->tile[k].packed);
    for (int k = 0; k < frames->note_count; ++k) {
        dp_free((void*)frames->notes[k].name);
        dp_free((void*)frames->notes[k].text);
    }
    dp_free(frames->notes);
    dp_free(frames->tile);
    dp_free(frames->zero.packed);
    dp_bytes_free(&frames->nowhere);
    dp_bytes_free(&frames->file);
    dp_free(frames);
}
