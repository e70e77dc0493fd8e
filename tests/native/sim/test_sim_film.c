// Films of one ground: each sees its own rectangle of every change, and none outlives the reel.
#include <stdio.h>

#include "check.h"
#include "folder.h"
#include "sim/planted.h"

static char folder[512];

static const char* path_of(const char* name, int number)
{
    static char path[2][640];
    static int  turn;
    char*       out = path[turn++ % 2];
    snprintf(out, sizeof path[0], "%s/%s%d.exr", folder, name, number);
    return out;
}

static DpFilm* film_of(DpReel* reel, long tx, int tiles_x)
{
    DpFilm*       film = NULL;
    DpFilmOptions options = {
        .tile_x = tx, .tile_y = -1, .tiles_x = tiles_x, .tiles_y = 2, .fields = 2};
    options.field[0] = DP_FIELD_COMPRESSION, options.channel[0] = "B";
    options.field[1] = DP_FIELD_HEAP, options.channel[1] = "H";
    CHECK(dp_film_open(reel, &options, &film) == DP_OK);
    return film;
}

// whether the left or the right tiles of the whole picture are those of a part
static bool is_part(const char* whole, const char* part, int right)
{
    DpMapFile *a = NULL, *b = NULL;
    bool       same = dp_maps_read(whole, &a) == DP_OK && dp_maps_read(part, &b) == DP_OK &&
                a->nx == 2 * b->nx && a->ny == b->ny;
    bool pressed = false;
    for (int c = 0; same && c < 2; ++c)
        for (int j = 0; same && j < b->ny; ++j)
            for (int i = 0; same && i < b->nx; ++i) {
                const float from = a->value[(c * a->ny + j) * a->nx + i + right * b->nx];
                const float is = b->value[(c * b->ny + j) * b->nx + i];
                same = !(from > is) && !(from < is);
                pressed = pressed || is > 0.0f;
            }
    dp_map_file_destroy(a);
    dp_map_file_destroy(b);
    return same && pressed;
}

TEST(parts_are_cut_from_the_whole)
{
    World       world;
    Stride      s = stride_make(1, 3, 80.0, STRIDE_RATE);
    DpReel*     reel = NULL;
    const char* failed = "";
    for (int k = 0; k < s.gait.times * s.gait.parts; ++k)
        s.pose[7 * k] -= 0.5, s.point[3 * k] -= 0.5;
    CHECK(world_make(&world, NULL, 0.0, 0.0, 0.0, 1.0, 0.02, 2) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_reel_create(&reel, world.sim, 2) == DP_OK);
    DpFilm* whole = film_of(reel, -1, 2);
    DpFilm* left = film_of(reel, -1, 1);
    DpFilm* right = NULL;
    for (int k = 0; k < 2; ++k) {
        CHECK(dp_sim_run(world.sim, (k + 1) * (s.gait.times - 1) / 2) == DP_OK);
        if (!right) right = film_of(reel, 0, 1);  // late: it begins with what is there
        CHECK(dp_film_write(left, path_of("left", k), 0.0, &failed) == DP_OK);
        CHECK(dp_film_write(whole, path_of("whole", k), 0.0, &failed) == DP_OK);
        CHECK(dp_film_write(right, path_of("right", k), 0.0, &failed) == DP_OK);
    }
    dp_film_close(left);  // when its file is written
    CHECK(is_part(path_of("whole", 1), path_of("left", 1), 0));
    CHECK(is_part(path_of("whole", 1), path_of("right", 1), 1));
    CHECK(dp_film_write(right, NULL, 0.0, &failed) == DP_OK);
    CHECK(dp_reel_outcome(reel, true, &failed) == DP_OK && !*failed);
    dp_reel_destroy(reel);
    for (int k = 0; k < 2; ++k) {
        remove(path_of("left", k)), remove(path_of("whole", k)), remove(path_of("right", k));
    }
    world_drop(&world);
    stride_drop(&s);
    CHECK(dp_bytes_live() == 0);
}

static const char* note_of(const DpMapFile* file, const char* name)
{
    for (int n = 0; n < file->note_count; ++n)
        if (strcmp(file->note_name[n], name) == 0) return file->note_text[n];
    return "";
}

