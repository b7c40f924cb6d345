/* X-rays: what they go with and what they do not. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "shade/frame.h"
#include "support/random.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

struct drawing {
    struct reading *reading;
    struct zr_arena arena;
    const struct zr_frame *frame;
};

static void draw(struct zr_team *team, const char *text, struct drawing *d)
{
    struct zr_error error = {.status = ZR_OK};
    d->reading = read_scene(text);
    zr_arena_init(&d->arena, (size_t)1 << 28);
    assert_int_equal(zr_render(&(struct zr_run){.arena = &d->arena, .team = team, .error = &error}, d->reading->scene,
                               NULL, &d->frame),
                     ZR_OK);
}

static void end(struct drawing *d)
{
    zr_arena_free(&d->arena);
    reading_free(d->reading);
}

/* ---- what is no layer ---- */

#define VIEW                                                                                                           \
    "\"look\": \"xray\", \"window\": {\"width\": 60, \"height\": 40}, \"view\": {\"eye\": [0, 0, 9], "                 \
    "\"target\": [0, 0, 0], \"perspective\": {\"yfovDegrees\": 30}}"
#define SQUARE "\"vertices\": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]]"

/* The ink's own colour is on some pixels. */
static bool has_color(const struct zr_frame *frame, int r, int g, int b)
{
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        const uint8_t *p = frame->color + 4 * i;
        if (p[0] == r && p[1] == g && p[2] == b) return true;
    }
    return false;
}

TEST(outlines_stay_opaque)
{
    struct drawing with, without;
    draw(NULL, "{" VIEW ", \"lineWidth\": 3, \"polygons\": [{" SQUARE ", \"outline\": \"#ff0000\"}]}", &with);
    draw(NULL, "{" VIEW ", \"polygons\": [{" SQUARE "}]}", &without);
    assert_true(has_color(with.frame, 255, 0, 0));
    assert_false(has_color(without.frame, 255, 0, 0));
    end(&with);
    end(&without);
}

TEST(painter_draws_none)
{
    struct drawing depths;
    draw(NULL,
         "{" VIEW ", \"algorithm\": \"painter\", \"outputs\": [{\"channel\": \"depth\"}], \"polygons\": [{" SQUARE
         "}]}",
         &depths);
    end(&depths);
}

/* What makes the ink thinner is no alpha that nobody looks at. */
TEST(alpha_is_no_oddity)
{
    struct reading *reading = read_scene("{" VIEW ", \"polygons\": [{" SQUARE ", \"color\": \"#2b6cb080\"}]}");
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
