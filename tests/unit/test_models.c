/* What is shaded pixel by pixel: phong and normals, at places where it is known by hand. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input_check.h"
#include "support/scenes.h"

enum { SIDE = 65 };

/* A square of 2 by 2 in front of the camera, whose corners have these w, under one light from the camera. */
static const uint8_t *render_in(struct reading **reading, const double w[4], const char *material, const char *light)
{
    static char text[2000];
    static const double x[4] = {-1, 1, 1, -1}, y[4] = {-1, -1, 1, 1};
    char *at =
        text +
        sprintf(text,
                "{\"version\": 1, \"window\": {\"width\": %d, \"height\": %d}, %s,"
                "\"view\": {\"eye\": [0, 0, 1.5], \"perspective\": {\"yfovDegrees\": 60}, \"znear\": 0.5, \"zfar\": 9},"
                "\"materials\": [{\"name\": \"m\", \"baseColorFactor\": [0.8, 0.4, 0.2], %s}],"
                "\"meshes\": [{\"material\": \"m\", \"faces\": [[0, 1, 2, 3]], \"positions\": [",
                SIDE, SIDE, light, material);
    for (int k = 0; k < 4; k++)
        at += sprintf(at, "%s[%.9g, %.9g, 0, %.9g]", k ? ", " : "", x[k] * w[k], y[k] * w[k], w[k]);
    strcpy(at, "]}]}");
    *reading = read_text(ZR_FORMAT_JSON, text);
    assert_read(*reading);
    return scene_render(&(*reading)->arena, NULL, (*reading)->scene)->color;
}

static const uint8_t *render(struct reading **reading, const double w[4], const char *material)
{
    return render_in(reading, w, material,
                     "\"ambient\": [0.1, 0.1, 0.1], \"lights\": [{\"type\": \"directional\", \"direction\": [0, 0, -1],"
                     "\"intensity\": 0.5}]");
}

static void assert_pixel(const uint8_t *color, int red, int green, int blue)
{
    const uint8_t *middle = color + 4 * (SIDE / 2 * SIDE + SIDE / 2);
    assert_int_equal(middle[0], red);
    assert_int_equal(middle[1], green);
    assert_int_equal(middle[2], blue);
}

static void phong_in_the_middle_has_ambient_diffuse_and_all_of_the_highlight(void **state)
{
    (void)state;
    const double w[4] = {1, 1, 1, 1};
    struct reading *reading;
    /* 0.8 (0.1 + 0.5), and 0.5 0.6 of the highlight where light, eye and normal are one line. */
    assert_pixel(render(&reading, w, "\"shading\": \"phong\""), 122, 61, 31);
    reading_free(reading);
    assert_pixel(render(&reading, w, "\"shading\": \"phong\", \"specular\": [0.6, 0, 0], \"shininess\": 500"), 199, 61,
                 31);
    reading_free(reading);
    assert_pixel(render(&reading, w, "\"shading\": \"normals\""), 128, 128, 255);
    reading_free(reading);
}

/* The places are the same, whatever w they are times: so is the picture, up to rounding. */
static void highlights_do_not_move_with_the_w_of_corners(void **state)
{
    (void)state;
    static const double ws[3][4] = {{2, 2, 2, 2}, {1, 1, 2, 2}, {1, 3, 1, 0.01}};
    const double ones[4] = {1, 1, 1, 1};
    static uint8_t want[4 * SIDE * SIDE];
    const char *shiny = "\"shading\": \"phong\", \"specular\": [1, 1, 1], \"shininess\": 20";
    struct reading *reading;
    memcpy(want, render(&reading, ones, shiny), sizeof want);
    reading_free(reading);
    for (size_t i = 0; i < sizeof ws / sizeof ws[0]; i++) {
        const uint8_t *got = render(&reading, ws[i], shiny);
        for (size_t k = 0; k < sizeof want; k++)
            assert_true(abs(got[k] - want[k]) <= 1);
        reading_free(reading);
    }
}

/* 1.5 in front of the camera: half way between its own colour and the fog's, or all of either. */
static void fog_takes_its_share_by_depth(void **state)
{
    (void)state;
    static const struct {
        const char *fog;
        int red, green, blue;
    } cases[] = {{"{\"color\": [0, 0, 1], \"near\": 1, \"far\": 2}", 102, 51, 153},
                 {"{\"color\": [0, 0, 1], \"near\": 1.5, \"far\": 2}", 204, 102, 51},
                 {"{\"color\": [0, 0, 1], \"near\": 0, \"far\": 1.25}", 0, 0, 255},
                 {"{\"near\": 0, \"far\": 1}", 255, 255, 255}}; /* the background */
    const double ones[4] = {1, 1, 1, 1}, twos[4] = {2, 2, 2, 2};
    static const char *const shadings[] = {"flat", "gouraud", "unlit", "phong"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (size_t k = 0; k < sizeof shadings / sizeof shadings[0]; k++) {
            char material[200], rest[200];
            struct reading *reading;
            snprintf(material, sizeof material, "\"shading\": \"%s\"", shadings[k]);
            snprintf(rest, sizeof rest, "\"ambient\": [1, 1, 1], \"lights\": [], \"fog\": %s", cases[i].fog);
            assert_pixel(render_in(&reading, k % 2 ? ones : twos, material, rest), cases[i].red, cases[i].green,
                         cases[i].blue);
            reading_free(reading);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phong_in_the_middle_has_ambient_diffuse_and_all_of_the_highlight),
        cmocka_unit_test(highlights_do_not_move_with_the_w_of_corners),
        cmocka_unit_test(fog_takes_its_share_by_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
