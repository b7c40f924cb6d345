/* X-rays: the ink is mixed with the background by the product of what all layers let through. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json_check.h"
#include "shade/frame.h"
#include "support/isas.h"
#include "support/random.h"

enum { SIDE = 9, MIDDLE = SIDE * (SIDE / 2) + SIDE / 2, LAYERS_MOST = 12, TEXT_SIZE = 16384 };

static double decoded(double c)
{
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double encoded(double c)
{
    return c <= 0.0031308 ? c * 12.92 : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

static double opacity_of(double cosine)
{
    return 0.07 + 0.68 * pow(1.0 - fabs(cosine), 3.0);
}

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
    assert_int_equal(zr_render(&d->arena, team, d->reading->scene, NULL, NULL, &d->frame, &error), ZR_OK);
}

static void end(struct drawing *d)
{
    zr_arena_free(&d->arena);
    reading_free(d->reading);
}

/* ---- stacks of sheets, seen along z ---- */

struct stack {
    int count;
    double turned[LAYERS_MOST]; /* about y, radians */
    double depth[LAYERS_MOST];
};

static void make_stack(struct random *random, struct stack *stack)
{
    stack->count = 1 + (int)random_below(random, LAYERS_MOST);
    for (int i = 0; i < stack->count; i++) {
        stack->turned[i] = random_range(random, -1.5, 1.5);
        stack->depth[i] = random_range(random, -1.0, 1.0);
    }
}

/* Each is long enough to cover the middle, and some show their backs. */
static void write_stack(const struct stack *stack, const char *head, bool backwards, char text[TEXT_SIZE])
{
    int length =
        snprintf(text, TEXT_SIZE,
                 "{\"look\": \"xray\", \"window\": {\"width\": %d, \"height\": %d}, \"view\": {\"eye\": [0, 0, 20],"
                 "\"target\": [0, 0, 0], \"orthographic\": {\"xmag\": 1, \"ymag\": 1}},%s \"polygons\": [",
                 SIDE, SIDE, head);
    for (int k = 0; k < stack->count; k++) {
        const int i = backwards ? stack->count - 1 - k : k;
        const double x = 4.0 * cos(stack->turned[i]), z = 4.0 * sin(stack->turned[i]), at = stack->depth[i];
        const double y = i % 3 ? 4.0 : -4.0;
        length += snprintf(text + length, (size_t)(TEXT_SIZE - length),
                           "%s{\"vertices\": [[%.9g,%g,%.9g],[%.9g,%g,%.9g],[%.9g,%g,%.9g],[%.9g,%g,%.9g]]}",
                           k ? "," : "", -x, -y, at - z, x, -y, at + z, x, y, at + z, -x, y, at - z);
        assert_in_range(length, 1, TEXT_SIZE - 1);
    }
    assert_true(snprintf(text + length, (size_t)(TEXT_SIZE - length), "]}") < TEXT_SIZE - length);
}

static int worst_at_middle(const struct zr_frame *frame, const struct stack *stack, const double ink[3],
                           const double background[3])
{
    double through = 1.0;
    int worst = 0;
    for (int i = 0; i < stack->count; i++)
        through *= 1.0 - opacity_of(cos(stack->turned[i]));
    for (int k = 0; k < 3; k++) {
        const double mixed = decoded(ink[k]) * (1.0 - through) + decoded(background[k]) * through;
        const int want = (int)(encoded(mixed) * 255.0 + 0.5), got = frame->color[4 * MIDDLE + k];
        worst = abs(got - want) > worst ? abs(got - want) : worst;
    }
    return worst;
}

