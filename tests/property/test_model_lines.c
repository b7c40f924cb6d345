/* Drawings of real models keep their pixels: technical and blueprint, whose lines the small scenes of tests/scenes have
 * few of. A compiler may be wrong about one of them (`make test-clang`). The models are not in the repository. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "support/files.h"
#include "support/isas.h"
#include "support/pictures/digests.h"
#include "support/scenes.h"

static const char *const models[] = {"spot",          "cow",         "suzanne",       "stanford-bunny",
                                     "teapot",        "fandisk",     "beetle",        "parts/gear",
                                     "parts/housing", "parts/plate", "parts/openbox", "parts/cube"};
static const char *const looks[] = {"technical@1", "blueprint@1"};
enum { MODELS = sizeof models / sizeof *models, LOOKS = sizeof looks / sizeof *looks, WIDTH = 320, HEIGHT = 240 };

static const char *folder(void)
{
    const char *data = getenv("ZRASTER_DATA");
    return data ? data : "../shared/data";
}

/* NULL if there is none. */
static char *read_model(const char *name, size_t *size)
{
    char path[512];
    snprintf(path, sizeof path, "%s/models/%s.obj", folder(), name);
    return file_read(path, size);
}

static void add_drawing(FILE *rows, struct zr_team *team, const char *model, const struct zr_request *request)
{
    struct zr_arena arena;
    struct zr_error error = {.count = 0};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    char name[80];
    zr_arena_init(&arena, (size_t)1 << 30);
    if (zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, request, &limits, &scene) != ZR_OK)
        fail_msg("%s: %s", model, error.items[0].detail);
    struct zr_scene sized = *scene;
    sized.views[0].width = WIDTH;
    sized.views[0].height = HEIGHT;
    snprintf(name, sizeof name, "%s, %s", model, request->look);
    digests_add(rows, name, scene_render(&arena, team, &sized));
    zr_arena_free(&arena);
}

static bool add_model(FILE *rows, struct zr_team *team, const char *model)
{
    struct zr_request request = {.format = ZR_FORMAT_OBJ};
    char *text = read_model(model, &request.size);
    request.bytes = text;
    for (int look = 0; text && look < LOOKS; look++) {
        request.look = looks[look];
        add_drawing(rows, team, model, &request);
    }
    free(text);
    return text != NULL;
}

TEST_EACH_ISA(drawings_of_models_keep_their_pixels)
{
    const enum zr_isa isa = isa_under_test(state);
    struct zr_team *team = zr_team_create_for(3, isa);
    FILE *rows = digests_open();
    int found = 0;
    assert_non_null(team);
    for (int i = 0; i < MODELS; i++)
        found += add_model(rows, team, models[i]);
    zr_team_destroy(team);
    digests_check(rows, found == MODELS ? "tests/property/model_lines.txt" : NULL);
    if (found == MODELS) return;
    fprintf(stderr, "LEFT OUT: drawings of %d models: they are not in %s/models (ZRASTER_DATA names the folder)\n",
            MODELS - found, folder());
    skip();
}

RUN_TESTS(NULL, NULL)
