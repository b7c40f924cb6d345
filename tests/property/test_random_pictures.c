/* Scenes with any values of the keys that pictures have: every instruction set gives, on 1, 2 and 7 threads, the bytes
 * of plain C on one; the first 100 have those of tests/scenes/random-digests.txt. RANDOM_PICTURES=N draws so many (100
 * otherwise), RANDOM_PICTURES_FROM=N begins with that one. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "scene/picture.h"
#include "support/isas.h"
#include "support/pictures/digests.h"
#include "support/pictures/pictures.h"
#include "support/random_scenes.h"

static uint64_t number_of(const char *variable, uint64_t otherwise)
{
    const char *wish = getenv(variable);
    return wish && *wish ? strtoull(wish, NULL, 10) : otherwise;
}

/* How many pictures have what is to be tried. */
struct seen {
    uint64_t linear, textbook, gradients, environments, occluded, grounded, edged, shadowed, placed, shown, several;
};

static bool has_shadows(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].has_shadows) return true;
    return false;
}

static bool has_placed_lamps(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (zr_light_has_place(&scene->lights[i])) return true;
    return false;
}

/* More than one colour. */
static bool shows_something(const struct zr_frame *frame)
{
    for (size_t i = 1; i < (size_t)frame->width * frame->height; i++)
        if (memcmp(frame->color, frame->color + 4 * i, 4) != 0) return true;
    return false;
}

static void count(const struct drawn_picture *drawn, struct seen *seen)
{
    const struct zr_picture *picture = drawn->scene->picture;
    seen->linear += picture->is_linear;
    seen->textbook += !picture->is_linear;
    seen->gradients += picture->has_gradient;
    seen->environments += picture->environment.name != ZR_ENVIRONMENT_NONE;
    seen->occluded += picture->is_linear && picture->occlusion.is_on;
    seen->grounded += picture->is_linear && picture->has_ground;
    seen->edged += picture->is_linear && picture->edges.is_on;
    seen->shadowed += picture->is_linear && has_shadows(drawn->scene);
    seen->placed += has_placed_lamps(drawn->scene);
    seen->several += picture->side > 1;
    seen->shown += shows_something(drawn->frame);
}

static void assert_enough(const struct seen *seen, uint64_t pictures)
{
    const uint64_t least[] = {seen->linear,   seen->gradients, seen->environments, seen->occluded,
                              seen->grounded, seen->edged,     seen->shadowed,     seen->several};
    for (size_t i = 0; i < sizeof least / sizeof *least; i++)
        if (least[i] < pictures / 6)
            fail_msg("only %" PRIu64 " of %" PRIu64 " have feature %zu", least[i], pictures, i);
    assert_true(seen->textbook >= pictures / 50);
    assert_true(seen->placed >= pictures / 10);
    assert_true(seen->shown >= pictures * 3 / 4);
}

TEST_EACH_ISA(random_pictures_have_the_bytes_of_plain_c)
{
    enum { TEAMS = 3, DIGESTS = 100 };
    static const int threads[TEAMS] = {1, 2, 7};
    const enum zr_isa isa = isa_under_test(state);
    const uint64_t pictures = number_of("RANDOM_PICTURES", 100), from = number_of("RANDOM_PICTURES_FROM", 1);
    struct zr_team *teams[TEAMS];
    struct zr_arena arena;
    struct seen seen = {0};
    FILE *digests = digests_open();
    zr_arena_init(&arena, (size_t)1 << 28);
    for (int t = 0; t < TEAMS; t++)
        assert_non_null(teams[t] = zr_team_create_for(threads[t], isa));
    for (uint64_t i = 0; i < pictures; i++) {
        const struct drawn_picture drawn = picture_assert_same(&arena, teams, TEAMS, random_scene(from + i));
        count(&drawn, &seen);
        char name[32];
        snprintf(name, sizeof name, "%" PRIu64, from + i);
        if (from + i <= DIGESTS) digests_add(digests, name, drawn.frame);
        zr_arena_reset(&arena, SIZE_MAX);
    }
    for (int t = 0; t < TEAMS; t++)
        zr_team_destroy(teams[t]);
    zr_arena_free(&arena);
    assert_true(pictures > 0);
    if (pictures >= 100) assert_enough(&seen, pictures);
    digests_check(digests, from == 1 && pictures >= DIGESTS ? "tests/scenes/random-digests.txt" : NULL);
}

RUN_TESTS(NULL, NULL)
