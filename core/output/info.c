#include "output/info.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked.h"
#include "output/palette.h"
#include "scene/looks.h"
#include "scene/orbit.h"
#include "version.h"

/* Pixels of one id, and the box that holds them: x1 and y1 exclusive. */
struct patch {
    uint64_t pixels;
    uint32_t x0, y0, x1, y1;
};

/* cJSON remembers no failure, takes NULL for an item, and leaves an item that it could not add to the caller: so every
 * item is checked here, what belongs to no tree is freed, and a tree that lacks one is not printed. */
struct writer {
    bool ok;
};

static cJSON *check(struct writer *w, cJSON *item)
{
    if (!item) w->ok = false;
    return item;
}

/* The shortest decimal that reads back as the same float. */
static cJSON *number(struct writer *w, float value)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) break;
    }
    return check(w, cJSON_CreateRaw(text));
}

static void put(struct writer *w, cJSON *object, const char *key, cJSON *item)
{
    if (item && cJSON_AddItemToObject(object, key, item)) return;
    w->ok = false;
    cJSON_Delete(item);
}

static void append(struct writer *w, cJSON *array, cJSON *item)
{
    if (item && cJSON_AddItemToArray(array, item)) return;
    w->ok = false;
    cJSON_Delete(item);
}

static void put_count(struct writer *w, cJSON *object, const char *key, uint64_t count)
{
    put(w, object, key, check(w, cJSON_CreateNumber((double)count)));
}

static cJSON *numbers(struct writer *w, const float *values, int count)
{
    cJSON *array = check(w, cJSON_CreateArray());
    for (int i = 0; i < count; i++)
        append(w, array, number(w, values[i]));
    return array;
}

static cJSON *vec3(struct writer *w, zr_vec3 v)
{
    return numbers(w, (float[3]){v.x, v.y, v.z}, 3);
}

/* Pinhole intrinsics in pixels, (0, 0) at the top left corner; only where the
 * projection is one. */
static void put_intrinsics(struct writer *w, cJSON *object, const struct zr_frame *frame)
{
    const float *p = frame->camera.projection.m;
    if (p[3] != 0.0f || p[7] != 0.0f || p[11] != -1.0f || p[15] != 0.0f) return;
    double x = (double)frame->width * 0.5, y = (double)frame->height * 0.5;
    double skew = 0.0 - (double)p[4], lean = 0.0 - (double)p[1]; /* from zero, so that no zero becomes -0 */
    const float rows[3][3] = {{(float)((double)p[0] * x), (float)(skew * x), (float)((1.0 - (double)p[8]) * x)},
                              {(float)(lean * y), (float)((double)p[5] * y), (float)((1.0 + (double)p[9]) * y)},
                              {0.0f, 0.0f, 1.0f}};
    cJSON *k = check(w, cJSON_CreateArray());
    for (int i = 0; i < 3; i++)
        append(w, k, numbers(w, rows[i], 3));
    put(w, object, "K", k);
}

/* For people: where the view leads to. */
static void put_orbit(struct writer *w, cJSON *object, const struct zr_camera *camera, bool z_is_up)
{
    const struct zr_orbit orbit = zr_orbit_of(camera, z_is_up);
    put(w, object, "up", check(w, cJSON_CreateString(z_is_up ? "z" : "y")));
    if (orbit.has_angles) {
        put(w, object, "azimuthDegrees", number(w, (float)orbit.azimuth_degrees));
        put(w, object, "elevationDegrees", number(w, (float)orbit.elevation_degrees));
    }
    if (orbit.has_eye) put(w, object, "eye", vec3(w, orbit.eye));
}

static cJSON *camera_of(struct writer *w, const struct zr_frame *frame, bool z_is_up)
{
    const struct zr_camera *camera = &frame->camera;
    cJSON *object = check(w, cJSON_CreateObject());
    put(w, object, "worldToCamera", numbers(w, camera->world_to_eye.m, 16));
    put(w, object, "projectionMatrix", numbers(w, camera->projection.m, 16));
    put_intrinsics(w, object, frame);
    if (camera->znear != 0.0f || camera->zfar != 0.0f) {
        put(w, object, "znear", number(w, camera->znear));
        put(w, object, "zfar", number(w, camera->zfar));
    }
    put_orbit(w, object, camera, z_is_up);
    return object;
}

