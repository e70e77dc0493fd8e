// tests/native/maps/foreign.h - small files of other writers: any packing, any channel type, tiles
// and mip levels, windows that do not begin at 0.
#pragma once
#include <openexr.h>

#include "maps/world.h"

typedef struct Foreign
{
    int               nx, ny, x0, y0;
    int               tile;    // side of a tile, 0 = scan lines
    int               levels;  // 1 = mip maps
    exr_compression_t packing;
    exr_pixel_type_t  type[3];  // of A, B, C
} Foreign;

static inline float foreign_value(int i, int row, int c)
{
    return (float)((i * 7 + row * 13 + c * 29) % 61);  // whole and small: half and uint hold it
}

static inline exr_result_t foreign_chunk(exr_context_t file, const exr_chunk_info_t* chunk, int x,
                                         int row, const Foreign* as)
{
    exr_encode_pipeline_t pipe = {.pipe_size = sizeof pipe};
    exr_result_t          done = exr_encoding_initialize(file, 0, chunk, &pipe);
    float*                value[3] = {NULL, NULL, NULL};
    for (int c = 0; !done && c < 3; ++c) {
        const int w = chunk->width, h = chunk->height;
        value[c] = malloc((size_t)w * (size_t)h * sizeof *value[c]);
        for (int j = 0; j < h; ++j)
            for (int i = 0; i < w; ++i) {
                const float    v = foreign_value(x + i, row + j, c);
                const unsigned whole = (unsigned)v;
                if (as->type[c] == EXR_PIXEL_UINT)
                    memcpy(&value[c][j * w + i], &whole, 4);
                else
                    value[c][j * w + i] = v;
            }
        exr_coding_channel_info_t* from = &pipe.channels[c];
        from->encode_from_ptr = (const uint8_t*)value[c];
        from->user_data_type = as->type[c] == EXR_PIXEL_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        from->user_bytes_per_element = 4;
        from->user_pixel_stride = 4;
        from->user_line_stride = 4 * w;
    }
    if (!done) done = exr_encoding_choose_default_routines(file, 0, &pipe);
    if (!done) done = exr_encoding_run(file, 0, &pipe);
    exr_encoding_destroy(file, &pipe);
    for (int c = 0; c < 3; ++c) free(value[c]);
    return done;
}

static inline exr_result_t foreign_pixels(exr_context_t file, const Foreign* as)
{
    exr_chunk_info_t chunk;
    exr_result_t     done = 0;
    if (!as->tile) {
        int32_t lines = 1;
        exr_get_scanlines_per_chunk(file, 0, &lines);
        for (int row = 0; !done && row < as->ny; row += lines) {
            done = exr_write_scanline_chunk_info(file, 0, as->y0 + row, &chunk);
            if (!done) done = foreign_chunk(file, &chunk, 0, row, as);
        }
        return done;
    }
    int32_t levels = 1, other = 1;
    exr_get_tile_levels(file, 0, &levels, &other);
    for (int level = 0; level < levels; ++level) {
        int32_t count_x = 0, count_y = 0;
        exr_get_tile_counts(file, 0, level, level, &count_x, &count_y);
        for (int ty = 0; !done && ty < count_y; ++ty)
            for (int tx = 0; !done && tx < count_x; ++tx) {
                done = exr_write_tile_chunk_info(file, 0, tx, ty, level, level, &chunk);
                if (!done) done = foreign_chunk(file, &chunk, tx * as->tile, ty * as->tile, as);
            }
    }
    return done;
}

// 0 when the file stands at `path`
static inline int foreign_write(const char* path, const Foreign* as)
{
    static const char* const  names[] = {"A", "B", "C"};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t             file;
    int                       part;
    const exr_attr_box2i_t window = {{as->x0, as->y0}, {as->x0 + as->nx - 1, as->y0 + as->ny - 1}};
    const exr_attr_v2f_t   centre = {0.0f, 0.0f};
    exr_result_t           done = exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &setup);
    if (done) return done;
    done = exr_add_part(file, NULL, as->tile ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part);
    if (!done)
        done = exr_initialize_required_attr(file, 0, &window, &window, 1.0f, &centre, 1.0f,
                                            EXR_LINEORDER_INCREASING_Y, as->packing);
    if (!done && as->tile)
        done = exr_set_tile_descriptor(file, 0, (uint32_t)as->tile, (uint32_t)as->tile,
                                       as->levels ? EXR_TILE_MIPMAP_LEVELS : EXR_TILE_ONE_LEVEL,
                                       EXR_TILE_ROUND_DOWN);
    for (int c = 0; !done && c < 3; ++c)
        done = exr_add_channel(file, 0, names[c], as->type[c], EXR_PERCEPTUALLY_LINEAR, 1, 1);
    if (!done) done = exr_attr_set_string(file, 0, "owner", "somebody else");
    if (!done) done = exr_attr_set_int(file, 0, "shoeSize", 43);
    if (!done) done = exr_attr_set_float(file, 0, "focus", 0.5f);
    if (!done) done = exr_write_header(file);
    if (!done) done = foreign_pixels(file, as);
    const exr_result_t closed = exr_finish(&file);
    return done ? done : closed;
}

// every way of packing and storing that is read bit for bit
#define F EXR_PIXEL_FLOAT
#define H EXR_PIXEL_HALF
#define U EXR_PIXEL_UINT
static const Foreign foreign_sorts[] = {
    {53, 41, 0, 0, 0, 0, EXR_COMPRESSION_NONE, {F, F, F}},
    {53, 41, -7, 19, 0, 0, EXR_COMPRESSION_RLE, {H, F, U}},
    {53, 41, 5, -300, 0, 0, EXR_COMPRESSION_ZIPS, {U, U, U}},
    {53, 41, 0, 0, 0, 0, EXR_COMPRESSION_ZIP, {H, H, H}},
    {53, 41, 0, 0, 0, 0, EXR_COMPRESSION_PIZ, {H, F, H}},
    {53, 41, 0, 0, 0, 0, EXR_COMPRESSION_PXR24, {H, H, F}},
    {53, 41, 0, 0, 16, 0, EXR_COMPRESSION_ZIP, {F, H, U}},
    {53, 41, 9, 9, 32, 0, EXR_COMPRESSION_NONE, {F, F, F}},
    {64, 64, 0, 0, 16, 1, EXR_COMPRESSION_PIZ, {F, F, F}},
    {1, 90, 0, 0, 0, 0, EXR_COMPRESSION_ZIP, {H, F, U}},
    {53, 41, 0, 0, 0, 0, EXR_COMPRESSION_DWAA, {U, U, U}},
    {53, 41, 0, 0, 32, 0, EXR_COMPRESSION_DWAB, {U, U, U}},
};
#define FOREIGN_SORTS ((int)(sizeof foreign_sorts / sizeof *foreign_sorts))
#undef F
#undef H
#undef U
