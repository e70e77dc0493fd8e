// Films of one ground: each sees its own rectangle of every change, and none outlives the reel.
#include <stdio.h>
#include <unistd.h>

#include "check.h"
#include "sim/planted.h"

static char folder[64];

static const char* path_of(const char* name, int number)
{
    static char path[2][128];
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
    CHECK(dp_reel_told(reel, true, &failed) == DP_OK && !*failed);
    dp_reel_destroy(reel);
    for (int k = 0; k < 2; ++k) {
        unlink(path_of("left", k)), unlink(path_of("whole", k)), unlink(path_of("right", k));
    }
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
    options.field[0] = DP_FIELD_LEAN;  // nothing grows here
    CHECK(dp_film_open(reel, &options, &film) == DP_BAD_ARGUMENT && !film);
    options.field[0] = DP_FIELD_BASE_HEIGHT, options.tiles_x = 0;
    CHECK(dp_film_open(reel, &options, &film) == DP_BAD_ARGUMENT && !film);
    options.tiles_x = 1, options.fields = DP_FILM_FIELDS + 1;
    CHECK(dp_film_open(reel, &options, &film) == DP_BAD_ARGUMENT && !film);
    dp_reel_destroy(reel);
    world_drop(&world);
    CHECK(dp_bytes_live() == 0);
}

int main(void)
{
    snprintf(folder, sizeof folder, "/tmp/desire_path_film_XXXXXX");
    if (!mkdtemp(folder)) return 1;
    RUN(parts_are_cut_from_the_whole);
    RUN(what_cannot_be_filmed_is_refused);
    rmdir(folder);
    return check_done();
}
