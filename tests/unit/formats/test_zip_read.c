/* input/zip/zip_read.h: reads valid archives, refuses others. */
#include "base/cancel.h"
#include "input/zip/zip_read.h"
#include "support/input/zip_file.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

enum { TEXT_SIZE = 100000, CEILING = 1 << 24 };

static char text[TEXT_SIZE];

struct opened {
    struct zr_arena arena;
    struct guarded file;
    struct zr_zip zip;
    struct zr_reason reason;
    enum zr_status status;
};

static void open_zip(struct opened *opened, const void *bytes, size_t size)
{
    memset(opened, 0, sizeof *opened);
    zr_arena_init(&opened->arena, CEILING);
    opened->file = guarded_copy(bytes, size);
    opened->status = zr_zip_open(&opened->arena, opened->file.bytes, size, &opened->zip, &opened->reason);
}

static void close_zip(struct opened *opened)
{
    guarded_free(&opened->file);
    zr_arena_free(&opened->arena);
}

static unsigned char *two_members(size_t *size, size_t *directory)
{
    for (size_t i = 0; i < TEXT_SIZE; i++)
        text[i] = (char)('a' + i * i % 23 % 26);
    const struct zip_entry entries[] = {{"dir/b.txt", text, TEXT_SIZE, true}, {"A.txt", "hello", 5, false}};
    return zip_file(entries, 2, size, directory);
}

TEST(members_are_found_by_name_and_read)
{
    size_t size, directory;
    unsigned char *file = two_members(&size, &directory);
    struct opened opened;
    const char *bytes;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_OK);
    assert_int_equal(opened.zip.count, 2);
    const struct zr_zip_member *b = zr_zip_find(&opened.zip, "dir/b.txt", 9);
    const struct zr_zip_member *a = zr_zip_find(&opened.zip, "a.TXT", 5);
    assert_non_null(b);
    assert_non_null(a);
    assert_null(zr_zip_find(&opened.zip, "b.txt", 5));
    assert_int_equal(zr_zip_read(b, &opened.arena, &bytes, &opened.reason), ZR_OK);
    assert_int_equal(b->size, TEXT_SIZE);
    assert_memory_equal(bytes, text, TEXT_SIZE);
    assert_int_equal(zr_zip_read(a, &opened.arena, &bytes, &opened.reason), ZR_OK);
    assert_memory_equal(bytes, "hello", 5);
    close_zip(&opened);
    free(file);
}

TEST(backslashes_of_names_are_slashes)
{
    size_t size, directory;
    const struct zip_entry entries[] = {{"dir\\sub\\b.txt", "1", 1, false}, {"dir\\", "", 0, false}};
    unsigned char *file = zip_file(entries, 2, &size, &directory);
    struct opened opened;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_OK);
    assert_int_equal(opened.zip.count, 1);
    assert_non_null(zr_zip_find(&opened.zip, "dir/sub/b.txt", 13));
    close_zip(&opened);
    free(file);
    const struct zip_entry above[] = {{"a\\..\\b", "1", 1, false}};
    file = zip_file(above, 1, &size, &directory);
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "'..'"));
    close_zip(&opened);
    free(file);
}

/* Replaces bytes of an archive of two members. Offsets are from the directory if the first field is true. */
TEST(wrong_bytes_are_refused_with_their_reason)
{
    static const struct {
        bool in_directory;
        size_t offset;
        uint32_t value;
        int bytes;
        const char *reason;
    } cases[] = {
        {true, 8, 1, 2, "encrypted"},
        {true, 24, 99999, 4, "another size or method"},
        {true, 42, 4, 4, "local header is missing"},
        {true, 46, 0x2F2E2E, 3, "'..'"},
        {true, 46, '/', 1, "absolute"},
        {true, 46, '\\', 1, "absolute"},
        {true, 46, 1, 1, "control character"},
        {true, 46, 'e', 1, "another name"},
        {true, 42 + 55, 0, 4, "another name"},
        {true, 0, 0, 4, "cut off"},
        {false, 0, 0, 4, "local header is missing"},
        {false, 8, 0, 2, "another size or method"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size, directory;
        unsigned char *file = two_members(&size, &directory);
        zip_put(file + (cases[i].in_directory ? directory : 0) + cases[i].offset, cases[i].value, cases[i].bytes);
        struct opened opened;
        open_zip(&opened, file, size);
        if (opened.status != ZR_BAD_SYNTAX || !strstr(opened.reason.text, cases[i].reason))
            fail_msg("case %zu: status %d, %s", i, (int)opened.status, opened.reason.text);
        close_zip(&opened);
        free(file);
    }
}

TEST(duplicates_and_overlaps_are_refused)
{
    size_t size, directory;
    const struct zip_entry twice[] = {{"a", "1", 1, false}, {"a", "2", 1, false}};
    unsigned char *file = zip_file(twice, 2, &size, &directory);
    struct opened opened;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "'a': it occurs twice"));
    close_zip(&opened);
    zip_put(file + directory + 47 + 42, 0, 4); /* the second entry names the first member's header */
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "overlaps"));
    close_zip(&opened);
    free(file);
}

