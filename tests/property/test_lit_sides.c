/* What is seen of a surface is lit from the side that it is seen from, by lamps of every kind, in every shading, with
 * and without linear light: a two-sided face shows a lamp's light where the lamp is on that side, and on the other side
 * it is as dark as without. One that is one-sided is seen from its front alone. */
#include <stdio.h>
#include <string.h>

#include "support/cmocka_all.h"
#include "support/scenes.h"

enum { WIDTH = 33, HEIGHT = 25, CENTRE = HEIGHT / 2 * WIDTH + WIDTH / 2 };

static struct zr_arena arena;
static const char *const shadings[] = {"flat", "gouraud", "phong", "pbr"};

/* How a face across the z axis is seen, and what lights it. */
struct setting {
    const char *shading;
    enum zr_light_type light;
    bool is_linear, double_sided, given_normals, lamp_behind, eye_behind;
};

/* Beside the z axis, towards the face. */
static void write_light(const struct setting *s, char *out, size_t size)
{
    const int side = s->lamp_behind ? -1 : 1;
    if (s->light == ZR_LIGHT_DIRECTIONAL)
        snprintf(out, size, "{\"type\": \"directional\", \"direction\": [0.1, 0, %d], \"intensity\": 0.8}", -side);
    else if (s->light == ZR_LIGHT_POINT)
        snprintf(out, size, "{\"type\": \"point\", \"position\": [0.3, 0, %d], \"intensity\": 3}", 2 * side);
    else
        snprintf(out, size,
                 "{\"type\": \"spot\", \"position\": [0.2, 0, %d], \"direction\": [-0.1, 0, %d], "
                 "\"innerConeAngleDegrees\": 60, \"outerConeAngleDegrees\": 80, \"intensity\": 4}",
                 2 * side, -side);
}

/* The colour in the middle of the picture. */
static void draw(const struct setting *s, bool is_on, uint8_t rgba[4])
{
    char text[2048], light[512];
    write_light(s, light, sizeof light);
    snprintf(
        text, sizeof text,
        "{\"window\": {\"width\": %d, \"height\": %d}, \"colorManagement\": \"%s\", \"ambient\": [0.1, 0.1, 0.1], "
        "\"shading\": \"%s\", \"lights\": [%s], \"view\": {\"eye\": [0.1, 0.2, %d], \"target\": [0, 0, 0]}, "
        "\"background\": \"#0000ff\", \"meshes\": [{\"positions\": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], "
        "\"faces\": [[0, 1, 2, 3]], \"doubleSided\": %s%s}]}",
        WIDTH, HEIGHT, s->is_linear ? "srgb" : "none", s->shading, is_on ? light : "", s->eye_behind ? -4 : 4,
        s->double_sided ? "true" : "false",
        s->given_normals ? ", \"normals\": [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]" : "");
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .size = strlen(text), .bytes = text};
    const struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    if (zr_scene_read(&arena, NULL, &request, &limits, &scene, &error) != ZR_OK)
        fail_msg("%s %s: %s", error.items[0].pointer, error.items[0].detail, text);
    memcpy(rgba, scene_render(&arena, NULL, scene)->color + 4 * CENTRE, 4);
    zr_arena_reset(&arena, (size_t)1 << 26);
}

static void check(const struct setting *s)
{
    static const uint8_t blue[4] = {0, 0, 255, 255};
    uint8_t lit[4], dark[4];
    draw(s, true, lit);
    draw(s, false, dark);
    if (!s->double_sided && s->eye_behind) {
        assert_memory_equal(lit, blue, 4);
        return;
    }
    assert_memory_not_equal(dark, blue, 4);
    const bool is_lit = lit[0] > dark[0] + 50, is_same = memcmp(lit, dark, 4) == 0;
    if (s->lamp_behind == s->eye_behind ? !is_lit : !is_same)
        fail_msg("%s, %s, %s, %s normals; the lamp %s, the eye %s: %d beside %d without; kind %d", s->shading,
                 s->is_linear ? "linear" : "as bytes", s->double_sided ? "two-sided" : "one-sided",
                 s->given_normals ? "given" : "computed", s->lamp_behind ? "behind" : "in front",
                 s->eye_behind ? "behind" : "in front", lit[0], dark[0], (int)s->light);
}

static void the_side_that_is_seen_is_lit(void **state)
{
    (void)state;
    static const enum zr_light_type lights[] = {ZR_LIGHT_DIRECTIONAL, ZR_LIGHT_POINT, ZR_LIGHT_SPOT};
    zr_arena_init(&arena, (size_t)1 << 26);
    for (int i = 0; i < 4 * 3 * 32; i++) {
        const int bits = i / 12;
        check(&(struct setting){.shading = shadings[i % 4],
                                .light = lights[i / 4 % 3],
                                .is_linear = bits & 1 || i % 4 == 3,
                                .double_sided = bits & 2,
                                .given_normals = bits & 4,
                                .lamp_behind = bits & 8,
                                .eye_behind = bits & 16});
    }
    zr_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_side_that_is_seen_is_lit)};
    return cmocka_run_group_tests_name("lit_sides", tests, NULL, NULL);
}
