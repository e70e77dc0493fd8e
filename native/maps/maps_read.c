// maps/maps_read.c - a flat OpenEXR file of any writer, read whole; damaged ones are refused.
//
// What a header promises is held against the size of the file before memory is taken for it.
#include <string.h>

#include "base/alloc.h"
#include "maps/maps_exr.h"

#define LARGEST_TILE 16384  // [px]
#define HEADER_LOOK 16384   // bytes in which a header names its packing

typedef struct Source
{
    DpFile  file;
    int64_t size;  // [bytes]
} Source;

static int64_t read_bytes(exr_const_context_t context, void* user, void* into, uint64_t count,
                          uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    (void)context, (void)complain;
    const Source* source = user;
    if (offset > (uint64_t)source->size) return -1;
    return dp_file_read(source->file, into, (size_t)count, (int64_t)offset);
}

static int64_t size_of_source(exr_const_context_t context, void* user)
{
    (void)context;
    return ((const Source*)user)->size;
}

// ---- what the header says ----------------------------------------------------------------------

// The shape of a file that this room can read, else DP_BAD_FILE.
static DpStatus read_shape(exr_const_context_t context, int64_t file_size, DpMapFile* map,
                           const exr_attr_chlist_t** list, bool* tiled)
{
    exr_storage_t     storage;
    exr_attr_box2i_t  window;
    exr_compression_t packing;
    if (exr_get_storage(context, 0, &storage) || exr_get_data_window(context, 0, &window) ||
        exr_get_compression(context, 0, &packing) || exr_get_channels(context, 0, list))
        return DP_BAD_FILE;
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) return DP_BAD_FILE;
    *tiled = storage == EXR_STORAGE_TILED;

    const int64_t nx = (int64_t)window.max.x - window.min.x + 1;
    const int64_t ny = (int64_t)window.max.y - window.min.y + 1;
    const int64_t channels = (*list)->num_channels;
    if (nx < 1 || ny < 1 || nx > DP_MAPS_SIDE || ny > DP_MAPS_SIDE || nx * ny > DP_MAPS_PIXELS ||
        channels < 1 || channels > 4096)
        return DP_BAD_FILE;
    for (int c = 0; c < channels; ++c)
        if ((*list)->entries[c].x_sampling != 1 || (*list)->entries[c].y_sampling != 1)
            return DP_BAD_FILE;

    // no packing shrinks pixels further than this; only DWA writes next to nothing for even planes
    const bool    dwa = packing == EXR_COMPRESSION_DWAA || packing == EXR_COMPRESSION_DWAB;
    const int64_t max_bytes = (file_size + 256) * (dwa ? 262144 : 4096);
    uint32_t      tile_x = 1, tile_y = 1;
    if (*tiled && exr_get_tile_descriptor(context, 0, &tile_x, &tile_y, NULL, NULL))
        return DP_BAD_FILE;
    if (tile_x > LARGEST_TILE || tile_y > LARGEST_TILE) return DP_BAD_FILE;
    if (nx * ny * channels * 4 > max_bytes || (int64_t)tile_x * tile_y * channels * 4 > max_bytes)
        return DP_BAD_FILE;
    map->nx = (int)nx;
    map->ny = (int)ny;
    return DP_OK;
}

static char* copy_text(const char* text, int32_t length)
{
    char* copy = dp_alloc((size_t)length + 1, 1);
    if (copy && length > 0) memcpy(copy, text, (size_t)length);
    return copy;
}

// texts and numbers that are not OpenEXR's own
static bool is_note(const exr_attribute_t* at)
{
    if (strcmp(at->name, "pixelAspectRatio") == 0 || strcmp(at->name, "screenWindowWidth") == 0 ||
        strcmp(at->name, "name") == 0 || strcmp(at->name, "type") == 0 ||
        strcmp(at->name, "version") == 0 || strcmp(at->name, "chunkCount") == 0)
        return false;
    return at->type == EXR_ATTR_STRING || at->type == EXR_ATTR_DOUBLE ||
           at->type == EXR_ATTR_FLOAT || at->type == EXR_ATTR_INT;
}

