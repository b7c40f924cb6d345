#include "output/json/warnings.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/matrix.h"
#include "geometry/face.h"
#include "overlay/annotate/annotate.h"
#include "scene/camera/resolved_view.h"
#include "scene/mesh_label.h"
#include "scene/output.h"
#include "scene/picture.h"
#include "sections/sections.h"

/* Returns true if the corners of every placed face are collinear. */
static bool are_lines(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t face = 0; face < mesh->face_count; face++)
            if (!zr_face_is_line(mesh, face)) return false;
    }
    return true;
}

/* ---- the mesh that a warning names ---- */

/* A changed copy of a mesh (scene/parts/part_edit.h) has the number of the original mesh. Both share face_offsets. */
static struct zr_mesh_label label_of(const struct zr_scene *scene, uint32_t mesh)
{
    uint32_t given = 0;
    while (scene->meshes[given].face_offsets != scene->meshes[mesh].face_offsets)
        given++;
    return zr_mesh_label_of(given, scene->meshes[mesh].name);
}

/* Finds the first odd element of a mesh and describes it: "face 1 of ". False: the mesh has none. */
struct found {
    char text[128];
};
typedef bool find_fn(const struct zr_mesh *mesh, struct found *found);

static bool find_degenerate_face(const struct zr_mesh *mesh, struct found *found)
{
    for (uint32_t face = 0; face < mesh->face_count; face++)
        if (zr_face_is_degenerate(mesh, face)) {
            snprintf(found->text, sizeof found->text, "face %" PRIu32 " of ", face);
            return true;
        }
    return false;
}

static bool find_line_without_length(const struct zr_mesh *mesh, struct found *found)
{
    for (uint32_t line = 0; line < mesh->line_count; line++)
        if (zr_vec4_equal(mesh->positions[mesh->lines[2 * line]], mesh->positions[mesh->lines[2 * line + 1]])) {
            snprintf(found->text, sizeof found->text, "line %" PRIu32 " of ", line);
            return true;
        }
    return false;
}

static bool find_unplaced_position(const struct zr_mesh *mesh, struct found *found)
{
    for (uint32_t i = 0; i < mesh->position_count; i++)
        if (zr_vec4_equal(mesh->positions[i], (zr_vec4){0, 0, 0, 0})) {
            snprintf(found->text, sizeof found->text, "position %" PRIu32 " of ", i);
            return true;
        }
    return false;
}

/* Returns ", the first: face 1 of mesh 0", counted from 0; "" if no placed mesh has one, since a matrix of an instance
 * is the cause. Walks over all meshes up to that one, but only for scenes that get a warning. */
static struct found first_in(const struct zr_scene *scene, find_fn *find)
{
    struct found found, text = {""};
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const uint32_t mesh = scene->instances[i].mesh;
        if (i > 0 && mesh == scene->instances[i - 1].mesh) continue;
        if (!find(&scene->meshes[mesh], &found)) continue;
        snprintf(text.text, sizeof text.text, ", the first: %.31s%s", found.text, label_of(scene, mesh).text);
        break;
    }
    return text;
}

/* ---- warnings ---- */

/* Adds warnings about dropped primitives, replaced normals and clamped depths. */
static void add_counts(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_frame *frame,
                       struct zr_warning_list *w)
{
    const struct zr_counts *counts = &frame->counts;
    if (counts->degenerate_polygons > 0)
        zr_warning_list_add(
            arena, w, "%" PRIu64 " of %" PRIu64 " polygons have fewer than three distinct corners and were dropped%s",
            counts->degenerate_polygons, counts->polygons, first_in(scene, find_degenerate_face).text);
    if (counts->degenerate_lines > 0)
        zr_warning_list_add(arena, w, "%" PRIu64 " of %" PRIu64 " lines have no length and were dropped%s",
                            counts->degenerate_lines, counts->lines, first_in(scene, find_line_without_length).text);
    if (counts->unplaced > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " triangles, lines and points have a corner that is nowhere, such as (0, 0, 0, "
                            "0), and were dropped%s",
                            counts->unplaced, first_in(scene, find_unplaced_position).text);
    if (scene->counts.zero_normals > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " of %" PRIu64 " normals are zero, the first in %s: they are computed "
                            "instead",
                            scene->counts.zero_normals, scene->counts.normals,
                            label_of(scene, scene->counts.zero_normals_mesh).text);
    if (frame->base && frame->base->clamped_depths > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " depths of the base are not between the near and the far plane: they are "
                            "taken to be on the nearer of these",
                            frame->base->clamped_depths);
}

