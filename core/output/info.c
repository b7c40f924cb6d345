#include "output/info.h"

#include <stdio.h>

#include "measure/combined.h"
#include "output/annotations_json.h"
#include "output/images/palette.h"
#include "output/json/camera_json.h"
#include "output/json/features_json.h"
#include "output/json/json_print.h"
#include "output/json/picks_json.h"
#include "output/masks.h"
#include "scene/camera/camera.h"
#include "scene/looks.h"
#include "scene/picture.h"
#include "sections/sections.h"
#include "version.h"

/* Pixel count and bounding box of one id; x1 and y1 are exclusive. */
struct patch {
    uint64_t pixels;
    uint32_t x0, y0, x1, y1;
};

static void print_file(struct zr_print *print, const struct zr_scene *scene)
{
    const struct zr_file_facts *file = &scene->file;
    if (file->unit)
        zr_print_string(print, "unit", file->unit);
    else
        zr_print_null(print, "unit");
    zr_print_begin(print, "up", '{');
    zr_print_string(print, "axis", file->up ? file->up : scene->picture->z_is_up ? "z" : "y");
    zr_print_string(print, "source", file->up ? file->up_source : "scene");
    zr_print_end(print, '}');
}

/* Prints the counts that need no drawing. */
static void print_given_counts(struct zr_print *print, const struct zr_scene *scene)
{
    uint64_t polygons = 0, lines = 0, points = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        polygons += mesh->face_count;
        lines += mesh->line_count;
        points += mesh->point_count;
    }
    zr_print_begin(print, "counts", '{');
    zr_print_count(print, "polygons", polygons);
    zr_print_count(print, "lines", lines);
    zr_print_count(print, "points", points);
    zr_print_count(print, "zeroNormals", scene->counts.zero_normals);
    zr_print_count(print, "leftOutCells", scene->counts.left_out_cells);
    zr_print_end(print, '}');
}

