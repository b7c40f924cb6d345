#include "api/picture.h"

#include <stdlib.h>
#include <string.h>

#include "api/cancel.h"
#include "api/error.h"
#include "base/run.h"
#include "scene/looks.h"
#include "scene/output.h"
#include "scene/validate.h"
#include "views/views.h"

/* ---- drawing ---- */

static bool keep_results(zraster_picture *picture, const struct zr_scene *scene, const struct zr_frame *frame)
{
    struct zr_arena *arena = picture->arena;
    struct zr_look_pin *pin = zr_arena_alloc(arena, 1, sizeof *pin);
    picture->encode_input = zr_encode_input_make(arena, scene, frame);
    if (!pin || !picture->encode_input) return false;
    *pin = zr_look_pin_of(scene->look);
    picture->look = pin->text;
    picture->warnings = zr_warnings_list(arena, &picture->encode_input->warnings, 0);
    return zr_arena_ok(arena);
}

/* Returns the run of steps whose results go to `arena`. */
static struct zr_run run_of(const zraster_picture *picture, struct zr_arena *arena, struct zr_arena *scratch,
                            struct zr_error *error)
{
    return (struct zr_run){arena, scratch, zr_renderer_team(picture->renderer), zr_cancel_flag(picture->cancel), error};
}

static enum zr_status draw(zraster_picture *picture, const struct zr_scene *scene, size_t scene_bytes,
                           struct zr_error *error)
{
    const struct zr_frame *frame;
    struct zr_arena *scratch = zr_renderer_take(picture->renderer, ZR_ARENA_SCRATCH, scene_bytes);
    if (!scratch) return ZR_NO_MEMORY;
    const struct zr_run run = run_of(picture, picture->arena, scratch, error);
    enum zr_status status = zr_render_apart(&run, scene, NULL, &frame);
    if (status == ZR_OK && !keep_results(picture, scene, frame)) status = ZR_NO_MEMORY;
    zr_renderer_give(picture->renderer, scratch, ZR_ARENA_SCRATCH);
    if (status == ZR_OK) status = zr_strict_check(scene, picture->warnings.texts, picture->warnings.count, error);
    return status;
}

/* Makes a picture without contents. NULL without memory. */
static zraster_picture *open_picture(zraster *renderer, zraster_cancel *cancel)
{
    zraster_picture *picture = calloc(1, sizeof *picture);
    if (!picture) return NULL;
    picture->renderer = zr_renderer_use(renderer);
    picture->cancel = zr_cancel_use(cancel);
    picture->arena = zr_renderer_take(renderer, ZR_ARENA_RESULT, 0);
    if (picture->arena) return picture;
    zraster_picture_free(picture);
    return NULL;
}

static enum zr_status close_picture(enum zr_status status, zraster_picture *picture, zraster_picture **out)
{
    if (status == ZR_OK)
        *out = picture;
    else
        zraster_picture_free(picture);
    return status;
}

enum zr_status zr_picture_make(zraster *renderer, const struct zr_scene *scene, size_t scene_bytes,
                               zraster_cancel *cancel, zraster_picture **out, struct zr_error *error)
{
    zraster_picture *picture = open_picture(renderer, cancel);
    return picture ? close_picture(draw(picture, scene, scene_bytes, error), picture, out) : ZR_NO_MEMORY;
}

static enum zr_status draw_views(zraster_picture *picture, struct zr_views *views, struct zr_error *error)
{
    const struct zr_run run = run_of(picture, picture->arena, NULL, error);
    struct zr_look_pin *pin = zr_arena_alloc(picture->arena, 1, sizeof *pin);
    struct zr_files files;
    enum zr_status status = pin ? zr_views_plan(&run, views) : ZR_NO_MEMORY;
    if (status == ZR_OK) status = zr_views_draw(&run, views, &files);
    if (status != ZR_OK) return status;
    *pin = zr_look_pin_of(views->scene->look);
    picture->look = pin->text;
    picture->files = files;
    picture->warnings = files.warnings;
    return ZR_OK;
}

enum zr_status zr_picture_make_views(zraster *renderer, struct zr_views *views, zraster_cancel *cancel,
                                     zraster_picture **out, struct zr_error *error)
{
    zraster_picture *picture = open_picture(renderer, cancel);
    return picture ? close_picture(draw_views(picture, views, error), picture, out) : ZR_NO_MEMORY;
}

size_t zraster_picture_memory(const zraster_picture *picture)
{
    return picture ? picture->arena->held + picture->arena->spare_bytes : 0;
}

void zraster_picture_free(zraster_picture *picture)
{
    if (!picture) return;
    zr_renderer_give(picture->renderer, picture->arena, ZR_ARENA_RESULT);
    zraster_cancel_free(picture->cancel);
    zraster_close(picture->renderer);
    free(picture);
}

/* ---- channels and warnings ---- */

static const struct zr_view *view_of(const zraster_picture *picture)
{
    return picture->encode_input->frame.view;
}