static DpStatus read_notes(exr_const_context_t context, DpMapFile* map)
{
    int32_t count = 0;
    if (exr_get_attribute_count(context, 0, &count) || count < 1) return DP_BAD_FILE;
    map->note_name = dp_alloc((size_t)count, sizeof *map->note_name);
    map->note_text = dp_alloc((size_t)count, sizeof *map->note_text);
    map->note_number = dp_alloc((size_t)count, sizeof *map->note_number);
    if (!map->note_name || !map->note_text || !map->note_number) return DP_NO_MEMORY;
    for (int32_t k = 0; k < count; ++k) {
        const exr_attribute_t* at;
        if (exr_get_attribute_by_index(context, 0, EXR_ATTR_LIST_FILE_ORDER, k, &at))
            return DP_BAD_FILE;
        if (!is_note(at)) continue;
        const int n = map->note_count++;
        map->note_name[n] = copy_text(at->name, at->name_length);
        if (!map->note_name[n]) return DP_NO_MEMORY;
        if (at->type == EXR_ATTR_STRING) {
            map->note_text[n] = copy_text(at->string->str, at->string->length);
            if (!map->note_text[n]) return DP_NO_MEMORY;
        }
        if (at->type == EXR_ATTR_DOUBLE) map->note_number[n] = at->d;
        if (at->type == EXR_ATTR_FLOAT) map->note_number[n] = (double)at->f;
        if (at->type == EXR_ATTR_INT) map->note_number[n] = (double)at->i;
    }
    return DP_OK;
}

// ---- the pixels --------------------------------------------------------------------------------

// Unpack one chunk whose upper left pixel is (x, row), row 0 = the image's highest.
static exr_result_t read_chunk(exr_const_context_t context, exr_decode_pipeline_t* pipe,
                               bool* ready, const exr_chunk_info_t* chunk, DpMapFile* map, int x,
                               int row)
{
    exr_result_t done = *ready ? exr_decoding_update(context, 0, chunk, pipe)
                               : exr_decoding_initialize(context, 0, chunk, pipe);
    if (done) return done;
    const bool first = !*ready;
    *ready = true;
    if (pipe->channel_count != map->channel_count) return EXR_ERR_CORRUPT_CHUNK;
    for (int c = 0; c < pipe->channel_count; ++c) {
        exr_coding_channel_info_t* to = &pipe->channels[c];
        if (to->width < 1 || to->height < 1 || to->width > map->nx - x ||
            to->height > map->ny - row)
            return EXR_ERR_CORRUPT_CHUNK;
        const size_t line = (size_t)c * (size_t)map->ny + (size_t)(map->ny - 1 - row);
        to->decode_to_ptr = (uint8_t*)(map->value + line * (size_t)map->nx + x);
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_bytes_per_element = 4;
        to->user_pixel_stride = 4;
        to->user_line_stride = -4 * map->nx;
    }
    if (first) done = exr_decoding_choose_default_routines(context, 0, pipe);
    return done ? done : exr_decoding_run(context, 0, pipe);
}

static exr_result_t read_lines(exr_const_context_t context, exr_decode_pipeline_t* pipe,
                               DpMapFile* map)
{
    exr_attr_box2i_t window;
    int32_t          lines = 0;
    exr_result_t     done = exr_get_data_window(context, 0, &window);
    if (!done) done = exr_get_scanlines_per_chunk(context, 0, &lines);
    if (!done && lines < 1) done = EXR_ERR_FILE_BAD_HEADER;
    bool ready = false;
    for (int64_t row = 0; !done && row < map->ny; row += lines) {
        exr_chunk_info_t chunk;
        done = exr_read_scanline_chunk_info(context, 0, (int)(window.min.y + row), &chunk);
        if (!done) done = read_chunk(context, pipe, &ready, &chunk, map, 0, (int)row);
    }
    return done;
}

static exr_result_t read_tiles(exr_const_context_t context, exr_decode_pipeline_t* pipe,
                               DpMapFile* map)
{
    int32_t      wide, high, count_x, count_y;
    exr_result_t done = exr_get_tile_sizes(context, 0, 0, 0, &wide, &high);
    if (!done) done = exr_get_tile_counts(context, 0, 0, 0, &count_x, &count_y);
    if (done) return done;
    // together the tiles must be the image, no more and no less
    if (wide < 1 || high < 1 || count_x != (map->nx - 1) / wide + 1 ||
        count_y != (map->ny - 1) / high + 1)
        return EXR_ERR_FILE_BAD_HEADER;
    bool ready = false;
    for (int ty = 0; !done && ty < count_y; ++ty) {
        for (int tx = 0; !done && tx < count_x; ++tx) {
            exr_chunk_info_t chunk;
            done = exr_read_tile_chunk_info(context, 0, tx, ty, 0, 0, &chunk);
            if (!done) done = read_chunk(context, pipe, &ready, &chunk, map, tx * wide, ty * high);
        }
    }
    return done;
}

