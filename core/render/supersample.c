#include "render/supersample.h"

#include <stdatomic.h>
#include <string.h>

#include "base/rgba.h"
#include "base/run.h"
#include "render/layers/layer_surfaces.h"
#include "render/layers/layers.h"
#include "scene/channels.h"
#include "shade/models/xray.h"
#include "shade/paint.h"

/* Tiles per claim: as many as leave each thread RANGES claims. A claim touches each page of its stack. */
enum { TILES_PER_RANGE = 2, TILES_PER_RANGE_MOST = 16, RANGES = 16 };

/* State shared by the threads. */
struct drawing {
    const struct zr_pass *pass;
    const struct zr_sample_stages *stages;
    const struct zr_paint *paint;
    const struct zr_averages *averages;
    enum zr_isa isa;
    uint32_t side;
    uint32_t background; /* RGBA; for bytes only */
    const struct zr_frame *frame;
    const struct zr_cancel *cancel;
    atomic_uint_fast64_t covered; /* samples */
};

/* Pixels that a tile of samples covers. Row 0 is the lowest; a tile's size is a multiple of side. */
struct place {
    uint32_t x, y, width, height; /* pixels */
};

static struct place place_of(const struct drawing *d, const struct zr_tile *tile)
{
    const uint32_t side = d->side;
    return (struct place){(uint32_t)tile->x / side, (uint32_t)tile->y / side, (uint32_t)tile->width / side,
                          (uint32_t)tile->height / side};
}

/* ---- bytes ---- */

static void average_bytes(struct drawing *d, struct zr_tile *tile, struct zr_layers *blended, uint32_t *words,
                          uint64_t *covered)
{
    const struct place place = place_of(d, tile);
    struct zr_tile_targets to = {.clear_value = d->background};
    to.channels[ZR_CHANNEL_COLOR] = (struct zr_pixel_rows){.first = words, .stride = ZR_TILE_SIZE};
    if (blended)
        *covered += zr_layers_put(&d->pass->tiles, blended, tile, &to.channels[ZR_CHANNEL_COLOR]);
    else if (tile->is_empty)
        d->paint->fill(&to.channels[ZR_CHANNEL_COLOR], tile->width, tile->height, d->background);
    else
        d->paint->shade(&d->pass->geometry, &d->pass->attributes, tile, &to);
    for (uint32_t y = 0; y < place.height; y++) {
        const size_t row = d->frame->height - 1 - (place.y + y);
        uint32_t *out = (uint32_t *)(void *)d->frame->color + row * d->frame->width + place.x;
        d->averages->bytes(words + (size_t)y * d->side * ZR_TILE_SIZE, d->side, place.width,
                           d->pass->tiles.scene->background.w >= 1.0f, out);
    }
}

/* ---- light ---- */

enum { TILE_WORDS = ZR_TILE_STRIDE * ZR_TILE_SIZE };

/* A tile's G-buffer, and its lighting. */
struct lit_tile {
    _Alignas(64) float floats[9][TILE_WORDS];
    float occlusion[TILE_WORDS];
    float color[3][TILE_WORDS];
    uint32_t owner[TILE_WORDS], material[TILE_WORDS];
    struct zr_gbuffer_textures textures;
    union {
        float texels[ZR_TEXTURE_VALUES_FINISHED][TILE_WORDS]; /* in the order of struct zr_gbuffer_textures */
        struct zr_sample_room room;                           /* of tiles without textures, whose surfaces are lit */
    };
};

struct lit_room {
    struct lit_tile tile;
    struct zr_surfaces surfaces;
    struct zr_surface_pixels pixels;
    struct zr_edge_samples edges;
};

static void point_at_texels(struct lit_tile *lit, const struct zr_texture_maps *maps)
{
    for (int k = 0; k < 3; k++) {
        lit->textures.base[k] = lit->texels[k];
        lit->textures.emissive[k] = lit->texels[6 + k];
        lit->textures.normal[k] = lit->texels[9 + k];
    }
    lit->textures.roughness = lit->texels[3];
    lit->textures.metallic = lit->texels[4];
    lit->textures.occlusion = lit->texels[5];
    if (!maps->of_finishes) {
        lit->textures.coat = NULL;
        return;
    }
    lit->textures.coat = lit->texels[12];
    lit->textures.coat_roughness = lit->texels[13];
    lit->textures.film = lit->texels[20];
    lit->textures.film_thickness = lit->texels[21];
    lit->textures.transmission = lit->texels[22];
    lit->textures.thickness = lit->texels[23];
    lit->textures.anisotropy = lit->texels[27];
    for (int k = 0; k < 3; k++) {
        lit->textures.coat_normal[k] = lit->texels[14 + k];
        lit->textures.sheen[k] = lit->texels[17 + k];
        lit->textures.along[k] = lit->texels[24 + k];
    }
}

