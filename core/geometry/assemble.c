#include "geometry/assemble.h"

#include "geometry/clip.h"
#include "geometry/normals.h"

enum { FACES_A_CANCEL_CHECK = 1024 };

/* One triangle on its way: corners as positions of the mesh and as colours. */
struct corners {
    uint32_t vertex[3], color[3];
};

/* ---- appending ---- */

/* Drops what has no area or shows its back and must not; of the rest, orients it
 * as the reference does: rule 6, on snapped coordinates. True where it was kept. */
static bool append_triangle(struct zr_builder *builder, struct zr_triangle triangle, bool double_sided)
{
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_window_vertex *v0 = &geometry->vertices[triangle.v[0]], *v1 = &geometry->vertices[triangle.v[1]],
                                  *v2 = &geometry->vertices[triangle.v[2]];
    int64_t dx01 = v0->sx - v1->sx, dy01 = v0->sy - v1->sy, dx20 = v2->sx - v0->sx, dy20 = v2->sy - v0->sy;
    int64_t area = dx01 * dy20 - dx20 * dy01;
    if (area == 0) {
        geometry->counts.zero_area++;
        return false;
    }
    bool counter_clockwise = area < 0; /* with y up */
    bool front = counter_clockwise != builder->mirrored;
    if (!front && !double_sided) {
        geometry->counts.culled++;
        return false;
    }
    if (counter_clockwise) {
        uint32_t v = triangle.v[0], c = triangle.c[0];
        triangle.v[0] = triangle.v[1];
        triangle.c[0] = triangle.c[1];
        triangle.v[1] = v;
        triangle.c[1] = c;
    }
    triangle.back = front ? 0 : 1;
    if (!zr_builder_reserve(builder, 0, 0, 1)) return false;
    geometry->triangles[geometry->triangle_count++] = triangle;
    return true;
}

/* ---- clipping ---- */

static void clip_and_append(struct zr_builder *builder, const struct corners *corners, unsigned outcodes, uint32_t face,
                            bool double_sided)
{
    struct zr_geometry *geometry = builder->geometry;
    struct zr_clip_vertex in[3], out[ZR_CLIP_MAX];
    for (int k = 0; k < 3; k++) {
        const struct zr_window_vertex *vertex = &geometry->vertices[builder->first_vertex + corners->vertex[k]];
        in[k] = (struct zr_clip_vertex){.position = builder->clip_positions[corners->vertex[k]],
                                        .front = geometry->front_colors[corners->color[k]],
                                        .back = geometry->back_colors[corners->color[k]],
                                        .eye_z = vertex->eye_z,
                                        .eye_w = vertex->eye_w};
    }
    geometry->counts.clipped++;
    int count = zr_clip_triangle(in, outcodes, out);
    if (count == 0 || !zr_builder_reserve(builder, ZR_CLIP_MAX, ZR_CLIP_MAX, ZR_CLIP_MAX)) return;

    bool flat = corners->color[0] == corners->color[1] && corners->color[1] == corners->color[2];
    uint32_t vertex = geometry->vertex_count, color = flat ? corners->color[0] : geometry->color_count;
    bool placed[ZR_CLIP_MAX];
    for (int i = 0; i < count; i++) {
        struct zr_window_vertex *new_vertex = &geometry->vertices[geometry->vertex_count++];
        placed[i] = zr_viewport_apply(&builder->viewport, out[i].position, new_vertex);
        new_vertex->eye_z = out[i].eye_z;
        new_vertex->eye_w = out[i].eye_w;
        if (flat) continue;
        geometry->back_colors[geometry->color_count] = out[i].back;
        geometry->front_colors[geometry->color_count++] = out[i].front;
    }
    const struct zr_counts before = geometry->counts;
    for (int i = 2; i < count; i++) {
        if (!placed[i - 1] || !placed[i] || !placed[0]) continue;
        uint32_t a = (uint32_t)i - 1, b = (uint32_t)i;
        struct zr_triangle piece = {.v = {vertex + a, vertex + b, vertex}, .c = {color, color, color}, .face = face};
        if (!flat) {
            piece.c[0] = color + a;
            piece.c[1] = color + b;
        }
        if (append_triangle(builder, piece, double_sided)) geometry->counts.drawn_pieces++;
    }
    /* The triangle is counted once, as clipped: what became of its pieces is counted apart. */
    geometry->counts.culled_pieces += geometry->counts.culled - before.culled;
    geometry->counts.culled = before.culled;
    geometry->counts.zero_area = before.zero_area;
}

