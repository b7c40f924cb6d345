/* Parts that threads read, up to the first that cannot be. */
#include "support/tests.h"
#include "unit/common/by_teams.h"

enum { PARTS = 1000 };

struct parts {
    size_t bad, raises; /* a part that cannot be read, and one that raises `cancel` */
    struct zr_cancel cancel;
    _Atomic uint8_t read[PARTS];
};

static bool read_part(void *context, size_t part)
{
    struct parts *parts = context;
    parts->read[part]++;
    if (part == parts->raises) atomic_store(&parts->cancel.raised, true);
    return part < parts->bad;
}

TEST(all_parts_before_a_bad_one_are_read_once)
{
    static const size_t bads[] = {PARTS, PARTS - 1, 500, 11, 10};
    enum { FIRST = 10 };
    for (int team = -1; team < TEAMS; team++)
        for (size_t i = 0; i < sizeof bads / sizeof bads[0]; i++) {
            struct parts parts = {.bad = bads[i], .raises = SIZE_MAX};
            const size_t failed =
                zr_parts_read(team < 0 ? NULL : teams[team], &parts.cancel, FIRST, PARTS, read_part, &parts);
            assert_int_equal(failed, bads[i]);
            for (size_t k = 0; k < failed; k++)
                assert_int_equal(parts.read[k], k >= FIRST);
        }
}

TEST(nothing_is_begun_once_it_is_cancelled)
{
    enum { RAISES = 100 };
    struct parts parts = {.bad = PARTS, .raises = RAISES};
    assert_int_equal(zr_parts_read(NULL, &parts.cancel, 0, PARTS, read_part, &parts), RAISES + 1);
    for (size_t k = 0; k < PARTS; k++)
        assert_int_equal(parts.read[k], k <= RAISES);
    for (size_t i = 0; i < TEAMS; i++) {
        struct parts shared = {.bad = PARTS, .raises = RAISES};
        const size_t failed = zr_parts_read(teams[i], &shared.cancel, 0, PARTS, read_part, &shared);
        size_t read = 0;
        for (size_t k = 0; k < PARTS; k++)
            read += shared.read[k];
        assert_in_range(failed, 1, PARTS); /* the one that raises it may be taken last */
        for (size_t k = 0; k < failed; k++)
            assert_int_equal(shared.read[k], 1);
        assert_true(failed == PARTS || read < PARTS);
    }
}

static const char *cut_behind_comma(const char *at, size_t size, const char *end)
{
    const char *comma = memchr(at + size, ',', (size_t)(end - at) - size);
    return comma ? comma + 1 : end;
}

TEST(parts_are_all_that_there_is)
{
    static const char text[] = "aaa,bbbb,c,ddddddd,ee";
    static const char *const wants[][6] = {{"aaa,", "bbbb,", "c,", "ddddddd,", "ee"},
                                           {"aaa,bbbb,", "c,ddddddd,", "ee"},
                                           {"aaa,bbbb,c,ddddddd,", "ee"},
                                           {text}};
    static const size_t sizes[] = {1, 5, 11, sizeof text - 1};
    for (size_t i = 0; i < 4; i++) {
        struct zr_arena arena;
        size_t count;
        zr_arena_init(&arena, 1 << 16);
        const struct zr_part *parts =
            zr_parts_cut(&arena, text, text + sizeof text - 1, sizes[i], cut_behind_comma, &count);
        for (size_t k = 0; k < count; k++) {
            assert_non_null(wants[i][k]);
            assert_int_equal(parts[k].end - parts[k].at, strlen(wants[i][k]));
            assert_memory_equal(parts[k].at, wants[i][k], strlen(wants[i][k]));
        }
        assert_null(wants[i][count]);
        zr_arena_free(&arena);
    }
    struct zr_arena none;
    size_t count;
    zr_arena_init(&none, 0);
    assert_null(zr_parts_cut(&none, text, text + 5, 1, cut_behind_comma, &count));
    assert_int_equal(count, 0);
    zr_arena_free(&none);
}

RUN_TESTS(start_teams, end_teams)
