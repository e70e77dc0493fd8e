// maps/maps.h - what leaves the simulation: OpenEXR files, whole or not at all. TRAIL 4.3, (17), MODEL 8.1
//
//   tiles changed ---DpFrames---> frames/trail_0001.exr ..  a picture as it changes, file by file
//                 ---DpWriter---> the same, in the background
//   grids         ---dp_maps_write---> maps_start.exr       whole planes
//
// The one file format is OpenEXR, through OpenEXRCore. Files are 32-bit float, ZIP. A file is
// written as <path>.<process>-<number>.part beside its target and renamed when whole; what a killed
// process leaves behind ends in .part.
#pragma once
#include <stdbool.h>

#include "base/status.h"
#include "base/types.h"

// One line of metadata for a file's header. Text is UTF-8.
typedef struct DpNote
{
    const char* name;
    const char* text;  // a text, or NULL for a number
    double      number;
} DpNote;

// ---- one picture as it changes: tiled, only changed tiles are encoded again ----------------------

typedef struct DpFrames DpFrames;

// A writer for files of tiles_x x tiles_y tiles (DP_TILE cells a side), all zero at first, with
// 1..16 channels. Notes are copied and stand in every file's header.
DpStatus dp_frames_create(DpFrames** frames, int tiles_x, int tiles_y, const char* const* channel,
                          int channel_count, const DpNote* notes, int note_count);
void     dp_frames_destroy(DpFrames* frames);
int      dp_frames_channels(const DpFrames* frames);

// Encode one tile anew: tile (tx, ty), ty = 0 at the lowest y; value (DP_TILE, DP_TILE, channels),
// row 0 = lowest y (the file stores the highest row first, as images do). Different tiles may be
// set from different threads at once; worker (0..63) picks the scratch memory.
DpStatus dp_frames_set_tile(DpFrames* frames, int tx, int ty, const float* value, int worker);

// Add every file from now on, when it is there, to the list in this file, which is there already: a line
// with its name, how many bytes it has, and their digest (base/digest.h). Before the first file.
DpStatus dp_frames_list(DpFrames* frames, const char* path);

// Write the whole picture from the packed tiles. `time` [s] goes into the header.
DpStatus dp_frames_write(DpFrames* frames, const char* path, double time);

// ---- in the background -------------------------------------------------------------------------

// One thread packs tiles and writes files, in the order they are given, while others go on. After a
// failure it leaves out all that is given until somebody asks how things went; the pictures lack it.
typedef struct DpWriter DpWriter;
DpStatus                dp_writer_create(DpWriter** writer, int workers);
void                    dp_writer_destroy(DpWriter* writer);  // when all that was given is written

// What is to be packed into `frames` next: fill in tiles, then give it to the writer, from the one
// thread that has the writer. NULL: no memory. Waits while many are queued.
typedef struct DpTiles DpTiles;
DpTiles*               dp_writer_tiles(DpWriter* writer, DpFrames* frames);
// Room for tile (tx, ty) as dp_frames_set_tile wants it, until the next call; NULL: no memory.
float* dp_tiles_add(DpTiles* tiles, int tx, int ty);
// Give the tiles, to be packed and, unless path is NULL, written as a file of that `time` [s]. The
// tiles are the writer's from now on, whatever comes back.
DpStatus dp_writer_give(DpWriter* writer, DpTiles* tiles, const char* path, double time);
// Let tiles go that cannot be filled.
void dp_writer_drop(DpWriter* writer, DpTiles* tiles);

// Wait until all that was given is written.
void dp_writer_wait(DpWriter* writer);

// How things went since the last call; path: where it failed ("" = encoding), valid until the next
// call to the writer. wait: first wait until all that was given is written.
DpStatus dp_writer_outcome(DpWriter* writer, bool wait, const char** path);

// ---- maps ------------------------------------------------------------------------------------

typedef struct DpMapChannel
{
    const char*  name;   // as in MAPS: compression, heap, ...
    const float* value;  // (ny, nx), row 0 = lowest y
} DpMapChannel;

// Write named float channels as one flat scan-line file, highest row first.
DpStatus dp_maps_write(const char* path, int nx, int ny, const DpMapChannel* channels,
                       int channel_count, const DpNote* notes, int note_count);

// The same of planes that hold DP_TILE rows at a time: before rows are written fill(context, j) has them hold rows j to
// j + DP_TILE - 1, from the highest down; of those below 0 nobody asks. Where it returns false: DP_CANNOT_WRITE, and the
// file is as it was.
typedef struct DpMapRows
{
    bool (*fill)(void* context, int j);
    void* context;
} DpMapRows;
DpStatus dp_maps_write_rows(const char* path, int nx, int ny, const DpMapChannel* channels,
                            int channel_count, const DpNote* notes, int note_count,
                            const DpMapRows* rows);

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
// A damaged or foreign file: DP_BAD_FILE, nothing allocated; images of more than 2^32 pixels, or 2^28 along
// a side, too.
// One packed as only a newer OpenEXR can: DP_BAD_PACKING.
DpStatus dp_maps_read(const char* path, DpMapFile** file);
void     dp_map_file_destroy(DpMapFile* file);

// ---- planes and points -------------------------------------------------------------------------

// Planes of the same cells: cell (i, j) has its centre at (x0, y0) + (i + 0.5, j + 0.5) cell.
typedef struct DpPlanes
{
    int                 nx, ny, count;
    double              x0, y0, cell;  // [m]
    double              still;         // a point this near to a centre lies on it [cells]
    const float* const* plane;         // (count) of (ny, nx)
} DpPlanes;

// Points of a mesh, in the world or in the object's own space.
typedef struct DpPoints
{
    int           count;
    const double* world;  // [m] (count, 3), or NULL:
    const float*  local;  // (count, 3)
    const double* place;  // rows of the map from own space to the world (3, 4) [m]
} DpPoints;

// Add to out (planes, points) what every plane says at the points: between the centres of cells in
// proportion, nothing outside.
void dp_planes_at(const DpPlanes* planes, const DpPoints* points, int workers, float* out);
