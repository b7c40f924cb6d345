#include "reference/gl/layers_twin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "reference/gl/reference_blend.h"
#include "reference/gl/reference_program.h"
#include "render/pass.h"

bool layers_twin_is_for(const struct zr_scene *scene)
{
    return zr_any_is_see_through(scene->materials, scene->material_count);
}

/* ---- what is drawn by itself ---- */

/* The arrays of one picture in floats. */
struct drawn {
    float *rgba, *depth;
    uint8_t *gaps;
};

/* A see-through part of the scene, and what the reference made of it. */
struct part {
    struct batches_only only;
    struct drawn drawn;
};

struct parts {
    uint32_t count, room;
    struct part *items; /* in the order of the scene's primitives */
};

static size_t pixels_of(const struct layers_twin *twin)
{
    return (size_t)twin->scene->views[0].width * twin->scene->views[0].height;
}

static bool make_drawn(const struct layers_twin *twin, struct drawn *drawn)
{
    const size_t pixels = pixels_of(twin);
    drawn->rgba = zr_arena_alloc(twin->arena, pixels, 4 * sizeof *drawn->rgba);
    drawn->depth = zr_arena_alloc(twin->arena, pixels, sizeof *drawn->depth);
    drawn->gaps = zr_arena_alloc(twin->arena, pixels, 1);
    return zr_arena_ok(twin->arena);
}

/* Colours as the scene looks. */
static bool draw(const struct layers_twin *twin, const struct batches_only *only, const struct drawn *to,
                 struct reference_error *error)
{
    static const struct reference_shader none = {.program = 0};
    const uint32_t width = twin->scene->views[0].width, height = twin->scene->views[0].height;
    struct batches batches;
    struct batches_options options = twin->options;
    options.purpose = BATCHES_COLORS;
    options.only = only;
    if (!batches_make(twin->arena, twin->scene, twin->camera, &options, &batches) ||
        !reference_resize(twin->reference, width, height, true, error) ||
        !reference_draw_floats(twin->reference, &batches.arrays, &none, to->rgba, error) ||
        !reference_read(twin->reference, NULL, to->depth, error) ||
        !reference_read_gaps(twin->reference, to->gaps, error))
        return false;
    batches_mark_thin(&batches, width, height, to->gaps);
    return true;
}

static bool draw_owners(const struct layers_twin *twin, const struct batches_only *only, uint32_t *owner,
                        struct reference_error *error)
{
    const size_t pixels = pixels_of(twin);
    uint8_t *rgba = zr_arena_alloc(twin->arena, pixels, 4);
    struct batches batches;
    struct batches_options options = twin->options;
    options.purpose = BATCHES_OWNERS;
    options.only = only;
    if (!rgba || !batches_make(twin->arena, twin->scene, twin->camera, &options, &batches) ||
        !reference_draw(twin->reference, &batches.arrays, error) || !reference_read(twin->reference, rgba, NULL, error))
        return false;
    for (size_t i = 0; i < pixels; i++)
        owner[i] = batches_owner_number(rgba + 4 * i);
    return true;
}

/* ---- the parts of a scene ---- */

static bool add_part(const struct layers_twin *twin, struct parts *parts, const struct batches_only *only,
                     struct reference_error *error)
{
    if (parts->count == parts->room) {
        const uint32_t room = 2 * parts->room + 64;
        parts->items = zr_arena_grow(twin->arena, parts->items, parts->count, room, sizeof *parts->items);
        parts->room = room;
    }
    if (!zr_arena_ok(twin->arena)) return false;
    struct part *part = &parts->items[parts->count++];
    part->only = *only;
    return make_drawn(twin, &part->drawn) && draw(twin, only, &part->drawn, error);
}

static bool add_kind(const struct layers_twin *twin, struct parts *parts, struct batches_only *only,
                     enum batches_kind kind, uint32_t count, struct reference_error *error)
{
    const struct zr_mesh *mesh = &twin->scene->meshes[twin->scene->instances[only->instance].mesh];
    only->kind = kind;
    for (only->number = 0; only->number < count; only->number++) {
        const struct zr_material *material = kind >= BATCHES_LINE
                                                 ? &twin->scene->materials[mesh->material]
                                                 : zr_material_of_face(twin->scene, mesh, only->number);
        if (material->alpha_mode != only->mode) continue;
        if (kind == BATCHES_OUTLINE && material->outline == ZR_OUTLINE_NONE) continue;
        if (!add_part(twin, parts, only, error)) return false;
    }
    return true;
}

