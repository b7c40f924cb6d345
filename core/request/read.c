/* read.c - request: reads the query, then the body by the reader of its format, and checks the whole scene. */
#include "change.h"

#include <stdio.h>
#include <string.h>

#include "base/memory_error.h"
#include "base/run.h"
#include "geometry/geometry.h"
#include "input/formats/formats.h"
#include "input/formats/input.h"
#include "input/formats/sniff.h"
#include "input/images/image_record.h"
#include "input/model/kept_mesh.h"
#include "input/query/axis_colors.h"
#include "input/query/parameters.h"
#include "input/query/part_select.h"
#include "input/query/query_text.h"
#include "input/query/zip_body.h"
#include "input/root/change.h"
#include "input/scene/kept.h"
#include "input/text/text.h"
#include "mesh/mesh_tables.h"
#include "overlay/color_bar.h"
#include "render_request.h"
#include "request/csg_check.h"
#include "scene/camera/camera.h"
#include "scene/camera/view_set.h"
#include "scene/defaults.h"
#include "scene/parts/part_list.h"
#include "scene/scene_edit.h"
#include "scene/validate.h"

/* Bytes of a time as text, in microseconds, with its final zero. */
enum { ZR_TIME_SIZE = 24 };

/* False if the arena cannot hold the vertices that drawing keeps. Nodes can place a large mesh so often that a walk
 * over its points would take minutes; this check refuses such scenes first. */
static bool fits_memory(struct zr_arena *arena, const struct zr_scene *scene)
{
    uint64_t points = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        points += scene->meshes[scene->instances[i].mesh].position_count;
    const uint64_t point_bytes = sizeof(struct zr_window_vertex) + sizeof(struct zr_eye);
    if (points <= zr_arena_left(arena) / point_bytes) return true;
    return zr_arena_charge(arena,
                           points < SIZE_MAX / point_bytes ? (size_t)(points * point_bytes) : SIZE_MAX); /* fails */
}

/* Returns the number of bytes skipped. */
static size_t skip_byte_order_mark(struct zr_request *request)
{
    const size_t mark =
        zr_format_rows[request->format].is_binary ? 0 : zr_byte_order_mark(request->bytes, request->size);
    request->bytes += mark;
    request->size -= mark;
    return mark;
}

/* Moves the places of faults by `skipped` bytes. */
static void count_skipped(struct zr_error *error, size_t skipped)
{
    for (size_t i = 0; i < zr_error_held(error); i++)
        if (error->items[i].place != 0) error->items[i].place += skipped;
}

/* Adds a first item to *error if a body with a syntax error looks like another format than its content type. */
static enum zr_status name_bytes(const struct zr_request *request, enum zr_status status, struct zr_error *error)
{
    const struct zr_format_row *row = &zr_format_rows[request->format];
    if (status != ZR_BAD_SYNTAX || row->looks_so(request->bytes, request->size) ||
        zr_format_of_bytes(request->bytes, request->size) == request->format)
        return status;
    const char *words = zr_bytes_in_words(request->bytes, request->size);
    if (!words) return status;
    const struct zr_error all = *error;
    *error = (struct zr_error){0};
    zr_error_add(error, status, NULL, "the type is %s, but the body looks like %s", row->name, words);
    for (size_t i = 0; i < zr_error_held(&all); i++) {
        zr_error_add(error, status, all.items[i].pointer, "%s", all.items[i].detail);
        if (i + 1 < zr_error_held(error)) error->items[i + 1].place = all.items[i].place;
    }
    return status;
}

/* True for no bytes, or a few of white space only. */
static bool is_empty(const struct zr_request *request)
{
    enum { FEW = 64 };
    size_t i = 0;
    while (i < request->size && i < FEW && strchr(" \t\r\n", request->bytes[i]) && request->bytes[i])
        i++;
    return i == request->size;
}

