/* Collects the files of all views: some each by itself, others joined. */
#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "output/images/apng.h"
#include "output/images/gif.h"
#include "output/images/webp_frames.h"
#include "output/npy.h"
#include "scene/output.h"
#include "scene/scene.h"
#include "views/sheet_picture.h"
#include "views/view_scene.h"

/* Files of one output of all views. */
struct sink {
    const struct zr_output *output;
    enum { EACH, STACK, APNG, WEBP, GIF, SHEET, SHEET_INFO } kind;
    struct zr_buffer out;
    struct zr_apng apng;
    struct zr_webp_frames webp;
    struct zr_gif_frames gif;
};

/* Number of views that have a warning, and the first of them. */
struct warned {
    uint32_t views, first;
};

struct collecting {
    const struct zr_run *run;
    const struct zr_views *views;
    struct sink *sinks;
    struct zr_sheet_picture sheet;
    struct zr_files *files;
    struct warned *warned; /* by warning of the files */
};

static bool add_file(struct collecting *c, const char *name, const void *bytes, size_t size, const char *type)
{
    struct zr_files *files = c->files;
    const char *copied = zr_arena_copy(c->run->arena, name, strlen(name) + 1);
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
    if (sink->kind == GIF) return zr_gif_frames_add(&sink->gif, entry->bytes, entry->size);
    const bool is_apng = sink->kind == APNG;
    const enum zr_status status = is_apng ? zr_apng_add(&sink->apng, entry->bytes, entry->size)
                                          : zr_webp_frames_add(&sink->webp, entry->bytes, entry->size);
    if (status != ZR_BAD_SCENE) return status;
    struct zr_error fault = {0};
    zr_error_add(
        &fault, status, NULL, "%s",
        is_apng ? "its size, or whether its background is opaque, differs from view 0: all frames of an apng must agree"
                : "with this frame, the webp has 4 GiB or more: a smaller window, fewer frames or less quality fit");
    return zr_view_report(c->views, number, status, &fault, c->run->error);
}

