/* Draws all views of a request, a few at once, and collects their files. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/mesh_tables.h"
#include "output/apng.h"
#include "output/npy.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "views/sheet_picture.h"
#include "views/view_scene.h"

enum { AT_ONCE = 16 };

/* ---- one view ---- */

struct drawing {
    struct zr_arena arena; /* of its scene, frame and files */
    enum zr_status status;
    struct zr_error error;
    struct zr_files files;
    const struct zr_frame *frame;
};

struct batch {
    const struct zr_views *views;
    struct zr_team *team;
    const struct zr_cancel *cancel;
    uint32_t first;
    struct drawing *drawings;
};

static void draw(const struct batch *batch, uint32_t number, struct drawing *d)
{
    const struct zr_scene *scene;
    struct zr_error faults = {0};
    zr_arena_reset(&d->arena, SIZE_MAX);
    d->error = (struct zr_error){0};
    d->status = zr_view_scene(batch->views, number, &d->arena, batch->team, batch->cancel, &scene, &d->error);
    if (d->status != ZR_OK) return;
    d->status = zr_render(&d->arena, batch->team, scene, NULL, batch->cancel, &d->frame, &faults);
    if (d->status == ZR_OK)
        d->status = zr_encode_files(&d->arena, batch->team, scene, d->frame, NULL, batch->cancel, &d->files, &faults);
    if (d->status != ZR_OK) zr_view_report(batch->views, number, d->status, &faults, &d->error);
}

static void draw_some(void *context, size_t begin, size_t end)
{
    const struct batch *batch = context;
    for (; begin < end; begin++)
        draw(batch, batch->first + (uint32_t)begin, &batch->drawings[begin]);
}

/* ---- files ---- */

/* Files of one output of all views. */
struct sink {
    const struct zr_output *output;
    enum { EACH, STACK, ANIMATION, SHEET, SHEET_INFO } kind;
    struct zr_buffer out;
    struct zr_apng apng;
};

struct collecting {
    struct zr_arena *arena;
    const struct zr_views *views;
    struct zr_team *team;
    const struct zr_cancel *cancel;
    struct sink *sinks;
    struct zr_sheet_picture sheet;
    struct zr_files *files;
    struct zr_error *error;
};

static bool add_file(struct collecting *c, const char *name, const void *bytes, size_t size, const char *type)
{
    struct zr_files *files = c->files;
    const char *copied = zr_arena_copy(c->arena, name, strlen(name) + 1);
    if (!copied) return false;
    files->entries[files->count] = (struct zr_zip_entry){copied, bytes, size};
    files->types[files->count++] = type;
    return true;
}

/* Appends the rows of an array. */
static enum zr_status add_rows(struct sink *sink, const struct zr_zip_entry *entry)
{
    const bool is_added =
        zr_buffer_add(&sink->out, (const char *)entry->bytes + ZR_NPY_HEADER, entry->size - ZR_NPY_HEADER);
    return is_added ? ZR_OK : ZR_NO_MEMORY;
}

static enum zr_status add_frame(struct collecting *c, struct sink *sink, uint32_t number,
                                const struct zr_zip_entry *entry)
{
    const enum zr_status status = zr_apng_add(&sink->apng, entry->bytes, entry->size);
    if (status != ZR_BAD_SCENE) return status;
    struct zr_error fault = {0};
    zr_error_add(&fault, status, NULL,
                 "another size than view 0, or an opaque background where that has none: frames of an apng are alike");
    return zr_view_report(c->views, number, status, &fault, c->error);
}

