#include "render/pixel_fragments.h"

#include <string.h>

#include "base/cancel.h"
#include "base/dvec3.h"
#include "base/run.h"
#include "scene/csg.h"
#include "shade/visible_points.h"

/* Writes the normal of a triangle and a corner, in world space. */
static void find_plane(const struct zr_source *source, const struct zr_instance *instance,
                       struct zr_pixel_fragment *out)
{
    const struct zr_matrix matrix = zr_matrix_of(&instance->object_to_world);
    zr_dvec3 at[3];
    for (int k = 0; k < 3; k++) {
        const zr_vec4 *p = source->corners[k];
        const double from[4] = {(double)p->x, (double)p->y, (double)p->z, (double)p->w};
        double to[4];
        zr_matrix_apply(&matrix, from, to);
        if (!(to[3] != 0.0)) return;
        at[k] = (zr_dvec3){to[0] / to[3], to[1] / to[3], to[2] / to[3]};
    }
    const zr_dvec3 n = zr_dvec3_cross(zr_dvec3_sub(at[1], at[0]), zr_dvec3_sub(at[2], at[0]));
    const double length = sqrt(zr_dvec3_dot(n, n));
    if (!(length > 0.0)) return;
    const double normal[3] = {n.x / length, n.y / length, n.z / length};
    const double corner[3] = {at[0].x, at[0].y, at[0].z};
    memcpy(out->normal, normal, sizeof normal);
    memcpy(out->corner, corner, sizeof corner);
}

/* Describes a fragment by the ids and alpha mode of the original scene. */
static struct zr_pixel_fragment fragment_of(const struct zr_layer_pass *pass, const struct zr_scene *scene,
                                            const struct zr_frame *frame, int32_t x, int32_t y, uint32_t owner)
{
    const struct zr_geometry *geometry = &pass->pass.geometry;
    const struct zr_draw *draw = zr_draw_of(geometry, owner - 1);
    const struct zr_material *material = &scene->materials[draw->material - pass->scene.materials];
    struct zr_pixel_fragment fragment = {
        .face_id = zr_draw_id(draw, owner - 1), .instance = draw->instance, .alpha_mode = material->alpha_mode};
    if (!zr_draw_is_of_wires(draw)) {
        const struct zr_triangle triangle = zr_triangle_of(geometry, draw, owner - 1);
        const struct zr_source source = zr_source_of(geometry, draw, triangle.v);
        const uint32_t face = zr_draw_face(draw, owner - 1 - draw->first);
        fragment.front_facing = triangle.back ? 2 : 1;
        fragment.is_culled = triangle.back && !material->double_sided;
        find_plane(&source, &scene->instances[draw->instance], &fragment);
        if (scene->csg) fragment.solid = (uint8_t)zr_csg_part_of(scene->csg, draw->instance, draw->mesh, face);
    }
    zr_visible_point_find(geometry, zr_eye_depths_of(pass->pass.tiles.isa), frame, owner, x, y, &fragment.depth,
                          fragment.position);
    return fragment;
}

/* At equal depth, an opaque or masked fragment hides a blended one. */
static bool is_shown(const struct zr_frame *frame, size_t pixel, const struct zr_pixel_fragment *fragment, float depth)
{
    const uint32_t seen = frame->face_id[pixel];
    const float nearest = frame->window_depth[pixel];
    if (fragment->alpha_mode == ZR_ALPHA_BLEND) return seen == 0 || depth < nearest;
    return seen == fragment->face_id && depth == nearest;
}

static bool list_fragments(const struct zr_run *run, const struct zr_fragment_source *source,
                           const struct zr_layers *layers, const struct zr_frame *frame, struct zr_pixel_fragments *out)
{
    const uint32_t up = frame->height - 1 - out->y;
    const uint32_t place = up % ZR_TILE_SIZE * ZR_TILE_STRIDE + out->x % ZR_TILE_SIZE;
    uint32_t count;
    const uint64_t *keys = zr_fragments_of(&layers->fragments, place, &count);
    struct zr_pixel_fragment *list = zr_arena_alloc(run->arena, count, sizeof *list);
    if (!list) return false;
    for (uint32_t i = 0; i < count && !(i % 1024 == 0 && zr_is_cancelled(run->cancel)); i++) {
        list[i] =
            fragment_of(source->pass, source->scene, frame, (int32_t)out->x, (int32_t)up, zr_fragment_owner(keys[i]));
        list[i].is_shown =
            is_shown(frame, (size_t)out->y * frame->width + out->x, &list[i], zr_fragment_depth(keys[i]));
    }
    out->count = count;
    out->at = list;
    return true;
}

enum zr_status zr_fragment_source_make(const struct zr_run *run, const struct zr_scene *scene, enum zr_layer_kind kind,
                                       const struct zr_frame *frame, struct zr_fragment_source *out)
{
    *out = (struct zr_fragment_source){scene, zr_arena_zero(run->arena, 1, sizeof *out->pass),
                                       zr_arena_alloc(run->arena, 1, sizeof *out->tile)};
    if (!out->pass || !out->tile) return ZR_NO_MEMORY;
    return zr_layer_pass_make(run, scene, kind, frame, out->pass);
}

enum zr_status zr_fragments_list(const struct zr_run *run, const struct zr_fragment_source *source, uint32_t x,
                                 uint32_t y, const struct zr_frame *frame, struct zr_pixel_fragments *out)
{
    const uint32_t up = frame->height - 1 - y;
    const uint32_t number = up / ZR_TILE_SIZE * zr_tile_across(frame->width) + x / ZR_TILE_SIZE;
    struct zr_layers_pool *pool = source->pass->pass.tiles.layers;
    *out = (struct zr_pixel_fragments){.x = x, .y = y};
    if (!pool) return ZR_OK;
    struct zr_layers *layers = zr_layer_pass_find(source->pass, number, run->cancel, source->tile);
    const bool is_listed = layers && list_fragments(run, source, layers, frame, out);
    if (layers) zr_layers_give(pool, layers);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    return is_listed ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_pixel_fragments_find(const struct zr_run *run, const struct zr_scene *scene, uint32_t x, uint32_t y,
                                       struct zr_frame *frame)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    struct zr_fragment_source source;
    frame->fragments = (struct zr_pixel_fragments){.x = x, .y = y};
    const enum zr_status status = zr_fragment_source_make(&inner, scene, ZR_LAYERS_AS_DRAWN, frame, &source);
    return status == ZR_OK ? zr_fragments_list(run, &source, x, y, frame, &frame->fragments) : status;
}
