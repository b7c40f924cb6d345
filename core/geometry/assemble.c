#include "geometry/assemble.h"

#include "geometry/normals.h"
#include "geometry/place.h"
#include "geometry/shape.h"
#include "geometry/wire.h"

/* Looks at the flag of cancellation are so many corners squared apart, which is what cutting faces may take:
 * some milliseconds. */
enum { WORK_A_CANCEL_CHECK = 1 << 20 };

static bool same_place(const struct zr_mesh *mesh, uint32_t a, uint32_t b)
{
    const zr_vec4 *p = &mesh->positions[a], *q = &mesh->positions[b];
    return a == b || (p->x == q->x && p->y == q->y && p->z == q->z && p->w == q->w);
}

/* Fewer than three distinct corners. What merely has no area is left to the
 * subpixel grid, where the reference decides it too. */
static bool is_degenerate(const struct zr_mesh *mesh, uint32_t face)
{
    const uint32_t *indices = mesh->indices + mesh->face_offsets[face];
    uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    uint32_t second = 1;
    while (second < count && same_place(mesh, indices[0], indices[second]))
        second++;
    for (uint32_t i = second + 1; i < count; i++)
        if (!same_place(mesh, indices[0], indices[i]) && !same_place(mesh, indices[second], indices[i])) return false;
    return true;
}

/* A triangle keeps the order of its corners; a larger polygon becomes the fan
 * (i-1, i, 0), as GL_POLYGON does in the reference (rule 10). */
static void place_fan(struct zr_builder *builder, uint32_t face, bool smooth, const struct zr_part *part)
{
    const struct zr_mesh *mesh = builder->mesh;
    uint32_t begin = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - begin;
    for (uint32_t i = 2; i < count; i++) {
        const uint32_t fan[3] = {i - 1, i, 0}, whole[3] = {0, 1, 2}, *order = count == 3 ? whole : fan;
        struct zr_corners corners;
        for (int k = 0; k < 3; k++) {
            corners.vertex[k] = mesh->indices[begin + order[k]];
            corners.color[k] = zr_builder_color(builder, face, smooth, begin + order[k]);
        }
        zr_place_triangle(builder, &corners, part);
    }
}

static bool is_concave(const struct zr_mesh *mesh, uint32_t face)
{
    if (mesh->faces_are_fans) return false;
    uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    return zr_mesh_rings(mesh, face).count > 1 || (count > 3 && zr_face_is_concave(mesh, face));
}

static void place_face(struct zr_builder *builder, uint32_t face)
{
    const struct zr_mesh *mesh = builder->mesh;
    const struct zr_material *material = zr_material_of_face(builder->scene, mesh, face);
    struct zr_counts *counts = &builder->geometry->counts;
    counts->polygons++;
    if (is_degenerate(mesh, face)) {
        counts->degenerate_polygons++;
        return;
    }
    bool concave = is_concave(mesh, face), smooth = zr_material_is_smooth(mesh, material);
    counts->concave_polygons += concave;
    if (material->hollow) return;
    struct zr_part part = {.face = builder->first_face_id + face,
                           .double_sided = material->double_sided,
                           .pushed = material->outline != ZR_OUTLINE_NONE};
    if (concave)
        zr_shape_place(builder, face, smooth, &part);
    else
        place_fan(builder, face, smooth, &part);
}

static void outline_face(struct zr_builder *builder, uint32_t face)
{
    if (!is_degenerate(builder->mesh, face)) zr_wire_outline(builder, face, is_concave(builder->mesh, face));
}

static bool has_outlines(const struct zr_builder *builder)
{
    const struct zr_scene *scene = builder->scene;
    const struct zr_mesh *mesh = builder->mesh;
    if (!mesh->face_materials) return scene->materials[mesh->material].outline != ZR_OUTLINE_NONE;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        if (scene->materials[mesh->face_materials[face]].outline != ZR_OUTLINE_NONE) return true;
    return false;
}

static enum zr_status for_each_face(struct zr_builder *builder, void (*work)(struct zr_builder *builder, uint32_t face))
{
    const uint32_t *offsets = builder->mesh->face_offsets;
    uint64_t done = 0;
    for (uint32_t face = 0; face < builder->mesh->face_count; face++) {
        uint64_t corners = offsets[face + 1] - offsets[face];
        done += corners * corners;
        if (done >= WORK_A_CANCEL_CHECK) {
            if (zr_is_cancelled(builder->cancel)) return ZR_CANCELLED;
            done = 0;
        }
        work(builder, face);
        if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    }
    return zr_is_cancelled(builder->cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_assemble_mesh(struct zr_builder *builder)
{
    enum zr_status status = for_each_face(builder, place_face);
    if (status == ZR_OK && has_outlines(builder)) status = for_each_face(builder, outline_face);
    return status == ZR_OK ? zr_wire_lines(builder) : status;
}