/* `maps`: the textures of the scene, or NULL for a G-buffer without their values. */
static struct zr_gbuffer gbuffer_of(struct lit_tile *lit, const struct zr_tile *tile,
                                    const struct zr_texture_maps *maps)
{
    struct zr_gbuffer out = {.width = tile->width,
                             .height = tile->height,
                             .stride = ZR_TILE_STRIDE,
                             .owner = lit->owner,
                             .material = lit->material};
    for (int k = 0; k < 3; k++) {
        out.base[k] = lit->floats[k];
        out.normal[k] = lit->floats[3 + k];
        out.point[k] = lit->floats[6 + k];
    }
    if (maps && maps->of) {
        point_at_texels(lit, maps);
        out.textures = &lit->textures;
    }
    return out;
}

static void average_light(const struct drawing *d, const struct place *place, const struct lit_tile *lit)
{
    const struct zr_linear_frame *to = d->stages->out;
    for (uint32_t y = 0; y < place->height; y++) {
        const size_t from = (size_t)y * d->side * ZR_TILE_STRIDE, at = (place->y + y) * to->stride + place->x;
        const float *const color[3] = {lit->color[0] + from, lit->color[1] + from, lit->color[2] + from};
        float *const out[4] = {to->color[0] + at, to->color[1] + at, to->color[2] + at, to->cover + at};
        d->averages->light(color, lit->owner + from, d->side, place->width, out);
    }
}

static void clear_light(const struct drawing *d, const struct place *place)
{
    const struct zr_linear_frame *to = d->stages->out;
    for (uint32_t y = place->y; y < place->y + place->height; y++)
        for (size_t at = y * to->stride + place->x; at < y * to->stride + place->x + place->width; at++)
            to->color[0][at] = to->color[1][at] = to->color[2][at] = to->cover[at] = 0.0f;
}

/* Makes samples transparent that are of glass which refracts, or in front of one. is_hidden: of each sample. */
static void leave_glass(const struct drawing *d, const struct zr_gbuffer *samples, bool *is_hidden, float *opacity)
{
    const struct zr_material *materials = d->stages->lighting->materials;
    for (int32_t y = 0; y < samples->height; y++)
        for (ptrdiff_t i = y * samples->stride; i < y * samples->stride + samples->width; i++) {
            is_hidden[i] |= samples->owner[i] > 0 && zr_material_refracts(&materials[samples->material[i]]);
            if (is_hidden[i]) opacity[i] = 0.0f;
        }
}

/* Blends the layers over the lit tile: color[3] and cover. Layers are lit like opaque surfaces, but without
 * occlusion. */
static void blend_light(const struct drawing *d, struct zr_layers *blended, struct lit_tile *lit)
{
    const struct zr_tile *layer = &blended->tile;
    float *const color[3] = {blended->front[0], blended->front[1], blended->front[2]};
    const float *const front[4] = {color[0], color[1], color[2], blended->front[3]};
    float *const sum[4] = {blended->sum[0], blended->sum[1], blended->sum[2], blended->sum[3]};
    const struct zr_gbuffer samples = gbuffer_of(lit, layer, &d->pass->attributes.textures);
    bool is_hidden[TILE_WORDS] = {false};
    for (uint32_t depth = 0; depth < blended->most && !zr_is_cancelled(d->cancel); depth++) {
        zr_layers_show(blended, depth);
        d->paint->opacity(&d->pass->geometry, &d->pass->attributes, layer, blended->front[3]);
        d->paint->samples(&d->pass->geometry, &d->pass->attributes, layer, &samples);
        zr_linear_light_of(d->isa)(d->stages->lighting, &samples, NULL, color);
        if (d->stages->has_xrays) zr_xray_of(d->isa)(d->stages->lighting, &samples, blended->front[3]);
        if (d->stages->glass == ZR_GLASS_LEFT_OUT) leave_glass(d, &samples, is_hidden, blended->front[3]);
        d->paint->blend(layer, front, sum);
    }
}

