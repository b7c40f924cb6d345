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

/* Appends the triangle unless it has no area or is culled. Returns true if it was appended. */
static bool append_triangle(struct zr_builder *builder, const struct zr_corner ends[3], const struct zr_common *common)
{
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_window_vertex *vertices = geometry->vertices + builder->first_vertex;
    const struct zr_window_vertex *v0 = &vertices[ends[0].vertex], *v1 = &vertices[ends[1].vertex],
                                  *v2 = &vertices[ends[2].vertex];
    const int64_t area = zr_window_area(v0, v1, v2);
    if (area == 0 || (common->skip_thin && zr_place_is_thin(v0, v1, v2))) {
        geometry->counts.zero_area++;
        return false;
    }
    const bool counter_clockwise = area < 0; /* with y up */
    const bool back = common->kind == ZR_DRAW_SHAPES
                          ? common->back
                          : ZR_MUTANT(culls_fronts, counter_clockwise, !counter_clockwise) == builder->mirrored;
    if (back && !common->material->double_sided) {
        geometry->counts.culled++;
        return false;
    }
    zr_builder_place(builder, common, ends);
    return zr_arena_ok(builder->run->arena);
}

static void clip_and_append(struct zr_builder *builder, const struct zr_corner corners[3], unsigned outcodes,
                            const struct zr_common *common)
{
    struct zr_geometry *geometry = builder->geometry;
    struct zr_clipped clipped;
    struct zr_corner ends[ZR_CLIP_MAX];
    bool placed[ZR_CLIP_MAX];
    zr_vec4 in[3];
    for (int k = 0; k < 3; k++)
        in[k] = zr_builder_clip_position(builder, corners[k].vertex);
    geometry->counts.clipped++;
    const int count = zr_clip_triangle(in, outcodes, NULL, &clipped);
    if (count == 0 || !zr_builder_append_cut(builder, &clipped, corners, ends, placed)) return;
    const struct zr_counts before = geometry->counts;
    for (int i = 2; i < count; i++) {
        const struct zr_corner piece[3] = {ends[i - 1], ends[i], ends[0]};
        if (!placed[i - 1] || !placed[i] || !placed[0]) {
            geometry->counts.unplaced++;
            continue;
        }
        if (append_triangle(builder, piece, common)) geometry->counts.drawn_pieces++;
    }
    /* Count the triangle once, as clipped; its pieces have counters of their own. */
    geometry->counts.culled_pieces += geometry->counts.culled - before.culled;
    geometry->counts.culled = before.culled;
    geometry->counts.zero_area = before.zero_area;
}

static void count_unplaced(struct zr_counts *counts)
{
    counts->zero_area++;
    counts->unplaced++;
}

void zr_place_triangle(struct zr_builder *builder, const uint32_t slots[3], const struct zr_common *common)
{
    struct zr_counts *counts = &builder->geometry->counts;
    struct zr_corner corners[3];
    for (int k = 0; k < 3; k++)
        corners[k] = (struct zr_corner){builder->mesh->indices[slots[k]], slots[k]};
    const struct zr_outcodes codes = zr_builder_outcodes(builder, corners, 3);
    counts->triangles++;
    if (codes.all)
        counts->outside++;
    else if (codes.any & ZR_OUTCODE_UNPLACED)
        count_unplaced(counts);
    else if (codes.any)
        clip_and_append(builder, corners, codes.any, common);
    else
        counts->drawn_whole += append_triangle(builder, corners, common);
}
