#include "output/info.h"

#include <stdlib.h>
#include <string.h>

#include "base/checked.h"
#include "output/json_tree.h"
#include "output/palette.h"
#include "scene/camera.h"
#include "scene/looks.h"
#include "version.h"

/* Pixel count and bounding box of one id; x1 and y1 are exclusive. */
struct patch {
    uint64_t pixels;
    uint32_t x0, y0, x1, y1;
};

/* Adds the pinhole intrinsics in pixels, (0, 0) at the top left corner, if the camera is a pinhole. */
static void put_intrinsics(struct zr_tree *w, cJSON *object, const struct zr_frame *frame)
{
    const float *p = frame->camera.projection.m;
    if (p[3] != 0.0f || p[7] != 0.0f || p[11] != -1.0f || p[15] != 0.0f) return;
    double x = (double)frame->width * 0.5, y = (double)frame->height * 0.5;
    double skew = 0.0 - (double)p[4], lean = 0.0 - (double)p[1]; /* subtracted from zero, so that no zero becomes -0 */
    const float rows[3][3] = {{(float)((double)p[0] * x), (float)(skew * x), (float)((1.0 - (double)p[8]) * x)},
                              {(float)(lean * y), (float)((double)p[5] * y), (float)((1.0 + (double)p[9]) * y)},
                              {0.0f, 0.0f, 1.0f}};
    cJSON *k = zr_tree_check(w, cJSON_CreateArray());
    for (int i = 0; i < 3; i++)
        zr_tree_append(w, k, zr_tree_numbers(w, rows[i], 3));
    zr_tree_put(w, object, "K", k);
}

/* Adds the direction of the view in angles, for readers. */
static void put_orbit(struct zr_tree *w, cJSON *object, const struct zr_camera *camera, bool z_is_up)
{
    const struct zr_orbit orbit = zr_orbit_of(camera, z_is_up);
    zr_tree_put(w, object, "up", zr_tree_check(w, cJSON_CreateString(z_is_up ? "z" : "y")));
    if (orbit.has_angles) {
        zr_tree_put(w, object, "azimuthDegrees", zr_tree_number(w, (float)orbit.azimuth_degrees));
        zr_tree_put(w, object, "elevationDegrees", zr_tree_number(w, (float)orbit.elevation_degrees));
    }
    if (orbit.has_eye) zr_tree_put(w, object, "eye", zr_tree_vec3(w, orbit.eye));
}

static cJSON *camera_of(struct zr_tree *w, const struct zr_frame *frame, bool z_is_up)
{
    const struct zr_camera *camera = &frame->camera;
    cJSON *object = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put(w, object, "worldToCamera", zr_tree_numbers(w, camera->world_to_eye.m, 16));
    zr_tree_put(w, object, "projectionMatrix", zr_tree_numbers(w, camera->projection.m, 16));
    put_intrinsics(w, object, frame);
    if (camera->znear != 0.0f || camera->zfar != 0.0f) {
        zr_tree_put(w, object, "znear", zr_tree_number(w, camera->znear));
        zr_tree_put(w, object, "zfar", zr_tree_number(w, camera->zfar));
    }
    put_orbit(w, object, camera, z_is_up);
    return object;
}

static cJSON *counts_of(struct zr_tree *w, const struct zr_scene *scene, const struct zr_frame *frame, uint64_t misfits)
{
    const struct zr_counts *c = &frame->counts;
    cJSON *object = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put_count(w, object, "polygons", c->polygons);
    zr_tree_put_count(w, object, "degeneratePolygons", c->degenerate_polygons);
    zr_tree_put_count(w, object, "concavePolygons", c->concave_polygons);
    zr_tree_put_count(w, object, "triangles", c->triangles);
    zr_tree_put_count(w, object, "outside", c->outside);
    zr_tree_put_count(w, object, "clipped", c->clipped);
    zr_tree_put_count(w, object, "culled", c->culled);
    zr_tree_put_count(w, object, "zeroArea", c->zero_area);
    zr_tree_put_count(w, object, "drawnWhole", c->drawn_whole);
    zr_tree_put_count(w, object, "drawnPieces", c->drawn_pieces);
    zr_tree_put_count(w, object, "culledPieces", c->culled_pieces);
    zr_tree_put_count(w, object, "clippedOutlines", c->clipped_outlines);
    zr_tree_put_count(w, object, "lines", c->lines);
    zr_tree_put_count(w, object, "degenerateLines", c->degenerate_lines);
    zr_tree_put_count(w, object, "outsideLines", c->outside_lines);
    zr_tree_put_count(w, object, "clippedLines", c->clipped_lines);
    zr_tree_put_count(w, object, "points", c->points);
    zr_tree_put_count(w, object, "outsidePoints", c->outside_points);
    zr_tree_put_count(w, object, "unplaced", c->unplaced);
    zr_tree_put_count(w, object, "zeroNormals", scene->counts.zero_normals);
    zr_tree_put_count(w, object, "leftOutCells", scene->counts.left_out_cells);
    zr_tree_put_count(w, object, "saturatedDepths", misfits);
    if (frame->base) zr_tree_put_count(w, object, "clampedBaseDepths", frame->base->clamped_depths);
    return object;
}

