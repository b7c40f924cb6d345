/* Reads buffers and views of glTF. Finds the bytes of a buffer at its first use, and fetches nothing. */
#include "input/gltf/gltf_extensions.h"

#include <string.h>
#include <strings.h>

#include "input/files/file_parts.h"
#include "input/formats/sniff.h"
#include "input/text/text.h"

/* ---- lists ---- */

enum { BUFFER_LENGTH, BUFFER_URI };
#define AT(member) offsetof(struct zr_gltf_buffer, member)
static const struct zr_json_field buffer_fields[] = {
    [BUFFER_LENGTH] = {"byteLength", zr_json_whole, AT(length), .required = true, .text = "bytes of the buffer"},
    [BUFFER_URI] = {.key = "uri", .read = zr_gltf_uri, .offset = AT(uri)},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object buffer_object = ZR_JSON_OBJECT_OF("buffer", buffer_fields);

static void read_buffer(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    zr_gltf_fields(file, json, path, &buffer_object, &file->buffers[number]);
}

enum { VIEW_BUFFER, VIEW_LENGTH, VIEW_OFFSET, VIEW_STRIDE };
enum { STRIDE_MIN = 4, STRIDE_MAX = 252 };
struct given_view {
    struct zr_gltf_view view;
    const char *extensions; /* JSON text */
};
#define AT(member) offsetof(struct given_view, member)
static const struct zr_json_field view_fields[] = {
    [VIEW_BUFFER] = {"buffer", zr_gltf_index, AT(view.span.buffer), .required = true, .text = "number of the buffer"},
    [VIEW_LENGTH] = {"byteLength", zr_json_whole, AT(view.span.length), .required = true, .text = "bytes of the view"},
    [VIEW_OFFSET] = {.key = "byteOffset", .read = zr_json_whole, .offset = AT(view.span.offset)},
    [VIEW_STRIDE] = {.key = "byteStride", .read = zr_json_whole, .offset = AT(view.stride)},
    {.key = "target", .read = zr_gltf_ignore},
    {.key = "extensions", .read = zr_json_value_start, .offset = AT(extensions)},
    {.key = "extras", .read = zr_gltf_ignore},
    ZR_GLTF_NAME};
#undef AT
static const struct zr_json_object view_object = ZR_JSON_OBJECT_OF("bufferView", view_fields);

static void find_compression(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                             struct zr_gltf_view *view)
{
    static const char *const names[] = {ZR_GLTF_MESHOPT, ZR_GLTF_KHR_MESHOPT};
    for (size_t i = 0; i < sizeof names / sizeof *names && !view->compressed; i++) {
        view->compression = names[i];
        zr_gltf_find_extension(file, path, extensions, names[i], &view->compressed);
    }
}

static void read_view(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_view given = {.extensions = NULL};
    struct zr_gltf_view *view = &file->views[number];
    zr_gltf_fields(file, json, path, &view_object, &given);
    const bool has_stride = zr_json_gives(file->given, VIEW_STRIDE);
    *view = given.view;
    if (given.extensions) find_compression(file, ZR_JSON_KEY(path, "extensions"), given.extensions, view);
    if (has_stride && view->stride == 0)
        zr_gltf_note(&file->zero_strides, ZR_JSON_KEY(path, view_fields[VIEW_STRIDE].key));
    else if (has_stride && (view->stride < STRIDE_MIN || view->stride > STRIDE_MAX))
        zr_json_fault(json, ZR_JSON_KEY(path, view_fields[VIEW_STRIDE].key), "%u; %d to %d bytes are allowed",
                      view->stride, STRIDE_MIN, STRIDE_MAX);
}

bool zr_gltf_read_buffers(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    file->buffers = zr_arena_zero(arena, file->counts[ZR_GLTF_BUFFERS], sizeof *file->buffers);
    file->views = zr_arena_zero(arena, file->counts[ZR_GLTF_BUFFER_VIEWS], sizeof *file->views);
    return zr_arena_ok(arena) && zr_gltf_read_list(file, ZR_GLTF_BUFFERS, read_buffer) &&
           zr_gltf_read_list(file, ZR_GLTF_BUFFER_VIEWS, read_view);
}

/* ---- URIs ---- */

static bool refuse_missing(struct zr_json *json, const struct zr_json_path *path, const char *uri)
{
    char *plain = zr_arena_alloc(json->arena, strlen(uri) + 1, 1);
    if (!plain) return false;
    const size_t length = zr_file_path_clean(uri, strlen(uri), plain);
    return zr_json_fault(json, path, "no part of the request has the name %s; nothing is fetched from elsewhere",
                         zr_quote(plain, length).text);
}

bool zr_gltf_uri(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_gltf_uri *uri = out;
    struct zr_json_text text;
    if (zr_json_type(json) != ZR_JSON_STRING) return zr_json_expect(json, path, "a string");
    if (!zr_json_take_string(json, &text)) return false;
    const struct zr_json_uri *noted = json->uris ? zr_json_uri_at(json->uris, text.at) : NULL;
    const char *copy = noted ? NULL : zr_json_decode(json, &text);
    if (noted)
        *uri = (struct zr_gltf_uri){noted->text, noted->size};
    else if (copy)
        *uri = (struct zr_gltf_uri){copy, strlen(copy)};
    return noted || copy;
}

static bool is_data(const struct zr_gltf_uri *uri)
{
    return uri->size >= 5 && strncasecmp(uri->text, "data:", 5) == 0;
}

bool zr_gltf_is_missing(struct zr_gltf *file, const struct zr_gltf_uri *uri)
{
    return uri->text && !is_data(uri) && !zr_file_part_find(&file->assets, file->json.arena, uri->text) &&
           zr_arena_ok(file->json.arena);
}

bool zr_gltf_find_uri(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_uri *uri,
                      struct zr_parsed_bytes *out)
{
    struct zr_json *json = &file->json;
    if (is_data(uri)) {
        struct zr_reason reason;
        const enum zr_status status =
            zr_json_uri_decode(&file->uris, uri->text, uri->size, &out->bytes, &out->size, &reason);
        return status == ZR_OK || (status == ZR_BAD_SCENE && zr_json_fault(json, path, "%s", reason.text));
    }
    const struct zr_asset *part = zr_file_part_find(&file->assets, json->arena, uri->text);
    if (!part && !zr_arena_ok(json->arena)) return false;
    if (!part) return refuse_missing(json, path, uri->text);
    if (part->array.type != ZR_BYTES)
        return zr_json_fault(json, path, "the part %s is an array; the bytes of a file are needed",
                             zr_quote(part->name, strlen(part->name)).text);
    if (zr_is_lfs_pointer(part->bytes, part->size))
        return zr_json_fault(json, path, "the part %s is a pointer of Git LFS, not the file: git lfs pull fetches it",
                             zr_quote(part->name, strlen(part->name)).text);
    *out = (struct zr_parsed_bytes){part->bytes, part->size};
    return true;
}

/* ---- bytes ---- */

/* Finds the bytes of a buffer. Only the first one may be the binary chunk of a GLB. */
static bool find_bytes(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number)
{
    struct zr_gltf_buffer *buffer = &file->buffers[number];
    struct zr_json *json = &file->json;
    if (buffer->uri.text) {
        if (!zr_gltf_find_uri(file, ZR_JSON_KEY(path, buffer_fields[BUFFER_URI].key), &buffer->uri, &buffer->bytes))
            return false;
    } else if (number == 0 && file->chunk.bytes) {
        buffer->bytes = file->chunk;
    } else {
        return zr_json_fault(json, path, "without a uri, and %s",
                             number == 0 ? "the file has no binary chunk" : "only buffer 0 may be the binary chunk");
    }
    if (buffer->length > buffer->bytes.size)
        zr_gltf_note(&file->short_buffers, ZR_JSON_KEY(path, buffer_fields[BUFFER_LENGTH].key));
    else
        buffer->bytes.size = buffer->length;
    return true;
}

/* Finds bytes of a buffer. `path` leads to the object whose key `buffer` has its number. */
static bool find_range(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_span *span,
                       struct zr_parsed_bytes *out)
{
    const uint32_t number = span->buffer;
    const uint64_t end = (uint64_t)span->offset + span->length;
    if (!zr_gltf_check_index(file, ZR_JSON_KEY(path, view_fields[VIEW_BUFFER].key), number, ZR_GLTF_BUFFERS))
        return false;
    struct zr_gltf_buffer *buffer = &file->buffers[number];
    if (buffer->state == ZR_GLTF_UNREAD)
        buffer->state =
            find_bytes(file, ZR_GLTF_ITEM(ZR_GLTF_BUFFERS, number), number) ? ZR_GLTF_READ : ZR_GLTF_REFUSED;
    if (buffer->state == ZR_GLTF_REFUSED) return false;
    if (end > buffer->bytes.size)
        return zr_json_fault(&file->json, path, "bytes %u to %llu of buffer %u, which has %zu", span->offset,
                             (unsigned long long)end, number, buffer->bytes.size);
    *out = (struct zr_parsed_bytes){(const char *)buffer->bytes.bytes + span->offset, span->length};
    return true;
}

/* Decodes a compressed view at its first use. */
static bool decompress(struct zr_gltf *file, const struct zr_json_path *path, struct zr_gltf_view *view)
{
    const struct zr_json_path *extensions = ZR_JSON_KEY(path, "extensions"),
                              *at = ZR_JSON_KEY(extensions, view->compression);
    struct zr_gltf_compressed given;
    struct zr_parsed_bytes packed;
    return zr_gltf_read_compressed(file, at, view, &given) && find_range(file, at, &given.span, &packed) &&
           zr_gltf_decompress(file, at, &given, &packed, &view->bytes);
}

bool zr_gltf_find_view(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number,
                       struct zr_parsed_bytes *out)
{
    if (!zr_gltf_check_index(file, path, number, ZR_GLTF_BUFFER_VIEWS)) return false;
    struct zr_gltf_view *view = &file->views[number];
    const struct zr_json_path *at = ZR_GLTF_ITEM(ZR_GLTF_BUFFER_VIEWS, number);
    if (!view->compressed) return find_range(file, at, &view->span, out);
    if (view->state == ZR_GLTF_UNREAD) view->state = decompress(file, at, view) ? ZR_GLTF_READ : ZR_GLTF_REFUSED;
    *out = view->bytes;
    return view->state == ZR_GLTF_READ;
}

bool zr_gltf_has_view(struct zr_gltf *file, uint32_t number)
{
    if (number >= file->counts[ZR_GLTF_BUFFER_VIEWS]) return false;
    const uint32_t buffer = file->views[number].span.buffer;
    if (buffer >= file->counts[ZR_GLTF_BUFFERS]) return false;
    const struct zr_gltf_uri *uri = &file->buffers[buffer].uri;
    if (!uri->text) return buffer == 0 && file->chunk.bytes;
    return is_data(uri) || zr_file_part_find(&file->assets, file->json.arena, uri->text);
}
