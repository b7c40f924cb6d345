/* Draws all views of a request, a few at once, and hands them on in order. */
#include <math.h>

#include "base/run.h"
#include "mesh/mesh_tables.h"
#include "render/frame_parts.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "views/view_scene.h"

enum { AT_ONCE = 16 };

/* ---- one view ---- */

struct drawing {
    struct zr_arena arena; /* of its scene and frame */
    struct zr_arena out;   /* of its files */
    enum zr_status status;
    struct zr_error error;
    struct zr_files files;
    const struct zr_frame *frame;
};

struct batch {
    const struct zr_run *run;
    const struct zr_views *views;
    uint32_t first;
    uint32_t width; /* drawn at once */
    struct drawing *drawings;
    struct zr_views_taker taker;
};

static void draw(const struct batch *batch, uint32_t number, struct drawing *d)
{
    const struct zr_scene *scene;
    struct zr_error faults = {0};
    const struct zr_run own = zr_run_in(batch->run, &d->arena);
    const struct zr_run reading = zr_run_reporting(&own, &d->error), drawing = zr_run_reporting(&own, &faults);
    const struct zr_run encoding = zr_run_in(&drawing, &d->out);
    zr_arena_reset(&d->arena, SIZE_MAX);
    zr_arena_reset(&d->out, SIZE_MAX);
    d->error = (struct zr_error){0};
    d->status = zr_view_scene(&reading, batch->views, number, &scene);
    if (d->status != ZR_OK) return;
    d->status = zr_render(&drawing, scene, NULL, &d->frame);
    if (d->status == ZR_OK && !zr_arena_charge(&d->out, d->arena.held)) d->status = ZR_NO_MEMORY;
    if (d->status == ZR_OK) d->status = zr_encode_files(&encoding, scene, d->frame, NULL, &d->files);
    if (d->status != ZR_OK) zr_view_report(batch->views, number, d->status, &faults, &d->error);
}

static void draw_some(void *context, size_t begin, size_t end)
{
    const struct batch *batch = context;
    for (; begin < end; begin++)
        draw(batch, batch->first + (uint32_t)begin, &batch->drawings[begin]);
}

/* ---- all views ---- */

/* Returns the memory of a drawing to the system. */
static void drop(struct drawing *d)
{
    zr_arena_free(&d->arena);
    zr_arena_free(&d->out);
}

/* Draws a view again, alone, with the memory of the whole batch: its share was too small. */
static void draw_alone(struct batch *batch, uint32_t number)
{
    const uint32_t width = batch->width;
    struct drawing *d = &batch->drawings[number];
    const size_t share = d->arena.ceiling;
    for (uint32_t i = 0; i < width; i++)
        drop(&batch->drawings[i]);
    for (uint32_t i = number + 1; i < width; i++)
        batch->drawings[i].status = ZR_NO_MEMORY; /* lost */
    d->arena.ceiling = d->out.ceiling = share * width;
    draw(batch, batch->first + number, d);
    d->arena.ceiling = d->out.ceiling = share;
}

size_t zr_drawn_view_shrink(void *memory)
{
    const struct batch *batch = memory;
    size_t held = zr_arena_bytes(batch->run->arena);
    for (uint32_t i = 0; i < batch->width; i++) {
        struct drawing *d = &batch->drawings[i];
        zr_arena_free(&d->arena);
        held += zr_arena_bytes(&d->out);
    }
    return held;
}

static enum zr_status hand_on(struct batch *batch, uint32_t number, const struct drawing *d)
{
    char name[ZR_VIEW_NAME_SIZE];
    zr_view_name(batch->views->set, number, name);
    const struct zr_drawn_view view = {number, name, &d->files, d->frame, batch};
    const enum zr_status status = batch->taker.take(batch->taker.context, &view, batch->run->error);
    const struct zr_views *views = batch->views;
    if (status == ZR_OK && views->progress) views->progress(views->progress_context, number + 1, views->set->count);
    return status;
}

