#include "output/warnings.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "geometry/face.h"

/* A share of the geometry's size that is seen. */
static const float MARGIN_SEEN = 0.01f;

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

struct zr_warning_list zr_warnings_make(struct zr_arena *arena, const struct zr_scene *scene,
                                        const struct zr_frame *frame, uint64_t misfits)
{
    const struct zr_counts *counts = &frame->counts;
    struct zr_warning_list w = {.count = 0};
    for (uint32_t i = 0; i < scene->warning_count; i++)
        zr_warning_list_add(arena, &w, "%s", scene->warnings[i]);
    if (counts->degenerate_polygons > 0)
        zr_warning_list_add(
            arena, &w, "%" PRIu64 " of %" PRIu64 " polygons have fewer than three distinct corners and were dropped",
            counts->degenerate_polygons, counts->polygons);
    if (frame->camera.fit_margin > MARGIN_SEEN)
        zr_warning_list_add(
            arena, &w,
            "the geometry is small and far from the origin: rounding may move it by %.2g of its size, and the fitted "
            "view "
            "leaves room for that",
            (double)frame->camera.fit_margin);
    if (misfits > 0)
        zr_warning_list_add(arena, &w, "the depth of %" PRIu64 " pixels does not fit 16 bits at this scale", misfits);
    if (frame->covered_pixels > 0 || frame->covered_samples > 0) return w;
    /* What is blended is drawn in colours only. */
    if (!frame->color && zr_any_is_see_through(scene->materials, scene->material_count)) return w;
    const uint64_t things = counts->triangles + counts->lines + counts->points;
    bool drawn = counts->drawn_whole + counts->drawn_pieces > 0;
    if (!drawn && counts->culled + counts->culled_pieces > 0)
        zr_warning_list_add(arena, &w, "nothing is seen: what is in view faces away (doubleSided draws both sides)");
    else if (counts->outside + counts->outside_lines + counts->outside_points == things && things > 0)
        zr_warning_list_add(arena, &w, "nothing is seen: all geometry is outside the view");
    else if (counts->triangles > 0 && are_lines(scene))
        zr_warning_list_add(arena, &w, "nothing is seen: the corners of each polygon are collinear, on one line");
    else if (!drawn && counts->zero_area > 0)
        zr_warning_list_add(arena, &w,
                            "nothing is seen: the polygons in view are edge-on, or smaller than 1/256 pixel");
    else if (frame->base)
        zr_warning_list_add(arena, &w, "nothing is seen: no pixel is covered in front of the base");
    else
        zr_warning_list_add(
            arena, &w, "nothing is seen: no pixel is covered (edge-on, smaller than a pixel, or at the far plane)");
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
