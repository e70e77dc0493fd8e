// sim/sim_film.h - pictures of a simulation's ground as it changes, written in the background.
//
//   ground ---what changed---> reel ---> films (a rectangle of tiles, some fields) ---> files
//
// Many films may be open at once, of the same ground or of different ones: each hears of every
// change within its rectangle. Comes in with sim/sim.h.
#pragma once
#include "maps/maps.h"
#include "terrain/terrain.h"

#define DP_FILM_FIELDS 48

// Fields beyond the terrain's own, as terrain_fields.h has those.
#define DP_SIM_FIELDS(X)                                                                \
    X(LEAN_X, lean_x, 64, "-", "", "how far grass leans along x, by its height, -1..1") \
    X(LEAN_Y, lean_y, 65, "-", "", "how far it leans along y")                          \
    X(CRUSHED, crushed, 66, "-", "", "share of its height that is pressed down, 0..1")  \
    X(PRESSURE, pressure, 67, "Pa", "", "stress under the soles at that moment")
enum
{
    DP_SIM_FIELDS(DP_FIELD_NUMBER)
};
#define DP_FIELD_LAYER 3000  // and from here on: layers of the ground, dp_sim_layers

// All fields of a simulation, the terrain's and these; *count how many.
const DpFieldInfo* dp_sim_fields(int* count);

typedef struct DpSim  DpSim;
typedef struct DpReel DpReel;  // all films of one simulation, and the thread that writes them
typedef struct DpFilm DpFilm;

#define DP_PAGE 60      // cells a page of a sparse picture shows ..
#define DP_PAGE_EDGE 2  // .. and so many of its neighbours' beyond each side: DP_TILE together

// A sparse picture: some pages of a rectangle of tiles, page (x, y) from its cell (x, y) * DP_PAGE on. The k-th lies in
// column k % columns, row k / columns of the picture, rows from its lower side.
typedef struct DpAtlas
{
    int            columns, rows, pages;  // 1 <= pages <= columns * rows
    const int32_t* page;                  // x and y of each, none twice (pages, 2)
} DpAtlas;

typedef struct DpFilmOptions
{
    long tile_x, tile_y;    // lowest tile
    int  tiles_x, tiles_y;  // >= 1

    const DpAtlas* atlas;  // copied; NULL = all of the rectangle is in the picture

    int         fields;                   // 1..DP_FILM_FIELDS
    int         field[DP_FILM_FIELDS];    // of dp_sim_fields; how grass lies on planted ground only
    const char* channel[DP_FILM_FIELDS];  // the name of each in the files

    const DpNote* notes;  // of every file's header
    int           note_count;
} DpFilmOptions;

// What a file for playback shows, a channel each: R, G, B, A.
typedef enum DpPlayback
{
    DP_PLAY_TRAIL = 0,  // height change, plant strength, compression, pressure_time
    DP_PLAY_LEAN = 1    // lean_x, lean_y, crushed, plant strength; on planted ground only
} DpPlayback;

// The simulation is borrowed and must outlive the reel.
DpStatus dp_reel_create(DpReel** reel, DpSim* sim, int workers);
void     dp_reel_destroy(DpReel* reel);  // with its films, when all that was given is written

// How the files of all films went since the last call; path: where it failed ("" = encoding), valid
// until the next call. wait: first wait until all that was given is written.
DpStatus dp_reel_outcome(DpReel* reel, bool wait, const char** path);

// Begin a film with the ground as it is now.
DpStatus dp_film_open(DpReel* reel, const DpFilmOptions* options, DpFilm** film);
// The same for playback: of `options` only the tiles are looked at. `software` stands in the header.
DpStatus dp_film_open_playback(DpReel* reel, const DpFilmOptions* options, DpPlayback shows,
                               const char* software, DpFilm** film);
// Can a film show this field on this ground?
bool dp_film_shows(const DpSim* sim, int field);
void dp_film_close(DpFilm* film);  // when what it was given is written

// Add every file of the film to a list, see dp_frames_list; when what it was given is written.
DpStatus dp_film_list(DpFilm* film, const char* path);

// Take in what changed since the film's last file, to be packed and, unless path is NULL, written as
// a file of that `time` [s]. Tells first of files that failed before: *failed as dp_reel_outcome's path.
DpStatus dp_film_write(DpFilm* film, const char* path, double time, const char** failed);