static bool find_parts(const struct layers_twin *twin, enum zr_alpha_mode mode, struct parts *parts,
                       struct reference_error *error)
{
    for (uint32_t i = 0; i < twin->scene->instance_count; i++) {
        const struct zr_mesh *mesh = &twin->scene->meshes[twin->scene->instances[i].mesh];
        struct batches_only only = {.mode = mode, .one = true, .instance = i};
        if (!add_kind(twin, parts, &only, BATCHES_FACE, mesh->face_count, error) ||
            !add_kind(twin, parts, &only, BATCHES_OUTLINE, mesh->face_count, error) ||
            !add_kind(twin, parts, &only, BATCHES_LINE, mesh->line_count, error) ||
            !add_kind(twin, parts, &only, BATCHES_POINT, mesh->point_count, error))
            return false;
    }
    return true;
}

static uint32_t id_of(const struct zr_scene *scene, const struct batches_only *only)
{
    uint32_t id = 1 + only->number;
    for (uint32_t i = 0; i < only->instance; i++)
        id += (uint32_t)zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
    const struct zr_mesh *mesh = &scene->meshes[scene->instances[only->instance].mesh];
    if (only->kind >= BATCHES_LINE) id += mesh->face_count;
    if (only->kind == BATCHES_POINT) id += mesh->line_count;
    return id;
}

static const struct zr_material *material_of(const struct zr_scene *scene, const struct batches_only *only)
{
    const struct zr_mesh *mesh = &scene->meshes[scene->instances[only->instance].mesh];
    if (only->kind >= BATCHES_LINE) return &scene->materials[mesh->material];
    return zr_material_of_face(scene, mesh, only->number);
}

static float clamped(float v)
{
    return fminf(fmaxf(v, 0.0f), 1.0f);
}

static uint8_t byte_of(float v)
{
    return (uint8_t)nearbyintf(clamped(v) * 255.0f);
}

/* ---- masks ---- */

/* As GL's alpha test does: what does not pass leaves nothing, no depth either. */
static bool pass_masked(const struct layers_twin *twin, const struct drawn *opaque,
                        const struct layers_picture *picture, struct reference_error *error)
{
    struct parts parts = {.count = 0};
    if (!find_parts(twin, ZR_ALPHA_MASK, &parts, error)) return false;
    for (uint32_t p = 0; p < parts.count; p++) {
        const struct part *part = &parts.items[p];
        const uint8_t cutoff = byte_of(material_of(twin->scene, &part->only)->alpha_cutoff);
        const uint32_t id = id_of(twin->scene, &part->only);
        for (size_t i = 0; i < pixels_of(twin); i++) {
            opaque->gaps[i] |= part->drawn.gaps[i];
            if (!(part->drawn.depth[i] < opaque->depth[i]) || byte_of(part->drawn.rgba[4 * i + 3]) < cutoff) continue;
            opaque->depth[i] = part->drawn.depth[i];
            memcpy(opaque->rgba + 4 * i, part->drawn.rgba + 4 * i, 4 * sizeof(float));
            picture->owner[i] = id;
        }
    }
    return true;
}

/* ---- layers ---- */

/* Those of one pixel that lie in front of what is opaque, or as deep (GL_LEQUAL), the farthest first; of equally deep ones the later is
 * farther. */
static uint32_t sort_layers(const struct parts *parts, size_t pixel, float behind, uint32_t *order)
{
    uint32_t count = 0;
    for (uint32_t p = 0; p < parts->count; p++) {
        const float depth = parts->items[p].drawn.depth[pixel];
        uint32_t at = count;
        if (!(depth <= behind && depth < 1.0f)) continue;
        while (at > 0 && parts->items[order[at - 1]].drawn.depth[pixel] <= depth)
            at--;
        memmove(order + at + 1, order + at, (count - at) * sizeof *order);
        order[at] = p;
        count++;
    }
    return count;
}

/* Layer after layer: of each pixel the next of its own. */
static bool blend_layers(const struct layers_twin *twin, const struct parts *parts, const struct drawn *opaque,
                         const struct layers_picture *picture, struct reference_error *error)
{
    const size_t pixels = pixels_of(twin);
    const uint32_t count = parts->count > 0 ? parts->count : 1;
    uint32_t *orders = zr_arena_alloc(twin->arena, pixels * count, sizeof *orders), most = 0;
    float *layer = zr_arena_alloc(twin->arena, pixels, 4 * sizeof *layer);
    if (!zr_arena_ok(twin->arena)) return false;
    for (size_t i = 0; i < pixels; i++) {
        picture->count[i] = sort_layers(parts, i, opaque->depth[i], orders + i * count);
        if (picture->count[i] > most) most = picture->count[i];
    }
    if (!reference_blend_begin(twin->reference, opaque->rgba, error)) return false;
    for (uint32_t k = 0; k < most; k++) {
        memset(layer, 0, 4 * pixels * sizeof *layer);
        for (size_t i = 0; i < pixels; i++)
            for (int c = 0; c < 4 && k < picture->count[i]; c++)
                layer[4 * i + (size_t)c] = clamped(parts->items[orders[i * count + k]].drawn.rgba[4 * i + (size_t)c]);
        if (!reference_blend_layer(twin->reference, layer, error)) return false;
    }
    return reference_blend_end(twin->reference, picture->sum, error);
}