static void extend(struct patch *patch, uint32_t x, uint32_t y, uint32_t x1, uint32_t y1, uint64_t pixels)
{
    if (patch->pixels == 0) *patch = (struct patch){0, x, y, x1, y1};
    if (x < patch->x0) patch->x0 = x;
    if (y < patch->y0) patch->y0 = y;
    if (x1 > patch->x1) patch->x1 = x1;
    if (y1 > patch->y1) patch->y1 = y1;
    patch->pixels += pixels;
}

static uint32_t first_face_id(const struct zr_frame *frame)
{
    return frame->base ? frame->base->first_face_id : 1;
}

/* Returns patches[1 + number of the face]. patches[0] is the background, and the last one is the base, whose ids are
 * distinct from those of the faces (input/json_base.c refuses others). */
static struct patch *patches_of(struct zr_arena *arena, const struct zr_frame *frame, uint32_t face_count)
{
    struct patch *patches = zr_arena_zero(arena, (size_t)face_count + 2, sizeof *patches);
    if (!patches) return NULL;
    const uint32_t *id = frame->face_id, first = first_face_id(frame);
    for (uint32_t y = 0; y < frame->height; y++)
        for (uint32_t x = 0; x < frame->width; x++, id++) {
            uint32_t number = *id - first; /* the base's smaller ids wrap to large numbers */
            extend(&patches[*id == 0 ? 0 : 1 + (number < face_count ? number : face_count)], x, y, x + 1, y + 1, 1);
        }
    return patches;
}

static void put_patch(struct zr_tree *w, cJSON *object, const struct patch *patch)
{
    zr_tree_put_count(w, object, "pixels", patch->pixels);
    if (patch->pixels == 0) return;
    int box[4] = {(int)patch->x0, (int)patch->y0, (int)patch->x1, (int)patch->y1};
    zr_tree_put(w, object, "box", zr_tree_check(w, cJSON_CreateIntArray(box, 4)));
}

/* Returns the covered share of samples, if the picture has several per pixel; else that of pixels, including the
 * base's. */
static double covered_share(const struct zr_frame *frame, uint64_t covered_pixels)
{
    const double pixels = (double)frame->width * (double)frame->height;
    if (frame->samples_a_pixel == 0) return (double)covered_pixels / pixels;
    return (double)frame->covered_samples / (pixels * (double)frame->samples_a_pixel);
}

/* Reports measures by which a client recognizes a useless picture. */
static cJSON *picture_of(struct zr_tree *w, const struct zr_scene *scene, const struct zr_frame *frame,
                         const struct patch *patches, uint32_t face_count)
{
    const size_t pixels = (size_t)frame->width * frame->height;
    const uint32_t colors = zr_palette_count(frame->color, pixels, scene->background.w >= 1.0f);
    struct patch all = {.pixels = 0};
    for (uint32_t i = 1; i <= face_count + 1; i++)
        if (patches[i].pixels > 0)
            extend(&all, patches[i].x0, patches[i].y0, patches[i].x1, patches[i].y1, patches[i].pixels);
    const bool touches = all.x0 == 0 || all.y0 == 0 || all.x1 == frame->width || all.y1 == frame->height;
    const double share = covered_share(frame, all.pixels);
    cJSON *object = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put(w, object, "coveredShare", zr_tree_number(w, (float)share));
    zr_tree_put(w, object, "touchesBorder", zr_tree_check(w, cJSON_CreateBool(all.pixels > 0 && touches)));
    zr_tree_put(w, object, "blank", zr_tree_check(w, cJSON_CreateBool(share == 0.0 || colors == 1)));
    zr_tree_put_count(w, object, "colors", colors);
    return object;
}

static cJSON *faces_of(struct zr_tree *w, const struct patch *patches, uint32_t face_count, uint32_t first)
{
    cJSON *array = zr_tree_check(w, cJSON_CreateArray());
    for (uint32_t id = 1; id <= face_count; id++) {
        if (patches[id].pixels == 0) continue;
        cJSON *face = zr_tree_check(w, cJSON_CreateObject());
        zr_tree_put_count(w, face, "id", first + (id - 1));
        put_patch(w, face, &patches[id]);
        zr_tree_append(w, array, face);
    }
    return array;
}

static cJSON *meshes_of(struct zr_tree *w, const struct zr_scene *scene, const struct patch *patches, uint32_t first)
{
    cJSON *array = zr_tree_check(w, cJSON_CreateArray());
    uint32_t id = 1;
    for (uint32_t i = 0; i < scene->instance_count && i < ZR_INFO_MESHES_MAX; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        cJSON *object = zr_tree_check(w, cJSON_CreateObject());
        zr_tree_put(w, object, "name", zr_tree_check(w, cJSON_CreateString(mesh->name)));
        if (scene->instances[i].node)
            zr_tree_put(w, object, "node", zr_tree_check(w, cJSON_CreateString(scene->instances[i].node)));
        zr_tree_put_count(w, object, "firstFaceId", first + (id - 1));
        zr_tree_put_count(w, object, "faces", mesh->face_count);
        if (mesh->line_count > 0) zr_tree_put_count(w, object, "lines", mesh->line_count);
        if (mesh->point_count > 0) zr_tree_put_count(w, object, "points", mesh->point_count);
        struct patch all = {.pixels = 0};
        for (uint64_t ids = zr_mesh_ids(mesh); ids > 0; ids--, id++)
            if (patches[id].pixels > 0)
                extend(&all, patches[id].x0, patches[id].y0, patches[id].x1, patches[id].y1, patches[id].pixels);
        put_patch(w, object, &all);
        zr_tree_append(w, array, object);
    }
    return array;
}

