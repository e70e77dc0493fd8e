// maps/maps_exr.c - TRAIL 4.3: named channels as one flat OpenEXR file, and what every file begins
// with.
#include "maps/maps_exr.h"

#include <string.h>

#include "base/alloc.h"

// ---- how a context starts ----------------------------------------------------------------------

static _Thread_local bool starved;

// OpenEXR takes nothing for a failure when it asks for no bytes, too
static void* lend(size_t bytes)
{
    void* block = dp_alloc(bytes ? bytes : 1, 1);
    if (!block) starved = true;
    return block;
}

bool dp_exr_starved(void)
{
    const bool was = starved;
    starved = false;
    return was;
}

static void say_nothing(exr_const_context_t context, exr_result_t code, const char* words)
{
    (void)context, (void)code, (void)words;
}

exr_context_initializer_t dp_exr_setup(void* user)
{
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = say_nothing;
    setup.alloc_fn = lend;
    setup.free_fn = dp_free;
    setup.user_data = user;
    setup.zip_level = DP_ZIP_LEVEL;
    return setup;
}

static int64_t put_bytes(exr_const_context_t context, void* user, const void* from, uint64_t count,
                         uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    (void)context, (void)complain;
    if (dp_bytes_put(user, (size_t)offset, from, (size_t)count) == DP_OK) return (int64_t)count;
    starved = true;
    return -1;
}

// ---- the header --------------------------------------------------------------------------------

#define LONGEST_NAME 31  // what every reader understands

static bool is_name(const char* name)
{
    return name && *name && strlen(name) <= LONGEST_NAME;
}

// names that mean something to readers of OpenEXR
static bool is_taken(exr_const_context_t context, const char* name)
{
    static const char* const meant[] = {"name",       "type",    "version",
                                        "chunkCount", "view",    "tiles",
                                        "multiView",  "preview", "dwaCompressionLevel"};
    for (size_t k = 0; k < sizeof meant / sizeof *meant; ++k)
        if (strcmp(name, meant[k]) == 0) return true;
    const exr_attribute_t* there;
    return exr_get_attribute_by_name(context, 0, name, &there) == EXR_ERR_SUCCESS;
}

static DpStatus add_note(exr_context_t context, const char* name, const char* text, double number)
{
    if (!is_name(name) || is_taken(context, name)) return DP_BAD_ARGUMENT;
    const exr_result_t done = text ? exr_attr_set_string(context, 0, name, text)
                                   : exr_attr_set_double(context, 0, name, number);
    return done == EXR_ERR_SUCCESS         ? DP_OK
           : done == EXR_ERR_OUT_OF_MEMORY ? DP_NO_MEMORY
                                           : DP_BAD_ARGUMENT;
}

