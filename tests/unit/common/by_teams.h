/* by_teams.h - tests: whatever the number of threads that read it, a text becomes the same scene, or is refused for the
 * same faults. */
#ifndef ZR_TESTS_BY_TEAMS_H
#define ZR_TESTS_BY_TEAMS_H

#include "base/team.h"
#include "input/text/parts.h"
#include "same_scene.h"
#include "texts.h"

enum { TEAMS = 3, CEILING = 1 << 28, FAULT_SIZE = 96 };

static struct zr_team *teams[TEAMS];

/* Assets of each request. */
static const struct zr_asset *team_assets;
static size_t team_asset_count;

/* Before all tests of a file, and after them. */
static inline int start_teams(void **state)
{
    static const int sizes[TEAMS] = {2, 3, 7};
    (void)state;
    for (size_t i = 0; i < TEAMS; i++)
        if (!(teams[i] = zr_team_create(sizes[i]))) return -1;
    return 0;
}

static inline int end_teams(void **state)
{
    (void)state;
    for (size_t i = 0; i < TEAMS; i++)
        zr_team_destroy(teams[i]);
    return 0;
}

static inline struct reading *read_by(struct zr_team *team, enum zr_format format, const struct text *text)
{
    const struct zr_request request = {.format = format, .assets = team_assets, .asset_count = team_asset_count};
    return read_by_team(team, request, text->bytes, text->size, zr_limits_default(), CEILING);
}

static inline void assert_same_reading(const struct reading *a, const struct reading *b)
{
    assert_int_equal(a->status, b->status);
    assert_int_equal(a->error.status, b->error.status);
    assert_int_equal(a->error.count, b->error.count);
    for (size_t i = 0; i < zr_error_held(&a->error); i++) {
        assert_string_equal(a->error.items[i].pointer, b->error.items[i].pointer);
        assert_string_equal(a->error.items[i].detail, b->error.items[i].detail);
    }
    if (a->scene) assert_same_scene(a->scene, b->scene);
}

/* What one thread reads, and every team as well. */
static inline struct reading *read_by_all(enum zr_format format, const struct text *text)
{
    struct reading *alone = read_by(NULL, format, text);
    for (size_t i = 0; i < TEAMS; i++) {
        struct reading *shared = read_by(teams[i], format, text);
        assert_same_reading(alone, shared);
        reading_free(shared);
    }
    return alone;
}

/* Asserts that the faults, up to the maximum that an error holds, have details that contain these texts, in order. */
static inline void assert_faults(const struct reading *reading, char (*faults)[FAULT_SIZE], size_t count)
{
    assert_int_equal(reading->status, ZR_BAD_SCENE);
    assert_int_equal(reading->error.count, count < ZR_ERROR_ITEMS ? count : ZR_ERROR_ITEMS);
    for (size_t i = 0; i < zr_error_held(&reading->error); i++)
        assert_non_null(strstr(reading->error.items[i].detail, faults[i]));
}

#endif