/* Detects the format from the bytes if the request has no type. ZR_BAD_TYPE if none fits. */
static enum zr_status find_format(struct zr_request *request, struct zr_error *error)
{
    if (request->format != ZR_FORMAT_UNKNOWN) return ZR_OK;
    if (is_empty(request)) return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "the body is empty");
    request->format = zr_format_of_bytes(request->bytes, request->size);
    if (request->format != ZR_FORMAT_UNKNOWN) return ZR_OK;
    const char *words = zr_bytes_in_words(request->bytes, request->size);
    return zr_error_add(error, ZR_BAD_TYPE, NULL, "no type is given; the body looks like %s%snone of: %s",
                        words ? words : "", words ? ", which is " : "", zr_format_types_join().text);
}

/* All text is read as UTF-8. Clones without Git LFS have short texts in place of large files. */
static enum zr_status refuse_text(const struct zr_request *request, struct zr_error *error)
{
    const struct zr_format_row *row = &zr_format_rows[request->format];
    if (zr_is_lfs_pointer(request->bytes, request->size))
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "a pointer of Git LFS, not the file: git lfs pull fetches it");
    if (!zr_is_utf16(request->bytes, request->size)) return ZR_OK;
    if (row->is_binary && row->looks_so(request->bytes, request->size)) return ZR_OK;
    return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "the body is UTF-16 text; %s is read as UTF-8", row->name);
}

/* Validates the scene; faults of keys from the query have the names of their parameters. */
static enum zr_status validate(const struct zr_request *request, const struct zr_scene *scene,
                               const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_error faults = {0};
    const enum zr_status status = zr_scene_validate(scene, limits, &faults);
    zr_query_report(request, status, &faults, error);
    return status;
}

/* Adds the views of a sheet. */
static enum zr_status complete_sheet(const struct zr_request *request, struct zr_scene *scene, struct zr_error *error)
{
    struct zr_error faults = {0};
    const enum zr_status status = zr_sheet_complete(scene, &faults);
    zr_query_report(request, status, &faults, error);
    return status;
}

/* Leaves only the base colours of materials, if the scene wants that. Their readers have dropped the rest. */
static enum zr_status leave_material_colors(const struct zr_scene_builder *builder, struct zr_error *faults)
{
    struct zr_scene *scene = builder->scene;
    if (scene->parts.colors != ZR_COLORS_MATERIALS) return ZR_OK;
    if (scene->color_bar.is_on)
        return zr_error_add(faults, ZR_BAD_SCENE, "/colors",
                            "materials cannot be combined with colorBar: colours of scalars are left out");
    return zr_scene_drop_colors(builder->arena, scene) ? ZR_OK : ZR_NO_MEMORY;
}

/* Colours the scene by a coordinate, if the scene wants that, and then warns of the colour bar. */
static enum zr_status color_by_axis(struct zr_scene_builder *builder)
{
    struct zr_scene *scene = builder->scene;
    if (!zr_axis_colors_are_given(scene)) return ZR_OK;
    if (!zr_axis_colors_apply(builder)) return ZR_NO_MEMORY;
    zr_color_bar_warn(builder->arena, scene, &scene->views[0], &builder->warnings);
    scene->warnings = builder->warnings.texts;
    scene->warning_count = (uint32_t)builder->warnings.count;
    return ZR_OK;
}

/* Applies the keys of parts and colours to the scene. */
static enum zr_status edit_parts(const struct zr_request *request, struct zr_scene_builder *builder,
                                 struct zr_error *error)
{
    struct zr_error faults = {0};
    const bool has_parts = zr_part_keys_are_given(&builder->scene->parts) || builder->scene->sections.uncut_count > 0;
    enum zr_status status = leave_material_colors(builder, &faults);
    if (status == ZR_OK) status = color_by_axis(builder);
    if (status == ZR_OK && has_parts && !fits_memory(builder->arena, builder->scene)) return ZR_NO_MEMORY;
    if (status == ZR_OK && has_parts) status = zr_parts_apply(builder, &faults);
    if (status == ZR_OK && builder->scene->csg) status = zr_csg_check(builder, &faults);
    if (status == ZR_OK && has_parts) status = zr_parts_check_uncut(builder, &faults);
    if (status == ZR_BAD_SCENE) zr_query_report(request, status, &faults, error);
    return status;
}