static cJSON *build(struct zr_tree *w, const struct zr_scene *scene, const struct zr_frame *frame, float depth_scale,
                    uint64_t misfits, const struct zr_warning_list *warnings, const struct patch *patches,
                    uint32_t face_count)
{
    cJSON *root = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put_count(w, root, "rules", ZR_RULES);
    cJSON *window = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put_count(w, window, "width", frame->width);
    zr_tree_put_count(w, window, "height", frame->height);
    zr_tree_put(w, root, "window", window);
    zr_tree_put(w, root, "camera", camera_of(w, frame, scene->picture.z_is_up));
    if (frame->bounds.valid) {
        cJSON *bounds = zr_tree_check(w, cJSON_CreateObject());
        zr_tree_put(w, bounds, "min", zr_tree_vec3(w, frame->bounds.min));
        zr_tree_put(w, bounds, "max", zr_tree_vec3(w, frame->bounds.max));
        zr_tree_put(w, root, "bounds", bounds);
    }
    if (depth_scale > 0.0f) zr_tree_put(w, root, "depthScale", zr_tree_number(w, depth_scale));
    zr_tree_put(w, root, "counts", counts_of(w, scene, frame, misfits));
    zr_tree_put(w, root, "look", zr_tree_check(w, cJSON_CreateString(zr_look_pin_of(scene->look).text)));
    if (frame->color) zr_tree_put(w, root, "picture", picture_of(w, scene, frame, patches, face_count));
    zr_tree_put_count(w, root, "backgroundPixels", patches[0].pixels);
    if (frame->base) {
        cJSON *base = zr_tree_check(w, cJSON_CreateObject());
        put_patch(w, base, &patches[face_count + 1]);
        zr_tree_put(w, root, "base", base);
    }
    zr_tree_put_count(w, root, "instances", scene->instance_count);
    uint32_t first = first_face_id(frame);
    zr_tree_put(w, root, "meshes", meshes_of(w, scene, patches, first));
    if (face_count <= ZR_INFO_FACES_MAX) zr_tree_put(w, root, "faces", faces_of(w, patches, face_count, first));
    static const char *const none[1]; /* cJSON takes no null pointer, even for 0 strings */
    zr_tree_put(
        w, root, "warnings",
        zr_tree_check(w, cJSON_CreateStringArray(warnings->texts ? warnings->texts : none, (int)warnings->count)));
    return root;
}

static bool predict_memory(const struct zr_scene *scene, const struct zr_warning_list *warnings, uint32_t face_count,
                           size_t *bytes)
{
    const uint32_t faces = face_count <= ZR_INFO_FACES_MAX ? face_count : 0;
    size_t characters = 0;
    uint32_t meshes = 0;
    bool fits = true;
    for (; meshes < scene->instance_count && meshes < ZR_INFO_MESHES_MAX; meshes++) {
        const struct zr_instance *instance = &scene->instances[meshes];
        fits &= zr_add_size(characters, strlen(scene->meshes[instance->mesh].name), &characters);
        fits &= zr_add_size(characters, instance->node ? strlen(instance->node) : 0, &characters);
    }
    for (size_t i = 0; i < warnings->count; i++)
        fits &= zr_add_size(characters, strlen(warnings->texts[i]), &characters);
    return fits && zr_mul_size(characters, ZR_TREE_CHARACTER_BYTES, bytes) &&
           zr_add_size(*bytes, ZR_TREE_OTHER_BYTES + (size_t)(meshes + faces) * ZR_TREE_LISTED_BYTES, bytes);
}

enum zr_status zr_info_write(const struct zr_scene *scene, const struct zr_frame *frame, float depth_scale,
                             uint64_t misfits, const struct zr_warning_list *warnings, struct zr_buffer *out)
{
    uint32_t face_count = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        face_count += (uint32_t)zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
    const struct patch *patches = patches_of(out->arena, frame, face_count);
    size_t predicted;
    if (!patches || !predict_memory(scene, warnings, face_count, &predicted) || !zr_arena_charge(out->arena, predicted))
        return ZR_NO_MEMORY;
    struct zr_tree w = {.ok = true};
    cJSON *root = build(&w, scene, frame, depth_scale, misfits, warnings, patches, face_count);
    const bool ok = zr_tree_print(&w, root, out);
    zr_arena_refund(out->arena, predicted);
    return ok ? ZR_OK : ZR_NO_MEMORY;
}
