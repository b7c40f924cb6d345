#include "geometry/place.h"

static double length_squared(double x, double y)
{
    return x * x + y * y;
}

bool zr_place_is_thin(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                      const struct zr_window_vertex *v2)
{
    const double width = 1.0 / 64.0, grid = (double)ZR_SUBPIXELS;
    double x1 = (double)v1->x - (double)v0->x, y1 = (double)v1->y - (double)v0->y;
    double x2 = (double)v2->x - (double)v0->x, y2 = (double)v2->y - (double)v0->y;
    double snapped_x1 = zr_snapped_x(v1) - zr_snapped_x(v0), snapped_y1 = zr_snapped_y(v1) - zr_snapped_y(v0);
    double snapped_x2 = zr_snapped_x(v2) - zr_snapped_x(v0), snapped_y2 = zr_snapped_y(v2) - zr_snapped_y(v0);
    double area = fabs(x1 * y2 - x2 * y1);
    double snapped_area = fabs(snapped_x1 * snapped_y2 - snapped_x2 * snapped_y1) / (grid * grid);
    double longest = fmax(length_squared(x1, y1), fmax(length_squared(x2, y2), length_squared(x2 - x1, y2 - y1)));
    return fmin(area, snapped_area) < width * sqrt(longest);
}

bool zr_corners_make(struct zr_builder *builder, uint32_t face, bool smooth, const uint32_t slots[3],
                     const struct zr_part *part, struct zr_corners *out)
{
    for (int k = 0; k < 3; k++) {
        out->vertex[k] = builder->mesh->indices[slots[k]];
        out->color[k] = zr_builder_color(builder, face, smooth, slots[k]);
        out->normal[k] = 0;
    }
    return !zr_builder_wants_normals(builder, part->material) ||
           zr_builder_add_normals(builder, face, slots, out->normal);
}

/* Drops what has no area or shows its back and must not; of the rest, orients it
 * as the reference does: rule 6, on snapped coordinates. True where it was kept. */
static bool append_triangle(struct zr_builder *builder, struct zr_triangle triangle, const uint32_t normals[3],
                            const struct zr_part *part)
{
    struct zr_written_surface surface = {{normals[0], normals[1], normals[2]}, part->material};
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_window_vertex *v0 = &geometry->vertices[triangle.v[0]], *v1 = &geometry->vertices[triangle.v[1]],
                                  *v2 = &geometry->vertices[triangle.v[2]];
    int64_t area = zr_window_area(v0, v1, v2);
    if (area == 0 || (part->skip_thin && zr_place_is_thin(v0, v1, v2))) {
        geometry->counts.zero_area++;
        return false;
    }
    bool counter_clockwise = area < 0; /* with y up */
    bool back = part->shape != 0 ? part->back
                                 : ZR_MUTANT(culls_fronts, counter_clockwise, !counter_clockwise) == builder->mirrored;
    if (back && !part->double_sided) {
        geometry->counts.culled++;
        return false;
    }
    if (counter_clockwise) {
        const int k = zr_swapped_corner();
        uint32_t v = triangle.v[0], c = triangle.c[0];
        triangle.v[0] = triangle.v[k];
        triangle.c[0] = triangle.c[k];
        triangle.v[k] = v;
        triangle.c[k] = c;
        surface.n[0] = normals[k];
        surface.n[k] = normals[0];
    }
    triangle.turned = counter_clockwise;
    triangle.face = part->face;
    triangle.back = back;
    triangle.pushed = part->pushed;
    triangle.shape = part->shape & ZR_SHAPE_MASK;
    if (!zr_builder_reserve(builder, 0, 0, 1)) return false;
    if (geometry->surfaces) geometry->surfaces[geometry->triangle_count] = surface;
    geometry->triangles[geometry->triangle_count++] = triangle;
    return true;
}

static void clip_and_append(struct zr_builder *builder, const struct zr_corners *corners, unsigned outcodes,
                            const struct zr_part *part)
{
    struct zr_geometry *geometry = builder->geometry;
    struct zr_builder_corner ends[3];
    struct zr_clipped clipped;
    zr_vec4 in[3];
    for (int k = 0; k < 3; k++) {
        ends[k] = (struct zr_builder_corner){corners->vertex[k], corners->color[k], corners->normal[k]};
        in[k] = zr_builder_clip_position(builder, corners->vertex[k]);
    }
    geometry->counts.clipped++;
    int count = zr_clip_triangle(in, outcodes, NULL, &clipped);
    if (count == 0 || !zr_builder_reserve_cut(builder)) return;

    bool flat = corners->color[0] == corners->color[1] && corners->color[1] == corners->color[2];
    const bool even = corners->normal[0] == corners->normal[1] && corners->normal[1] == corners->normal[2];
    uint32_t vertex = geometry->vertex_count, color = flat ? corners->color[0] : geometry->color_count;
    uint32_t normal = even ? corners->normal[0] : geometry->normal_count;
    bool placed[ZR_CLIP_MAX];
    if (!zr_builder_append_clipped(builder, &clipped, ends, placed)) return;
    geometry->sources.cuts[geometry->sources.cut_count++] =
        (struct zr_source_cut){vertex, {corners->vertex[0], corners->vertex[1], corners->vertex[2]}};
    const struct zr_counts before = geometry->counts;
    for (int i = 2; i < count; i++) {
        if (!placed[i - 1] || !placed[i] || !placed[0]) continue;
        uint32_t a = (uint32_t)i - 1, b = (uint32_t)i;
        struct zr_triangle piece = {.v = {vertex + a, vertex + b, vertex}, .c = {color, color, color}};
        if (!flat) {
            piece.c[0] = color + a;
            piece.c[1] = color + b;
        }
        const uint32_t normals[3] = {even ? normal : normal + a, even ? normal : normal + b, normal};
        if (append_triangle(builder, piece, normals, part)) geometry->counts.drawn_pieces++;
    }
    /* The triangle is counted once, as clipped: what became of its pieces is counted apart. */
    geometry->counts.culled_pieces += geometry->counts.culled - before.culled;
    geometry->counts.culled = before.culled;
    geometry->counts.zero_area = before.zero_area;
}

void zr_place_triangle(struct zr_builder *builder, const struct zr_corners *corners, const struct zr_part *part)
{
    struct zr_counts *counts = &builder->geometry->counts;
    struct zr_outcodes codes = zr_builder_outcodes(builder, corners->vertex, 3);
    counts->triangles++;
    if (codes.all) {
        counts->outside++;
    } else if (codes.any & ZR_OUTCODE_UNPLACED) {
        counts->zero_area++;
    } else if (codes.any) {
        clip_and_append(builder, corners, codes.any, part);
    } else {
        struct zr_triangle triangle = {.c = {corners->color[0], corners->color[1], corners->color[2]}};
        for (int k = 0; k < 3; k++)
            triangle.v[k] = builder->first_vertex + corners->vertex[k];
        if (append_triangle(builder, triangle, corners->normal, part)) counts->drawn_whole++;
    }
}