/* Both headers have the same wrong size or checksum. */
TEST(members_that_are_not_as_the_directory_says_are_refused)
{
    static const struct {
        size_t local, central;
        uint32_t value;
        const char *reason;
    } cases[] = {{22, 24, TEXT_SIZE - 1, "more than the size"},
                 {22, 24, TEXT_SIZE + 1, "less than the size"},
                 {14, 16, 7, "checksum"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size, directory;
        const char *bytes;
        unsigned char *file = two_members(&size, &directory);
        zip_put(file + cases[i].local, cases[i].value, 4);
        zip_put(file + directory + cases[i].central, cases[i].value, 4);
        struct opened opened;
        open_zip(&opened, file, size);
        assert_int_equal(opened.status, ZR_OK);
        const struct zr_zip_member *member = zr_zip_find(&opened.zip, "dir/b.txt", 9);
        assert_int_equal(zr_zip_read(member, &opened.arena, &bytes, &opened.reason), ZR_BAD_SYNTAX);
        if (!strstr(opened.reason.text, cases[i].reason)) fail_msg("case %zu: %s", i, opened.reason.text);
        close_zip(&opened);
        free(file);
    }
}

TEST(bombs_are_foretold_by_the_directory)
{
    size_t size, directory;
    const char *bytes;
    char *zeros = calloc(CEILING, 2);
    const struct zip_entry entries[] = {{"zeros", zeros, 2 * (size_t)CEILING, true}};
    unsigned char *file = zip_file(entries, 1, &size, &directory);
    struct opened opened;
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_OK);
    assert_int_equal(zr_zip_read(opened.zip.members, &opened.arena, &bytes, &opened.reason), ZR_NO_MEMORY);
    close_zip(&opened);
    zip_put(file + 22, 0xFFFFFFF0, 4); /* more than the packed bytes can inflate to */
    zip_put(file + directory + 24, 0xFFFFFFF0, 4);
    open_zip(&opened, file, size);
    assert_int_equal(opened.status, ZR_BAD_SYNTAX);
    assert_non_null(strstr(opened.reason.text, "do not add up"));
    close_zip(&opened);
    free(file);
    free(zeros);
}

TEST(archives_that_are_cut_off_are_refused)
{
    size_t size, directory;
    unsigned char *file = two_members(&size, &directory);
    for (size_t cut = 0; cut < size; cut += cut < 200 || size - cut < 200 ? 1 : 97) {
        struct opened opened;
        open_zip(&opened, file, cut);
        assert_int_equal(opened.status, ZR_BAD_SYNTAX);
        close_zip(&opened);
    }
    free(file);
}

TEST(a_raised_cancel_stops_inflating)
{
    size_t size, directory;
    const char *bytes;
    unsigned char *file = two_members(&size, &directory);
    struct opened opened;
    struct zr_cancel cancel = {.raised = true};
    open_zip(&opened, file, size);
    opened.arena.cancel = &cancel;
    assert_int_equal(zr_zip_read(&opened.zip.members[1], &opened.arena, &bytes, &opened.reason), ZR_CANCELLED);
    close_zip(&opened);
    free(file);
}

RUN_TESTS(NULL, NULL)