static DpStatus add_channel(exr_context_t context, const char* name)
{
    if (!is_name(name)) return DP_BAD_ARGUMENT;
    const exr_attr_chlist_t* list;
    if (exr_get_channels(context, 0, &list) == EXR_ERR_SUCCESS)
        for (int k = 0; k < list->num_channels; ++k)
            if (strcmp(list->entries[k].name.str, name) == 0) return DP_BAD_ARGUMENT;
    const exr_result_t done =
        exr_add_channel(context, 0, name, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    return done == EXR_ERR_SUCCESS ? DP_OK : DP_NO_MEMORY;
}

static DpStatus fill_header(exr_context_t context, int nx, int ny, bool tiled,
                            const char* const* channel, int channel_count, const DpNote* notes,
                            int note_count, const double* time)
{
    int part;
    if (exr_add_part(context, NULL, tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part) ||
        exr_initialize_required_attr_simple(context, 0, nx, ny, EXR_COMPRESSION_ZIP) ||
        (tiled && exr_set_tile_descriptor(context, 0, DP_TILE, DP_TILE, EXR_TILE_ONE_LEVEL,
                                          EXR_TILE_ROUND_DOWN)))
        return DP_NO_MEMORY;

    DpStatus status = DP_OK;
    for (int k = 0; status == DP_OK && k < channel_count; ++k)
        status = add_channel(context, channel[k]);
    if (status == DP_OK && time) status = add_note(context, "time", NULL, *time);
    for (int k = 0; status == DP_OK && k < note_count; ++k)
        status = add_note(context, notes[k].name, notes[k].text, notes[k].number);
    if (status == DP_OK && exr_write_header(context) != EXR_ERR_SUCCESS) status = DP_NO_MEMORY;
    return status;
}

DpStatus dp_exr_begin(exr_context_t* context, DpBytes* out, int nx, int ny, bool tiled,
                      const char* const* channel, int channel_count, const DpNote* notes,
                      int note_count, const double* time)
{
    *context = NULL;
    if (nx < 1 || ny < 1 || nx > DP_MAPS_SIDE || ny > DP_MAPS_SIDE ||
        (int64_t)nx * ny > DP_MAPS_PIXELS || channel_count < 1 || note_count < 0 ||
        (note_count > 0 && !notes))
        return DP_BAD_ARGUMENT;
    exr_context_initializer_t setup = dp_exr_setup(out);
    setup.write_fn = put_bytes;
    out->size = 0;
    if (exr_start_write(context, "memory", EXR_WRITE_FILE_DIRECTLY, &setup) != EXR_ERR_SUCCESS)
        return DP_NO_MEMORY;
    const DpStatus status =
        fill_header(*context, nx, ny, tiled, channel, channel_count, notes, note_count, time);
    if (status != DP_OK) exr_finish(context);
    return status;
}

// ---- named channels, scan line by scan line -----------------------------------------------------

// Planes as they are written: from the highest row down, of which row `low` is the lowest they hold.
typedef struct Planes
{
    int                 nx, ny, low;
    const DpMapChannel* channels;
    int                 channel_count;
    const DpMapRows*    rows;  // NULL: they hold all
} Planes;

// one chunk of 16 lines; image row 0 is the grid's last row
static exr_result_t write_chunk(exr_context_t context, exr_encode_pipeline_t* pipe, bool first,
                                int row, const Planes* planes)
{
    const DpMapChannel* channels = planes->channels;
    const int           nx = planes->nx, in_plane = planes->ny - 1 - row - planes->low;
    exr_chunk_info_t    chunk;
    exr_result_t        done = exr_write_scanline_chunk_info(context, 0, row, &chunk);
    if (!done)
        done = first ? exr_encoding_initialize(context, 0, &chunk, pipe)
                     : exr_encoding_update(context, 0, &chunk, pipe);
    if (done) return done;
    for (int c = 0; c < pipe->channel_count; ++c) {
        exr_coding_channel_info_t* to = &pipe->channels[c];
        for (int k = 0; k < planes->channel_count;
             ++k)  // the file keeps its channels sorted by name
            if (strcmp(channels[k].name, to->channel_name) == 0)
                to->encode_from_ptr =
                    (const uint8_t*)(channels[k].value + (size_t)in_plane * (size_t)nx);
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_bytes_per_element = 4;
        to->user_pixel_stride = 4;
        to->user_line_stride = -4 * nx;
    }
    if (first) done = exr_encoding_choose_default_routines(context, 0, pipe);
    return done ? done : exr_encoding_run(context, 0, pipe);
}

// the planes hold a row and those of its chunk
static bool has_rows(Planes* planes, int row)
{
    if (!planes->rows || row % DP_TILE != 0) return true;
    planes->low = planes->ny - DP_TILE - row;
    return planes->rows->fill(planes->rows->context, planes->low);
}

static DpStatus pack_maps(DpBytes* out, Planes* planes, const DpNote* notes, int note_count)
{
    const char** names = dp_alloc((size_t)planes->channel_count, sizeof *names);
    if (!names) return DP_NO_MEMORY;
    for (int k = 0; k < planes->channel_count; ++k) names[k] = planes->channels[k].name;
    exr_context_t context;
    DpStatus      status = dp_exr_begin(&context, out, planes->nx, planes->ny, false, names,
                                        planes->channel_count, notes, note_count, NULL);
    dp_free(names);
    if (status != DP_OK) return status;

    exr_encode_pipeline_t pipe = {.pipe_size = sizeof pipe};
    int32_t               lines = 16;
    exr_get_scanlines_per_chunk(context, 0, &lines);
    exr_result_t done = EXR_ERR_SUCCESS;
    for (int row = 0; !done && status == DP_OK && row < planes->ny; row += lines) {
        if (!has_rows(planes, row)) status = DP_CANNOT_WRITE;
        if (status == DP_OK) done = write_chunk(context, &pipe, row == 0, row, planes);
    }
    exr_encoding_destroy(context, &pipe);
    if (exr_finish(&context) != EXR_ERR_SUCCESS || done) status = status ? status : DP_NO_MEMORY;
    return status;
}

DpStatus dp_maps_write(const char* path, int nx, int ny, const DpMapChannel* channels,
                       int channel_count, const DpNote* notes, int note_count)
{
    return dp_maps_write_rows(path, nx, ny, channels, channel_count, notes, note_count, NULL);
}

DpStatus dp_maps_write_rows(const char* path, int nx, int ny, const DpMapChannel* channels,
                            int channel_count, const DpNote* notes, int note_count,
                            const DpMapRows* rows)
{
    if (!path || !*path || channel_count < 1 || !channels) return DP_BAD_ARGUMENT;
    for (int k = 0; k < channel_count; ++k)
        if (!channels[k].name || !channels[k].value) return DP_BAD_ARGUMENT;
    Planes   planes = {nx, ny, 0, channels, channel_count, rows};
    DpBytes  out = {0};
    DpStatus status = pack_maps(&out, &planes, notes, note_count);
    if (status == DP_OK) status = dp_file_save(path, out.at, out.size);
    dp_bytes_free(&out);
    return status;
}