/* Adds a warning about elements that a file of lines lacks. */
static void add_left_out(struct zr_arena *arena, const struct zr_frame *frame, struct zr_warning_list *w)
{
    const uint64_t lines = frame->counts.lines, points = frame->counts.points;
    if (frame->lines && lines + points > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " lines and %" PRIu64
                            " points are left out of the SVG: it has only the lines of faces",
                            lines, points);
}

/* Adds a warning about parts whose volume is not the sum over their shells. */
static void add_overlaps(struct zr_arena *arena, const struct zr_frame *frame, struct zr_warning_list *w)
{
    const struct zr_frame_parts *parts = &frame->parts;
    uint32_t count = 0, first = 0;
    for (uint32_t i = parts->facts ? parts->list.count : 0; i-- > 0;) {
        count += parts->facts[i].has_overlap;
        if (parts->facts[i].has_overlap) first = i;
    }
    if (count == 1)
        zr_warning_list_add(arena, w,
                            "shells of the part %.100s overlap or are turned against one another: volume and "
                            "centerOfMass count each place inside once, to within volumeError",
                            parts->list.at[first].name);
    if (count > 1)
        zr_warning_list_add(arena, w,
                            "shells of %" PRIu32 " parts overlap or are turned against one another, the first: %.100s: "
                            "volume and centerOfMass count each place inside once, to within volumeError",
                            count, parts->list.at[first].name);
}

/* Adds warnings about marks that are not drawn. */
static void add_annotations(struct zr_arena *arena, const struct zr_frame *frame, struct zr_warning_list *w)
{
    static const char *const texts[ZR_LEFT_OUT_CAUSES] = {
        [ZR_LEFT_OUT_NO_ROOM] = "found no room", [ZR_LEFT_OUT_BY_VIEW] = "cannot be drawn in this view"};
    const struct zr_annotations *annotations = frame->annotations;
    for (uint32_t i = 0; annotations && i < annotations->left_out_count; i++) {
        const struct zr_left_out *mark = &annotations->left_out[i];
        if (mark->cause == ZR_LEFT_OUT_MISTAKE) zr_warning_list_add(arena, w, "/%s: %s", mark->what, mark->why);
        if (mark->cause == ZR_LEFT_OUT_NOT_SEARCHED) zr_warning_list_add(arena, w, "annotate: %s", mark->why);
    }
    for (int cause = 0; annotations && cause < ZR_LEFT_OUT_CAUSES; cause++) {
        const uint32_t count = annotations->causes[cause];
        if (!texts[cause] || count == 0) continue;
        zr_warning_list_add(arena, w, "%" PRIu32 " mark%s %s: info.annotations.leftOut lists %s", count,
                            count == 1 ? "" : "s", texts[cause], count == 1 ? "it" : "them");
    }
    const uint32_t boxed = annotations ? annotations->marks.boxed : 0;
    if (boxed > 0)
        zr_warning_list_add(arena, w, "annotate: %" PRIu32 " text%s characters that have no glyph: drawn as boxes", boxed,
                            boxed == 1 ? " has" : "s have");
}

/* Counts the faces with a mask. */
static uint64_t count_masked(const struct zr_scene *scene)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t face = 0; face < mesh->face_count; face++)
            count += zr_material_of_face(scene, mesh, face)->alpha_mode == ZR_ALPHA_MASK;
    }
    return count;
}

