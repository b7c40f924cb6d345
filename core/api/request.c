#include "api/request.h"

#include <string.h>
#include <strings.h>

#include "api/cancel.h"
#include "api/options.h"
#include "input/formats/formats.h"
#include "input/query/query_text.h"

static enum zr_status refuse(struct zr_error *error, const char *name, const char *why)
{
    return zr_error_add(error, ZR_BAD_REQUEST, NULL, "part '%.60s': %s", name, why);
}

/* Finds the format of "stl" or "model/stl". */
static enum zr_status find_format(const char *type, enum zr_format *out, struct zr_error *error)
{
    *out = zr_format_of_type(type);
    for (int i = 0; type && i < ZR_FORMAT_COUNT; i++)
        if (strcasecmp(type, zr_format_rows[i].suffix) == 0) *out = (enum zr_format)i;
    if (*out != ZR_FORMAT_UNKNOWN || zr_media_type_is_generic(type)) return ZR_OK;
    return zr_error_add(error, ZR_BAD_TYPE, NULL, "the type '%.80s' is none of: %s", type, zr_format_types_join().text);
}

static enum zr_status read_query(struct zr_arena *arena, const char *query, struct zr_request *request,
                                 struct zr_error *error)
{
    if (!query || !*query) return ZR_OK;
    char *room = zr_arena_alloc(arena, zr_query_room(query), 1);
    return room ? zr_query_split(query, room, request, error) : ZR_NO_MEMORY;
}

static struct zr_array array_of(const struct zraster_array *given)
{
    struct zr_array array = {.data = given->data, .type = (enum zr_number_type)given->type, .ndim = given->ndim};
    memcpy(array.shape, given->shape, sizeof array.shape);
    return array;
}

static enum zr_status check_part(const struct zraster_request *given, size_t i, struct zr_error *error)
{
    const struct zraster_part *part = &given->parts[i];
    const struct zraster_array *array = &part->array;
    if (!part->name || !*part->name) return refuse(error, "", "its name is missing");
    const struct zr_array numbers = array_of(array);
    size_t bytes;
    if (array->type >= ZR_NUMBER_TYPES) return refuse(error, part->name, "its type is unknown");
    if (array->type == ZRASTER_BYTES && array->ndim != 1)
        return refuse(error, part->name, "bytes need ndim 1 and their number in shape[0]");
    if (array->ndim < 1 || array->ndim > ZR_ARRAY_SIDES_MAX) return refuse(error, part->name, "its ndim is not 1 to 4");
    if (!zr_array_bytes(&numbers, &bytes)) return refuse(error, part->name, "its shape is too large");
    if (!array->data && bytes > 0) return refuse(error, part->name, "its data is NULL");
    if (part->flags & ~(uint32_t)(ZRASTER_LEND | ZRASTER_OPTIONAL)) return refuse(error, part->name, "unknown flags");
    for (size_t k = 0; k < i; k++)
        if (strcmp(given->parts[k].name, part->name) == 0) return refuse(error, part->name, "given twice");
    return ZR_OK;
}

static enum zr_status take_parts(struct zr_arena *arena, const struct zraster_request *given, bool is_kept,
                                 struct zr_request *request, struct zr_error *error)
{
    if (given->part_count == 0) return ZR_OK;
    struct zr_asset *assets = zr_arena_alloc(arena, given->part_count, sizeof *assets);
    for (size_t i = 0; assets && i < given->part_count; i++) {
        const struct zraster_part *part = &given->parts[i];
        const enum zr_status status = check_part(given, i, error);
        if (status != ZR_OK) return status;
        struct zr_asset *asset = &assets[i];
        *asset = (struct zr_asset){.name = part->name, .bytes = part->array.data, .array = array_of(&part->array)};
        zr_array_bytes(&asset->array, &asset->size);
        asset->is_lent = part->flags & ZRASTER_LEND;
        asset->is_optional = part->flags & ZRASTER_OPTIONAL;
        if (!is_kept) continue;
        asset->name = zr_arena_copy(arena, part->name, strlen(part->name) + 1);
        if (asset->is_lent) continue;
        asset->bytes = asset->array.data = zr_arena_copy(arena, asset->bytes, asset->size);
        asset->is_lent = true;
    }
    request->assets = assets;
    request->asset_count = given->part_count;
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_request_take(struct zr_arena *arena, const struct zraster_request *given, bool is_kept,
                               struct zr_taken_request *out, struct zr_error *error)
{
    struct zraster_request all;
    *out = (struct zr_taken_request){.cancel = NULL};
    struct zr_request *request = &out->request;
    enum zr_status status = zr_request_struct_read(given, &all, error);
    if (status != ZR_OK) return status;
    if ((all.body_size > 0 && !all.body) || (all.part_count > 0 && !all.parts))
        status = zr_error_add(error, ZR_BAD_REQUEST, NULL, "the body or the parts are NULL");
    if (status == ZR_OK) status = find_format(all.type, &request->format, error);
    if (status == ZR_OK) status = read_query(arena, all.query, request, error);
    if (status == ZR_OK) status = take_parts(arena, &all, is_kept, request, error);
    out->cancel = all.cancel;
    out->progress = all.progress;
    out->progress_context = all.progress_context;
    request->cancel = zr_cancel_flag(all.cancel);
    request->bytes = all.body;
    request->size = all.body_size;
    return status;
}