/* Takes the files of a view out of its arena. */
static enum zr_status take_files(struct collecting *c, uint32_t number, const struct zr_files *files)
{
    char view[ZR_VIEW_NAME_SIZE], name[ZR_VIEW_NAME_SIZE + 64];
    zr_view_name(c->views->set, number, view);
    for (uint32_t i = 0; i < files->count; i++) {
        const struct zr_zip_entry *entry = &files->entries[i];
        struct sink *sink = &c->sinks[i];
        enum zr_status status = ZR_OK;
        const void *copy;
        switch (sink->kind) {
        case EACH:
            copy = zr_arena_copy(c->arena, entry->bytes, entry->size);
            snprintf(name, sizeof name, "%s.%s", view, entry->name);
            if (!copy || !add_file(c, name, copy, entry->size, files->types[i])) status = ZR_NO_MEMORY;
            break;
        case STACK:
            status = add_rows(sink, entry);
            break;
        case ANIMATION:
            status = add_frame(c, sink, number, entry);
            break;
        case SHEET_INFO:
            if (number == 0 && !zr_buffer_add(&sink->out, entry->bytes, entry->size)) status = ZR_NO_MEMORY;
            break;
        case SHEET:
            break;
        }
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}

/* Notes the encoders of the first view that has some: views differ in qualities at most. */
static bool take_encoders(struct collecting *c, const char *encoders)
{
    if (*c->files->encoders || !encoders || !*encoders) return true;
    c->files->encoders = zr_arena_copy(c->arena, encoders, strlen(encoders) + 1);
    return c->files->encoders != NULL;
}

/* Adds warnings that no earlier view has. */
static void take_warnings(struct collecting *c, const struct zr_warning_list *warnings)
{
    struct zr_warning_list *all = &c->files->warnings;
    for (size_t i = 0; i < warnings->count; i++) {
        size_t k = 0;
        while (k < all->count && strcmp(all->texts[k], warnings->texts[i]) != 0)
            k++;
        if (k == all->count) zr_warning_list_add(c->arena, all, "%s", warnings->texts[i]);
    }
}

static enum zr_status open_sink(struct collecting *c, const struct zr_output *output, struct sink *sink)
{
    const struct zr_view_set *set = c->views->set;
    const struct zr_channel_row *row = &zr_channel_rows[output->channel];
    *sink = (struct sink){.output = output, .out = {.arena = c->arena}};
    if (c->views->scene->sheet.is_on && output->channel == ZR_CHANNEL_COLOR)
        sink->kind = SHEET;
    else if (c->views->scene->sheet.is_on && output->channel == ZR_CHANNEL_INFO)
        sink->kind = SHEET_INFO;
    else if (output->encoding == ZR_ENCODING_NPY && c->views->has_one_window)
        sink->kind = STACK;
    else if (output->encoding == ZR_ENCODING_APNG)
        sink->kind = ANIMATION;
    sink->apng = (struct zr_apng){.out = &sink->out, .frames = set->count, .seconds = 1.0};
    if (set->seconds > 0.0) sink->apng.seconds = set->seconds / set->count;
    if (sink->kind != STACK) return ZR_OK;
    const size_t shape[] = {set->count, c->views->height, c->views->width, row->words};
    if (!zr_buffer_room(&sink->out, ZR_NPY_HEADER + 4 * shape[0] * shape[1] * shape[2] * shape[3])) return ZR_NO_MEMORY;
    return zr_npy_begin(row->values == ZR_VALUES_UINT32 ? ZR_NPY_UINT32 : ZR_NPY_FLOAT32, shape, row->words > 1 ? 4 : 3,
                        &sink->out);
}

static enum zr_status open_files(struct collecting *c)
{
    const struct zr_view *view = &c->views->scene->views[0];
    const size_t most = (size_t)c->views->set->count * view->output_count;
    static char empty[1];
    enum zr_status status = ZR_OK;
    *c->files = (struct zr_files){.entries = zr_arena_alloc(c->arena, most, sizeof *c->files->entries),
                                  .types = zr_arena_alloc(c->arena, most, sizeof *c->files->types),
                                  .encoders = empty};
    c->sinks = zr_arena_alloc(c->arena, view->output_count, sizeof *c->sinks);
    if (!c->files->entries || !c->files->types || !c->sinks) return ZR_NO_MEMORY;
    for (uint32_t i = 0; status == ZR_OK && i < view->output_count; i++)
        status = open_sink(c, &view->outputs[i], &c->sinks[i]);
    if (status == ZR_OK && c->views->scene->sheet.is_on) status = zr_sheet_picture_make(c->arena, c->views, &c->sheet);
    return status;
}

static enum zr_status close_sheet(struct collecting *c, uint32_t number)
{
    struct zr_files files;
    const enum zr_status status =
        zr_sheet_picture_encode(&c->sheet, number, c->arena, c->team, c->cancel, &files, c->error);
    if (status != ZR_OK) return status;
    const struct zr_zip_entry *entry = &files.entries[0];
    if (!take_encoders(c, files.encoders)) return ZR_NO_MEMORY;
    return add_file(c, entry->name, entry->bytes, entry->size, files.types[0]) ? ZR_OK : ZR_NO_MEMORY;
}

/* Adds the files that all views have together. */
static enum zr_status close_files(struct collecting *c)
{
    char name[64];
    for (uint32_t i = 0; i < c->views->scene->views[0].output_count; i++) {
        struct sink *sink = &c->sinks[i];
        enum zr_status status = ZR_OK;
        if (sink->kind == EACH) continue;
        if (sink->kind == SHEET_INFO) status = zr_sheet_info_add(&c->sheet, &sink->out);
        if (sink->kind == SHEET) status = close_sheet(c, i);
        if (status != ZR_OK) return status;
        if (sink->kind == SHEET) continue;
        const struct zr_file_kind *kind = &zr_file_kinds[sink->output->encoding];
        snprintf(name, sizeof name, "%s.%s", zr_channel_rows[sink->output->channel].name, kind->extension);
        if (!add_file(c, name, sink->out.bytes, sink->out.size, kind->type)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}

/* ---- all views ---- */

/* Draws a view again, alone, with the memory of the whole batch: its share was too small. */
static void draw_alone(struct batch *batch, uint32_t number, uint32_t width)
{
    struct drawing *d = &batch->drawings[number];
    const size_t share = d->arena.ceiling;
    for (uint32_t i = 0; i < width; i++)
        zr_arena_reset(&batch->drawings[i].arena, 0);
    for (uint32_t i = number + 1; i < width; i++)
        batch->drawings[i].status = ZR_NO_MEMORY; /* lost */
    d->arena.ceiling = share * width;
    draw(batch, batch->first + number, d);
    d->arena.ceiling = share;
}

static enum zr_status take_batch(struct collecting *c, struct batch *batch, uint32_t count, uint32_t width)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct drawing *d = &batch->drawings[i];
        if (d->status == ZR_NO_MEMORY && width > 1) draw_alone(batch, i, width);
        enum zr_status status = d->status;
        for (size_t k = 0; k < zr_error_held(&d->error); k++)
            zr_error_add(c->error, status, d->error.items[k].pointer, "%s", d->error.items[k].detail);
        if (status == ZR_NO_MEMORY) zr_arena_charge(c->arena, zr_arena_left(c->arena) + 1); /* fails, for the caller */
        if (status == ZR_OK) status = take_files(c, batch->first + i, &d->files);
        if (status != ZR_OK) return status;
        if (!take_encoders(c, d->files.encoders)) return ZR_NO_MEMORY;
        if (c->views->scene->sheet.is_on) zr_sheet_picture_add(&c->sheet, batch->first + i, d->frame);
        take_warnings(c, &d->files.warnings);
        if (d->arena.held > d->arena.ceiling) zr_arena_reset(&batch->drawings[i].arena, 0); /* was drawn alone */
    }
    return ZR_OK;
}

/* Views drawn at once: one for each thread, as far as they fit into half of `memory`, by their predicted size. More of
 * them would touch more memory, which the system clears first. Whether a view fits does not depend on this number. */
static uint32_t find_width(const struct zr_views *views, struct zr_team *team, size_t memory)
{
    const double fit = 0.5 * (double)memory / fmax(views->cost.window_bytes, 1.0);
    const uint32_t threads = (uint32_t)zr_team_size(team), limit = threads < AT_ONCE ? threads : AT_ONCE;
    const uint32_t most = views->set->count < limit ? views->set->count : limit;
    return fit >= (double)most ? most : fit < 1.0 ? 1 : (uint32_t)fit;
}

static enum zr_status draw_all(struct collecting *c, struct batch *batch, uint32_t width)
{
    const uint32_t count = c->views->set->count;
    enum zr_status status = open_files(c);
    for (; status == ZR_OK && batch->first < count; batch->first += width) {
        const uint32_t now = count - batch->first < width ? count - batch->first : width;
        zr_team_ranges(batch->team, now, 1, draw_some, batch);
        status = take_batch(c, batch, now, width);
    }
    return status == ZR_OK ? close_files(c) : status;
}

static enum zr_status make_tables(struct zr_arena *arena, struct zr_team *team, struct zr_views *views,
                                  const struct zr_cancel *cancel)
{
    struct zr_mesh_tables *tables = zr_arena_alloc(arena, 1, sizeof *tables);
    views->tables = tables;
    return tables ? zr_mesh_tables_make(arena, team, views->scene, cancel, tables) : ZR_NO_MEMORY;
}

enum zr_status zr_views_draw(struct zr_arena *arena, struct zr_team *team, struct zr_views *views,
                             const struct zr_cancel *cancel, struct zr_files *files, struct zr_error *error)
{
    enum zr_status status = make_tables(arena, team, views, cancel);
    if (status != ZR_OK) return status;
    const size_t memory = zr_arena_left(arena) / 2;
    const uint32_t width = find_width(views, team, memory);
    const size_t share = memory / width;
    struct batch batch = {.views = views, .team = team, .cancel = cancel};
    struct collecting collecting = {
        .arena = arena, .team = team, .cancel = cancel, .views = views, .files = files, .error = error};
    batch.drawings = zr_arena_zero(arena, width, sizeof *batch.drawings);
    if (!batch.drawings || !zr_arena_charge(arena, share * width)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < width; i++)
        zr_arena_init(&batch.drawings[i].arena, share);
    status = draw_all(&collecting, &batch, width);
    for (uint32_t i = 0; i < width; i++)
        zr_arena_free(&batch.drawings[i].arena);
    zr_arena_refund(arena, share * width);
    return status;
}
