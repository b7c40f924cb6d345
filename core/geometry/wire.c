#include "geometry/wire.h"

#include "geometry/face.h"
#include "geometry/outline.h"
#include "geometry/shape.h"

/* A line takes as long as some corners do. */
enum { LINE_WORK = 256 };

/* ---- records ---- */

/* One end of a line: a vertex and a colour of the geometry. */
struct end {
    uint32_t vertex, color;
};

/* The depth of a vertex that is a position's; those that clipping made have theirs. */
static void own_eye(struct zr_builder *builder, uint32_t vertex)
{
    uint32_t position = vertex - builder->first_vertex;
    if (position < builder->mesh->position_count) builder->geometry->eyes[vertex] = zr_builder_eye(builder, position);
}

static void append_line(struct zr_builder *builder, struct end from, struct end to, uint32_t face, bool back)
{
    struct zr_geometry *geometry = builder->geometry;
    if (!zr_builder_reserve(builder, 0, 0, 1)) return;
    own_eye(builder, from.vertex);
    own_eye(builder, to.vertex);
    if (geometry->surfaces) geometry->surfaces[geometry->triangle_count] = (struct zr_written_surface){{0, 0, 0}, NULL};
    geometry->triangles[geometry->triangle_count++] = (struct zr_triangle){.v = {from.vertex, to.vertex, to.vertex},
                                                                           .c = {from.color, to.color, to.color},
                                                                           .face = face,
                                                                           .back = back,
                                                                           .line = true};
}

/* Appends what clipping left as ends of lines, whose colours are their own unless `color` is that of them all. False
 * where one has no place in the window, or the arena has failed. */
static bool append_ends(struct zr_builder *builder, const struct zr_clipped *clipped,
                        const struct zr_builder_corner *corners, const uint32_t *color, struct end *ends)
{
    uint32_t vertex = builder->geometry->vertex_count, own_color = builder->geometry->color_count;
    bool placed[ZR_CLIP_MAX], all_placed = true;
    if (!zr_builder_append_clipped(builder, clipped, corners, placed)) return false;
    for (int i = 0; i < clipped->count; i++) {
        ends[i] = (struct end){vertex + (uint32_t)i, color ? *color : own_color + (uint32_t)i};
        all_placed = all_placed && placed[i];
    }
    return all_placed;
}

/* ---- outlines ---- */

/* What the outline of one face is drawn with. */
struct pen {
    uint32_t face;       /* id */
    unsigned sides;      /* of zr_outline_make */
    bool flat, mirrored; /* flat: one colour, that of ends[0] */
    bool whole, back;    /* whole: all pieces show this side, whatever their own windings are */
};

static void draw_triangle(struct zr_builder *builder, const struct pen *pen, const uint32_t positions[3],
                          const struct end ends[3], unsigned edges)
{
    struct zr_geometry *geometry = builder->geometry;
    struct zr_window_vertex vertices[ZR_CLIP_MAX];
    struct end corners[ZR_CLIP_MAX];
    struct zr_outline_line lines[ZR_CLIP_MAX];
    const struct zr_outcodes codes = zr_builder_outcodes(builder, positions, 3);
    int count = 3;
    for (int k = 0; k < 3; k++)
        corners[k] = ends[k];
    if (codes.all || codes.any & ZR_OUTCODE_UNPLACED) return;
    if (codes.any) {
        geometry->counts.clipped_outlines++;
        struct zr_builder_corner given[3];
        struct zr_clipped clipped;
        zr_vec4 in[3];
        for (int k = 0; k < 3; k++) {
            given[k] = (struct zr_builder_corner){positions[k], ends[k].color, 0};
            in[k] = zr_builder_clip_position(builder, positions[k]);
        }
        count = zr_clip_triangle(in, codes.any, &edges, &clipped);
        if (!append_ends(builder, &clipped, given, pen->flat ? &ends[0].color : NULL, corners)) return;
    }
    for (int i = 0; i < count; i++)
        vertices[i] = geometry->vertices[corners[i].vertex];
    count = zr_outline_make(vertices, count, edges, codes.any != 0, pen->sides, lines);
    for (int i = 0; i < count; i++)
        append_line(builder, corners[lines[i].from], corners[lines[i].to], pen->face,
                    pen->whole ? pen->back : lines[i].back != pen->mirrored);
}

/* The index of the one colour of all outlines of this material; they come one after the other. */
static uint32_t outline_color(struct zr_builder *builder, zr_vec4 color)
{
    struct zr_geometry *geometry = builder->geometry;
    if (builder->outline_color > 0 && zr_vec4_equal(geometry->front_colors[builder->outline_color - 1], color))
        return builder->outline_color - 1;
    if (!zr_builder_reserve(builder, 0, 1, 0)) return 0;
    geometry->back_colors[geometry->color_count] = geometry->front_colors[geometry->color_count] = color;
    builder->outline_color = ++geometry->color_count;
    return builder->outline_color - 1;
}

