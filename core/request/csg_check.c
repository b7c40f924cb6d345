#include "request/csg_check.h"

#include <string.h>

#include "base/cancel.h"
#include "base/run.h"
#include "input/text/text.h"
#include "mesh/facts/closed_parts.h"
#include "scene/camera/camera.h"
#include "scene/parts/part_list.h"
#include "scene/picture.h"

/* Share of the diagonal of the bounds, as in zr_weld_make: float positions and matrices are no more exact. */
#define TOLERANCE 1e-6

/* Width of lines from samples in a window of 600 pixels, where those of the mesh have none of their own. */
#define LINE_WIDTH 1.5f

enum { FACES_PER_CANCEL_CHECK = 1 << 14 };

/* Returns what is wrong with a material of an operand, or NULL. */
static const char *fault_of(const struct zr_material *material)
{
    if (material->is_hidden) return NULL;
    if (material->unfilled) return "is not filled";
    if (material->outline != ZR_OUTLINE_NONE) return "has outlines, which the solid would not cut";
    if (zr_material_is_layered(material))
        return "is translucent: operands must be opaque, so looks like xray have no solids";
    return NULL;
}

static const char *fault_of_part(const struct zr_scene_builder *builder, const struct zr_mesh *mesh, uint32_t part)
{
    uint32_t last = UINT32_MAX;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t number = mesh->face_materials ? mesh->face_materials[face] : mesh->material;
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(builder->arena->cancel)) return NULL;
        if (number == last || (mesh->face_parts && mesh->face_parts[face] != part)) continue;
        const char *fault = fault_of(&builder->materials[number]);
        if (fault) return fault;
        last = number;
    }
    return NULL;
}

/* Finds the closed parts of a mesh once. */
static const uint8_t *closed_of(const struct zr_run *run, const struct zr_scene *scene, uint32_t mesh,
                                const uint8_t **known)
{
    if (known[mesh]) return known[mesh];
    uint8_t *closed = zr_arena_alloc(run->arena, zr_mesh_part_count(&scene->meshes[mesh]), sizeof *closed);
    if (!closed || !zr_closed_parts_find(run, &scene->meshes[mesh], closed, NULL)) return NULL;
    return known[mesh] = closed;
}

/* Lines of meshes do not end where operands are cut: lines of samples replace them. */
static bool draw_lines_of_samples(struct zr_scene_builder *builder)
{
    struct zr_scene *scene = builder->scene;
    if (!scene->picture->edges.is_on || !scene->picture->edges.is_from_mesh) return true;
    struct zr_picture *picture = zr_arena_copy(builder->arena, scene->picture, sizeof *picture);
    if (!picture) return false;
    picture->edges.is_from_mesh = false;
    if (!(picture->edges.width > 0.0f)) picture->edges.width = LINE_WIDTH;
    scene->picture = picture;
    return true;
}

enum zr_status zr_csg_check(struct zr_scene_builder *builder, struct zr_error *error)
{
    struct zr_scene *scene = builder->scene;
    struct zr_arena *arena = builder->arena;
    const struct zr_run run = {
        .arena = arena, .scratch = arena, .team = builder->team, .cancel = arena->cancel, .error = error};
    const uint8_t **known = zr_arena_zero(arena, scene->mesh_count, sizeof *known);
    struct zr_csg *csg = zr_arena_copy(arena, scene->csg, sizeof *csg);
    const struct zr_part_list list = zr_part_list_make(arena, scene, UINT32_MAX / 4);
    if (!zr_arena_ok(arena) || zr_is_cancelled(arena->cancel)) return ZR_NO_MEMORY;
    for (uint32_t p = 0; p < list.count; p++) {
        const struct zr_part *part = &list.at[p];
        if (csg->parts[p] == 0) continue;
        const uint32_t number = scene->instances[part->instance].mesh;
        const char *fault = fault_of_part(builder, &scene->meshes[number], part->number);
        const uint8_t *closed = fault ? NULL : closed_of(&run, scene, number, known);
        if (!fault && !closed) return ZR_NO_MEMORY;
        if (!fault && !closed[part->number])
            fault = "is not closed: it has no inside; the facts of a part (info) tell where its edges are open";
        if (fault)
            zr_error_add(error, ZR_BAD_SCENE, scene->parts.csg.pointer, "the operand %s %s",
                         zr_quote(part->name, strlen(part->name)).text, fault);
    }
    const struct zr_bounds bounds = zr_bounds_of(scene, builder->team, arena->cancel);
    csg->tolerance = TOLERANCE * (double)zr_diagonal_of(&bounds);
    scene->csg = csg;
    if (!draw_lines_of_samples(builder)) return ZR_NO_MEMORY;
    if (zr_is_cancelled(arena->cancel)) return ZR_NO_MEMORY;
    return error->count > 0 ? ZR_BAD_SCENE : ZR_OK;
}