// a program without Python writes what a bake plays: channels, notes and tiles are the core's
TEST(frames_for_playback_are_written_from_c)
{
    World       world;
    Stride      s = stride_make(1, 3, 80.0, STRIDE_RATE);
    DpPlantKind kind = dp_plant_kind_default();
    DpReel*     reel = NULL;
    DpFilm*     film[2] = {NULL, NULL};
    const char* failed = "";
    DpMapFile*  file[2] = {NULL, NULL};
    CHECK(world_make(&world, &kind, 0.0, -0.3, 0.6, 0.1, 0.02, 2) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_reel_create(&reel, world.sim, 2) == DP_OK);
    const DpFilmOptions tiles = {.tile_x = -1, .tile_y = -1, .tiles_x = 3, .tiles_y = 2};
    for (int k = 0; k < 2; ++k)
        CHECK(dp_film_open_playback(reel, &tiles, (DpPlayback)k, "a test", &film[k]) == DP_OK);
    CHECK(dp_sim_run(world.sim, s.gait.times - 1) == DP_OK);
    for (int k = 0; k < 2; ++k) {
        CHECK(dp_film_write(film[k], path_of("play", k), 0.5, &failed) == DP_OK);
        dp_film_close(film[k]);
        CHECK(dp_maps_read(path_of("play", k), &file[k]) == DP_OK);
        remove(path_of("play", k));
    }
    for (int k = 0; k < 2 && file[0] && file[1]; ++k) {
        CHECK(file[k]->nx == 3 * DP_TILE && file[k]->ny == 2 * DP_TILE);
        CHECK(file[k]->channel_count == 4 && strcmp(note_of(file[k], "software"), "a test") == 0);
        CHECK(strcmp(note_of(file[k], "channelG"), k ? "lean_y [-]" : "plant strength [-]") == 0);
    }
    for (int c = 0; c < 4 && file[0]; ++c) {  // B: compression
        if (strcmp(file[0]->channel[c], "B") != 0) continue;
        float* wanted = dp_alloc((size_t)(6 * DP_TILE * DP_TILE), sizeof *wanted);
        CHECK(wanted && dp_terrain_read(world.terrain, DP_FIELD_COMPRESSION, -DP_TILE, -DP_TILE,
                                        3 * DP_TILE, 2 * DP_TILE, wanted) == DP_OK);
        if (wanted)
            CHECK(memcmp(wanted, file[0]->value + (size_t)(c * 6 * DP_TILE * DP_TILE),
                         (size_t)(6 * DP_TILE * DP_TILE) * sizeof *wanted) == 0);
        dp_free(wanted);
    }
    for (int k = 0; k < 2; ++k) dp_map_file_destroy(file[k]);
    dp_reel_destroy(reel);
    world_drop(&world);
    stride_drop(&s);
    CHECK(dp_bytes_live() == 0);
}

TEST(what_cannot_be_filmed_is_refused)
{
    World         world;
    DpReel*       reel = NULL;
    DpFilm*       film = NULL;
    DpFilmOptions options = {.tiles_x = 1, .tiles_y = 1, .fields = 1};
    options.channel[0] = "Y";
    CHECK(world_make(&world, NULL, 0.0, 0.0, 0.0, 1.0, 0.02, 1) == DP_OK);
    CHECK(dp_reel_create(&reel, world.sim, 1) == DP_OK);
    options.field[0] = DP_FIELD_LEAN_X;  // nothing grows here
    CHECK(dp_film_open(reel, &options, &film) == DP_BAD_ARGUMENT && !film);
    options.field[0] = DP_FIELD_BASE_HEIGHT, options.tiles_x = 0;
    CHECK(dp_film_open(reel, &options, &film) == DP_BAD_ARGUMENT && !film);
    options.tiles_x = 1, options.fields = DP_FILM_FIELDS + 1;
    CHECK(dp_film_open(reel, &options, &film) == DP_BAD_ARGUMENT && !film);
    dp_reel_destroy(reel);
    world_drop(&world);
    CHECK(dp_bytes_live() == 0);
}

// how grass lies and what presses now, in a film as they are read
TEST(films_show_how_grass_lies_and_what_presses)
{
    static const int   field[4] = {DP_FIELD_LEAN_X, DP_FIELD_LEAN_Y, DP_FIELD_CRUSHED,
                                   DP_FIELD_PRESSURE};
    static const char* name[4] = {"A", "B", "G", "R"};
    static float       want[4][6 * DP_TILE * DP_TILE];
    const int          nx = 3 * DP_TILE, ny = 2 * DP_TILE;
    World              world;
    Stride             s = stride_make(1, 3, 80.0, STRIDE_RATE);
    DpPlantKind        kind = dp_plant_kind_default();
    DpReel*            reel = NULL;
    DpFilm*            film = NULL;
    DpMapFile*         file = NULL;
    const char*        failed = "";
    DpFilmOptions options = {.tile_x = -1, .tile_y = -1, .tiles_x = 3, .tiles_y = 2, .fields = 4};
    for (int f = 0; f < 4; ++f) options.field[f] = field[f], options.channel[f] = name[f];
    CHECK(world_make(&world, &kind, 0.0, -0.3, 0.9, 0.1, 0.02, 2) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_reel_create(&reel, world.sim, 2) == DP_OK);
    CHECK(dp_film_open(reel, &options, &film) == DP_OK);
    CHECK(dp_sim_run(world.sim, (int)(0.8 * STRIDE_RATE)) == DP_OK);  // somebody stands
    dp_grass_read(dp_sim_grass(world.sim), -DP_TILE, -DP_TILE, nx, ny, want[0], want[1], want[2]);
    dp_sim_pressure(world.sim, -DP_TILE, -DP_TILE, nx, ny, want[3]);
    CHECK(dp_film_write(film, path_of("lean", 0), 0.0, &failed) == DP_OK);
    dp_film_close(film);
    CHECK(dp_maps_read(path_of("lean", 0), &file) == DP_OK);
    remove(path_of("lean", 0));
    for (int c = 0; file && c < 4; ++c)
        for (int f = 0; f < 4; ++f) {
            if (strcmp(file->channel[c], name[f]) != 0) continue;
            float most = 0.0f;
            for (int k = 0; k < nx * ny; ++k) most = fmaxf(most, fabsf(want[f][k]));
            CHECK(most > 0.05f);
            CHECK(memcmp(file->value + (size_t)c * (size_t)(nx * ny), want[f], sizeof want[f]) ==
                  0);
        }
    dp_map_file_destroy(file);
    dp_reel_destroy(reel);
    world_drop(&world);
    stride_drop(&s);
}

int main(void)
{
    folder_make(folder, sizeof folder, "film");
    RUN(parts_are_cut_from_the_whole);
    RUN(frames_for_playback_are_written_from_c);
    RUN(what_cannot_be_filmed_is_refused);
    RUN(films_show_how_grass_lies_and_what_presses);
    FOLDER_REMOVE(folder);
    return check_done();
}