/* Starts the sum with the opaque surfaces. */
static void begin_blending(const struct zr_tile *tile, const struct lit_tile *lit, struct zr_layers *blended)
{
    for (int k = 0; k < 3; k++)
        memcpy(blended->sum[k], lit->color[k], sizeof lit->color[k]);
    for (uint32_t i = 0; i < TILE_WORDS; i++)
        blended->sum[3][i] = tile->owner[i] > 0 ? 1.0f : 0.0f;
}

/* Lights, blends and averages a tile with blended layers. Returns the number of samples that only those cover. */
static uint32_t light_layers(const struct drawing *d, const struct zr_tile *tile, const struct place *place,
                             struct zr_layers *blended, struct lit_tile *lit)
{
    const struct zr_linear_frame *to = d->stages->out;
    uint32_t uncovered = 0;
    begin_blending(tile, lit, blended);
    blend_light(d, blended, lit);
    for (uint32_t y = 0; y < place->height; y++) {
        const size_t from = (size_t)y * d->side * ZR_TILE_STRIDE, at = (place->y + y) * to->stride + place->x;
        const float *const sum[4] = {blended->sum[0] + from, blended->sum[1] + from, blended->sum[2] + from,
                                     blended->sum[3] + from};
        float *const out[4] = {to->color[0] + at, to->color[1] + at, to->color[2] + at, to->cover + at};
        d->averages->blended(sum, d->side, place->width, out);
    }
    for (uint32_t i = 0; i < TILE_WORDS; i++)
        uncovered += tile->owner[i] == 0 && blended->fragments.ends[i] < blended->fragments.ends[i + 1];
    zr_layers_give(d->pass->tiles.layers, blended);
    return uncovered;
}

/* Lights, blends and averages a tile that blended surfaces cover, each lit once in a pixel. Of the tile, lit->color has
 * the light, unless it shows nothing else. Returns as light_layers. */
static uint32_t light_layer_surfaces(const struct drawing *d, const struct zr_tile *tile, bool is_bare,
                                     struct zr_layer_surfaces *blended, struct lit_room *room)
{
    const struct place place = place_of(d, tile);
    const struct zr_linear_frame *to = d->stages->out;
    const struct zr_layer_light light = {&d->pass->tiles, d->stages->lighting, d->stages->has_xrays,
                                         d->stages->glass == ZR_GLASS_LEFT_OUT};
    const float *const color[3] = {room->tile.color[0], room->tile.color[1], room->tile.color[2]};
    uint32_t uncovered = 0;
    zr_layer_surfaces_light(&light, tile, d->cancel, &room->surfaces, &room->tile.room, blended);
    for (uint32_t i = 0; i < place.height * place.width && !zr_is_cancelled(d->cancel); i++) {
        const uint32_t x = i % place.width, y = i / place.width;
        const size_t at = (place.y + y) * to->stride + place.x + x;
        float out[4];
        uncovered +=
            zr_layer_surfaces_blend_of(d->isa)(blended, tile, y * ZR_SURFACES_COLUMNS + x, is_bare ? NULL : color, out);
        for (int k = 0; k < 3; k++)
            to->color[k][at] = out[k];
        to->cover[at] = out[3];
    }
    zr_layer_surfaces_give(&d->pass->tiles, blended);
    return uncovered;
}

/* ---- light of surfaces ---- */

static void light_rows(const struct drawing *d, const struct place *place, uint32_t y, struct zr_surfaces *surfaces)
{
    const struct zr_sample_stages *stages = d->stages;
    const struct zr_linear_frame *to = stages->out;
    const struct zr_gbuffer own = zr_surfaces_gbuffer(surfaces);
    float *const color[3] = {surfaces->color[0], surfaces->color[1], surfaces->color[2]};
    if (stages->occlusion)
        zr_occlusion_places_of(d->isa)(stages->occlusion, &surfaces->list, &own, d->side, surfaces->occlusion);
    zr_linear_light_of(d->isa)(stages->lighting, &own, stages->occlusion ? surfaces->occlusion : NULL, color);
    for (int32_t row = 0; row < surfaces->rows; row++) {
        const size_t at = (place->y + y + (uint32_t)row) * to->stride + place->x;
        float *const out[4] = {to->color[0] + at, to->color[1] + at, to->color[2] + at, to->cover + at};
        zr_surfaces_put(surfaces, row, out);
    }
}

