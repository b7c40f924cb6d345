/* Blended surfaces of looks with 16 samples, each lit once in a pixel, beside 64 samples, each lit. */
#include <string.h>

#include "base/run.h"
#include "shade/frame.h"
#include "support/isas.h"
#include "support/tests.h"
#include "unit/common/json_check.h"
#include "unit/common/lit_samples.h"

/* Panes of three colours that cross each other, before and through an opaque one. */
static const char scene_text[] =
    "{\"look\": \"studio\", \"samples\": %d, \"window\": {\"width\": 150, \"height\": 110}, \"groundShadow\": false, "
    "\"edges\": false, \"occlusion\": false, \"background\": \"white\", \"materials\": ["
    "{\"name\": \"red\", \"baseColorFactor\": [0.9, 0, 0, %s], \"alphaMode\": \"BLEND\", \"doubleSided\": true}, "
    "{\"name\": \"green\", \"baseColorFactor\": [0, 0.8, 0, %s], \"alphaMode\": \"BLEND\", \"doubleSided\": true}, "
    "{\"name\": \"blue\", \"baseColorFactor\": [0, 0, 0.9, %s], \"alphaMode\": \"BLEND\", \"doubleSided\": true}, "
    "{\"name\": \"grey\", \"baseColorFactor\": [0.3, 0.3, 0.3, 1], \"doubleSided\": true}], \"meshes\": ["
    "{\"material\": \"green\", \"positions\": [[-1.3, -1, -0.6], [1.2, -0.9, 0.7], [1.1, 1, 0.6], [-1.2, 1.1, -0.5]], "
    "\"faces\": [[0, 1, 2, 3]]}, "
    "{\"material\": \"red\", \"positions\": [[-1, -1.2, 0.8], [1.3, -1.1, -0.6], [1.2, 0.9, -0.4], [-1.1, 0.8, 0.9]], "
    "\"faces\": [[0, 1, 2, 3]]}, "
    "{\"material\": \"blue\", \"positions\": [[-0.9, 0.1, -1], [1, 0, -1], [1.1, 0.2, 1.1], [-1, 0.1, 1]], "
    "\"faces\": [[0, 1, 2], [0, 2, 3]]}, "
    "{\"material\": \"grey\", \"positions\": [[0.1, -0.9, -0.9], [1.4, -0.8, -0.8], [0.8, 0.7, -0.1]], "
    "\"faces\": [[0, 1, 2]]}]}";

static const struct zr_frame *draw(int samples, const char *opacity, struct zr_team *team, struct zr_arena *arena,
                                   struct reading **reading)
{
    char text[sizeof scene_text + 64];
    struct zr_error error = {.status = ZR_OK};
    const struct zr_run run = {.arena = arena, .team = team, .error = &error};
    const struct zr_frame *frame;
    snprintf(text, sizeof text, scene_text, samples, opacity, opacity, opacity);
    *reading = read_scene(text);
    assert_read(*reading);
    zr_arena_init(arena, (size_t)1 << 28);
    assert_int_equal(zr_render(&run, (*reading)->scene, NULL, &frame), ZR_OK);
    return frame;
}

/* Pixels differ at silhouettes, by the number of samples. With one order for all samples of a pixel, panes that cross
 * have teeth: the root of the mean square is 1.27. */
TEST_EACH_ISA(blended_surfaces_are_as_those_of_each_sample)
{
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    struct reading *readings[2];
    struct zr_arena arenas[2];
    const struct zr_frame *few = draw(16, "0.6", team, &arenas[0], &readings[0]);
    const struct zr_frame *many = draw(64, "0.6", team, &arenas[1], &readings[1]);
    const size_t bytes = 4 * (size_t)few->width * few->height;
    double squares = 0.0;
    size_t apart = 0;
    for (size_t i = 0; i < bytes; i++) {
        const int by = few->color[i] - many->color[i];
        squares += by * by;
        apart += by > 2 || by < -2;
    }
    print_message("rms %.3f, apart %.4f\n", sqrt(squares / (double)bytes), (double)apart / (double)bytes);
    assert_true(squares / (double)bytes < 0.95 * 0.95);
    assert_true((double)apart < 0.02 * (double)bytes);
    for (int k = 0; k < 2; k++) {
        zr_arena_free(&arenas[k]);
        reading_free(readings[k]);
    }
    zr_team_destroy(team);
}

/* Opaque panes cover as many samples as blended ones of any opacity. */
TEST(samples_of_blended_surfaces_are_counted)
{
    struct reading *readings[2];
    struct zr_arena arenas[2];
    const struct zr_frame *thin = draw(16, "0.05", NULL, &arenas[0], &readings[0]);
    const struct zr_frame *thick = draw(4, "1", NULL, &arenas[1], &readings[1]);
    const double a = (double)thin->covered_samples / 16, b = (double)thick->covered_samples / 4;
    print_message("%.2f and %.2f pixels\n", a, b);
    assert_true(a > 1000 && fabs(a - b) < 0.002 * b);
    for (int k = 0; k < 2; k++) {
        zr_arena_free(&arenas[k]);
        reading_free(readings[k]);
    }
}

RUN_TESTS(NULL, NULL)