/* Reads a model file that a scene names as a mesh. */
static enum zr_status read_model(struct zr_scene_builder *builder, const struct zr_request *request,
                                 const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_request body = *request;
    if (body.size == 0) return zr_error_add(error, ZR_BAD_SCENE, NULL, "the file is empty");
    body.format = zr_format_of_bytes(body.bytes, body.size);
    if (body.format == ZR_FORMAT_UNKNOWN && zr_stl_is_cut(body.bytes, body.size)) body.format = ZR_FORMAT_STL;
    if (body.format == ZR_FORMAT_UNKNOWN || body.format == ZR_FORMAT_ZIP || zr_format_rows[body.format].has_view) {
        const char *words = zr_bytes_in_words(body.bytes, body.size);
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "the file looks like %s; a mesh needs a model, such as %s or %s",
                            words ? words : "an unknown format", zr_format_rows[ZR_FORMAT_OBJ].name,
                            zr_format_rows[ZR_FORMAT_GLB].name);
    }
    skip_byte_order_mark(&body);
    return zr_format_rows[body.format].read(builder, &body, limits, error);
}

/* True if a mesh is read for this request alone, and its equal positions may be stored once. */
static bool shares_places(const struct zr_query *query, const struct zr_keeping *keeping)
{
    const bool is_kept = query->request->meshes.hash || (keeping && (keeping->from || !keeping->if_views));
    return !is_kept && zr_query_shares_places(query);
}

/* Reads the body, or takes the meshes of a kept scene and reads the changed keys. */
static enum zr_status read_body(struct zr_scene_builder *builder, const struct zr_request *request,
                                const struct zr_limits *limits, struct zr_error *error)
{
    const struct zr_format_row *format = &zr_format_rows[request->format];
    const struct zr_keeping *keeping = builder->keeping;
    if (keeping && keeping->from && !format->has_view)
        return zr_read_model_load(&keeping->from->bare, builder) ? ZR_OK : ZR_NO_MEMORY;
    if (format->has_view) return format->read(builder, request, limits, error);
    struct zr_assets_hash assets = {.is_made = false};
    struct zr_mesh_file file = {.builder = builder, .request = request, .limits = limits, .assets = &assets};
    if (zr_mesh_file_find(&file)) return ZR_OK;
    const enum zr_status status = zr_mesh_file_read(&file, format->read, error);
    if (status == ZR_OK && keeping && keeping->into) zr_read_model_save(&keeping->into->bare, builder);
    return status;
}

/* Counts the characters of the longest label of a part, for the room that a fitted view leaves. */
static void measure_labels(struct zr_arena *arena, struct zr_scene *scene)
{
    enum { PARTS_MAX = 1000, LETTERS_MAX = 30, MANY = 12, NUMBER_LETTERS = 4 };
    struct zr_annotate *annotate = &scene->views[0].annotate;
    if (!zr_annotate_has(annotate, ZR_ANNOTATE_LABELS)) return;
    const struct zr_part_list list = zr_part_list_make(arena, scene, PARTS_MAX);
    for (uint32_t i = 0; i < list.count; i++) {
        const uint32_t letters = (uint32_t)strnlen(list.at[i].name, LETTERS_MAX);
        if (letters > annotate->label_letters) annotate->label_letters = letters;
    }
    if (list.count > MANY) annotate->label_letters += NUMBER_LETTERS; /* of a table */
}

