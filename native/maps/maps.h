// maps/maps.h - what leaves the simulation: OpenEXR files, whole or not at all. TRAIL 4.3, (17)
//
//   tiles changed ---DpFrames---> frames/0001.exr ..   one RGBA file per frame, for playback
//   grids         ---dp_maps_write---> maps_final.exr  named channels, for everybody
//
// The one file format is OpenEXR, through OpenEXRCore. Files are 32-bit float, ZIP. A file is
// written as <path>.<process>-<number>.part beside its target and renamed when whole; what a killed
// process leaves behind ends in .part.
#pragma once
#include "base/status.h"
#include "base/types.h"

// One line of metadata for a file's header. Text is UTF-8.
typedef struct DpNote
{
    const char* name;
    const char* text;  // a text, or NULL for a number
    double      number;
} DpNote;

// ---- playback: tiled RGBA, only changed tiles are encoded again ---------------------------------

typedef struct DpFrames DpFrames;

// A writer for frames of tiles_x x tiles_y tiles (DP_TILE cells a side), all zero at first.
// Notes are copied and stand in every file's header.
DpStatus dp_frames_create(DpFrames** frames, int tiles_x, int tiles_y, const DpNote* notes,
                          int note_count);
void     dp_frames_destroy(DpFrames* frames);

// Encode one tile anew: tile (tx, ty), ty = 0 at the lowest y; rgba (DP_TILE, DP_TILE, 4), row 0 =
// lowest y (the file stores the highest row first, as images do). Different tiles may be set from
// different threads at once; worker (0..63) picks the scratch memory.
DpStatus dp_frames_set_tile(DpFrames* frames, int tx, int ty, const float* rgba, int worker);

// Write the whole frame from the packed tiles. `time` [s] goes into the header.
DpStatus dp_frames_write(DpFrames* frames, const char* path, double time);

// ---- maps ------------------------------------------------------------------------------------

typedef struct DpMapChannel
{
    const char*  name;   // as in MAPS: compression, heap, ...
    const float* value;  // (ny, nx), row 0 = lowest y
} DpMapChannel;

// Write named float channels as one flat scan-line file, highest row first.
DpStatus dp_maps_write(const char* path, int nx, int ny, const DpMapChannel* channels,
                       int channel_count, const DpNote* notes, int note_count);

// A file read whole. Row 0 = lowest y.
typedef struct DpMapFile
{
    int     nx, ny, channel_count, note_count;
    char**  channel;    // names (channel_count)
    float*  value;      // (channel_count, ny, nx)
    char**  note_name;  // (note_count): text and number attributes of the header
    char**  note_text;  // NULL where the note is a number
    double* note_number;
} DpMapFile;

// Read a flat EXR (scan-line or tiled, half, float or uint channels) of any writer.
// A damaged or foreign file: DP_BAD_FILE, nothing allocated; images of more than 2^28 pixels too.
DpStatus dp_maps_read(const char* path, DpMapFile** file);
void     dp_map_file_destroy(DpMapFile* file);
