#include "shade/resolve.h"

#include <string.h>

#include "shade/eye_depth.h"

/* A record's depth, kept while its runs are resolved. */
struct surface {
    uint32_t owner; /* 0: none yet */
    struct zr_eye_depth eye_depth;
};

/* As floats. */
#define INFINITY_BITS UINT32_C(0x7f800000)
#define ONE_BITS UINT32_C(0x3f800000)

/* Small records come back in every row of a tile: this many are remembered. */
enum { SURFACES = 256 };

/* Runs wait until the painter has some to paint side by side. */
enum { RUNS = 4 * ZR_TILE_SIZE };

/* What is kept from run to run of a tile. */
struct resolver {
    const struct zr_geometry *geometry;
    const struct zr_frame *frame;
    const struct zr_paint *paint;
    const struct zr_batch *batch; /* of the last record */
    struct surface surfaces[SURFACES];
    uint32_t run_count;
    struct zr_run runs[RUNS];
};

static const struct zr_batch *batch_of(struct resolver *r, uint32_t number)
{
    if (!zr_batch_holds(r->batch, number)) r->batch = zr_batch_of(r->geometry, number);
    return r->batch;
}

static const struct zr_eye_depth *eye_depth_of(struct resolver *r, uint32_t number)
{
    struct surface *surface = &r->surfaces[number % SURFACES];
    if (surface->owner == number + 1) return &surface->eye_depth;
    const struct zr_record record = zr_record_of(r->geometry, batch_of(r, number), number);
    surface->owner = number + 1;
    zr_eye_depth_make(r->geometry, &record.triangle, r->frame->width, r->frame->height, &surface->eye_depth);
    return &surface->eye_depth;
}

static uint32_t face_of(struct resolver *r, uint32_t number)
{
    const struct zr_batch *batch = batch_of(r, number);
    uint32_t t = number - batch->first;
    if (batch->written) return r->geometry->triangles[batch->first_record + t].face;
    return batch->first_id + zr_batch_face(batch, t);
}

/* The base as it is; its depth in the tile is for the depth test only. */
static void resolve_base(const struct zr_frame *frame, const struct zr_base *base, size_t pixel, int32_t count)
{
    size_t bytes = (size_t)count * 4;
    if (frame->color && base->color) memcpy(frame->color + 4 * pixel, base->color + 4 * pixel, bytes);
    if (frame->depth && base->depth) memcpy(frame->depth + pixel, base->depth + pixel, bytes);
    if (frame->face_id && base->face_id) memcpy(frame->face_id + pixel, base->face_id + pixel, bytes);
    if (frame->window_depth && base->window_depth)
        memcpy(frame->window_depth + pixel, base->window_depth + pixel, bytes);
}

/* Where nothing is drawn, in `rows` rows from the pixel on, one above the other in the window, so one below the other
 * in memory the other way round. */
static void resolve_nothing(const struct zr_frame *frame, const struct zr_paint *paint, uint32_t background,
                            size_t pixel, int32_t width, int32_t rows)
{
    const ptrdiff_t up = -(ptrdiff_t)frame->width;
    if (frame->color) paint->fill(frame->color + 4 * pixel, background, width, rows, up);
    if (frame->depth) paint->fill(frame->depth + pixel, INFINITY_BITS, width, rows, up);
    if (frame->face_id) paint->fill(frame->face_id + pixel, 0, width, rows, up);
    for (int32_t row = 0; frame->base && row < rows; row++)
        resolve_base(frame, frame->base, pixel - (size_t)row * frame->width, width);
}

static void resolve_run(struct resolver *r, const struct zr_run *run, size_t pixel)
{
    const struct zr_frame *frame = r->frame;
    if (frame->depth) {
        const struct zr_eye_depth depth = *eye_depth_of(r, run->number);
        for (uint32_t i = 0; i < run->count; i++)
            frame->depth[pixel + i] = zr_eye_depth_at(&depth, run->x + (int32_t)i, run->y);
    }
    if (frame->face_id) {
        uint32_t face = face_of(r, run->number) + (frame->base ? frame->base->first_face_id - 1 : 0);
        for (uint32_t i = 0; i < run->count; i++)
            frame->face_id[pixel + i] = face;
    }
}

/* Window space has y up, pictures have row 0 on top. */
static size_t pixel_of_row(const struct zr_frame *frame, const struct zr_tile *tile, int32_t row)
{
    return (size_t)(frame->height - 1 - (uint32_t)(tile->y + row)) * frame->width + (size_t)tile->x;
}

static void paint_runs(struct resolver *r)
{
    if (r->run_count > 0) r->paint->runs(r->geometry, r->runs, r->run_count);
    r->run_count = 0;
}

static uint32_t resolve_row(struct resolver *r, const struct zr_tile *tile, int32_t row, uint32_t nothing)
{
    const struct zr_frame *frame = r->frame;
    const uint32_t *owners = &tile->owner[row * ZR_TILE_STRIDE];
    const size_t line = pixel_of_row(frame, tile, row);
    uint32_t covered = 0;
    if (frame->window_depth)
        memcpy(frame->window_depth + line, &tile->depth[row * ZR_TILE_STRIDE], (size_t)tile->width * sizeof(float));
    int32_t begin = 0, end;
    for (uint64_t ends = r->paint->ends(owners, tile->width); ends; ends &= ends - 1, begin = end) {
        end = __builtin_ctzll(ends) + 1;
        size_t pixel = line + (size_t)begin;
        if (owners[begin] == 0) {
            resolve_nothing(frame, r->paint, nothing, pixel, end - begin, 1);
            continue;
        }
        struct zr_run *run = &r->runs[r->run_count];
        *run = (struct zr_run){.number = owners[begin] - 1,
                               .x = tile->x + begin,
                               .y = tile->y + row,
                               .count = (uint32_t)(end - begin),
                               .pixels = frame->color ? (uint32_t *)(void *)frame->color + pixel : NULL};
        covered += run->count;
        resolve_run(r, run, pixel);
        r->run_count += frame->color != NULL;
    }
    return covered;
}

uint32_t zr_resolve_tile(const struct zr_geometry *geometry, const struct zr_paint *paint, zr_vec4 background,
                         const struct zr_tile *tile, const struct zr_frame *frame)
{
    uint32_t nothing = zr_color_pack(zr_color_byte(background.x), zr_color_byte(background.y),
                                     zr_color_byte(background.z), zr_color_byte(background.w));
    if (tile->is_empty) {
        size_t pixel = pixel_of_row(frame, tile, 0);
        resolve_nothing(frame, paint, nothing, pixel, tile->width, tile->height);
        if (frame->window_depth)
            paint->fill(frame->window_depth + pixel, ONE_BITS, tile->width, tile->height, -(ptrdiff_t)frame->width);
        return 0;
    }
    struct resolver resolver;
    resolver.geometry = geometry;
    resolver.frame = frame;
    resolver.paint = paint;
    resolver.batch = &geometry->batches[0];
    resolver.run_count = 0;
    for (int i = 0; frame->depth && i < SURFACES; i++)
        resolver.surfaces[i].owner = 0;
    uint32_t covered = 0;
    for (int32_t row = 0; row < tile->height; row++) {
        if (resolver.run_count > RUNS - ZR_TILE_SIZE) paint_runs(&resolver);
        covered += resolve_row(&resolver, tile, row, nothing);
    }
    paint_runs(&resolver);
    return covered;
}