static enum zr_status read_scene(const struct zr_run *run, const struct zr_request *request,
                                 const struct zr_limits *limits, const struct zr_keeping *keeping,
                                 struct zr_scene *scene)
{
    struct zr_query query;
    zr_scene_defaults(scene);
    if (keeping && keeping->from) scene->tables = keeping->from->tables;
    struct zr_scene_builder builder = zr_scene_builder_open(run->arena, run->team, scene);
    builder.keeping = keeping;
    builder.read_model = read_model;
    enum zr_status status = zr_query_read(request, limits, &builder, &query, run->error);
    if (status != ZR_OK) return status;
    builder.shares_places = shares_places(&query, keeping);
    status = name_bytes(request, read_body(&builder, request, limits, run->error), run->error);
    if (status == ZR_OK) status = zr_query_apply(&query, run->error);
    if (status != ZR_OK) return status;
    zr_default_output_use(scene);
    if (!zr_axis_colors_are_given(scene)) zr_color_bar_warn(run->arena, scene, &scene->views[0], &builder.warnings);
    zr_view_matrices_warn(run->arena, &scene->views[0], &builder.warnings);
    zr_zip_body_warn(&builder, request);
    zr_scene_builder_close(&builder);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    zr_query_orient(&query);
    status = complete_sheet(request, scene, run->error);
    if (status == ZR_OK) status = edit_parts(request, &builder, run->error);
    if (status == ZR_OK) measure_labels(run->arena, scene);
    if (status == ZR_OK) status = validate(request, scene, limits, run->error);
    if (status == ZR_OK) status = zr_strict_check(scene, scene->warnings, scene->warning_count, run->error);
    return status == ZR_OK && !fits_memory(run->arena, scene) ? ZR_NO_MEMORY : status;
}

/* Finds the format, and the model in a ZIP archive. */
static enum zr_status open_body(struct zr_arena *arena, struct zr_request *body, const struct zr_limits *limits,
                                const char **model, struct zr_error *error)
{
    if (body->size == 0) body->bytes = ""; /* no arithmetic on a null pointer */
    enum zr_status status = find_format(body, error);
    if (status == ZR_OK) status = refuse_text(body, error);
    if (status != ZR_OK) return status;
    status = zr_zip_body_open(arena, body, limits, model, error);
    if (status != ZR_OK && body->format == ZR_FORMAT_ZIP) status = name_bytes(body, status, error);
    if (status == ZR_OK && *model) status = refuse_text(body, error);
    return status;
}

/* Stores the data that a change needs: the format of the body, and the members of a ZIP archive. */
static bool keep_body(struct zr_arena *arena, const struct zr_request *body, const struct zr_scene *made,
                      struct zr_kept *kept)
{
    kept->request->format = body->format;
    kept->request->member = NULL;
    kept->request->assets = body->assets;
    kept->request->asset_count = body->asset_count;
    if (made->view_set && made->view_set->kind == ZR_VIEW_SET_FILE) {
        kept->body = body->bytes;
        kept->body_size = body->size;
    }
    return zr_zip_body_keep(arena, body);
}

/* Reads a scene; `keeping` is NULL unless it is kept or changed. */
static enum zr_status read_request(const struct zr_run *run, const struct zr_request *request,
                                   const struct zr_limits *limits, const struct zr_keeping *keeping,
                                   const struct zr_scene **scene)
{
    struct zr_scene *made = zr_arena_alloc(run->arena, 1, sizeof *made);
    struct zr_request body = *request;
    const char *model = NULL;
    run->arena->cancel = request->cancel;
    enum zr_status status = made ? open_body(run->arena, &body, limits, &model, run->error) : ZR_NO_MEMORY;
    if (status == ZR_OK) {
        const size_t mark = skip_byte_order_mark(&body);
        status = read_scene(run, &body, limits, keeping, made);
        count_skipped(run->error, mark);
        status = zr_zip_body_check(&body, model, status, run->error);
    }
    const bool keeps = keeping && keeping->into && (made->view_set || !keeping->if_views);
    if (status == ZR_OK && keeps && !keep_body(run->arena, &body, made, keeping->into)) status = ZR_NO_MEMORY;
    if (status == ZR_OK && keeps) zr_image_record_keep_levels(keeping->into->images, run->arena, made);
    run->arena->cancel = NULL;
    if (zr_is_cancelled(request->cancel)) {
        *run->error = (struct zr_error){0}; /* faults of a partly read body */
        return zr_error_add(run->error, ZR_CANCELLED, NULL, "reading was stopped before it was done");
    }
    if ((status == ZR_OK && !zr_arena_ok(run->arena)) || (status == ZR_NO_MEMORY && run->error->count == 0))
        status = zr_memory_error_add(run->error, run->arena, "the scene", "");
    if (status != ZR_OK) return status;
    *scene = made;
    return ZR_OK;
}