static void print_counts(struct zr_print *print, const struct zr_scene *scene, const struct zr_frame *frame,
                         uint64_t clamped)
{
    const struct zr_counts *c = &frame->counts;
    zr_print_begin(print, "counts", '{');
    zr_print_count(print, "polygons", c->polygons);
    zr_print_count(print, "degeneratePolygons", c->degenerate_polygons);
    zr_print_count(print, "concavePolygons", c->concave_polygons);
    zr_print_count(print, "triangles", c->triangles);
    zr_print_count(print, "outside", c->outside);
    zr_print_count(print, "clipped", c->clipped);
    zr_print_count(print, "culled", c->culled);
    zr_print_count(print, "zeroArea", c->zero_area);
    zr_print_count(print, "drawnWhole", c->drawn_whole);
    zr_print_count(print, "drawnPieces", c->drawn_pieces);
    zr_print_count(print, "culledPieces", c->culled_pieces);
    zr_print_count(print, "clippedOutlines", c->clipped_outlines);
    zr_print_count(print, "lines", c->lines);
    zr_print_count(print, "degenerateLines", c->degenerate_lines);
    zr_print_count(print, "outsideLines", c->outside_lines);
    zr_print_count(print, "clippedLines", c->clipped_lines);
    zr_print_count(print, "points", c->points);
    zr_print_count(print, "outsidePoints", c->outside_points);
    zr_print_count(print, "unplaced", c->unplaced);
    zr_print_count(print, "zeroNormals", scene->counts.zero_normals);
    zr_print_count(print, "leftOutCells", scene->counts.left_out_cells);
    zr_print_count(print, "saturatedDepths", clamped);
    if (frame->base) zr_print_count(print, "clampedBaseDepths", frame->base->clamped_depths);
    zr_print_end(print, '}');
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

/* Returns patches[1 + number of the face], or NULL without memory. patches[0] is the background, and the last one is
 * the base, whose ids are distinct from those of the faces (input/mesh/json_base.c refuses others). */
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

static void print_patch(struct zr_print *print, const struct patch *patch)
{
    zr_print_count(print, "pixels", patch->pixels);
    if (patch->pixels == 0) return;
    const uint32_t box[4] = {patch->x0, patch->y0, patch->x1, patch->y1};
    zr_print_begin(print, "box", '[');
    for (int i = 0; i < 4; i++)
        zr_print_count(print, NULL, box[i]);
    zr_print_end(print, ']');
}

/* Returns the covered share of samples, if the picture has several per pixel; else that of pixels, including the
 * base's. */
static double covered_share(const struct zr_frame *frame, uint64_t covered_pixels)
{
    const double pixels = (double)frame->width * (double)frame->height;
    if (frame->samples_a_pixel == 0) return (double)covered_pixels / pixels;
    return (double)frame->covered_samples / (pixels * (double)frame->samples_a_pixel);
}

/* Prints measures by which a client recognizes a useless picture. */
static void print_picture(struct zr_print *print, const struct zr_scene *scene, const struct zr_frame *frame,
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
    zr_print_begin(print, "picture", '{');
    zr_print_float(print, "coveredShare", (float)share);
    zr_print_bool(print, "touchesBorder", all.pixels > 0 && touches);
    zr_print_bool(print, "blank", share == 0.0 || colors == 1);
    zr_print_count(print, "colors", colors);
    zr_print_end(print, '}');
}

static void print_faces(struct zr_print *print, const struct patch *patches, uint32_t face_count, uint32_t first)
{
    zr_print_begin(print, "faces", '[');
    for (uint32_t id = 1; id <= face_count; id++) {
        if (patches[id].pixels == 0) continue;
        zr_print_begin(print, NULL, '{');
        zr_print_count(print, "id", first + (id - 1));
        print_patch(print, &patches[id]);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

/* `patches` is NULL if nothing was drawn. */
static void print_meshes(struct zr_print *print, const struct zr_scene *scene, const struct patch *patches,
                         uint32_t first)
{
    uint32_t id = 1;
    zr_print_begin(print, "meshes", '[');
    for (uint32_t i = 0; i < scene->instance_count && i < ZR_INFO_MESHES_MAX; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "name", mesh->name);
        if (scene->instances[i].node) zr_print_string(print, "node", scene->instances[i].node);
        zr_print_count(print, "firstFaceId", first + (id - 1));
        zr_print_count(print, "faces", mesh->face_count);
        if (mesh->line_count > 0) zr_print_count(print, "lines", mesh->line_count);
        if (mesh->point_count > 0) zr_print_count(print, "points", mesh->point_count);
        const uint32_t end = id + (uint32_t)zr_mesh_ids(mesh);
        struct patch all = {.pixels = 0};
        for (uint32_t k = id; patches && k < end; k++)
            if (patches[k].pixels > 0)
                extend(&all, patches[k].x0, patches[k].y0, patches[k].x1, patches[k].y1, patches[k].pixels);
        if (patches) print_patch(print, &all);
        zr_print_end(print, '}');
        id = end;
    }
    zr_print_end(print, ']');
}

static void print_color(struct zr_print *print, zr_vec3 color)
{
    char text[8];
    const double steps[3] = {(double)color.x * 255.0, (double)color.y * 255.0, (double)color.z * 255.0};
    snprintf(text, sizeof text, "#%02x%02x%02x", (unsigned)(steps[0] + 0.5), (unsigned)(steps[1] + 0.5),
             (unsigned)(steps[2] + 0.5));
    zr_print_string(print, "color", text);
}

static void print_box(struct zr_print *print, const char *key, zr_vec3 min, zr_vec3 max, const double *moved)
{
    zr_print_begin(print, key, '{');
    zr_print_place(print, "min", min, moved);
    zr_print_place(print, "max", max, moved);
    zr_print_end(print, '}');
}

/* A flat shell has no inside. It counts as outward. */
static void print_shells(struct zr_print *print, const struct zr_shells *shells)
{
    zr_print_begin(print, "shells", '{');
    zr_print_count(print, "outward", (uint64_t)shells->outward + shells->flat);
    zr_print_count(print, "inward", shells->inward);
    zr_print_count(print, "open", shells->open);
    zr_print_end(print, '}');
}

/* Prints a place plus `moved`, which may be NULL. */
static void print_exact_place(struct zr_print *print, const char *key, const double at[3], const double *moved)
{
    double out[3] = {at[0], at[1], at[2]};
    for (int axis = 0; moved && axis < 3; axis++)
        out[axis] += moved[axis];
    zr_print_doubles(print, key, out, 3);
}

static void print_edges(struct zr_print *print, const char *key, const struct zr_edge_facts *edges, const double *moved)
{
    if (edges->count == 0) return;
    zr_print_begin(print, key, '{');
    zr_print_count(print, "count", edges->count);
    print_exact_place(print, "at", edges->at, moved);
    zr_print_end(print, '}');
}

/* The id equals the value of the channel instanceId as long as all meshes before it are one part. */
static void print_part(struct zr_print *print, const struct zr_frame_parts *parts, uint32_t number, bool has_features,
                       const double *moved)
{
    const struct zr_part_facts *facts = &parts->facts[number];
    const uint32_t instance = parts->list.at[number].instance;
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "name", parts->list.at[number].name);
    zr_print_count(print, "id", (uint64_t)number + 1);
    if (instance != number) zr_print_count(print, "instanceId", (uint64_t)instance + 1);
    if (facts->is_hidden) zr_print_bool(print, "hidden", true);
    if (facts->has_box)
        print_box(print, "box", facts->min, facts->max, moved);
    else
        zr_print_null(print, "box");
    zr_print_count(print, "triangles", facts->triangles);
    zr_print_double(print, "area", facts->area);
    if (facts->is_closed)
        zr_print_double(print, "volume", facts->volume);
    else
        zr_print_null(print, "volume");
    if (facts->has_overlap) zr_print_double(print, "volumeError", facts->volume_error);
    if (facts->has_center)
        print_exact_place(print, "centerOfMass", facts->center, moved);
    else
        zr_print_null(print, "centerOfMass");
    if (facts->least_wall.is_found)
        zr_print_double(print, "leastWall", facts->least_wall.thickness);
    else
        zr_print_null(print, "leastWall");
    if (facts->least_wall.is_found) print_exact_place(print, "leastWallAt", facts->least_wall.at, moved);
    if (facts->least_wall.is_omitted) zr_print_bool(print, "leastWallOmitted", true);
    zr_print_bool(print, "closed", facts->is_closed);
    print_shells(print, &facts->shells);
    print_edges(print, "openEdges", &facts->open_edges, moved);
    print_edges(print, "flippedEdges", &facts->flipped_edges, moved);
    if (parts->features && has_features) zr_features_print(print, &parts->features[number], moved);
    if (parts->cap_areas) zr_print_double(print, "capArea", parts->cap_areas[number]);
    if (parts->pixels) zr_print_count(print, "pixels", parts->pixels[number]);
    print_color(print, facts->color);
    zr_print_end(print, '}');
}

static void print_parts(struct zr_print *print, const struct zr_frame_parts *parts, bool has_features,
                        const double *moved)
{
    const uint32_t count = parts->list.count;
    zr_print_begin(print, "parts", '[');
    for (uint32_t i = 0; i < count; i++)
        print_part(print, parts, i, has_features, moved);
    zr_print_end(print, ']');
    if (parts->list.total > count) zr_print_count(print, "partsOmitted", parts->list.total - count);
}

static void print_combined(struct zr_print *print, const struct zr_combined *combined)
{
    const double center[3] = {combined->center.x, combined->center.y, combined->center.z};
    zr_print_begin(print, "csg", '{');
    zr_print_double(print, "volume", combined->volume);
    zr_print_double(print, "volumeError", combined->error);
    if (combined->volume > 0.0) zr_print_doubles(print, "centerOfMass", center, 3);
    zr_print_end(print, '}');
}

static void print_view(struct zr_print *print, const struct zr_scene *scene, const struct zr_frame *frame)
{
    zr_print_count(print, "rules", ZR_RULES);
    zr_print_begin(print, "window", '{');
    zr_print_count(print, "width", frame->width);
    zr_print_count(print, "height", frame->height);
    zr_print_end(print, '}');
    zr_camera_print(print, frame, scene->picture->z_is_up);
    print_file(print, scene);
    if (scene->origin && !scene->adds_origin) zr_print_doubles(print, "origin", scene->origin, 3);
    if (scene->parts.explode != 0.0) zr_print_double(print, "explode", scene->parts.explode);
    if (!frame->bounds.valid) return;
    print_box(print, "bounds", frame->bounds.min, frame->bounds.max, frame->origin);
}

enum zr_status zr_info_write(const struct zr_scene *scene, const struct zr_frame *frame, float depth_scale,
                             uint64_t clamped, const struct zr_warning_list *warnings, const char *encoders,
                             const struct zr_cancel *cancel, struct zr_buffer *out)
{
    struct zr_print root = {.out = out}, *print = &root;
    const uint32_t first = first_face_id(frame);
    uint32_t face_count = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        face_count += (uint32_t)zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
    if (frame->sections) face_count += frame->sections->cap_count; /* whose ids follow those of the faces */
    const struct patch *patches = frame->face_id ? patches_of(out->arena, frame, face_count) : NULL;
    if (frame->face_id && !patches) return ZR_NO_MEMORY;
    zr_print_begin(print, NULL, '{');
    print_view(print, scene, frame);
    if (depth_scale > 0.0f) zr_print_float(print, "depthScale", depth_scale);
    if (*encoders) zr_print_string(print, "encoders", encoders);
    if (patches)
        print_counts(print, scene, frame, clamped);
    else
        print_given_counts(print, scene);
    zr_print_string(print, "look", zr_look_pin_of(scene->look).text);
    if (frame->color) print_picture(print, scene, frame, patches, face_count);
    if (patches) zr_print_count(print, "backgroundPixels", patches[0].pixels);
    if (patches && frame->base) {
        zr_print_begin(print, "base", '{');
        print_patch(print, &patches[face_count + 1]);
        zr_print_end(print, '}');
    }
    zr_print_count(print, "instances", scene->instance_count);
    print_meshes(print, scene, patches, first);
    print_parts(print, &frame->parts, scene->has_features, frame->origin);
    if (frame->combined) print_combined(print, frame->combined);
    if (frame->masks) {
        const enum zr_status status = zr_masks_print(print, scene, frame, cancel);
        if (status != ZR_OK) return status;
    }
    zr_picks_print(print, frame);
    zr_distances_print(print, frame);
    zr_annotations_print(print, frame->annotations);
    if (patches && face_count <= ZR_INFO_FACES_MAX) print_faces(print, patches, face_count, first);
    zr_print_begin(print, "warnings", '[');
    for (size_t i = 0; i < warnings->count; i++)
        zr_print_string(print, NULL, warnings->texts[i]);
    zr_print_end(print, ']');
    zr_print_end(print, '}');
    return zr_buffer_add(out, "\n", 1) && zr_arena_ok(out->arena) ? ZR_OK : ZR_NO_MEMORY;
}
