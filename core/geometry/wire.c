#include "geometry/wire.h"

#include <string.h>

#include "base/mutant.h"
#include "geometry/face.h"
#include "geometry/outline.h"
#include "geometry/shape.h"

/* Work per line or point, in corners. */
enum { LINE_WORK = 256, POINT_WORK = 64 };

/* Sets the eye depth of a vertex that is a position; vertices created by clipping already have theirs. */
static void own_eye(struct zr_builder *builder, uint32_t vertex)
{
    if (vertex < builder->mesh->position_count)
        builder->geometry->eyes[builder->first_vertex + vertex] = zr_builder_eye(builder, vertex);
}

static void append_line(struct zr_builder *builder, const struct zr_common *common, struct zr_corner from,
                        struct zr_corner to)
{
    const struct zr_corner ends[3] = {from, to, to};
    if (!zr_builder_reserve_eyes(builder)) return;
    own_eye(builder, from.vertex);
    own_eye(builder, to.vertex);
    zr_builder_place(builder, common, ends);
}

static bool are_placed(const bool *placed, int count)
{
    for (int i = 0; i < count; i++)
        if (!placed[i]) return false;
    return true;
}

/* ---- outlines ---- */

/* Settings for the outline of one face. */
struct pen {
    struct zr_common common;
    unsigned sides; /* sides that zr_outline_make draws */
    bool whole;     /* all pieces show the side of the shape, regardless of their own windings */
};

static void draw_triangle(struct zr_builder *builder, const struct pen *pen, const struct zr_corner ends[3],
                          unsigned edges)
{
    struct zr_geometry *geometry = builder->geometry;
    struct zr_window_vertex vertices[ZR_CLIP_MAX];
    struct zr_corner corners[ZR_CLIP_MAX];
    struct zr_outline_line lines[ZR_CLIP_MAX];
    const struct zr_outcodes codes = zr_builder_outcodes(builder, ends, 3);
    int count = 3;
    memcpy(corners, ends, 3 * sizeof *ends);
    if (codes.all || codes.any & ZR_OUTCODE_UNPLACED) return;
    if (codes.any) {
        struct zr_clipped clipped;
        zr_vec4 in[3];
        bool placed[ZR_CLIP_MAX];
        geometry->counts.clipped_outlines++;
        for (int k = 0; k < 3; k++)
            in[k] = zr_builder_clip_position(builder, ends[k].vertex);
        count = zr_clip_triangle(in, codes.any, &edges, &clipped);
        if (count == 0 || !zr_builder_append_cut(builder, &clipped, ends, corners, placed) ||
            !are_placed(placed, count))
            return;
    }
    for (int i = 0; i < count; i++)
        vertices[i] = geometry->vertices[builder->first_vertex + corners[i].vertex];
    count = zr_outline_make(vertices, count, edges, codes.any != 0, pen->sides, lines);
    for (int i = 0; i < count; i++) {
        struct zr_common common = pen->common;
        if (!pen->whole) common.back = lines[i].back != builder->mirrored;
        append_line(builder, &common, corners[lines[i].from], corners[lines[i].to]);
    }
}

static struct pen pen_of(const struct zr_builder *builder, uint32_t face, const struct zr_material *material)
{
    struct pen pen = {.common = {.face = face, .material = material, .kind = ZR_DRAW_OUTLINES}};
    pen.sides = material->double_sided ? ZR_SIDE_BOTH : builder->mirrored ? ZR_SIDE_MIRRORED_FRONT : ZR_SIDE_FRONT;
    if (zr_face_is_shape(builder->mesh, face)) {
        pen.whole = true;
        pen.common.back = zr_shape_shows_back(builder, face);
        pen.sides = pen.common.back && !material->double_sided ? 0 : ZR_SIDE_BOTH;
    }
    return pen;
}

void zr_wire_outline(struct zr_builder *builder, uint32_t face)
{
    const struct zr_mesh *mesh = builder->mesh;
    const struct zr_material *material = zr_material_of_face(builder->scene, mesh, face);
    if (material->outline == ZR_OUTLINE_NONE) return;
    const struct pen pen = pen_of(builder, face, material);
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    for (uint32_t r = 0; r < rings.count && pen.sides != 0; r++) {
        uint32_t begin = rings.offsets[r], count = rings.offsets[r + 1] - begin;
        for (uint32_t i = 2; i < count && zr_arena_ok(builder->run->arena); i++) {
            const uint32_t fan[3] = {i - 1, i, 0}, whole[3] = {0, 1, 2}, *order = count == 3 ? whole : fan;
            struct zr_corner ends[3];
            for (int k = 0; k < 3; k++)
                ends[k] = (struct zr_corner){mesh->indices[begin + order[k]], begin + order[k]};
            draw_triangle(builder, &pen, ends, count == 3 ? 7u : zr_outline_fan_edges(i, count));
        }
    }
}

