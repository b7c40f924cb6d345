#include "render/pixel_fragments.h"

#include "base/run.h"
#include "render/layer_pass.h"
#include "shade/visible_points.h"

/* Describes a fragment by the ids and alpha mode of the original scene. */
static struct zr_pixel_fragment fragment_of(const struct zr_layer_pass *pass, const struct zr_scene *scene,
                                            const struct zr_frame *frame, int32_t x, int32_t y, uint32_t owner)
{
    const struct zr_geometry *geometry = &pass->pass.geometry;
    const struct zr_draw *draw = zr_draw_of(geometry, owner - 1);
    struct zr_pixel_fragment fragment = {.face_id = zr_draw_id(draw, owner - 1),
                                         .instance = draw->instance,
                                         .alpha_mode =
                                             scene->materials[draw->material - pass->scene.materials].alpha_mode};
    if (!zr_draw_is_of_wires(draw)) fragment.front_facing = zr_triangle_of(geometry, draw, owner - 1).back ? 2 : 1;
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

static bool list_fragments(struct zr_arena *arena, const struct zr_layer_pass *pass, const struct zr_scene *scene,
                           const struct zr_layers *layers, struct zr_frame *frame)
{
    struct zr_pixel_fragments *out = &frame->fragments;
    const uint32_t up = frame->height - 1 - out->y;
    const uint32_t place = up % ZR_TILE_SIZE * ZR_TILE_STRIDE + out->x % ZR_TILE_SIZE;
    uint32_t count;
    const uint64_t *keys = zr_fragments_of(&layers->fragments, place, &count);
    struct zr_pixel_fragment *list = zr_arena_alloc(arena, count, sizeof *list);
    if (!list) return false;
    for (uint32_t i = 0; i < count; i++) {
        list[i] = fragment_of(pass, scene, frame, (int32_t)out->x, (int32_t)up, zr_fragment_owner(keys[i]));
        list[i].is_shown =
            is_shown(frame, (size_t)out->y * frame->width + out->x, &list[i], zr_fragment_depth(keys[i]));
    }
    out->count = count;
    out->at = list;
    return true;
}

enum zr_status zr_pixel_fragments_find(const struct zr_run *run, const struct zr_scene *scene, uint32_t x, uint32_t y,
                                       struct zr_frame *frame)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    const uint32_t up = frame->height - 1 - y;
    const uint32_t number = up / ZR_TILE_SIZE * zr_tile_across(frame->width) + x / ZR_TILE_SIZE;
    struct zr_layer_pass *pass = zr_arena_zero(run->scratch, 1, sizeof *pass);
    struct zr_tile *tile = zr_arena_alloc(run->scratch, 1, sizeof *tile);
    frame->fragments = (struct zr_pixel_fragments){.x = x, .y = y};
    if (!pass || !tile) return ZR_NO_MEMORY;
    const enum zr_status status = zr_layer_pass_make(&inner, scene, false, frame, pass);
    if (status != ZR_OK || !pass->pass.tiles.layers) return status;
    struct zr_layers *layers = zr_layer_pass_find(pass, number, run->cancel, tile);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    return layers && list_fragments(run->arena, pass, scene, layers, frame) ? ZR_OK : ZR_NO_MEMORY;
}