int zraster_picture_channel(const zraster_picture *picture, const char *channel, struct zraster_array *array)
{
    static const uint32_t types[] = {
        [ZR_VALUES_RGBA] = ZRASTER_U1, [ZR_VALUES_FLOAT32] = ZRASTER_F4, [ZR_VALUES_UINT32] = ZRASTER_U4};
    int number = 0;
    *array = (struct zraster_array){.data = NULL};
    if (!picture->encode_input) return 0;
    const struct zr_frame *frame = &picture->encode_input->frame;
    while (number < ZR_CHANNEL_COUNT && strcmp(zr_channel_rows[number].name, channel) != 0)
        number++;
    if (number == ZR_CHANNEL_COUNT || !frame->channels[number] ||
        !zr_view_wants(view_of(picture), (enum zr_channel)number))
        return 0;
    const struct zr_channel_row *row = &zr_channel_rows[number];
    const size_t last = row->values == ZR_VALUES_RGBA ? 4 : row->words;
    *array = (struct zraster_array){.data = frame->channels[number],
                                    .type = types[row->values],
                                    .ndim = last > 1 ? 3 : 2,
                                    .shape = {frame->height, frame->width, last > 1 ? last : 0}};
    return 1;
}

int zraster_picture_has_alpha(const zraster_picture *picture)
{
    return picture->encode_input && picture->encode_input->scene.background.w < 1.0f;
}

const char *zraster_picture_look(const zraster_picture *picture)
{
    return picture->look;
}

const char *zraster_picture_warning(const zraster_picture *picture, size_t i)
{
    return i < picture->warnings.count ? picture->warnings.texts[i] : NULL;
}

/* ---- files ---- */

/* Copies the files out of the scratch memory of their encoding. */
static enum zr_status keep_files(zraster_picture *picture, const struct zr_files *files)
{
    struct zr_arena *arena = picture->arena;
    struct zr_zip_entry *entries = zr_arena_alloc(arena, files->count, sizeof *entries);
    const char **types = zr_arena_alloc(arena, files->count, sizeof *types);
    struct zr_warning_list warnings = {.count = 0};
    for (uint32_t i = 0; entries && types && i < files->count; i++) {
        const struct zr_zip_entry *entry = &files->entries[i];
        entries[i].name = zr_arena_copy(arena, entry->name, strlen(entry->name) + 1);
        entries[i].bytes = zr_arena_copy(arena, entry->bytes, entry->size);
        entries[i].size = entry->size;
        types[i] = files->types[i];
    }
    zr_warning_list_append(arena, &warnings, &files->warnings);
    const char *encoders = zr_arena_copy(arena, files->encoders, strlen(files->encoders) + 1);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    picture->warnings = warnings;
    picture->files = (struct zr_files){files->count, entries, types, warnings, encoders};
    return ZR_OK;
}

static enum zr_status encode(zraster_picture *picture, struct zr_error *error)
{
    const struct zr_encode_input *encode_input = picture->encode_input;
    struct zr_files files;
    struct zr_arena *scratch = zr_renderer_take(picture->renderer, ZR_ARENA_SCRATCH, 0);
    if (!scratch) return ZR_NO_MEMORY;
    const struct zr_run run = run_of(picture, scratch, NULL, error);
    enum zr_status status =
        zr_encode_files(&run, &encode_input->scene, &encode_input->frame, &encode_input->warnings, &files);
    if (status == ZR_OK) status = keep_files(picture, &files);
    zr_renderer_give(picture->renderer, scratch, ZR_ARENA_SCRATCH);
    return status;
}

static enum zr_status join(zraster_picture *picture, struct zr_error *error)
{
    struct zr_answer answer;
    if (picture->joined.data) return ZR_OK;
    const enum zr_status status = zr_files_join(picture->arena, &picture->files, &answer, error);
    if (status == ZR_OK) picture->joined = (struct zraster_bytes){answer.bytes, answer.size, answer.content_type};
    return status;
}

static bool is_file_of(const char *file, const char *channel)
{
    const size_t length = strlen(channel);
    return strncmp(file, channel, length) == 0 && file[length] == '.';
}

/* True for the channel of "top.color.png", the only file of several views. */
static bool is_only_file_of(const zraster_picture *picture, const char *channel)
{
    const char *at = picture->files.count == 1 ? strchr(picture->files.entries->name, '.') : NULL;
    while (at && !is_file_of(at + 1, channel))
        at = strchr(at + 1, '.');
    return at;
}

/* Finds the file of "depth" or "depth.npy". */
static enum zr_status find_file(const zraster_picture *picture, const char *name, struct zraster_bytes *bytes,
                                struct zr_error *error)
{
    for (uint32_t i = 0; i < picture->files.count; i++) {
        const struct zr_zip_entry *entry = &picture->files.entries[i];
        if (!is_file_of(entry->name, name) && strcmp(entry->name, name) != 0 && !is_only_file_of(picture, name))
            continue;
        *bytes = (struct zraster_bytes){entry->bytes, entry->size, picture->files.types[i]};
        return ZR_OK;
    }
    return zr_error_add(error, ZR_BAD_REQUEST, NULL, "no output is named '%.60s'", name);
}

zraster_status zraster_picture_encode(zraster_picture *picture, const char *channel, struct zraster_bytes *bytes,
                                      zraster_error **error)
{
    struct zr_error faults = {0};
    enum zr_status status = ZR_OK;
    *bytes = (struct zraster_bytes){.data = NULL};
    const locale_t before = zr_renderer_enter(picture->renderer);
    if (!picture->files.entries) status = encode(picture, &faults);
    if (status == ZR_OK && channel)
        status = find_file(picture, channel, bytes, &faults);
    else if (status == ZR_OK && (status = join(picture, &faults)) == ZR_OK)
        *bytes = picture->joined;
    zr_renderer_leave(before);
    return zr_error_give(status, &faults, error);
}
