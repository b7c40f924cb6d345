/* Reads a base: images of an earlier picture. scene/validate.h checks that the outputs have the images they need, since
 * the query may add outputs. */
#include <inttypes.h>
#include <math.h>

#include "input/formats/quick.h"
#include "input/images/image_file.h"
#include "input/json/npy_read.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

static const char *const sides[] = {"base", "scene"};
static const struct zr_names side_names = ZR_NAMES(2, sides);

enum { COLOR, WINDOW_DEPTH, DEPTH, FACE_ID, TIES, FIRST_FACE_ID, IMAGES = FACE_ID + 1 };

struct reader {
    struct zr_parsed_scene *root;
    const struct zr_json_path *path;
    uint64_t keys;
    const char *places[IMAGES]; /* first bytes in the text */
    int ties;
    uint32_t first_face_id;
    struct zr_parsed_bytes given[IMAGES];
    struct zr_base *base;
    uint64_t largest_id; /* the largest id in base->face_id */
};

#define IMAGE(key, number, what)                                                                                       \
    {                                                                                                                  \
        key, zr_json_value_start, offsetof(struct reader, places[number]), .text = what,                               \
                                                                           .schema = ZR_SCHEMA_OF("file")              \
    }
static const struct zr_json_field fields[] = {
    [COLOR] = IMAGE("color", COLOR, "picture, a PNG of the window's size"),
    [WINDOW_DEPTH] = IMAGE("windowDepth", WINDOW_DEPTH, "z-buffer of the picture, an npy of float32"),
    [DEPTH] = IMAGE("depth", DEPTH, "depths in front of the camera, an npy of float32"),
    [FACE_ID] = IMAGE("faceId", FACE_ID, "id of the face at each pixel, an npy of uint32"),
    [TIES] = {"ties", zr_json_choice, offsetof(struct reader, ties), .words = &side_names, .otherwise = "base",
              .text = "side that is visible at equal depth"},
    [FIRST_FACE_ID] = {"firstFaceId", zr_json_whole, offsetof(struct reader, first_face_id),
                       .otherwise = "the largest id of the base + 1", .text = "id of the first new face",
                       .schema = ZR_SCHEMA({"type" : "integer", "minimum" : 1, "maximum" : 4294967295})}};
static const struct zr_json_rule rules[] = {
    {ZR_RULE_SOME, .text = "windowDepth is missing: the base needs it, or depth, to hide what lies behind its surfaces",
     .sets = {ZR_KEY(WINDOW_DEPTH) | ZR_KEY(DEPTH)}}};
const struct zr_json_object zr_json_object_base = {ZR_JSON_FIELDS("base", fields), ZR_JSON_RULES(rules)};

static bool has(const struct reader *reader, int key)
{
    return zr_json_gives(reader->keys, key);
}

/* True if the window is valid; zr_scene_validate reports an invalid one. */
static bool window_is_good(const struct zr_parsed_scene *root)
{
    const struct zr_view *view = &root->scene->views[0];
    const struct zr_limits *limits = root->json.limits;
    return view->width >= 1 && view->width <= limits->window_side_max && view->height >= 1 &&
           view->height <= limits->window_side_max && (uint64_t)view->width * view->height <= limits->window_pixels_max;
}

static const struct zr_view *view_of(const struct reader *reader)
{
    return &reader->root->scene->views[0];
}

static size_t count_pixels(const struct reader *reader)
{
    return (size_t)view_of(reader)->width * view_of(reader)->height;
}

static bool pixel_fault(struct reader *reader, int key, size_t pixel, const char *what)
{
    const uint32_t width = view_of(reader)->width;
    return zr_json_fault(&reader->root->json, ZR_JSON_KEY(reader->path, fields[key].key),
                         "pixel (%zu, %zu), counted from the top left: %s", pixel % width, pixel / width, what);
}

static bool refuse(struct reader *reader, int key, enum zr_status status, const struct zr_reason *reason)
{
    if (status == ZR_BAD_SCENE)
        zr_json_fault(&reader->root->json, ZR_JSON_KEY(reader->path, fields[key].key), "%s", reason->text);
    return status == ZR_OK;
}

