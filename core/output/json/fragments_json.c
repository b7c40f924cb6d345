#include "output/json/fragments_json.h"

#include "output/json/json_print.h"

static const char *const alpha_modes[] = {
    [ZR_ALPHA_OPAQUE] = "OPAQUE", [ZR_ALPHA_MASK] = "MASK", [ZR_ALPHA_BLEND] = "BLEND"};

static void print_fragment(struct zr_print *print, const struct zr_scene *scene,
                           const struct zr_pixel_fragment *fragment)
{
    const struct zr_instance *instance = &scene->instances[fragment->instance];
    zr_print_begin(print, NULL, '{');
    zr_print_float(print, "depth", fragment->depth);
    zr_print_count(print, "faceId", fragment->face_id);
    zr_print_count(print, "instanceId", UINT64_C(1) + fragment->instance);
    zr_print_string(print, "mesh", scene->meshes[instance->mesh].name);
    if (instance->node) zr_print_string(print, "node", instance->node);
    if (fragment->part) zr_print_string(print, "part", fragment->part);
    zr_print_floats(print, "position", fragment->position, 3);
    zr_print_count(print, "frontFacing", (uint64_t)fragment->front_facing);
    zr_print_string(print, "alphaMode", alpha_modes[fragment->alpha_mode]);
    zr_print_bool(print, "shown", fragment->is_shown);
    zr_print_end(print, '}');
}

enum zr_status zr_fragments_json_write(const struct zr_scene *scene, const struct zr_frame *frame,
                                       struct zr_buffer *out)
{
    const struct zr_pixel_fragments *fragments = &frame->fragments;
    const uint32_t listed = fragments->count < ZR_FRAGMENTS_LISTED_MAX ? fragments->count : ZR_FRAGMENTS_LISTED_MAX;
    struct zr_print print = {.out = out};
    zr_print_begin(&print, NULL, '{');
    zr_print_count(&print, "x", fragments->x);
    zr_print_count(&print, "y", fragments->y);
    zr_print_count(&print, "count", fragments->count);
    zr_print_begin(&print, "fragments", '[');
    for (uint32_t i = 0; i < listed; i++)
        print_fragment(&print, scene, &fragments->at[i]);
    zr_print_end(&print, ']');
    zr_print_end(&print, '}');
    return zr_buffer_add(out, "\n", 1) && zr_arena_ok(out->arena) ? ZR_OK : ZR_NO_MEMORY;
}