/* Adds a warning about faces whose holes show in the picture, but not in its lines. */
static void add_masked(struct zr_arena *arena, const struct zr_scene *scene, struct zr_warning_list *w)
{
    const struct zr_edges *edges = &scene->picture->edges;
    bool has_mask = false;
    for (uint32_t i = 0; i < scene->material_count; i++)
        has_mask = has_mask || scene->materials[i].alpha_mode == ZR_ALPHA_MASK;
    if (!has_mask || !edges->is_on || !edges->is_from_mesh || !zr_view_wants(&scene->views[0], ZR_CHANNEL_COLOR))
        return;
    const uint64_t faces = count_masked(scene);
    if (faces > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " faces have the alphaMode MASK: they hide lines of the mesh as if they had no "
                            "holes",
                            faces);
}

/* Returns true if the near plane separates the vertices: some are cut off by it, and some lie beyond it. */
static bool near_plane_cuts(const struct zr_scene *scene, const struct zr_camera *camera)
{
    bool before = false, behind = false;
    for (uint32_t i = 0; i < scene->instance_count && !(before && behind); i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        const zr_mat4 to_eye = zr_mat4_mul(&camera->world_to_eye, &scene->instances[i].object_to_world),
                      to_clip = zr_mat4_mul(&camera->projection, &to_eye);
        for (uint32_t k = 0; k < mesh->position_count && !(before && behind); k++) {
            const zr_vec4 clip = zr_mat4_apply(&to_clip, mesh->positions[k]);
            before |= clip.z < -clip.w;
            behind |= clip.z > -clip.w;
        }
    }
    return before && behind;
}

static bool any_is_blended(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].alpha_mode == ZR_ALPHA_BLEND) return true;
    return false;
}

/* Returns true if the channel thickness has values. It includes faces that face away, which cover no pixel. */
static bool has_thickness(const struct zr_frame *frame)
{
    const float *thickness = frame->channels[ZR_CHANNEL_THICKNESS];
    for (size_t i = 0; thickness && i < (size_t)frame->width * frame->height; i++)
        if (thickness[i] > 0.0f) return true;
    return false;
}

/* Returns true if the channel layers or fragments has values. They include blended faces, which cover no pixel. */
static bool has_layers(const struct zr_frame *frame)
{
    const uint32_t *layers = frame->channels[ZR_CHANNEL_LAYERS];
    for (size_t i = 0; layers && i < (size_t)frame->width * frame->height; i++)
        if (layers[i] > 0) return true;
    return frame->fragments.count > 0;
}

/* Data channels omit blended faces. */
#define ONLY_BLENDED "all that is in view has the alphaMode BLEND, which only the channel color shows"

/* Returns the name of the first output whose pixels all have the clear value, or NULL. Channels that are also 0 on
 * lines are not checked. */
static const char *find_empty_output(const struct zr_scene *scene, const struct zr_frame *frame)
{
    static const enum zr_channel checked[] = {ZR_CHANNEL_DEPTH, ZR_CHANNEL_WINDOW_DEPTH, ZR_CHANNEL_FACE_ID,
                                              ZR_CHANNEL_DISTANCE, ZR_CHANNEL_INSTANCE_ID};
    for (size_t k = 0; k < sizeof checked / sizeof *checked; k++) {
        const struct zr_channel_row *row = &zr_channel_rows[checked[k]];
        const uint32_t *words = frame->channels[checked[k]];
        size_t i = 0, count = (size_t)frame->width * frame->height;
        if (!words || !zr_view_wants(&scene->views[0], checked[k])) continue;
        while (i < count && words[i] == row->clear_value)
            i++;
        if (i == count) return row->name;
    }
    return NULL;
}

