/* views_check.h - tests: draws several views of a scene, and single ones to compare them with. */
#ifndef ZR_TESTS_VIEWS_CHECK_H
#define ZR_TESTS_VIEWS_CHECK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "views/view_scene.h"
#include "views/views.h"

TEST_ARENA((size_t)1 << 29)

#define GEOMETRY                                                                                                       \
    "\"meshes\": [{\"name\": \"a\", \"positions\": [[0,0,0],[3,0,0],[0,2,0],[0,0,1]], "                                \
    "\"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}, {\"name\": \"b\", \"positions\": [[1,1,1],[2,1,1],[1,2,2]], "      \
    "\"faces\": [[0,1,2]]}], \"nodes\": [{\"name\": \"n\", \"mesh\": \"a\"}, {\"name\": \"m\", \"mesh\": \"b\"}]"
#define SCENE "{" GEOMETRY ", \"window\": {\"width\": 80, \"height\": 60}"

static struct zr_limits limits;

static inline struct zr_request request_of(const char *text)
{
    return (struct zr_request){.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
}

static inline enum zr_status read_views(struct zr_team *team, struct zr_request request, struct zr_views *views,
                                        struct zr_error *error)
{
    limits = zr_limits_default();
    *error = (struct zr_error){0};
    enum zr_status status =
        zr_views_read(&(struct zr_run){.arena = &arena, .team = team, .error = error}, &request, &limits, views);
    if (status == ZR_OK && views->set)
        status = zr_views_plan(&(struct zr_run){.arena = &arena, .team = team, .error = error}, views);
    return status;
}

/* Draws the views of a scene. */
static inline struct zr_files draw_with(struct zr_team *team, struct zr_request request, struct zr_views *views)
{
    struct zr_error error;
    struct zr_files files = {.count = 0};
    enum zr_status status = read_views(team, request, views, &error);
    assert_true(status != ZR_OK || views->set);
    if (status == ZR_OK)
        status = zr_views_draw(&(struct zr_run){.arena = &arena, .team = team, .error = &error}, views, &files);
    if (status != ZR_OK) fail_msg("%d %s: %s", (int)status, error.items[0].pointer, error.items[0].detail);
    return files;
}

static inline struct zr_files draw(const char *text, struct zr_views *views)
{
    return draw_with(NULL, request_of(text), views);
}

/* Draws a scene with one view. */
static inline const struct zr_frame *draw_alone(const char *text, struct zr_files *files)
{
    const struct zr_request request = request_of(text);
    const struct zr_scene *scene;
    const struct zr_frame *frame = NULL;
    struct zr_error error = {0};
    limits = zr_limits_default();
    enum zr_status status =
        zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene);
    if (status == ZR_OK) status = zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame);
    if (status == ZR_OK)
        status = zr_encode_files(&(struct zr_run){.arena = &arena, .error = &error}, scene, frame, NULL, files);
    if (status != ZR_OK) fail_msg("%s: %s: %s", text, error.items[0].pointer, error.items[0].detail);
    return frame;
}

static inline const struct zr_zip_entry *file_of(const struct zr_files *files, const char *name)
{
    for (uint32_t i = 0; i < files->count; i++)
        if (strcmp(files->entries[i].name, name) == 0) return &files->entries[i];
    fail_msg("no file %s", name);
    return NULL;
}

static inline void assert_same(const struct zr_zip_entry *got, const struct zr_zip_entry *want, const char *what)
{
    if (got->size != want->size || memcmp(got->bytes, want->bytes, got->size) != 0)
        fail_msg("%s: other bytes than those of the view alone", what);
}

static inline const struct zr_scene *scene_of_view(const struct zr_views *views, uint32_t number)
{
    const struct zr_scene *scene;
    struct zr_error error = {0};
    assert_int_equal(zr_view_scene(&(struct zr_run){.arena = &arena, .error = &error}, views, number, &scene), ZR_OK);
    return scene;
}

#endif