static void *read_numbers(struct reader *reader, int key, bool is_float)
{
    const struct zr_npy_wanted wanted = {is_float, view_of(reader)->width, view_of(reader)->height};
    struct zr_reason reason;
    void *values = NULL;
    enum zr_status status = zr_npy_read(reader->root->json.arena, &reader->given[key], &wanted, &values, &reason);
    return refuse(reader, key, status, &reason) ? values : NULL;
}

static void read_color(struct reader *reader)
{
    const struct zr_view *view = view_of(reader);
    struct zr_quick *quick = reader->root->assets.quick;
    struct zr_reason reason;
    uint8_t *rgba = NULL;
    if (quick && count_pixels(reader) > quick->image_pixels_max) {
        zr_quick_exceed(quick, reader->root->json.error);
        return;
    }
    const struct zr_png_head wanted = {view->width, view->height, 8};
    enum zr_status status = zr_png_read(reader->root->json.arena, &reader->given[COLOR], &wanted, &rgba, &reason);
    if (!refuse(reader, COLOR, status, &reason)) return;
    reader->base->color = rgba;
    uint8_t alpha = 255;
    for (size_t i = 0; i < count_pixels(reader); i++)
        alpha &= rgba[4 * i + 3];
    if (alpha != 255 && reader->root->scene->background.w >= 1.0f)
        zr_warning_list_add(reader->root->json.arena, &reader->root->builder->color_warnings,
                            "base.color is transparent in parts and the background is not: its alpha is left out");
}

static void read_window_depth(struct reader *reader)
{
    const float *depth = read_numbers(reader, WINDOW_DEPTH, true);
    const size_t pixels = count_pixels(reader);
    for (size_t i = 0; depth && i < pixels; i++)
        if (!(depth[i] >= 0.0f && depth[i] <= 1.0f)) {
            pixel_fault(reader, WINDOW_DEPTH, i, isnan(depth[i]) ? "not a number" : "outside of 0 to 1");
            return;
        }
    reader->base->window_depth = depth;
}

static void read_depth(struct reader *reader)
{
    float *depth = read_numbers(reader, DEPTH, true);
    const size_t pixels = count_pixels(reader);
    for (size_t i = 0; depth && i < pixels; i++) {
        if (isnan(depth[i])) depth[i] = INFINITY; /* both mean background, which the output writes as +inf */
        if (depth[i] == -INFINITY) {
            pixel_fault(reader, DEPTH, i, "-inf is not a depth; +inf marks uncovered pixels");
            return;
        }
    }
    reader->base->depth = depth;
}

/* Ids of the base may be any numbers except those of new faces. */
static void read_face_ids(struct reader *reader)
{
    const uint32_t *ids = read_numbers(reader, FACE_ID, false);
    const size_t pixels = count_pixels(reader);
    for (size_t i = 0; ids && i < pixels; i++)
        if (ids[i] > reader->largest_id) reader->largest_id = ids[i];
    reader->base->face_id = ids;
}

static void refuse_shared_ids(struct reader *reader, uint64_t faces)
{
    const struct zr_base *base = reader->base;
    const size_t pixels = count_pixels(reader);
    for (size_t i = 0; i < pixels; i++)
        if (base->face_id[i] >= base->first_face_id && base->face_id[i] - base->first_face_id < faces) {
            zr_json_fault(&reader->root->json, ZR_JSON_KEY(reader->path, fields[FIRST_FACE_ID].key),
                          "new faces would have the ids %" PRIu32 " to %" PRIu64 ", and base.faceId has %" PRIu32
                          " already",
                          base->first_face_id, base->first_face_id + faces - 1, base->face_id[i]);
            return;
        }
}

