#include "geometry/cost.h"

#include "geometry/clip.h"
#include "geometry/colors.h"
#include "geometry/viewport.h"
#include "scene/camera.h"

/* Pixels that the visible part of a triangle covers; below 0 where it faces away. */
static double window_area(const struct zr_viewport *viewport, const zr_vec4 corners[3])
{
    struct zr_clip_vertex in[3] = {{.position = corners[0]}, {.position = corners[1]}, {.position = corners[2]}};
    struct zr_clip_vertex out[ZR_CLIP_MAX];
    unsigned o[3] = {zr_clip_outcode(corners[0]), zr_clip_outcode(corners[1]), zr_clip_outcode(corners[2])};
    if (o[0] & o[1] & o[2]) return 0.0;
    int count = zr_clip_triangle(in, o[0] | o[1] | o[2], out);
    struct zr_window_vertex first, previous, current;
    double doubled = 0.0;
    for (int i = 0; i < count; i++) {
        if (!zr_viewport_apply(viewport, out[i].position, &current)) return 0.0;
        if (i == 0) first = current;
        if (i >= 2)
            doubled += (double)(previous.x - first.x) * (double)(current.y - first.y) -
                       (double)(current.x - first.x) * (double)(previous.y - first.y);
        previous = current;
    }
    return doubled * 0.5;
}

static double face_area(const struct zr_scene *scene, const struct zr_mesh *mesh, uint32_t face,
                        const zr_mat4 *object_to_clip, const struct zr_viewport *viewport)
{
    uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    bool double_sided = zr_material_of_face(scene, mesh, face)->double_sided;
    zr_vec4 corners[3] = {zr_mat4_apply(object_to_clip, mesh->positions[mesh->indices[begin]]),
                          zr_mat4_apply(object_to_clip, mesh->positions[mesh->indices[begin + 1]])};
    double sum = 0.0;
    for (uint32_t slot = begin + 2; slot < end; slot++) {
        corners[2] = zr_mat4_apply(object_to_clip, mesh->positions[mesh->indices[slot]]);
        double area = window_area(viewport, corners);
        if (area > 0.0 || double_sided) sum += fabs(area);
        corners[1] = corners[2];
    }
    return sum;
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

struct zr_cost zr_scene_cost(const struct zr_scene *scene)
{
    struct zr_cost cost = {0};
    struct zr_camera camera;
    struct zr_error ignored = {.count = 0}; /* rendering will tell */
    struct zr_bounds bounds = zr_bounds_of(scene);
    count_outputs(scene, &cost);
    if (zr_camera_resolve(scene, &bounds, &camera, &ignored) != ZR_OK) return cost;

    uint64_t faces = 0, number = 0, measured = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        faces += scene->meshes[scene->instances[i].mesh].face_count;
    uint64_t step = faces / ZR_COST_SAMPLES + 1;
    struct zr_viewport viewport = zr_viewport_make(scene->width, scene->height);
    zr_mat4 world_to_clip = zr_mat4_mul(&camera.projection, &camera.world_to_eye);
    double area = 0.0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        zr_mat4 object_to_clip = zr_mat4_mul(&world_to_clip, &scene->instances[i].object_to_world);
        cost.triangles += (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
        uint64_t skip = (step - number % step) % step; /* to the next multiple, counted over all meshes */
        for (uint64_t face = skip; face < mesh->face_count; face += step, measured++)
            area += face_area(scene, mesh, (uint32_t)face, &object_to_clip, &viewport);
        number += mesh->face_count;
    }
    if (measured > 0) cost.fragments = area * (double)faces / (double)measured;
    return cost;
}