static void place_triangle(struct zr_builder *builder, const struct corners *corners, uint32_t face, bool double_sided)
{
    struct zr_counts *counts = &builder->geometry->counts;
    const uint8_t *code = builder->outcodes;
    unsigned c0 = code[corners->vertex[0]], c1 = code[corners->vertex[1]], c2 = code[corners->vertex[2]];
    unsigned any = c0 | c1 | c2;
    counts->triangles++;
    if (c0 & c1 & c2 & ~(unsigned)ZR_OUTCODE_UNPLACED) {
        counts->outside++;
    } else if (any & ZR_OUTCODE_UNPLACED) {
        counts->zero_area++;
    } else if (any) {
        clip_and_append(builder, corners, any, face, double_sided);
    } else {
        struct zr_triangle triangle = {.c = {corners->color[0], corners->color[1], corners->color[2]}, .face = face};
        for (int k = 0; k < 3; k++)
            triangle.v[k] = builder->first_vertex + corners->vertex[k];
        if (append_triangle(builder, triangle, double_sided)) counts->drawn_whole++;
    }
}

/* ---- faces ---- */

static bool same_place(const struct zr_mesh *mesh, uint32_t a, uint32_t b)
{
    const zr_vec4 *p = &mesh->positions[a], *q = &mesh->positions[b];
    return a == b || (p->x == q->x && p->y == q->y && p->z == q->z && p->w == q->w);
}

/* Fewer than three distinct corners. What merely has no area is left to the
 * subpixel grid, where the reference decides it too. */
static bool is_degenerate(const struct zr_mesh *mesh, const uint32_t *indices, uint32_t count)
{
    uint32_t second = 1;
    while (second < count && same_place(mesh, indices[0], indices[second]))
        second++;
    for (uint32_t i = second + 1; i < count; i++)
        if (!same_place(mesh, indices[0], indices[i]) && !same_place(mesh, indices[second], indices[i])) return false;
    return true;
}

static uint32_t color_index(const struct zr_builder *builder, enum zr_color_layout layout, bool smooth, uint32_t face,
                            uint32_t face_begin, uint32_t slot, uint32_t vertex)
{
    if (layout == ZR_COLOR_PER_FACE) return builder->first_color + face;
    if (layout == ZR_COLOR_PER_VERTEX) return builder->first_color + vertex;
    return builder->first_color + (smooth ? slot : face_begin);
}

/* A triangle keeps the order of its corners; a larger polygon becomes the fan
 * (i-1, i, 0), as GL_POLYGON does in the reference (rule 10). */
static void cut_face(struct zr_builder *builder, const struct zr_scene *scene, const struct zr_mesh *mesh,
                     enum zr_color_layout layout, uint32_t face, uint32_t face_id)
{
    struct zr_counts *counts = &builder->geometry->counts;
    uint32_t begin = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - begin;
    const uint32_t *indices = mesh->indices + begin;
    counts->polygons++;
    if (is_degenerate(mesh, indices, count)) {
        counts->degenerate_polygons++;
        return;
    }
    if (count > 3 && !mesh->faces_are_fans && zr_face_is_concave(mesh, face, zr_normal_of_face(mesh, face)))
        counts->concave_polygons++;

    const struct zr_material *material = zr_material_of_face(scene, mesh, face);
    bool smooth = zr_material_is_smooth(mesh, material);
    for (uint32_t i = 2; i < count; i++) {
        const uint32_t fan[3] = {i - 1, i, 0}, whole[3] = {0, 1, 2}, *order = count == 3 ? whole : fan;
        struct corners corners;
        for (int k = 0; k < 3; k++) {
            corners.vertex[k] = indices[order[k]];
            corners.color[k] = color_index(builder, layout, smooth, face, begin, begin + order[k], corners.vertex[k]);
        }
        place_triangle(builder, &corners, face_id, material->double_sided);
    }
}

enum zr_status zr_assemble_mesh(struct zr_builder *builder, const struct zr_scene *scene, const struct zr_mesh *mesh,
                                enum zr_color_layout layout, uint32_t first_face_id)
{
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (face % FACES_A_CANCEL_CHECK == 0 && zr_is_cancelled(builder->cancel)) return ZR_CANCELLED;
        cut_face(builder, scene, mesh, layout, face, first_face_id + face);
        if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}