/* Takes the files of a view out of its arena. Views of a sheet without info have no file for its sink. */
static enum zr_status take_files(struct collecting *c, const struct zr_drawn_view *view)
{
    char name[ZR_VIEW_NAME_SIZE + 64];
    const struct zr_files *files = view->files;
    const bool has_info = zr_view_wants(view->frame->view, ZR_CHANNEL_INFO);
    struct sink *next = c->sinks;
    for (uint32_t i = 0; i < files->count; i++) {
        const struct zr_zip_entry *entry = &files->entries[i];
        while (next->kind == SHEET_INFO && !has_info)
            next++;
        struct sink *sink = next++;
        enum zr_status status = ZR_OK;
        const void *copy;
        switch (sink->kind) {
        case EACH:
            copy = zr_arena_copy(c->run->arena, entry->bytes, entry->size);
            snprintf(name, sizeof name, "%s.%s", view->name, entry->name);
            if (!copy || !add_file(c, name, copy, entry->size, files->types[i])) status = ZR_NO_MEMORY;
            break;
        case STACK:
            status = add_rows(sink, entry);
            break;
        case APNG:
        case WEBP:
        case GIF:
            status = add_frame(c, sink, view->number, entry);
            break;
        case SHEET_INFO:
            if (view->number == 0 && !zr_buffer_add(&sink->out, entry->bytes, entry->size)) status = ZR_NO_MEMORY;
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
    c->files->encoders = zr_arena_copy(c->run->arena, encoders, strlen(encoders) + 1);
    return c->files->encoders != NULL;
}

/* Adds warnings that no earlier view has. */
static void take_warnings(struct collecting *c, const struct zr_warning_list *warnings, uint32_t number)
{
    struct zr_warning_list *all = &c->files->warnings;
    for (size_t i = 0; i < warnings->count; i++) {
        size_t k = 0;
        while (k < all->count && strcmp(all->texts[k], warnings->texts[i]) != 0)
            k++;
        if (k == all->count) {
            struct warned *more = zr_arena_grow(c->run->arena, c->warned, k, k + 1, sizeof *more);
            if (!more) return;
            c->warned = more;
            c->warned[k] = (struct warned){0, number};
            zr_warning_list_add(c->run->arena, all, "%s", warnings->texts[i]);
        }
        if (k < all->count) c->warned[k].views++;
    }
}

/* Names the views of warnings that some views have, and others not. */
static void name_warnings(struct collecting *c)
{
    const struct zr_warning_list all = c->files->warnings;
    const uint32_t count = c->views->set->count;
    char name[ZR_VIEW_NAME_SIZE];
    c->files->warnings = (struct zr_warning_list){0};
    for (size_t i = 0; i < all.count; i++) {
        const struct warned *warned = &c->warned[i];
        zr_view_name(c->views->set, warned->first, name);
        if (warned->views == count)
            zr_warning_list_add(c->run->arena, &c->files->warnings, "%s", all.texts[i]);
        else if (warned->views == 1)
            zr_warning_list_add(c->run->arena, &c->files->warnings, "view %s: %s", name, all.texts[i]);
        else
            zr_warning_list_add(c->run->arena, &c->files->warnings, "%u of %u views, the first is %s: %s",
                                warned->views, count, name, all.texts[i]);
    }
}

static enum zr_status open_sink(struct collecting *c, const struct zr_output *output, struct sink *sink)
{
    const struct zr_view_set *set = c->views->set;
    const struct zr_channel_row *row = &zr_channel_rows[output->channel];
    *sink = (struct sink){.output = output, .out = {.arena = c->run->arena}};
    if (c->views->scene->sheet.is_on && output->channel == ZR_CHANNEL_COLOR)
        sink->kind = SHEET;
    else if (c->views->scene->sheet.is_on && output->channel == ZR_CHANNEL_INFO)
        sink->kind = SHEET_INFO;
    else if (output->encoding == ZR_ENCODING_NPY && c->views->has_one_window)
        sink->kind = STACK;
    else if (output->encoding == ZR_ENCODING_APNG)
        sink->kind = APNG;
    else if (output->encoding == ZR_ENCODING_WEBP && zr_view_set_has_times(set))
        sink->kind = WEBP;
    else if (output->encoding == ZR_ENCODING_GIF && zr_view_set_has_times(set))
        sink->kind = GIF;
    const double seconds = zr_view_set_has_times(set) ? set->seconds / set->count : 1.0;
    sink->gif = (struct zr_gif_frames){.out = &sink->out, .frames = set->count, .seconds = seconds};
    sink->apng = (struct zr_apng){.out = &sink->out, .frames = set->count, .seconds = seconds};
    sink->webp = (struct zr_webp_frames){.out = &sink->out,
                                         .frames = set->count,
                                         .seconds = seconds,
                                         .width = c->views->width,
                                         .height = c->views->height};
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
    enum zr_status status = ZR_OK;
    *c->files = (struct zr_files){.entries = zr_arena_alloc(c->run->arena, most, sizeof *c->files->entries),
                                  .types = zr_arena_alloc(c->run->arena, most, sizeof *c->files->types),
                                  .encoders = ""};
    c->sinks = zr_arena_alloc(c->run->arena, view->output_count, sizeof *c->sinks);
    if (!c->files->entries || !c->files->types || !c->sinks) return ZR_NO_MEMORY;
    for (uint32_t i = 0; status == ZR_OK && i < view->output_count; i++)
        status = open_sink(c, &view->outputs[i], &c->sinks[i]);
    if (status == ZR_OK && c->views->scene->sheet.is_on)
        status = zr_sheet_picture_make(c->run->arena, c->views, &c->sheet);
    return status;
}

static enum zr_status close_sheet(struct collecting *c, uint32_t number)
{
    struct zr_files files;
    const enum zr_status status = zr_sheet_picture_encode(c->run, &c->sheet, number, &files);
    if (status != ZR_OK) return status;
    const struct zr_zip_entry *entry = &files.entries[0];
    if (!take_encoders(c, files.encoders)) return ZR_NO_MEMORY;
    return add_file(c, entry->name, entry->bytes, entry->size, files.types[0]) ? ZR_OK : ZR_NO_MEMORY;
}

/* Adds the files that all views have together. */
static enum zr_status close_files(struct collecting *c)
{
    char name[64];
    name_warnings(c);
    for (uint32_t i = 0; i < c->views->scene->views[0].output_count; i++) {
        struct sink *sink = &c->sinks[i];
        enum zr_status status = ZR_OK;
        if (sink->kind == EACH) continue;
        if (sink->kind == SHEET_INFO) status = zr_sheet_info_add(&c->sheet, &sink->out);
        if (sink->kind == SHEET) status = close_sheet(c, i);
        if (status != ZR_OK) return status;
        if (sink->kind == SHEET) continue;
        const struct zr_encoding_row *row = &zr_encoding_rows[sink->output->encoding];
        snprintf(name, sizeof name, "%s.%s", zr_channel_rows[sink->output->channel].name, row->ending);
        if (!add_file(c, name, sink->out.bytes, sink->out.size, row->type)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}

static enum zr_status take(void *context, const struct zr_drawn_view *view, struct zr_error *error)
{
    struct collecting *c = context;
    enum zr_status status = view->number == 0 ? open_files(c) : ZR_OK;
    (void)error; /* that of *c */
    if (status == ZR_OK) status = take_files(c, view);
    if (status == ZR_OK && !take_encoders(c, view->files->encoders)) status = ZR_NO_MEMORY;
    if (status != ZR_OK) return status;
    if (c->views->scene->sheet.is_on) zr_sheet_picture_add(&c->sheet, view->number, view->frame);
    take_warnings(c, &view->files->warnings, view->number);
    return ZR_OK;
}

/* Refuses a number of bytes for an animated WebP, whose size is known after the last frame, and frames of a GIF that
 * browsers would slow down. */
static enum zr_status check_animation(const struct zr_views *views, struct zr_error *error)
{
    const struct zr_view *view = &views->scene->views[0];
    const double seconds = views->set->seconds / views->set->count;
    const bool is_animated = zr_view_set_has_times(views->set) && !views->scene->sheet.is_on;
    for (uint32_t i = 0; is_animated && i < view->output_count; i++) {
        char pointer[48];
        if (view->outputs[i].encoding == ZR_ENCODING_GIF && seconds < ZR_GIF_SECONDS_MIN - 1e-9) {
            snprintf(pointer, sizeof pointer, "/outputs/%u/encoding", i);
            return zr_error_add(error, ZR_BAD_SCENE, pointer,
                                "a gif shows each frame for %g seconds or more, but these have %g: fewer frames, more "
                                "seconds, or apng",
                                ZR_GIF_SECONDS_MIN, seconds);
        }
        if (view->outputs[i].encoding != ZR_ENCODING_WEBP || view->outputs[i].max_bytes == 0) continue;
        snprintf(pointer, sizeof pointer, "/outputs/%u/maxBytes", i);
        return zr_error_add(error, ZR_BAD_SCENE, pointer, "an animated webp has none: quality makes it smaller");
    }
    return ZR_OK;
}

enum zr_status zr_views_draw(const struct zr_run *run, struct zr_views *views, struct zr_files *files)
{
    struct collecting collecting = {
        .run = run,
        .views = views,
        .files = files,
    };
    const struct zr_views_taker taker = {take, &collecting, 0};
    enum zr_status status = check_animation(views, run->error);
    if (status == ZR_OK) status = zr_views_draw_each(run, views, taker);
    return status == ZR_OK ? close_files(&collecting) : status;
}
