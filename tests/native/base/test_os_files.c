// tests of os_files_posix.c and os_files_windows.c: files are the same on every system
#include "base/os.h"
#include "check.h"
#include "folder.h"

static char folder[256];

static const char* place(const char* name)
{
    static char path[4][4096];
    static int  turn;
    char*       out = path[turn++ % 4];
    snprintf(out, sizeof path[0], "%s/%s", folder, name);
    return out;
}

static int put(const char* path, const char* text)
{
    DpFile file;
    return dp_file_create(path, &file) == DP_OK &&
           dp_file_write(file, text, strlen(text)) == DP_OK && dp_file_close(file) == DP_OK;
}

static int holds(const char* path, const char* text)
{
    DpFile  file;
    int64_t size = -1;
    char    read[64] = "";
    if (dp_file_open(path, &file, &size) != DP_OK) return 0;
    const int64_t got = dp_file_read(file, read, sizeof read - 1, 0);
    return dp_file_close(file) == DP_OK && got == size && (size_t)size == strlen(text) &&
           strcmp(read, text) == 0;
}

TEST(a_file_is_written_added_to_and_replaced)
{
    DpFile  file;
    int64_t size;
    CHECK(dp_file_open(place("a"), &file, &size) == DP_CANNOT_OPEN);
    CHECK(dp_file_append(place("a"), &file) == DP_CANNOT_OPEN);
    CHECK(put(place("a"), "one\r\ntwo\n"));  // bytes, not lines
    CHECK(holds(place("a"), "one\r\ntwo\n"));
    CHECK(dp_file_append(place("a"), &file) == DP_OK);
    CHECK(dp_file_write(file, "three", 5) == DP_OK);
    CHECK(dp_file_close(file) == DP_OK);
    CHECK(holds(place("a"), "one\r\ntwo\nthree"));
    CHECK(put(place("b"), "new"));
    CHECK(dp_file_open(place("a"), &file, &size) == DP_OK);
#ifndef _WIN32  // who reads the old one goes on reading it; there nobody replaces it meanwhile
    CHECK(dp_file_replace(place("b"), place("a")) == DP_OK);
#endif
    char byte[2];
    CHECK(dp_file_read(file, byte, 2, 3) == 2 && byte[0] == '\r' && byte[1] == '\n');
    CHECK(dp_file_read(file, byte, 2, size - 1) == 1);
    CHECK(dp_file_read(file, byte, 2, size + 9) == 0);
    CHECK(dp_file_close(file) == DP_OK);
#ifdef _WIN32
    CHECK(dp_file_replace(place("b"), place("a")) == DP_OK);
#endif
    CHECK(holds(place("a"), "new"));
    CHECK(dp_file_open(place("b"), &file, &size) == DP_CANNOT_OPEN);
    dp_file_remove(place("a"));
    dp_file_remove(place("a"));
    CHECK(dp_file_open(place("a"), &file, &size) == DP_CANNOT_OPEN);
    CHECK(dp_file_close(DP_NO_FILE) == DP_OK);
}

TEST(what_is_no_file_is_told)
{
    DpFile  file;
    int64_t size;
    CHECK(dp_file_open(folder, &file, &size) == DP_BAD_FILE);
    CHECK(file == DP_NO_FILE);
    CHECK(dp_file_create(place("none/a"), &file) == DP_CANNOT_OPEN);
    CHECK(put(place("a"), "x"));
    CHECK(dp_file_replace(place("a"), folder) == DP_CANNOT_WRITE);
    CHECK(holds(place("a"), "x"));
    dp_file_remove(place("a"));
}

TEST(names_may_have_any_letter)
{
    const char* name = place("\xe9\x9b\xaa\xe3\x81\xae\xe8\xb7\xa1 \xc3\xa4.exr");
    CHECK(put(name, "snow"));
    CHECK(holds(name, "snow"));
    dp_file_remove(name);
    CHECK(strcmp(dp_os_name("a/b.exr"), "b.exr") == 0);
    CHECK(strcmp(dp_os_name("b.exr"), "b.exr") == 0);
}

TEST(paths_may_be_longer_than_windows_once_took)
{
    char part[151], deep[600], name[1000];
    memset(part, 'x', sizeof part - 1), part[sizeof part - 1] = 0;
    snprintf(deep, sizeof deep, "%s/%s", folder, part);
    CHECK(FOLDER_MAKE(deep) == 0);
    snprintf(name, sizeof name, "%s/%s\xe9\x9b\xaa.exr", deep, part);
    CHECK(strlen(name) > 260 + 40);
    CHECK(put(name, "snow"));
    CHECK(put(place("b"), "more snow"));
    CHECK(dp_file_replace(place("b"), name) == DP_OK);
    CHECK(holds(name, "more snow"));
    dp_file_remove(name);
    CHECK(FOLDER_REMOVE(deep) == 0);
}

// what is to be a new file takes the place of a link, and follows none to be added to
#ifndef _WIN32
TEST(links_are_not_followed)
{
    DpFile file;
    CHECK(put(place("a"), "kept"));
    CHECK(symlink(place("a"), place("link")) == 0);
    CHECK(dp_file_append(place("link"), &file) == DP_CANNOT_OPEN);
    CHECK(put(place("link"), "new"));
    CHECK(holds(place("a"), "kept") && holds(place("link"), "new"));
    dp_file_remove(place("a")), dp_file_remove(place("link"));
}
#endif

// a file larger than one buffer, read from its middle
TEST(many_bytes_are_written_and_read)
{
    enum
    {
        MANY = 300000
    };
    unsigned char* bytes = dp_alloc(MANY, 1);
    unsigned char* read = dp_alloc(MANY, 1);
    unsigned       seed = 5u;
    DpFile         file;
    int64_t        size;
    for (int k = 0; k < MANY; ++k) bytes[k] = (unsigned char)(256.0 * check_random(&seed));
    CHECK(dp_file_create(place("a"), &file) == DP_OK);
    CHECK(dp_file_write(file, bytes, 1000) == DP_OK);
    CHECK(dp_file_write(file, bytes + 1000, MANY - 1000) == DP_OK && dp_file_close(file) == DP_OK);
    CHECK(dp_file_open(place("a"), &file, &size) == DP_OK && size == MANY);
    CHECK(dp_file_read(file, read, MANY, 0) == MANY && memcmp(read, bytes, MANY) == 0);
    CHECK(dp_file_read(file, read, MANY, 123456) == MANY - 123456);
    CHECK(memcmp(read, bytes + 123456, MANY - 123456) == 0);
    CHECK(dp_file_write(file, bytes, 1) == DP_CANNOT_WRITE);  // it is open to read
    CHECK(dp_file_close(file) == DP_OK);
    CHECK(put(place("a"), "x") && holds(place("a"), "x"));  // anew, not over what was longer
    dp_file_remove(place("a"));
    dp_free(bytes), dp_free(read);
}

int main(void)
{
    folder_make(folder, sizeof folder, "files");
    RUN(a_file_is_written_added_to_and_replaced);
    RUN(what_is_no_file_is_told);
    RUN(names_may_have_any_letter);
    RUN(paths_may_be_longer_than_windows_once_took);
#ifndef _WIN32
    RUN(links_are_not_followed);
#endif
    RUN(many_bytes_are_written_and_read);
    FOLDER_REMOVE(folder);
    return check_done();
}