static cJSON *counts_of(struct writer *w, const struct zr_scene *scene, const struct zr_frame *frame, uint64_t misfits)
{
    const struct zr_counts *c = &frame->counts;
    cJSON *object = check(w, cJSON_CreateObject());
    put_count(w, object, "polygons", c->polygons);
    put_count(w, object, "degeneratePolygons", c->degenerate_polygons);
    put_count(w, object, "concavePolygons", c->concave_polygons);
    put_count(w, object, "triangles", c->triangles);
    put_count(w, object, "outside", c->outside);
    put_count(w, object, "clipped", c->clipped);
    put_count(w, object, "culled", c->culled);
    put_count(w, object, "zeroArea", c->zero_area);
    put_count(w, object, "drawnWhole", c->drawn_whole);
    put_count(w, object, "drawnPieces", c->drawn_pieces);
    put_count(w, object, "culledPieces", c->culled_pieces);
    put_count(w, object, "clippedOutlines", c->clipped_outlines);
    put_count(w, object, "lines", c->lines);
    put_count(w, object, "degenerateLines", c->degenerate_lines);
    put_count(w, object, "outsideLines", c->outside_lines);
    put_count(w, object, "clippedLines", c->clipped_lines);
    put_count(w, object, "points", c->points);
    put_count(w, object, "outsidePoints", c->outside_points);
    put_count(w, object, "unplaced", c->unplaced);
    put_count(w, object, "zeroNormals", scene->counts.zero_normals);
    put_count(w, object, "leftOutCells", scene->counts.left_out_cells);
    put_count(w, object, "saturatedDepths", misfits);
    if (frame->base) put_count(w, object, "clampedBaseDepths", frame->base->clamped_depths);
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

/* patches[1 + number of the face]; patches[0] is the background, and the last is the base,
 * whose ids are none of the faces' (input/json_base.c refuses the others). */
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

static void put_patch(struct writer *w, cJSON *object, const struct patch *patch)
{
    put_count(w, object, "pixels", patch->pixels);
    if (patch->pixels == 0) return;
    int box[4] = {(int)patch->x0, (int)patch->y0, (int)patch->x1, (int)patch->y1};
    put(w, object, "box", check(w, cJSON_CreateIntArray(box, 4)));
}

/* Of a picture of several samples, of these; else of pixels, by their centres, the base's included. */
static double covered_share(const struct zr_frame *frame, uint64_t covered_pixels)
{
    const double pixels = (double)frame->width * (double)frame->height;
    if (frame->samples_a_pixel == 0) return (double)covered_pixels / pixels;
    return (double)frame->covered_samples / (pixels * (double)frame->samples_a_pixel);
}

/* What tells a useless picture from others. */
static cJSON *picture_of(struct writer *w, const struct zr_scene *scene, const struct zr_frame *frame,
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
    cJSON *object = check(w, cJSON_CreateObject());
    put(w, object, "coveredShare", number(w, (float)share));
    put(w, object, "touchesBorder", check(w, cJSON_CreateBool(all.pixels > 0 && touches)));
    put(w, object, "blank", check(w, cJSON_CreateBool(share == 0.0 || colors == 1)));
    put_count(w, object, "colors", colors);
    return object;
}

static cJSON *faces_of(struct writer *w, const struct patch *patches, uint32_t face_count, uint32_t first)
{
    cJSON *array = check(w, cJSON_CreateArray());
    for (uint32_t id = 1; id <= face_count; id++) {
        if (patches[id].pixels == 0) continue;
        cJSON *face = check(w, cJSON_CreateObject());
        put_count(w, face, "id", first + (id - 1));
        put_patch(w, face, &patches[id]);
        append(w, array, face);
    }
    return array;
}

static cJSON *meshes_of(struct writer *w, const struct zr_scene *scene, const struct patch *patches, uint32_t first)
{
    cJSON *array = check(w, cJSON_CreateArray());
    uint32_t id = 1;
    for (uint32_t i = 0; i < scene->instance_count && i < ZR_INFO_MESHES_MAX; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        cJSON *object = check(w, cJSON_CreateObject());
        put(w, object, "name", check(w, cJSON_CreateString(mesh->name)));
        if (scene->instances[i].node) put(w, object, "node", check(w, cJSON_CreateString(scene->instances[i].node)));
        put_count(w, object, "firstFaceId", first + (id - 1));
        put_count(w, object, "faces", mesh->face_count);
        if (mesh->line_count > 0) put_count(w, object, "lines", mesh->line_count);
        if (mesh->point_count > 0) put_count(w, object, "points", mesh->point_count);
        struct patch all = {.pixels = 0};
        for (uint64_t ids = zr_mesh_ids(mesh); ids > 0; ids--, id++)
            if (patches[id].pixels > 0)
                extend(&all, patches[id].x0, patches[id].y0, patches[id].x1, patches[id].y1, patches[id].pixels);
        put_patch(w, object, &all);
        append(w, array, object);
    }
    return array;
}

static cJSON *build(struct writer *w, const struct zr_scene *scene, const struct zr_frame *frame, float depth_scale,
                    uint64_t misfits, const struct zr_warning_list *warnings, const struct patch *patches,
                    uint32_t face_count)
{
    cJSON *root = check(w, cJSON_CreateObject());
    put_count(w, root, "rules", ZR_RULES);
    cJSON *window = check(w, cJSON_CreateObject());
    put_count(w, window, "width", frame->width);
    put_count(w, window, "height", frame->height);
    put(w, root, "window", window);
    put(w, root, "camera", camera_of(w, frame, scene->picture.z_is_up));
    if (frame->bounds.valid) {
        cJSON *bounds = check(w, cJSON_CreateObject());
        put(w, bounds, "min", vec3(w, frame->bounds.min));
        put(w, bounds, "max", vec3(w, frame->bounds.max));
        put(w, root, "bounds", bounds);
    }
    if (depth_scale > 0.0f) put(w, root, "depthScale", number(w, depth_scale));
    put(w, root, "counts", counts_of(w, scene, frame, misfits));
    put(w, root, "look", check(w, cJSON_CreateString(zr_look_pin_of(scene->look).text)));
    if (frame->color) put(w, root, "picture", picture_of(w, scene, frame, patches, face_count));
    put_count(w, root, "backgroundPixels", patches[0].pixels);
    if (frame->base) {
        cJSON *base = check(w, cJSON_CreateObject());
        put_patch(w, base, &patches[face_count + 1]);
        put(w, root, "base", base);
    }
    put_count(w, root, "instances", scene->instance_count);
    uint32_t first = first_face_id(frame);
    put(w, root, "meshes", meshes_of(w, scene, patches, first));
    if (face_count <= ZR_INFO_FACES_MAX) put(w, root, "faces", faces_of(w, patches, face_count, first));
    static const char *const none[1]; /* cJSON takes no null pointer, of none either */
    put(w, root, "warnings",
        check(w, cJSON_CreateStringArray(warnings->texts ? warnings->texts : none, (int)warnings->count)));
    return root;
}

/* Bytes that cJSON may have at once for a mesh or a face beside a name, for all else beside texts, and for a byte of a
 * name or a text: one in the tree, and printed up to six in memory that doubles, beside what it was copied from. */
enum { LISTED_BYTES = 2 << 10, OTHER_BYTES = 32 << 10, BYTES_OF_A_CHARACTER = 1 + 3 * 6 };

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
    return fits && zr_mul_size(characters, BYTES_OF_A_CHARACTER, bytes) &&
           zr_add_size(*bytes, OTHER_BYTES + (size_t)(meshes + faces) * LISTED_BYTES, bytes);
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
    struct writer w = {.ok = true};
    cJSON *root = build(&w, scene, frame, depth_scale, misfits, warnings, patches, face_count);
    char *text = w.ok ? cJSON_PrintUnformatted(root) : NULL;
    cJSON_Delete(root);
    bool ok = text && zr_buffer_add(out, text, strlen(text)) && zr_buffer_add(out, "\n", 1);
    cJSON_free(text);
    zr_arena_refund(out->arena, predicted);
    return ok ? ZR_OK : ZR_NO_MEMORY;
}
