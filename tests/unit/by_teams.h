/* by_teams.h - tests: whatever the number of threads that read it, a text becomes the same scene, or is refused for the
 * same faults. */
#ifndef ZR_TESTS_BY_TEAMS_H
#define ZR_TESTS_BY_TEAMS_H

#include "base/team.h"
#include "same_scene.h"
#include "texts.h"

enum { TEAMS = 3, CEILING = 1 << 28 };

static inline void start_teams(struct zr_team **teams)
{
    static const int sizes[TEAMS] = {2, 3, 7};
    for (size_t i = 0; i < TEAMS; i++)
        assert_non_null(teams[i] = zr_team_create(sizes[i]));
}

static inline void end_teams(struct zr_team **teams)
{
    for (size_t i = 0; i < TEAMS; i++)
        zr_team_destroy(teams[i]);
}

static inline struct reading *read_by(struct zr_team *team, enum zr_format format, const struct text *text)
{
    return read_by_team(team, (struct zr_request){.format = format}, text->bytes, text->size, zr_limits_default(),
                        CEILING);
}

static inline void assert_same_reading(const struct reading *a, const struct reading *b)
{
    assert_int_equal(a->status, b->status);
    assert_int_equal(a->error.count, b->error.count);
    for (size_t i = 0; i < zr_error_held(&a->error); i++) {
        assert_string_equal(a->error.items[i].pointer, b->error.items[i].pointer);
        assert_string_equal(a->error.items[i].detail, b->error.items[i].detail);
    }
    if (a->scene) assert_same_scene(a->scene, b->scene);
}

/* As `alone` was read without a team. */
static inline void assert_same_by_teams(struct zr_team *const *teams, enum zr_format format, const struct text *text,
                                        const struct reading *alone)
{
    for (size_t i = 0; i < TEAMS; i++) {
        struct reading *shared = read_by(teams[i], format, text);
        assert_same_reading(alone, shared);
        reading_free(shared);
    }
}

#endif
