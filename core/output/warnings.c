#include "output/warnings.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "geometry/face.h"
#include "scene/resolved_view.h"

/* Stops at the first face that is none. */
static bool are_lines(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t face = 0; face < mesh->face_count; face++)
            if (!zr_face_is_line(mesh, face)) return false;
    }
    return true;
}

/* What was left out, replaced or moved, of what there was. */
static void add_counts(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_frame *frame,
                       struct zr_warning_list *w)
{
    const struct zr_counts *counts = &frame->counts;
    if (counts->degenerate_polygons > 0)
        zr_warning_list_add(
            arena, w, "%" PRIu64 " of %" PRIu64 " polygons have fewer than three distinct corners and were dropped",
            counts->degenerate_polygons, counts->polygons);
    if (counts->degenerate_lines > 0)
        zr_warning_list_add(arena, w, "%" PRIu64 " of %" PRIu64 " lines have no length and were dropped",
                            counts->degenerate_lines, counts->lines);
    if (counts->unplaced > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " triangles, lines and points have a corner that is nowhere, such as (0, 0, 0, "
                            "0), and were dropped",
                            counts->unplaced);
    if (scene->counts.zero_normals > 0)
        zr_warning_list_add(arena, w, "%" PRIu64 " of %" PRIu64 " normals are zero: they are computed instead",
                            scene->counts.zero_normals, scene->counts.normals);
    if (frame->base && frame->base->clamped_depths > 0)
        zr_warning_list_add(arena, w,
                            "%" PRIu64 " depths of the base are not between the near and the far plane: they are "
                            "taken to be on the nearer of these",
                            frame->base->clamped_depths);
}

static const char *why_nothing_is_seen(const struct zr_scene *scene, const struct zr_frame *frame)
{
    const struct zr_counts *counts = &frame->counts;
    const bool drawn = counts->drawn_whole + counts->drawn_pieces > 0;
    const uint64_t things = counts->triangles + counts->lines - counts->degenerate_lines + counts->points;
    const uint64_t outside = counts->outside + counts->outside_lines + counts->outside_points;
    if (!drawn && counts->culled + counts->culled_pieces > 0)
        return "what is in view faces away (doubleSided draws both sides)";
    if (outside == things && things > 0) return "all geometry is outside the view";
    if (counts->triangles > 0 && are_lines(scene)) return "the corners of each polygon are collinear, on one line";
    if (!drawn && counts->zero_area > 0) return "the polygons in view are edge-on, or smaller than 1/256 pixel";
    if (frame->base) return "no pixel is covered in front of the base";
    return "no pixel is covered (edge-on, smaller than a pixel, or at the far plane)";
}

struct zr_warning_list zr_warnings_make(struct zr_arena *arena, const struct zr_scene *scene,
                                        const struct zr_frame *frame, uint64_t misfits)
{
    struct zr_warning_list w = {.count = 0};
    char text[ZR_VIEW_WARNING_SIZE];
    for (uint32_t i = 0; i < scene->warning_count; i++)
        zr_warning_list_add(arena, &w, "%s", scene->warnings[i]);
    add_counts(arena, scene, frame, &w);
    if (zr_view_warns(&frame->camera, text)) zr_warning_list_add(arena, &w, "%s", text);
    if (misfits > 0)
        zr_warning_list_add(arena, &w, "the depth of %" PRIu64 " pixels does not fit 16 bits at this scale", misfits);
    /* What is blended is drawn in colours only. */
    const bool may_show = !frame->color && zr_any_is_see_through(scene->materials, scene->material_count);
    if (frame->covered_pixels == 0 && frame->covered_samples == 0 && !may_show)
        zr_warning_list_add(arena, &w, "nothing is seen: %s", why_nothing_is_seen(scene, frame));
    return w;
}

/* Room for what is said of those that are left out, of which there are less than 2^32: "; and 4294967295 more". */
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