static enum zr_status take_batch(struct batch *batch, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct drawing *d = &batch->drawings[i];
        if (d->status == ZR_NO_MEMORY && batch->width > 1) draw_alone(batch, i);
        enum zr_status status = d->status;
        for (size_t k = 0; k < zr_error_held(&d->error); k++)
            zr_error_add(batch->run->error, status, d->error.items[k].pointer, "%s", d->error.items[k].detail);
        if (status == ZR_NO_MEMORY) /* fails, for the caller */
            zr_arena_charge(batch->run->arena, zr_arena_left(batch->run->arena) + 1);
        if (status == ZR_OK) status = hand_on(batch, batch->first + i, d);
        if (status != ZR_OK) return status;
        if (d->out.held > d->out.ceiling) drop(&batch->drawings[i]); /* was drawn alone */
    }
    return ZR_OK;
}

/* Views drawn at once: one for each thread, as far as they fit into half of `memory`, and into the bytes that the taker
 * allows, by their predicted size. More of them would touch more memory, which the system clears first. Whether a view
 * fits does not depend on this number. */
static uint32_t find_width(const struct zr_views *views, struct zr_team *team, size_t memory, size_t most_bytes)
{
    const double half = 0.5 * (double)memory, room = most_bytes ? fmin(half, (double)most_bytes) : half;
    const double fit = room / fmax(views->cost.window_bytes, 1.0);
    const uint32_t threads = (uint32_t)zr_team_size(team), limit = threads < AT_ONCE ? threads : AT_ONCE;
    const uint32_t most = views->set->count < limit ? views->set->count : limit;
    return fit >= (double)most ? most : fit < 1.0 ? 1 : (uint32_t)fit;
}

static enum zr_status draw_all(struct batch *batch)
{
    const uint32_t width = batch->width;
    const uint32_t count = batch->views->set->count;
    enum zr_status status = ZR_OK;
    for (; status == ZR_OK && batch->first < count; batch->first += width) {
        const uint32_t now = count - batch->first < width ? count - batch->first : width;
        zr_team_ranges(batch->run->team, now, 1, draw_some, batch);
        status = take_batch(batch, now);
    }
    return status;
}

static enum zr_status make_tables(const struct zr_run *run, struct zr_views *views)
{
    views->tables = views->scene->tables;
    if (views->tables) return ZR_OK; /* of a kept scene */
    struct zr_mesh_tables *tables = zr_arena_alloc(run->arena, 1, sizeof *tables);
    views->tables = tables;
    return tables ? zr_mesh_tables_make(run, views->scene, tables) : ZR_NO_MEMORY;
}

/* Measures the parts for all views that share them. */
static enum zr_status make_parts(const struct zr_run *run, struct zr_views *views)
{
    views->known_parts = NULL;
    if (!views->shares_parts) return ZR_OK;
    struct zr_known_parts *parts = zr_arena_alloc(run->arena, 1, sizeof *parts);
    if (!parts) return ZR_NO_MEMORY;
    views->known_parts = parts;
    return zr_known_parts_make(run, views->scene, parts);
}

enum zr_status zr_views_draw_each(const struct zr_run *run, struct zr_views *views, struct zr_views_taker taker)
{
    enum zr_status status = make_tables(run, views);
    if (status == ZR_OK) status = make_parts(run, views);
    if (status != ZR_OK) return status;
    const size_t memory = zr_arena_left(run->arena) / 2;
    const uint32_t width = find_width(views, run->team, memory, taker.most_bytes);
    const size_t share = memory / width;
    struct batch batch = {
        .run = run,
        .views = views,
        .width = width,
        .taker = taker,
    };
    batch.drawings = zr_arena_zero(run->arena, width, sizeof *batch.drawings);
    if (!batch.drawings || !zr_arena_charge(run->arena, share * width)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < width; i++) {
        zr_arena_init(&batch.drawings[i].arena, share);
        zr_arena_init(&batch.drawings[i].out, share);
        batch.drawings[i].arena.whole = batch.drawings[i].out.whole = run->arena->ceiling;
    }
    status = draw_all(&batch);
    for (uint32_t i = 0; i < width; i++)
        drop(&batch.drawings[i]);
    zr_arena_refund(run->arena, share * width);
    return status;
}