static void the_ink_is_mixed_by_the_product_of_all_layers(void **state)
{
    static const struct {
        const char *head;
        double ink[3], background[3];
    } heads[] = {
        {" \"background\": \"#ffffff\",", {0x2b / 255.0, 0x6c / 255.0, 0xb0 / 255.0}, {1, 1, 1}},
        {" \"background\": \"#102030\",",
         {0x2b / 255.0, 0x6c / 255.0, 0xb0 / 255.0},
         {0x10 / 255.0, 0x20 / 255.0, 0x30 / 255.0}},
        {" \"background\": \"#ffffff\", \"samples\": 1,", {0x2b / 255.0, 0x6c / 255.0, 0xb0 / 255.0}, {1, 1, 1}},
    };
    struct zr_team *team = zr_team_create_for(1, isa_under_test(state));
    struct random random = random_seeded(33);
    for (int round = 0; round < 60; round++) {
        char text[TEXT_SIZE];
        struct stack stack;
        struct drawing there, back;
        make_stack(&random, &stack);
        write_stack(&stack, heads[round % 3].head, false, text);
        draw(team, text, &there);
        write_stack(&stack, heads[round % 3].head, true, text);
        draw(team, text, &back);
        assert_in_range(worst_at_middle(there.frame, &stack, heads[round % 3].ink, heads[round % 3].background), 0, 1);
        assert_in_range(worst_at_middle(back.frame, &stack, heads[round % 3].ink, heads[round % 3].background), 0, 1);
        end(&there);
        end(&back);
    }
    zr_team_destroy(team);
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

static void outlines_stay_opaque(void **state)
{
    (void)state;
    struct drawing with, without;
    draw(NULL, "{" VIEW ", \"lineWidth\": 3, \"polygons\": [{" SQUARE ", \"outline\": \"#ff0000\"}]}", &with);
    draw(NULL, "{" VIEW ", \"polygons\": [{" SQUARE "}]}", &without);
    assert_true(has_color(with.frame, 255, 0, 0));
    assert_false(has_color(without.frame, 255, 0, 0));
    end(&with);
    end(&without);
}

/* A mesh of another shading is seen through x-rays in front of it, and hides those behind. */
static void what_is_solid_hides_layers(void **state)
{
    (void)state;
    static const char *const behind = ", {\"vertices\": [[-2,-2,-1],[2,-2,-1],[2,2,-1],[-2,2,-1]]}";
    struct drawing one, two;
    char text[TEXT_SIZE];
    for (int k = 0; k < 2; k++) {
        snprintf(text, sizeof text,
                 "{" VIEW ", \"polygons\": [{" SQUARE ", \"shading\": \"unlit\", \"color\": \"#00ff00\"}%s]}",
                 k ? behind : "");
        draw(NULL, text, k ? &two : &one);
    }
    const size_t middle = 4 * (size_t)(60 * 20 + 30);
    assert_true(has_color(one.frame, 0, 255, 0));
    assert_memory_equal(one.frame->color + middle, two.frame->color + middle, 4);
    assert_true(memcmp(one.frame->color, two.frame->color, 4 * 60 * 40) != 0);
    end(&one);
    end(&two);
}

static void painter_draws_none(void **state)
{
    (void)state;
    struct drawing depths;
    draw(NULL,
         "{" VIEW ", \"algorithm\": \"painter\", \"outputs\": [{\"channel\": \"depth\"}], \"polygons\": [{" SQUARE
         "}]}",
         &depths);
    end(&depths);
}

/* What makes the ink thinner is no alpha that nobody looks at. */
static void alpha_is_no_oddity(void **state)
{
    (void)state;
    struct reading *reading = read_scene("{" VIEW ", \"polygons\": [{" SQUARE ", \"color\": \"#2b6cb080\"}]}");
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(the_ink_is_mixed_by_the_product_of_all_layers),
        cmocka_unit_test(outlines_stay_opaque),
        cmocka_unit_test(what_is_solid_hides_layers),
        cmocka_unit_test(painter_draws_none),
        cmocka_unit_test(alpha_is_no_oddity),
    };
    return cmocka_run_group_tests_name("xray", tests, NULL, NULL);
}