static DpStatus read_pixels(exr_const_context_t context, const exr_attr_chlist_t* list, bool tiled,
                            DpMapFile* map)
{
    map->channel = dp_alloc((size_t)list->num_channels, sizeof *map->channel);
    map->value = dp_alloc((size_t)list->num_channels * (size_t)map->ny * (size_t)map->nx,
                          sizeof *map->value);
    if (!map->channel || !map->value) return DP_NO_MEMORY;
    for (int c = 0; c < list->num_channels; ++c) {
        const exr_attr_string_t* name = &list->entries[c].name;
        map->channel[map->channel_count++] = copy_text(name->str, name->length);
        if (!map->channel[c]) return DP_NO_MEMORY;
    }
    exr_decode_pipeline_t pipe = {.pipe_size = sizeof pipe};
    const exr_result_t    done =
        tiled ? read_tiles(context, &pipe, map) : read_lines(context, &pipe, map);
    exr_decoding_destroy(context, &pipe);
    return done ? DP_BAD_FILE : DP_OK;
}

// Whether a file's header names a packing that came after this OpenEXR, which takes it for another.
// The attribute is looked for where it stands: the rest of the header may be as new.
static bool is_packed_anew(Source* source)
{
    static const unsigned char magic[] = {0x76, 0x2f, 0x31, 0x01};
    static const char          named[] = "compression\0compression\0\1\0\0";  // and a last zero
    unsigned char              head[HEADER_LOOK];
    const int64_t              got = read_bytes(NULL, source, head, sizeof head, 0, NULL);
    if (got < (int64_t)(sizeof magic + sizeof named) || memcmp(head, magic, sizeof magic) != 0)
        return false;
    for (int64_t at = 8; at + (int64_t)sizeof named < got; ++at)
        if (memcmp(head + at, named, sizeof named) == 0)
            return head[at + (int64_t)sizeof named] >= EXR_COMPRESSION_LAST_TYPE;
    return false;
}

static DpStatus read_all(Source* source, DpMapFile* map)
{
    exr_context_initializer_t setup = dp_exr_setup(source);
    setup.read_fn = read_bytes;
    setup.size_fn = size_of_source;
    setup.max_image_width = DP_MAPS_SIDE;
    setup.max_image_height = DP_MAPS_SIDE;
    setup.max_tile_width = LARGEST_TILE;
    setup.max_tile_height = LARGEST_TILE;
    setup.flags =
        EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    exr_context_t context = NULL;
    dp_exr_starved();
    if (exr_start_read(&context, "file", &setup) != EXR_ERR_SUCCESS)
        return dp_exr_starved() ? DP_NO_MEMORY : DP_BAD_FILE;
    const exr_attr_chlist_t* list;
    bool                     tiled;
    DpStatus                 status = read_shape(context, source->size, map, &list, &tiled);
    if (status == DP_OK) status = read_notes(context, map);
    if (status == DP_OK) status = read_pixels(context, list, tiled, map);
    exr_finish(&context);
    if (status == DP_BAD_FILE && dp_exr_starved()) status = DP_NO_MEMORY;
    return status;
}

DpStatus dp_maps_read(const char* path, DpMapFile** file)
{
    if (!path || !*path || !file) return DP_BAD_ARGUMENT;
    Source     source;
    DpStatus   status = dp_file_open(path, &source.file, &source.size);
    DpMapFile* map = NULL;
    if (status == DP_OK) {
        map = dp_alloc(1, sizeof *map);
        status = !map                      ? DP_NO_MEMORY
                 : is_packed_anew(&source) ? DP_BAD_PACKING
                                           : read_all(&source, map);
    }
    dp_file_close(source.file);
    if (status == DP_OK)
        *file = map;
    else
        dp_map_file_destroy(map);
    return status;
}

void dp_map_file_destroy(DpMapFile* file)
{
    if (!file) return;
    for (int k = 0; k < file->channel_count; ++k) dp_free(file->channel[k]);
    for (int k = 0; k < file->note_count; ++k) {
        dp_free(file->note_name[k]);
        dp_free(file->note_text[k]);
    }
    dp_free(file->channel);
    dp_free(file->value);
    dp_free(file->note_name);
    dp_free(file->note_text);
    dp_free(file->note_number);
    dp_free(file);
}
