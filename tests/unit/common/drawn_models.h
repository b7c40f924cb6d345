/* drawn_models.h - unit: models for tests of drawings: files of ZRASTER_DATA, and bodies made here. */
#ifndef ZR_TEST_DRAWN_MODELS_H
#define ZR_TEST_DRAWN_MODELS_H

#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "core.h"
#include "lines/window_mesh.h"
#include "render_request.h"
#include "scene/camera/resolved_view.h"
#include "scene/scene.h"
#include "support/files.h"
#include "support/tests.h"

/* Reads a model as the daemon does. `look` may be NULL. Fails the running test on an error. */
static inline const struct zr_scene *model_of_text(struct zr_arena *arena, const char *text, const char *look)
{
    const struct zr_request request = {
        .format = text[0] == '{' ? ZR_FORMAT_JSON : ZR_FORMAT_OBJ, .bytes = text, .size = strlen(text), .look = look};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene = NULL;
    struct zr_error error = {0};
    if (zr_scene_read(&(struct zr_run){.arena = arena, .error = &error}, &request, &limits, &scene) != ZR_OK)
        fail_msg("%s", error.items[0].detail);
    return scene;
}

/* Reads models/NAME of ZRASTER_DATA. NULL without these models, which the test prints. */
static inline const struct zr_scene *model_of_file(struct zr_arena *arena, const char *name, const char *look)
{
    char path[512];
    size_t size = 0;
    const char *data = getenv("ZRASTER_DATA");
    snprintf(path, sizeof path, "%s/models/%s", data ? data : "../shared/data", name);
    char *text = file_read(path, &size);
    if (!text) {
        print_message("LEFT OUT: %s: there is no %s\n", name, path);
        return NULL;
    }
    char *kept = zr_arena_copy(arena, text, size + 1);
    free(text);
    return model_of_text(arena, kept, look);
}

/* A cube of six quads. */
#define CUBE_CORNERS "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
#define CUBE_SIDES   "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
#define CUBE_TOP     "f 5 6 7 8\n"

/* A model in the window of its view. */
struct drawn_model {
    const struct zr_scene *scene;
    struct zr_edge_mesh *tables;
    struct zr_window_mesh mesh;
};

static inline struct drawn_model model_in_window(struct zr_arena *arena, struct zr_team *team,
                                                 const struct zr_scene *scene, uint32_t width, uint32_t height)
{
    struct drawn_model model = {.scene = scene,
                                .tables = zr_arena_alloc(arena, scene->mesh_count, sizeof *model.tables)};
    struct zr_view view = scene->views[0];
    struct zr_camera camera;
    struct zr_error error = {0};
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    view.width = width;
    view.height = height;
    assert_int_equal(zr_camera_resolve(&(struct zr_run){.error = &error}, scene, &view, &bounds, &camera), ZR_OK);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        assert_int_equal(
            zr_edge_mesh_make(&(struct zr_run){.arena = arena, .team = team}, &scene->meshes[i], &model.tables[i]),
            ZR_OK);
    const struct zr_window_view window = zr_window_view_make(&camera, &bounds, width, height);
    assert_int_equal(
        zr_window_mesh_make(&(struct zr_run){.arena = arena, .team = team}, scene, model.tables, &window, &model.mesh),
        ZR_OK);
    return model;
}

#endif