enum zr_status zr_scene_read(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                             const struct zr_scene **scene)
{
    return read_request(run, request, limits, NULL, scene);
}

static enum zr_status keep(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                           bool if_views, struct zr_kept **kept)
{
    struct zr_kept *made = zr_arena_zero(run->arena, 1, sizeof *made);
    struct zr_image_record *images = zr_arena_alloc(run->arena, 1, sizeof *images);
    struct zr_request *lasting = zr_arena_alloc(run->arena, 1, sizeof *lasting);
    const struct zr_keeping keeping = {.into = made, .if_views = if_views};
    struct zr_request first = *request;
    if (request->frames && !if_views) first.bytes = zr_arena_copy(run->arena, request->bytes, request->size);
    if (!zr_arena_ok(run->arena)) return zr_memory_error_add(run->error, run->arena, "the scene", "");
    made->images = images;
    *lasting = *request;
    made->request = lasting;
    made->limits = *limits;
    first.images = zr_image_record_open(images, &request->images);
    if (request->frames) first.meshes = (struct zr_kept_meshes){.hash = NULL}; /* each frame finds these images */
    const enum zr_status status = read_request(run, &first, limits, &keeping, &made->scene);
    made->request->images = zr_image_record_lend(images);
    made->request->texts = (struct zr_kept_texts){.find = NULL};
    made->request->meshes = (struct zr_kept_meshes){.hash = NULL};
    made->request->bytes = NULL;
    made->request->size = 0;
    made->request->cancel = NULL;
    made->request->quick = NULL; /* the limits of the first reading, which changes share with other threads */
    if (status == ZR_OK) *kept = made;
    return status;
}

/* Makes the tables of the meshes for the kept scene and all its changes. */
static enum zr_status keep_tables(const struct zr_run *run, struct zr_kept *kept)
{
    struct zr_scene *scene = zr_arena_copy(run->arena, kept->scene, sizeof *scene);
    struct zr_mesh_tables *tables = zr_arena_alloc(run->arena, 1, sizeof *tables);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    const enum zr_status status = zr_mesh_tables_make(run, scene, tables);
    if (status != ZR_OK) return status;
    scene->tables = kept->tables = tables;
    kept->scene = scene;
    return ZR_OK;
}

enum zr_status zr_scene_keep(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_kept **kept)
{
    struct zr_run making = *run;
    making.cancel = request->cancel;
    enum zr_status status = keep(run, request, limits, false, kept);
    if (status != ZR_OK) return status;
    status = keep_tables(&making, *kept);
    if (status == ZR_CANCELLED) zr_error_add(run->error, status, NULL, "reading was stopped before it was done");
    if (status == ZR_NO_MEMORY)
        zr_error_add(run->error, status, NULL, "a scene needs more than %zu bytes", run->arena->ceiling);
    return status;
}

enum zr_status zr_scene_keep_text(const struct zr_run *run, const char *text, size_t size,
                                  const struct zr_asset *assets, size_t asset_count, const struct zr_limits *limits,
                                  struct zr_kept **kept)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON,
                                       .bytes = text,
                                       .size = size,
                                       .assets = assets,
                                       .asset_count = asset_count,
                                       .cancel = run->cancel};
    return zr_scene_keep(run, &request, limits, kept);
}

enum zr_status zr_scene_keep_for_views(const struct zr_run *run, const struct zr_request *request,
                                       const struct zr_limits *limits, struct zr_kept **kept)
{
    return keep(run, request, limits, true, kept);
}