/* Finds the values of the listed samples and writes them to the tile's G-buffer. */
static void put_samples(const struct drawing *d, struct lit_room *room, const struct zr_gbuffer *to)
{
    struct zr_edge_samples *samples = &room->edges;
    struct zr_gbuffer values = zr_surfaces_gbuffer(&room->surfaces); /* whose memory they take */
    values.material = NULL;
    values.base[0] = NULL;
    zr_samples_at_of(d->isa)(&d->pass->geometry, &d->pass->attributes, &samples->list, &room->tile.room, &values);
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < samples->list.count; i++) {
            to->normal[k][samples->place[i]] = values.normal[k][i];
            to->point[k][samples->place[i]] = values.point[k][i];
        }
    samples->list.count = 0;
}

static void mark_edges(const struct drawing *d, uint32_t number, const struct zr_tile *tile, struct lit_room *room)
{
    const struct zr_gbuffer samples = gbuffer_of(&room->tile, tile, NULL);
    struct zr_sample_pairs pairs;
    zr_surfaces_ends_of(d->isa)(d->stages->surfaces, &room->pixels, &pairs);
    room->edges.list.count = 0;
    for (int32_t y = 0; y < tile->height; y++) {
        zr_surfaces_list_row(&pairs, tile, samples.owner, y, &room->edges);
        if (room->edges.list.count > ZR_SAMPLES_LISTED - ZR_TILE_SIZE) put_samples(d, room, &samples);
    }
    put_samples(d, room, &samples);
    zr_edges_mark_tile(d->stages->edges, d->isa, number, &samples, &pairs);
}

/* Lights the surfaces of each pixel once. */
static void light_surfaces(const struct drawing *d, uint32_t number, const struct zr_tile *tile, struct lit_room *room)
{
    const struct place place = place_of(d, tile);
    const struct zr_pixel_rows owners = {.first = room->tile.owner, .stride = ZR_TILE_STRIDE};
    struct zr_surfaces *surfaces = &room->surfaces;
    d->paint->owners(tile, &owners);
    for (int32_t y = 0; y < (int32_t)place.height; y += surfaces->rows) {
        zr_surfaces_find_of(d->isa)(room->tile.owner, tile, y, surfaces);
        const struct zr_gbuffer values = zr_surfaces_gbuffer(surfaces);
        zr_samples_at_of(d->isa)(&d->pass->geometry, &d->pass->attributes, &surfaces->list, &room->tile.room, &values);
        zr_surfaces_join_of(d->isa)(d->stages->surfaces, surfaces);
        light_rows(d, &place, (uint32_t)y, surfaces);
        if (d->stages->edges) zr_surfaces_keep(surfaces, y, &room->pixels);
    }
    if (d->stages->edges) mark_edges(d, number, tile, room);
}

/* Blended primitives over a tile: layers of its samples, or surfaces of its pixels, or neither. */
struct blended {
    struct zr_layers *layers;
    struct zr_layer_surfaces *surfaces;
};

/* Returns true if surfaces are lit once in a pixel. Textures are sampled at their own rate. */
static bool are_surfaces_lit(const struct drawing *d)
{
    return d->stages && d->stages->surfaces && !d->pass->attributes.textures.of;
}

static bool find_blended(const struct drawing *d, uint32_t number, struct zr_tile *tile, struct blended *out)
{
    *out = (struct blended){NULL, NULL};
    if (are_surfaces_lit(d)) return zr_layer_surfaces_find(&d->pass->tiles, number, d->cancel, tile, &out->surfaces);
    return zr_layers_blend(&d->pass->tiles, number, d->cancel, tile, !d->stages, &out->layers);
}

