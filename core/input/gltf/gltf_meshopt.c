/* EXT_meshopt_compression and KHR_meshopt_compression: buffer views whose bytes are compressed. */
#include "input/gltf/gltf_extensions.h"

static const char *const mode_words[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
static const char *const filter_words[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
static const struct zr_names modes = ZR_NAMES(3, mode_words), filters = ZR_NAMES(5, filter_words);

enum { BUFFER, LENGTH, STRIDE, COUNT, MODE };
#define AT(member) offsetof(struct zr_gltf_compressed, member)
static const struct zr_json_field fields[] = {
    [BUFFER] = {"buffer", zr_gltf_index, AT(span.buffer), .required = true, .text = "number of the buffer"},
    [LENGTH] = {"byteLength", zr_json_whole, AT(span.length), .required = true, .text = "compressed bytes"},
    [STRIDE] = {"byteStride", zr_json_whole, AT(layout.stride), .required = true, .text = "bytes of an element"},
    [COUNT] = {"count", zr_json_whole, AT(layout.count), .required = true, .text = "number of elements"},
    [MODE] = {"mode", zr_json_choice, AT(layout.mode), .words = &modes, .required = true,
              .text = "ATTRIBUTES, TRIANGLES or INDICES"},
    {.key = "byteOffset", .read = zr_json_whole, .offset = AT(span.offset)},
    {.key = "filter", .read = zr_json_choice, .offset = AT(layout.filter), .words = &filters},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("meshopt_compression", fields);

bool zr_gltf_read_compressed(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_view *view,
                             struct zr_gltf_compressed *out)
{
    const struct zr_error *error = file->json.error;
    const size_t faults = error->count;
    *out = (struct zr_gltf_compressed){.span = {0, 0, 0}};
    if (!zr_gltf_fields_at(file, view->compressed, path, &object, out) || error->count > faults) return false;
    return (uint64_t)out->layout.count * out->layout.stride == view->span.length ||
           zr_json_fault(&file->json, path, "%u elements of %u bytes, but the view has %u bytes", out->layout.count,
                         out->layout.stride, view->span.length);
}

bool zr_gltf_decompress(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_compressed *given,
                        const struct zr_parsed_bytes *packed, struct zr_parsed_bytes *out)
{
    struct zr_json *json = &file->json;
    const struct zr_meshopt *of = &given->layout;
    const size_t size = (size_t)of->count * of->stride;
    struct zr_reason reason = {""};
    if (!zr_meshopt_check(of, packed->bytes, packed->size, &reason))
        return zr_json_fault(json, path, "%s", reason.text);
    unsigned char *bytes = zr_gltf_allocate(file, size, 1);
    if (!bytes) return false;
    if (!zr_meshopt_decode(of, packed->bytes, packed->size, bytes, json->cancel, &reason))
        return zr_json_fault(json, path, "%s", reason.text);
    *out = (struct zr_parsed_bytes){(const char *)bytes, size};
    return true;
}
