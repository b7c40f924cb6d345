/* view_check.h - tests: a view in JSON, resolved, and where points are seen.
 *
 * Pixels are measured from the top left corner of the picture, y down.
 */
#ifndef ZR_TESTS_VIEW_CHECK_H
#define ZR_TESTS_VIEW_CHECK_H

#include <math.h>

#include "base/run.h"
#include "geometry/viewport.h"
#include "json_check.h"
#include "scene/camera/camera.h"
#include "scene/camera/resolved_view.h"

/* A cube from -1 to 1. */
#define CUBE                                                                                                           \
    "{\"name\": \"cube\", \"positions\": [[-1,-1,-1],[1,-1,-1],[1,1,-1],[-1,1,-1],[-1,-1,1],[1,-1,1],[1,1,1],"         \
    "[-1,1,1]], \"points\": [0,1,2,3,4,5,6,7]}"
/* A cube of half the size around (10, 0, 0). */
#define NUT                                                                                                            \
    "{\"name\": \"nut\", \"positions\": [[9.5,-0.5,-0.5],[10.5,-0.5,-0.5],[10.5,0.5,-0.5],[9.5,0.5,-0.5],"             \
    "[9.5,-0.5,0.5],[10.5,-0.5,0.5],[10.5,0.5,0.5],[9.5,0.5,0.5]], \"points\": [0,1,2,3,4,5,6,7]}"
#define P90 "\"perspective\": {\"yfovDegrees\": 90}"

struct shot {
    struct reading *reading;
    struct zr_camera camera;
    enum zr_status status;
    struct zr_error error;
};

/* End with reading_free of its reading. */
static inline struct shot shoot(const char *window, const char *meshes, const char *view)
{
    char text[2048];
    snprintf(text, sizeof text, "{\"window\": %s, \"meshes\": [%s], \"view\": {%s}}", window, meshes, view);
    struct shot shot = {.reading = read_scene(text)};
    struct zr_bounds bounds = zr_bounds_of(shot.reading->scene, NULL, NULL);
    shot.status = zr_camera_resolve(&(struct zr_run){.error = &shot.error}, shot.reading->scene,
                                    &shot.reading->scene->views[0], &bounds, &shot.camera);
    return shot;
}

struct pixel {
    double x, y;
};

static inline struct pixel pixel_of(const struct shot *shot, zr_vec3 point)
{
    const struct zr_scene *scene = shot->reading->scene;
    zr_mat4 matrix = zr_mat4_mul(&shot->camera.projection, &shot->camera.world_to_eye);
    struct zr_viewport viewport = zr_viewport_make(scene->views[0].width, scene->views[0].height);
    struct zr_window_vertex vertex;
    zr_viewport_apply(&viewport, zr_mat4_apply(&matrix, (zr_vec4){point.x, point.y, point.z, 1.0f}), &vertex);
    return (struct pixel){(double)vertex.x, (double)scene->views[0].height - (double)vertex.y};
}

struct sight {
    const char *view;
    zr_vec3 point;
    struct pixel pixel;
};

/* Each point within a thousandth of its pixel. */
static inline void assert_seen(const char *window, const char *meshes, const struct sight *sights, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct shot shot = shoot(window, meshes, sights[i].view);
        assert_int_equal(shot.status, ZR_OK);
        struct pixel got = pixel_of(&shot, sights[i].point), want = sights[i].pixel;
        if (!(fabs(got.x - want.x) < 1e-3) || !(fabs(got.y - want.y) < 1e-3))
            fail_msg("%s: seen at %.6f %.6f, not %.6f %.6f", sights[i].view, got.x, got.y, want.x, want.y);
        reading_free(shot.reading);
    }
}

#endif
