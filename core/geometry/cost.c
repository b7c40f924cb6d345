/* cost.c - geometry: how much work a scene is, counted before any of it is done.
 *
 * Space:  triangles are placed, clipped and measured in the window just as for drawing;
 *         of a large scene a sample will do, one polygon out of each stretch of them, at a
 *         place that no regular pattern in the scene can keep to. The same scene gives
 *         the same cost.
 */
#include "zraster.h"

#include "geometry/clip.h"
#include "geometry/colors.h"
#include "geometry/viewport.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* What the triangles of one face cover, and the box around them. */
struct measure {
    const struct zr_viewport *viewport;
    double area; /* pixels, those covered twice counted twice */
    double net;  /* less those of triangles that face away */
    double min_x, min_y, max_x, max_y;
};

static void include(struct measure *measure, const struct zr_window_vertex *v)
{
    measure->min_x = fmin(measure->min_x, (double)v->x);
    measure->min_y = fmin(measure->min_y, (double)v->y);
    measure->max_x = fmax(measure->max_x, (double)v->x);
    measure->max_y = fmax(measure->max_y, (double)v->y);
}

/* Adds the visible part of a triangle. */
static void add_triangle(struct measure *measure, const zr_vec4 corners[3])
{
    struct zr_clip_vertex in[3] = {{.position = corners[0]}, {.position = corners[1]}, {.position = corners[2]}};
    struct zr_clip_vertex out[ZR_CLIP_MAX];
    unsigned o[3] = {zr_clip_outcode(corners[0]), zr_clip_outcode(corners[1]), zr_clip_outcode(corners[2])};
    if (o[0] & o[1] & o[2]) return;
    int count = zr_clip_triangle(in, o[0] | o[1] | o[2], out);
    struct zr_window_vertex first, previous, current;
    double doubled = 0.0;
    for (int i = 0; i < count; i++) {
        if (!zr_viewport_apply(measure->viewport, out[i].position, &current)) return;
        include(measure, &current);
        if (i == 0) first = current;
        if (i >= 2)
            doubled += (double)(previous.x - first.x) * (double)(current.y - first.y) -
                       (double)(current.x - first.x) * (double)(previous.y - first.y);
        previous = current;
    }
    measure->area += fabs(doubled * 0.5);
    measure->net += doubled * 0.5;
}

/* How the faces of one instance get to the window. */
struct placed {
    zr_mat4 object_to_clip;
    bool mirrored; /* a face that shows its front goes clockwise */
};

/* The fans of concave rings cover more than the face, but no more than their box. */
static double face_area(const struct zr_scene *scene, const struct zr_mesh *mesh, uint32_t face,
                        const struct placed *placed, const struct zr_viewport *viewport)
{
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    struct measure measure = {viewport, 0.0, 0.0, HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t *indices = mesh->indices + rings.offsets[r];
        zr_vec4 corners[3] = {zr_mat4_apply(&placed->object_to_clip, mesh->positions[indices[0]]),
                              zr_mat4_apply(&placed->object_to_clip, mesh->positions[indices[1]])};
        for (uint32_t i = 2; i < rings.offsets[r + 1] - rings.offsets[r]; i++) {
            corners[2] = zr_mat4_apply(&placed->object_to_clip, mesh->positions[indices[i]]);
            add_triangle(&measure, corners);
            corners[1] = corners[2];
        }
    }
    bool turned_away = (placed->mirrored ? measure.net > 0.0 : measure.net < 0.0) &&
                       !zr_material_of_face(scene, mesh, face)->double_sided;
    if (!(measure.area > 0.0) || turned_away) return 0.0;
    return fmin(measure.area, (measure.max_x - measure.min_x) * (measure.max_y - measure.min_y));
}

static void count_outputs(const struct zr_scene *scene, struct zr_cost *cost)
{
    double pixels = (double)scene->width * (double)scene->height;
    for (uint32_t i = 0; i < scene->output_count; i++) {
        enum zr_encoding encoding = scene->outputs[i].encoding;
        cost->pixels += pixels;
        if (encoding == ZR_ENCODING_PNG || encoding == ZR_ENCODING_PNG16) cost->png_pixels += pixels;
    }
}

/* Scattered numbers, the same on every machine (Steele's splitmix64). */
static uint64_t scatter(uint64_t n)
{
    n = (n + 1) * 0x9e3779b97f4a7c15u;
    n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
    n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
    return n ^ (n >> 31);
}

/* The area of all faces, from `samples` of them. */
static double total_area(const struct zr_scene *scene, const struct zr_camera *camera, uint64_t faces, uint64_t samples)
{
    struct zr_viewport viewport = zr_viewport_make(scene->width, scene->height);
    zr_mat4 world_to_clip = zr_mat4_mul(&camera->projection, &camera->world_to_eye);
    struct placed placed = {.mirrored = false};
    const struct zr_mesh *mesh = NULL;
    uint64_t first = 0, end = 0; /* the faces of `mesh`, counted over all instances */
    uint32_t next_instance = 0;
    double area = 0.0;
    for (uint64_t k = 0; k < samples; k++) {
        uint64_t begin = k * faces / samples, size = (k + 1) * faces / samples - begin;
        uint64_t face = begin + scatter(k) % size;
        while (face >= end) {
            const struct zr_instance *instance = &scene->instances[next_instance++];
            mesh = &scene->meshes[instance->mesh];
            placed.object_to_clip = zr_mat4_mul(&world_to_clip, &instance->object_to_world);
            placed.mirrored = zr_mat4_is_mirror(&instance->object_to_world);
            first = end;
            end += mesh->face_count;
        }
        area += face_area(scene, mesh, (uint32_t)(face - first), &placed, &viewport);
    }
    return samples > 0 ? area * (double)faces / (double)samples : 0.0;
}

struct zr_cost zr_scene_cost(const struct zr_scene *scene, uint32_t samples_max)
{
    struct zr_cost cost = {0};
    struct zr_camera camera;
    struct zr_error ignored = {.count = 0}; /* rendering will tell */
    struct zr_bounds bounds = zr_bounds_of(scene);
    uint64_t faces = 0;
    count_outputs(scene, &cost);
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        faces += mesh->face_count;
        cost.triangles += (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
        cost.triangles += (double)mesh->line_count;
    }
    if (zr_camera_resolve(scene, &bounds, &camera, &ignored) == ZR_OK)
        cost.fragments = total_area(scene, &camera, faces, faces < samples_max ? faces : samples_max);
    return cost;
}
