// maps/maps_exr.h - what the files of this room share: bytes in memory, files whole or not at all,
// OpenEXR's headers. Nobody outside the room comes in here.
#pragma once
#include <openexr.h>

#include "base/os.h"
#include "maps/maps.h"

// Memory that grows at its end.
typedef struct DpBytes
{
    unsigned char* at;    // the first `size` are filled
    size_t         size;  // [bytes]
} DpBytes;

// Place count bytes at `offset`; what lies between the end and there is zero.
DpStatus dp_bytes_put(DpBytes* bytes, size_t offset, const void* from, size_t count);
void     dp_bytes_free(DpBytes* bytes);

// Write a whole file: under `<path>.<process>-<number>.part` beside the target first, renamed when
// every byte and the closing have gone well. Else it is gone and the target as it was.
DpStatus dp_file_save(const char* path, const void* data, size_t size);

// Add a line to a list of files, which is there already: name, how many bytes, and their digest in hexadecimal digits.
DpStatus dp_list_add(const char* list, const char* path, const void* data, size_t size);

// Most pixels an image may have, written or read, and along one side.
#define DP_MAPS_PIXELS ((int64_t)1 << 32)
#define DP_MAPS_SIDE (1 << 28)

// How every context of this room starts: memory from base/alloc, not a word to the terminal,
// `user` for the caller's own functions.
exr_context_initializer_t dp_exr_setup(void* user);

// True once if this thread was refused memory inside OpenEXR since it was last asked.
bool dp_exr_starved(void);

// Start a file that grows in `out`: float channels, ZIP, the notes, `time` [s] unless NULL. Its
// chunks follow, then exr_finish. Bad sizes, names or notes: DP_BAD_ARGUMENT.
// @param tiled  in tiles of DP_TILE x DP_TILE instead of scan lines
DpStatus dp_exr_begin(exr_context_t* context, DpBytes* out, int nx, int ny, bool tiled,
                      const char* const* channel, int channel_count, const DpNote* notes,
                      int note_count, const double* time);

// The best level for files written often: see tests/bench/bench_maps.c.
#define DP_ZIP_LEVEL 4