/* ---- lines ---- */

static bool has_no_length(const struct zr_mesh *mesh, const struct zr_corner ends[2])
{
    return zr_vec4_equal(mesh->positions[ends[0].vertex], mesh->positions[ends[1].vertex]);
}

static void place_line(struct zr_builder *builder, const struct zr_common *common, const struct zr_corner given[2])
{
    struct zr_counts *counts = &builder->geometry->counts;
    const struct zr_outcodes codes = zr_builder_outcodes(builder, given, 2);
    struct zr_corner ends[ZR_CLIP_MAX] = {given[0], given[1]};
    counts->lines++;
    if (has_no_length(builder->mesh, given)) {
        counts->degenerate_lines++;
        return;
    }
    if (codes.all || codes.any & ZR_OUTCODE_UNPLACED) {
        counts->outside_lines++;
        counts->unplaced += !codes.all;
        return;
    }
    if (codes.any) {
        const unsigned own[2] = {builder->outcodes[given[0].vertex], builder->outcodes[given[1].vertex]};
        const zr_vec4 in[2] = {zr_builder_clip_position(builder, given[0].vertex),
                               zr_builder_clip_position(builder, given[1].vertex)};
        struct zr_clipped clipped;
        bool placed[ZR_CLIP_MAX];
        if (!zr_clip_line(in, own, &clipped) || !zr_builder_append_cut(builder, &clipped, given, ends, placed) ||
            !are_placed(placed, 2)) {
            counts->outside_lines++;
            return;
        }
        counts->clipped_lines++;
    }
    append_line(builder, common, ends[0], ends[1]);
}

enum zr_status zr_wire_lines(struct zr_builder *builder)
{
    const struct zr_mesh *mesh = builder->mesh;
    struct zr_common common = {.material = &builder->scene->materials[mesh->material], .kind = ZR_DRAW_LINES};
    if (common.material->is_hidden) return ZR_OK;
    for (uint32_t i = 0; i < mesh->line_count; i++) {
        const uint32_t *positions = mesh->lines + 2 * (size_t)i;
        const struct zr_corner ends[2] = {{positions[0], 0}, {positions[1], 0}};
        if (!zr_builder_go_on(builder, LINE_WORK)) return ZR_CANCELLED;
        common.face = mesh->face_count + i;
        place_line(builder, &common, ends);
        if (!zr_arena_ok(builder->run->arena)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}

/* ---- points ---- */

static void place_point(struct zr_builder *builder, const struct zr_common *common, uint32_t position)
{
    struct zr_counts *counts = &builder->geometry->counts;
    const struct zr_corner middle = {position, 0};
    const unsigned code = zr_outcode_of_point(builder->outcodes[position]);
    counts->points++;
    counts->outside_points += code != 0;
    counts->unplaced += code == ZR_OUTCODE_UNPLACED;
    if (code == 0) append_line(builder, common, middle, middle);
}

static enum zr_status add_cloud(struct zr_builder *builder, const struct zr_material *material)
{
    const struct zr_mesh *mesh = builder->mesh;
    const struct zr_draw cloud = {.kind = ZR_DRAW_POINTS,
                                  .count = mesh->point_count,
                                  .material = material,
                                  .first_face = mesh->face_count + mesh->line_count};
    return zr_builder_add_draw(builder, cloud) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_wire_points(struct zr_builder *builder)
{
    const struct zr_mesh *mesh = builder->mesh;
    struct zr_common common = {.material = &builder->scene->materials[mesh->material], .kind = ZR_DRAW_POINTS};
    if (common.material->is_hidden) return ZR_OK;
    if (!builder->singly) return add_cloud(builder, common.material);
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        if (!zr_builder_go_on(builder, POINT_WORK)) return ZR_CANCELLED;
        common.face = mesh->face_count + mesh->line_count + i;
        place_point(builder, &common, zr_mesh_point(mesh, i));
        if (!zr_arena_ok(builder->run->arena)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}