/* Colours times opacity, as blending has them. */
static void begin_colors(const struct layers_twin *twin, const struct drawn *opaque)
{
    const zr_vec4 b = twin->scene->background;
    for (size_t i = 0; i < pixels_of(twin); i++) {
        float *rgba = opaque->rgba + 4 * i;
        for (int c = 0; c < 3; c++)
            rgba[c] = opaque->depth[i] < 1.0f ? clamped(rgba[c]) : (&b.x)[c] * b.w;
        rgba[3] = opaque->depth[i] < 1.0f ? 1.0f : b.w;
    }
}

static void put_bytes(const struct layers_twin *twin, const struct drawn *opaque, const struct layers_picture *picture)
{
    const zr_vec4 b = twin->scene->background;
    for (size_t i = 0; i < pixels_of(twin); i++) {
        const float *rgba = picture->count[i] > 0 ? picture->sum + 4 * i : opaque->rgba + 4 * i;
        const bool covered = opaque->depth[i] < 1.0f || b.w >= 1.0f;
        const float opacity = covered ? 1.0f : rgba[3];
        for (int c = 0; c < 3; c++)
            picture->rgba[4 * i + (size_t)c] = byte_of(opacity > 0.0f ? rgba[c] / opacity : rgba[c]);
        picture->rgba[4 * i + 3] = byte_of(opacity);
        if (opaque->depth[i] < 1.0f || picture->count[i] > 0) continue;
        for (int c = 0; c < 4; c++)
            picture->rgba[4 * i + (size_t)c] = byte_of((&b.x)[c]);
    }
}

bool layers_twin_draw(const struct layers_twin *twin, const struct layers_picture *picture,
                      struct reference_error *error)
{
    static const struct batches_only what_is_opaque = {.mode = ZR_ALPHA_OPAQUE};
    struct drawn opaque;
    struct parts blended = {.count = 0};
    if (!make_drawn(twin, &opaque) || !draw(twin, &what_is_opaque, &opaque, error) ||
        !draw_owners(twin, &what_is_opaque, picture->owner, error) || !pass_masked(twin, &opaque, picture, error) ||
        !find_parts(twin, ZR_ALPHA_BLEND, &blended, error))
        return false;
    for (uint32_t p = 0; p < blended.count; p++)
        for (size_t i = 0; i < pixels_of(twin); i++)
            opaque.gaps[i] |= blended.items[p].drawn.gaps[i];
    begin_colors(twin, &opaque);
    if (!blend_layers(twin, &blended, &opaque, picture, error)) return false;
    put_bytes(twin, &opaque, picture);
    memcpy(picture->gaps, opaque.gaps, pixels_of(twin));
    memcpy(picture->depth, opaque.depth, pixels_of(twin) * sizeof(float));
    return true;
}

/* ---- sums ---- */

static uint64_t compare_tile(const struct zr_scene *scene, const struct zr_tile *tile, const struct zr_layers *blended,
                             const struct layers_picture *picture)
{
    const uint32_t width = scene->views[0].width, height = scene->views[0].height;
    uint64_t different = 0;
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const size_t pixel = (size_t)(height - 1 - (uint32_t)(tile->y + y)) * width + (size_t)(tile->x + x);
            const size_t at = (size_t)(y * ZR_TILE_STRIDE + x);
            if (picture->count[pixel] == 0 || picture->gaps[pixel]) continue;
            bool equal = blended != NULL;
            for (int c = 0; c < 4 && equal; c++)
                equal = blended->sum[c][at] == picture->sum[4 * pixel + (size_t)c];
            different += !equal;
        }
    return different;
}

uint64_t layers_twin_compare(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                             const struct zr_camera *camera, const struct layers_picture *picture)
{
    const uint32_t width = scene->views[0].width, height = scene->views[0].height;
    const struct zr_pass_desc desc = {
        .scene = scene, .camera = camera, .window = zr_window_of(scene, width, height, 1), .wants = {.colors = true}};
    struct zr_pass *pass = zr_arena_alloc(arena, 1, sizeof *pass);
    struct zr_tile *tile = zr_arena_alloc(arena, 1, sizeof *tile);
    const uint64_t all = (uint64_t)width * height;
    uint64_t different = 0;
    if (!pass || !tile || zr_pass_make(&(struct zr_run){.arena = arena, .team = team}, &desc, pass) != ZR_OK)
        return all;
    for (uint32_t number = 0; number < zr_tile_count(width, height); number++) {
        struct zr_layers *blended;
        if (!zr_tile_find_visible(&pass->tiles, number, NULL, tile) ||
            !zr_layers_blend(&pass->tiles, number, NULL, tile, true, &blended))
            return all;
        different += compare_tile(scene, tile, blended, picture);
        if (blended) zr_layers_give(&pass->layers, blended);
    }
    return different;
}