/* Lights and averages a tile. Returns as light_layers. */
static uint32_t light_tile(const struct drawing *d, uint32_t number, const struct zr_tile *tile,
                           const struct blended *blended, struct lit_room *room)
{
    const struct zr_sample_stages *stages = d->stages;
    const struct place place = place_of(d, tile);
    struct lit_tile *lit = &room->tile;
    if (tile->is_empty) {
        clear_light(d, &place);
        if (stages->edges) zr_edges_mark_empty(stages->edges, number);
        return 0;
    }
    if (are_surfaces_lit(d) && !blended->surfaces) {
        light_surfaces(d, number, tile, room);
        return 0;
    }
    if (blended->surfaces && d->paint->count(tile) == 0) {
        if (stages->edges) zr_edges_mark_empty(stages->edges, number);
        return light_layer_surfaces(d, tile, true, blended->surfaces, room);
    }
    const struct zr_gbuffer samples = gbuffer_of(lit, tile, &d->pass->attributes.textures);
    d->paint->samples(&d->pass->geometry, &d->pass->attributes, tile, &samples);
    if (stages->edges) zr_edges_mark_tile(stages->edges, d->isa, number, &samples, NULL);
    if (stages->occlusion)
        zr_occlusion_samples_of(d->isa)(stages->occlusion, &samples, d->side, tile->x, tile->y, lit->occlusion);
    float *const color[3] = {lit->color[0], lit->color[1], lit->color[2]};
    zr_linear_light_of(d->isa)(stages->lighting, &samples, stages->occlusion ? lit->occlusion : NULL, color);
    if (blended->surfaces) return light_layer_surfaces(d, tile, false, blended->surfaces, room);
    if (blended->layers) return light_layers(d, tile, &place, blended->layers, lit);
    average_light(d, &place, lit);
    return 0;
}

/* ---- all tiles ---- */

static void draw_range(void *context, size_t begin, size_t end)
{
    struct drawing *d = context;
    struct zr_tile tile = {0}; /* blending also reads samples outside the window */
    union {
        uint32_t words[ZR_TILE_SIZE * ZR_TILE_SIZE];
        struct lit_room lit;
    } room;
    uint64_t covered = 0;
    for (size_t number = begin; number < end; number++) {
        struct blended blended;
        if (d->stages && d->stages->glass == ZR_GLASS_REPEATED &&
            !zr_layers_has_blended(&d->pass->tiles, (uint32_t)number))
            continue;
        if (!zr_tile_find_visible(&d->pass->tiles, (uint32_t)number, d->cancel, &tile) ||
            !find_blended(d, (uint32_t)number, &tile, &blended))
            return;
        if (d->stages)
            covered += light_tile(d, (uint32_t)number, &tile, &blended, &room.lit);
        else
            average_bytes(d, &tile, blended.layers, room.words, &covered);
        if (!tile.is_empty) covered += d->paint->count(&tile);
    }
    atomic_fetch_add_explicit(&d->covered, covered, memory_order_relaxed);
}

static size_t tiles_per_range(size_t tiles, int threads)
{
    const size_t wanted = tiles / ((size_t)threads * RANGES);
    return wanted < TILES_PER_RANGE ? TILES_PER_RANGE : wanted > TILES_PER_RANGE_MOST ? TILES_PER_RANGE_MOST : wanted;
}

static enum zr_status draw(struct zr_team *team, struct drawing *d, struct zr_frame *frame)
{
    const uint32_t side = d->side;
    d->isa = zr_team_isa(team);
    d->paint = zr_paint_of(d->isa);
    d->averages = zr_averages_of(d->isa);
    d->frame = frame;
    const size_t tiles = zr_tile_count(frame->width * side, frame->height * side);
    zr_team_ranges(team, tiles, tiles_per_range(tiles, zr_team_size(team)), draw_range, d);
    if (zr_is_cancelled(d->cancel)) return ZR_CANCELLED;
    if (d->pass->tiles.layers && !zr_arena_ok(d->pass->tiles.layers->arena)) return ZR_NO_MEMORY;
    frame->covered_samples = d->covered;
    frame->samples_a_pixel = side * side;
    frame->spans = NULL;
    return ZR_OK;
}

enum zr_status zr_supersample_bytes(struct zr_team *team, const struct zr_pass *pass, uint32_t side,
                                    const struct zr_cancel *cancel, struct zr_frame *frame)
{
    struct drawing drawing = {
        .pass = pass, .side = side, .background = zr_rgba_make(pass->tiles.scene->background), .cancel = cancel};
    return draw(team, &drawing, frame);
}

enum zr_status zr_supersample_light(const struct zr_run *run, const struct zr_pass *pass,
                                    const struct zr_sample_stages *stages, uint32_t side, struct zr_frame *frame)
{
    struct drawing drawing = {.pass = pass, .stages = stages, .side = side, .cancel = run->cancel};
    struct zr_frame repeated = *frame;
    return draw(run->team, &drawing, stages->glass == ZR_GLASS_REPEATED ? &repeated : frame);
}