enum zr_status zr_scene_change(const struct zr_run *run, const struct zr_kept *kept, const struct zr_request *change,
                               const struct zr_scene **scene)
{
    struct zr_request request;
    struct zr_keeping keeping;
    enum zr_status status = zr_change_read(run->arena, kept, change, &request, &keeping, run->error);
    if (status == ZR_NO_MEMORY && run->error->count == 0)
        zr_error_add(run->error, status, NULL, "the change needs more than %zu bytes", run->arena->ceiling);
    return status == ZR_OK ? read_request(run, &request, &kept->limits, &keeping, scene) : status;
}

enum zr_status zr_scene_read_file(const struct zr_run *run, const struct zr_scene_file *file,
                                  const struct zr_limits *limits, const struct zr_scene **scene)
{
    struct zr_request request = {.format = file->type ? zr_format_of_type(file->type) : ZR_FORMAT_UNKNOWN,
                                 .bytes = file->bytes,
                                 .size = file->size,
                                 .assets = file->assets,
                                 .asset_count = file->asset_count,
                                 .cancel = run->cancel};
    if (file->stored) request.stored = *file->stored;
    if (request.format == ZR_FORMAT_UNKNOWN && file->type && !zr_media_type_is_generic(file->type))
        return zr_error_add(run->error, ZR_BAD_TYPE, NULL, "the type '%.80s' is none of: %s", file->type,
                            zr_format_types_join().text);
    return zr_scene_read(run, &request, limits, scene);
}

enum zr_status zr_scene_change_query(const struct zr_run *run, const struct zr_kept *kept, const char *query,
                                     const struct zr_scene **scene)
{
    struct zr_request change = {.format = ZR_FORMAT_JSON, .bytes = "{}", .size = 2, .cancel = run->cancel};
    char *room = zr_arena_alloc(run->arena, zr_query_room(query), 1);
    if (!room) return ZR_NO_MEMORY;
    const enum zr_status status = zr_query_split(query, room, &change, run->error);
    return status == ZR_OK ? zr_scene_change(run, kept, &change, scene) : status;
}

/* Reads the file of a kept scene at another time of its animation. */
static enum zr_status read_frame(const struct zr_run *run, const struct zr_kept *kept, double time,
                                 const struct zr_scene **scene)
{
    char *text = zr_arena_alloc(run->arena, ZR_TIME_SIZE, 1);
    struct zr_request request = *kept->request;
    if (!text) return ZR_NO_MEMORY;
    snprintf(text, ZR_TIME_SIZE, "%.6f", time);
    request.bytes = kept->body;
    request.size = kept->body_size;
    request.cancel = run->cancel;
    request.time = text;
    request.frames = request.timeEnd = NULL;
    return read_request(run, &request, &kept->limits, NULL, scene);
}

enum zr_status zr_scene_frame(const struct zr_run *run, const struct zr_kept *kept, uint32_t number,
                              const struct zr_scene **scene)
{
    const struct zr_view_set *set = kept->scene->view_set;
    const struct zr_request change = {.cancel = run->cancel};
    const double share = (double)number / (double)set->count;
    struct zr_request request;
    struct zr_keeping keeping;
    if (set->kind == ZR_VIEW_SET_FILE) return read_frame(run, kept, set->start + set->seconds * share, scene);
    enum zr_status status = zr_change_read(run->arena, kept, &change, &request, &keeping, run->error);
    if (status == ZR_NO_MEMORY && run->error->count == 0)
        zr_error_add(run->error, status, NULL, "a frame needs more than %zu bytes", run->arena->ceiling);
    if (status != ZR_OK) return status;
    keeping.animation = set->animation;
    keeping.moment = (struct zr_moment){share, set->seconds * share};
    return read_request(run, &request, &kept->limits, &keeping, scene);
}

const struct zr_scene *zr_kept_scene(const struct zr_kept *kept)
{
    return kept->scene;
}