static const char *why_uncovered(const struct zr_scene *scene, const struct zr_frame *frame)
{
    const struct zr_counts *counts = &frame->counts;
    const bool drawn = counts->drawn_whole + counts->drawn_pieces > 0;
    const uint64_t primitives = counts->triangles + counts->lines - counts->degenerate_lines + counts->points;
    const uint64_t outside = counts->outside + counts->outside_lines + counts->outside_points;
    if (!drawn && counts->culled + counts->culled_pieces > 0)
        return near_plane_cuts(scene, &frame->camera)
                   ? "the near plane (znear) cuts off the faces that face the camera, and the rest faces away"
                   : "every face in view faces away (doubleSided draws both sides)";
    if (primitives == 0 && frame->sections) return "the sections cut everything away";
    if (primitives == 0 && counts->degenerate_polygons == 0)
        return "fill is false, and there is no outline, line or point";
    if (counts->masked_tiles > 0) return "alpha is below alphaCutoff wherever something is drawn";
    if (outside == primitives && primitives > 0) return "all geometry is outside the view";
    if (counts->triangles > 0 && are_lines(scene)) return "the corners of each polygon are collinear, on one line";
    if (!drawn && counts->zero_area > 0) return "the polygons in view are edge-on, or smaller than 1/256 pixel";
    if (!frame->color && any_is_blended(scene)) return ONLY_BLENDED;
    if (frame->base) return "no pixel is covered in front of the base";
    return "no pixel is covered (edge-on, smaller than a pixel, or at the far plane)";
}

struct zr_drawing_warnings zr_drawing_warnings_make(struct zr_arena *arena, const struct zr_scene *scene,
                                                    const struct zr_frame *frame)
{
    struct zr_drawing_warnings w = {.first.count = 0};
    char text[ZR_VIEW_WARNING_SIZE];
    for (uint32_t i = 0; i < scene->warning_count; i++)
        zr_warning_list_add(arena, &w.first, "%s", scene->warnings[i]);
    add_counts(arena, scene, frame, &w.first);
    add_left_out(arena, frame, &w.first);
    add_overlaps(arena, frame, &w.first);
    add_annotations(arena, frame, &w.first);
    if (!scene->is_undrawn) add_masked(arena, scene, &w.first);
    if (frame->sections && frame->sections->warning)
        zr_warning_list_add(arena, &w.first, "%s", frame->sections->warning);
    if (frame->pixels_without_ray > 0)
        zr_warning_list_add(arena, &w.first,
                            "%" PRIu64 " pixels are beyond the fold of the lens, where its distortion has no inverse: "
                            "they have the values of uncovered pixels",
                            frame->pixels_without_ray);
    if (zr_view_warns(&frame->camera, text)) zr_warning_list_add(arena, &w.first, "%s", text);
    if (scene->is_undrawn) return w;
    if (frame->covered_pixels == 0 && frame->covered_samples == 0) {
        if (!has_thickness(frame) && !has_layers(frame))
            zr_warning_list_add(arena, &w.last, "nothing is visible: %s", why_uncovered(scene, frame));
    } else if (frame->color && any_is_blended(scene)) {
        const char *empty = find_empty_output(scene, frame);
        if (empty) zr_warning_list_add(arena, &w.last, "nothing is visible in the output %s: " ONLY_BLENDED, empty);
    }
    return w;
}

struct zr_warning_list zr_warnings_list(struct zr_arena *arena, const struct zr_drawing_warnings *drawing,
                                        uint64_t clamped)
{
    struct zr_warning_list all = {.count = 0};
    zr_warning_list_append(arena, &all, &drawing->first);
    if (clamped > 0)
        zr_warning_list_add(arena, &all, "the depth of %" PRIu64 " pixels does not fit 16 bits at this scale", clamped);
    zr_warning_list_append(arena, &all, &drawing->last);
    return all;
}

/* Room for "; and 4294967295 more": fewer than 2^32 warnings are left out. */
enum { MORE_SIZE = 24 };

const char *zr_warnings_join(struct zr_arena *arena, const struct zr_warning_list *warnings)
{
    char *joined = zr_arena_alloc(arena, ZR_WARNINGS_SIZE, 1), *end = joined;
    if (!joined) return "";
    *end = '\0';
    for (size_t i = 0; i < warnings->count; i++) {
        const char *separator = i > 0 ? "; " : "", *text = warnings->texts[i];
        const size_t left = ZR_WARNINGS_SIZE - (size_t)(end - joined);
        const size_t reserved = i + 1 < warnings->count ? MORE_SIZE : 0;
        if (strlen(separator) + strlen(text) + reserved >= left) {
            snprintf(end, left, "%sand %zu more", separator, warnings->count - i);
            break;
        }
        end = stpcpy(stpcpy(end, separator), text);
    }
    return joined;
}