static void number_faces(struct reader *reader)
{
    const struct zr_scene *scene = reader->root->scene;
    struct zr_base *base = reader->base;
    uint64_t faces = 0, first = has(reader, FIRST_FACE_ID) ? base->first_face_id : reader->largest_id + 1;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        faces += zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
    if (first + faces > (uint64_t)UINT32_MAX + 1) {
        zr_json_fault(&reader->root->json, ZR_JSON_KEY(reader->path, fields[FIRST_FACE_ID].key),
                      "ids from %" PRIu64 " on for %" PRIu64 " faces do not fit 32 bits", first, faces);
        return;
    }
    base->first_face_id = (uint32_t)first;
    if (has(reader, FIRST_FACE_ID) && base->face_id) refuse_shared_ids(reader, faces);
}

static void check_words(struct reader *reader)
{
    reader->base->scene_wins_ties = reader->ties == 1;
    reader->base->first_face_id = reader->first_face_id;
    if (reader->first_face_id == 0)
        zr_json_fault(&reader->root->json, ZR_JSON_KEY(reader->path, fields[FIRST_FACE_ID].key),
                      "0 is the id of uncovered pixels");
}

/* Requires znear and zfar: depths of a z-buffer are relative to its planes. Planes fitted to the new geometry would
 * change their meaning and hide the wrong faces. */
static void check_planes(struct reader *reader)
{
    const struct zr_view *view = view_of(reader);
    if (!has(reader, WINDOW_DEPTH) || view->projection == ZR_PROJECTION_MATRIX) return;
    if (view->has_znear && view->has_zfar) return;
    zr_json_fault(&reader->root->json, ZR_JSON_KEY(NULL, "view"),
                  "znear and zfar are missing: base.windowDepth is measured between the planes that it was drawn with, "
                  "which its info has");
}

/* Warns if the view is fitted: it fits the new geometry, and so differs from the base's view. */
static void warn_of_fitted_view(struct zr_parsed_scene *root)
{
    const struct zr_view *view = &root->scene->views[0];
    bool fitted_pose = view->pose == ZR_POSE_PRESET || view->pose == ZR_POSE_DIRECTION ||
                       (view->pose == ZR_POSE_ORBIT && !(view->has_target && view->distance > 0.0f));
    bool fitted_size = view->projection == ZR_PROJECTION_ORTHOGRAPHIC && !(view->xmag > 0.0f);
    bool fitted_planes = view->projection != ZR_PROJECTION_MATRIX && !(view->has_znear && view->has_zfar);
    if (fitted_pose || fitted_size || fitted_planes)
        zr_warning_list_add(root->json.arena, &root->builder->warnings,
                            "the view's %s fitted to the new geometry, not to the picture of base",
                            fitted_pose   ? "pose is"
                            : fitted_size ? "size is"
                                          : "znear and zfar are");
}

void zr_parsed_read_base(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    struct zr_json there = zr_json_at(&root->json, root->base), *json = &root->json;
    struct reader reader = {.root = root, .path = path, .first_face_id = 1};
    if (!zr_json_fields(&there, path, &zr_json_object_base, &reader, &reader.keys)) return;
    reader.base = zr_arena_zero(json->arena, 1, sizeof *reader.base);
    if (!reader.base) return;
    check_words(&reader);
    check_planes(&reader);
    for (int key = COLOR; key < IMAGES; key++) {
        struct zr_json image = zr_json_at(json, reader.places[key]);
        if (has(&reader, key)) zr_parsed_read_bytes(&image, ZR_JSON_KEY(path, fields[key].key), &reader.given[key]);
    }
    if (json->error->count > 0 || !zr_arena_ok(json->arena) || !window_is_good(root)) return;
    if (has(&reader, COLOR)) read_color(&reader);
    if (has(&reader, WINDOW_DEPTH)) read_window_depth(&reader);
    if (has(&reader, DEPTH)) read_depth(&reader);
    if (has(&reader, FACE_ID)) read_face_ids(&reader);
    if (json->error->count > 0 || !zr_arena_ok(json->arena)) return;
    number_faces(&reader);
    warn_of_fitted_view(root);
    root->scene->base = reader.base;
}