static struct pen pen_of(struct zr_builder *builder, uint32_t face, const struct zr_material *material)
{
    struct pen pen = {.face = builder->first_face_id + face, .mirrored = builder->mirrored};
    pen.flat = material->outline == ZR_OUTLINE_COLORED || !zr_material_is_smooth(builder->mesh, material);
    pen.sides = material->double_sided ? ZR_SIDE_BOTH : builder->mirrored ? ZR_SIDE_MIRRORED_FRONT : ZR_SIDE_FRONT;
    if (zr_face_is_shape(builder->mesh, face)) {
        pen.whole = true;
        pen.back = zr_shape_shows_back(builder, face);
        pen.sides = pen.back && !material->double_sided ? 0 : ZR_SIDE_BOTH;
    }
    return pen;
}

void zr_wire_outline(struct zr_builder *builder, uint32_t face)
{
    const struct zr_mesh *mesh = builder->mesh;
    const struct zr_material *material = zr_material_of_face(builder->scene, mesh, face);
    if (material->outline == ZR_OUTLINE_NONE) return;
    struct pen pen = pen_of(builder, face, material);
    bool colored = material->outline == ZR_OUTLINE_COLORED, smooth = zr_material_is_smooth(mesh, material);
    uint32_t color = colored ? outline_color(builder, material->outline_color) : 0;
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    for (uint32_t r = 0; r < rings.count && pen.sides != 0; r++) {
        uint32_t begin = rings.offsets[r], count = rings.offsets[r + 1] - begin;
        for (uint32_t i = 2; i < count && zr_arena_ok(builder->arena); i++) {
            const uint32_t fan[3] = {i - 1, i, 0}, whole[3] = {0, 1, 2}, *order = count == 3 ? whole : fan;
            uint32_t positions[3];
            struct end ends[3];
            for (int k = 0; k < 3; k++) {
                uint32_t slot = begin + order[k];
                positions[k] = mesh->indices[slot];
                ends[k] = (struct end){zr_builder_vertex(builder, positions[k]),
                                       colored ? color : zr_builder_color(builder, face, smooth, slot)};
            }
            draw_triangle(builder, &pen, positions, ends, count == 3 ? 7u : zr_outline_fan_edges(i, count));
        }
    }
}

/* ---- lines ---- */

/* Colours of lines: those of the vertices, or one. */
static bool append_line_colors(struct zr_builder *builder, uint32_t *first)
{
    const struct zr_mesh *mesh = builder->mesh;
    struct zr_geometry *geometry = builder->geometry;
    zr_vec4 base = builder->scene->materials[mesh->material].base_color;
    uint32_t count = mesh->colors ? mesh->position_count : 1;
    if (!zr_builder_reserve(builder, 0, count, 0)) return false;
    *first = geometry->color_count;
    for (uint32_t i = 0; i < count; i++) {
        zr_vec4 color = mesh->colors ? zr_vec4_mul(base, mesh->colors[i]) : base;
        geometry->back_colors[geometry->color_count] = geometry->front_colors[geometry->color_count] = color;
        geometry->color_count++;
    }
    return true;
}

static void place_line(struct zr_builder *builder, const uint32_t positions[2], const struct end given[2],
                       uint32_t face)
{
    struct zr_counts *counts = &builder->geometry->counts;
    const struct zr_outcodes codes = zr_builder_outcodes(builder, positions, 2);
    struct end ends[2] = {given[0], given[1]};
    counts->lines++;
    if (codes.all || codes.any & ZR_OUTCODE_UNPLACED) {
        counts->outside_lines++;
        return;
    }
    if (codes.any) {
        const unsigned own[2] = {builder->outcodes[positions[0]], builder->outcodes[positions[1]]};
        const zr_vec4 in[2] = {zr_builder_clip_position(builder, positions[0]),
                               zr_builder_clip_position(builder, positions[1])};
        const struct zr_builder_corner corners[2] = {{positions[0], given[0].color, 0},
                                                     {positions[1], given[1].color, 0}};
        struct zr_clipped clipped;
        bool flat = given[0].color == given[1].color;
        if (!zr_clip_line(in, own, &clipped) ||
            !append_ends(builder, &clipped, corners, flat ? &given[0].color : NULL, ends)) {
            counts->outside_lines++;
            return;
        }
        counts->clipped_lines++;
    }
    append_line(builder, ends[0], ends[1], face, false);
}

enum zr_status zr_wire_lines(struct zr_builder *builder)
{
    const struct zr_mesh *mesh = builder->mesh;
    uint32_t first_color = 0;
    if (mesh->line_count == 0) return ZR_OK;
    if (!append_line_colors(builder, &first_color)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < mesh->line_count; i++) {
        if (!zr_builder_go_on(builder, LINE_WORK)) return ZR_CANCELLED;
        const uint32_t *positions = mesh->lines + 2 * (size_t)i;
        struct end ends[2];
        for (int k = 0; k < 2; k++)
            ends[k] =
                (struct end){zr_builder_vertex(builder, positions[k]), first_color + (mesh->colors ? positions[k] : 0)};
        place_line(builder, positions, ends, builder->first_face_id + mesh->face_count + i);
        if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}
