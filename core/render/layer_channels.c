#include "render/layer_channels.h"

#include <math.h>
#include <string.h>

#include "base/run.h"
#include "render/layer_pass.h"
#include "scene/camera/rays.h"
#include "shade/depths.h"

struct drawing {
    const struct zr_layer_pass *pass;
    const struct zr_cancel *cancel;
    const struct zr_frame *frame;
    bool solid;
    struct zr_rays rays;
};

static size_t pixel_of(const struct zr_frame *frame, const struct zr_tile *tile, int32_t x, int32_t y)
{
    return (size_t)(frame->height - 1 - (uint32_t)(tile->y + y)) * frame->width + (size_t)(tile->x + x);
}

/* ---- layers ---- */

static void count_layers(const struct drawing *d, const struct zr_layers *layers)
{
    const struct zr_tile *tile = &layers->tile;
    const uint32_t *ends = layers->fragments.ends;
    uint32_t *out = d->frame->channels[ZR_CHANNEL_LAYERS];
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const int32_t place = y * ZR_TILE_STRIDE + x;
            out[pixel_of(d->frame, tile, x, y)] = ends[place + 1] - ends[place];
        }
}

/* ---- thickness ---- */

/* State of each ray of a tile, walked from behind. */
struct walk {
    int32_t winding[ZR_LAYER_FLOATS];
    double last[ZR_LAYER_FLOATS]; /* depth */
    double open[ZR_LAYER_FLOATS], closed[ZR_LAYER_FLOATS];
};

static void pass_surface(struct walk *walk, int32_t place, double depth, bool back)
{
    if (walk->winding[place] != 0) walk->open[place] += walk->last[place] - depth;
    walk->last[place] = depth;
    walk->winding[place] += back ? 1 : -1;
    if (walk->winding[place] != 0) return;
    walk->closed[place] += walk->open[place];
    walk->open[place] = 0.0;
}

/* Adds one layer to the walk. Converts the layer's depths to those of the channel depth. */
static void walk_layer(const struct drawing *d, struct zr_tile *layer, struct walk *walk)
{
    const struct zr_geometry *geometry = &d->pass->pass.geometry;
    const enum zr_isa isa = d->pass->pass.tiles.isa;
    const struct zr_draw *draw = &geometry->draws[0];
    zr_depths_tile(geometry, zr_eye_depths_of(isa), zr_paint_of(isa)->ends, d->frame->width, d->frame->height, layer);
    for (int32_t y = 0; y < layer->height; y++)
        for (int32_t x = 0; x < layer->width; x++) {
            const int32_t place = y * ZR_TILE_STRIDE + x;
            const uint32_t owner = layer->owner[place];
            if (owner == 0) continue;
            draw = zr_draw_next(geometry, draw, owner - 1);
            pass_surface(walk, place, (double)layer->depth[place], zr_triangle_of(geometry, draw, owner - 1).back);
        }
}

/* Returns the length of the ray through a pixel's centre per unit of depth. */
static double length_of(const struct zr_rays *rays, int32_t x, int32_t y)
{
    const double u = (double)x + 0.5, v = (double)y + 0.5;
    const zr_vec3 *d = &rays->direction, *dx = &rays->direction_x, *dy = &rays->direction_y;
    const double ray[3] = {(double)d->x + u * (double)dx->x + v * (double)dy->x,
                           (double)d->y + u * (double)dx->y + v * (double)dy->y,
                           (double)d->z + u * (double)dx->z + v * (double)dy->z};
    return sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]) / fabs(ray[2]);
}

static void measure_thickness(const struct drawing *d, struct zr_layers *layers)
{
    const struct zr_tile *tile = &layers->tile;
    float *out = d->frame->channels[ZR_CHANNEL_THICKNESS];
    struct walk walk;
    memset(walk.winding, 0, sizeof walk.winding);
    for (int32_t place = 0; place < ZR_LAYER_FLOATS; place++)
        walk.open[place] = walk.closed[place] = 0.0;
    for (uint32_t depth = 0; depth < layers->most && !zr_is_cancelled(d->cancel); depth++) {
        zr_layers_show(layers, depth);
        walk_layer(d, &layers->tile, &walk);
    }
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const double inside = walk.closed[y * ZR_TILE_STRIDE + x];
            out[pixel_of(d->frame, tile, x, y)] =
                inside > 0.0 ? (float)(inside * length_of(&d->rays, tile->x + x, tile->y + y)) : 0.0f;
        }
}

/* ---- all tiles ---- */

static void draw_tile(const struct drawing *d, uint32_t number, struct zr_tile *tile)
{
    struct zr_layers *layers = zr_layer_pass_find(d->pass, number, d->cancel, tile);
    if (!layers) return;
    if (d->solid)
        measure_thickness(d, layers);
    else
        count_layers(d, layers);
    zr_layers_give(d->pass->pass.tiles.layers, layers);
}

static void draw_range(void *context, size_t begin, size_t end)
{
    struct zr_tile tile;
    for (size_t number = begin; number < end; number++)
        draw_tile(context, (uint32_t)number, &tile);
}

/* Draws the channel thickness if `solid`, else layers. */
static enum zr_status draw(const struct zr_run *run, const struct zr_scene *scene, bool solid, struct zr_frame *frame)
{
    struct zr_layer_pass *pass = zr_arena_zero(run->arena, 1, sizeof *pass);
    struct drawing drawing = {.pass = pass, .cancel = run->cancel, .frame = frame, .solid = solid};
    if (!pass) return ZR_NO_MEMORY;
    const enum zr_status status = zr_layer_pass_make(run, scene, solid ? ZR_LAYERS_SOLID : ZR_LAYERS_AS_DRAWN, frame, pass);
    if (status != ZR_OK) return status;
    const enum zr_channel channel = solid ? ZR_CHANNEL_THICKNESS : ZR_CHANNEL_LAYERS;
    const bool has_rays = zr_rays_of(&frame->camera, frame->width, frame->height, &drawing.rays);
    if (!pass->pass.tiles.layers || (solid && !has_rays)) {
        const size_t bytes = (size_t)frame->width * frame->height * sizeof(uint32_t);
        return zr_arena_clear(run->arena, frame->channels[channel], bytes) ? ZR_OK : ZR_CANCELLED;
    }
    zr_team_ranges(run->team, zr_tile_count(frame->width, frame->height), 1, draw_range, &drawing);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_layer_channels_draw(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    enum zr_status status = ZR_OK;
    if (frame->channels[ZR_CHANNEL_LAYERS]) status = draw(run, scene, false, frame);
    if (status == ZR_OK && frame->channels[ZR_CHANNEL_THICKNESS]) status = draw(run, scene, true, frame);
    return status;
}
