/* Reads accessors of glTF, and checks that their elements are within their bytes. */
#include "input/gltf/gltf_file.h"

#include <float.h>

static const char *const shape_words[ZR_GLTF_SHAPES] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
static const struct zr_names shapes = ZR_NAMES(ZR_GLTF_SHAPES, shape_words);

size_t zr_gltf_type_bytes(uint32_t type)
{
    switch (type) {
    case ZR_GLTF_INT8:
    case ZR_GLTF_UINT8:
        return 1;
    case ZR_GLTF_INT16:
    case ZR_GLTF_UINT16:
        return 2;
    case ZR_GLTF_UINT32:
    case ZR_GLTF_FLOAT32:
        return 4;
    default:
        return 0;
    }
}

/* Reads a componentType, a uint32_t. */
static bool read_type(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint32_t type;
    if (!zr_json_whole(json, path, &type)) return false;
    if (zr_gltf_type_bytes(type) == 0)
        return zr_json_fault(json, path, "%u; glTF has 5120, 5121, 5122, 5123, 5125 and 5126", type);
    *(uint32_t *)out = type;
    return true;
}

/* ---- sparse elements ---- */

#define AT(member) offsetof(struct zr_gltf_sparse, member)
static const struct zr_json_field indices_fields[] = {
    {"bufferView", zr_gltf_index, AT(indices_view), .required = true, .text = "number of the view"},
    {"componentType", read_type, AT(indices_type), .required = true, .text = "type of the indices"},
    {.key = "byteOffset", .read = zr_json_whole, .offset = AT(indices_offset)},
    ZR_GLTF_COMMON};
static const struct zr_json_object indices_object = ZR_JSON_OBJECT_OF("indices", indices_fields);
static const struct zr_json_field values_fields[] = {
    {"bufferView", zr_gltf_index, AT(values_view), .required = true, .text = "number of the view"},
    {.key = "byteOffset", .read = zr_json_whole, .offset = AT(values_offset)},
    ZR_GLTF_COMMON};
static const struct zr_json_object values_object = ZR_JSON_OBJECT_OF("values", values_fields);

/* Places of the objects of a sparse accessor. */
struct given_sparse {
    uint32_t count;
    const char *indices, *values;
};
#undef AT
#define AT(member) offsetof(struct given_sparse, member)
static const struct zr_json_field sparse_fields[] = {
    {"count", zr_json_whole, AT(count), .required = true, .text = "number of elements"},
    {"indices", zr_json_value_start, AT(indices), .required = true, .text = "numbers of the elements"},
    {"values", zr_json_value_start, AT(values), .required = true, .text = "their values"},
    ZR_GLTF_COMMON};
static const struct zr_json_object sparse_object = ZR_JSON_OBJECT_OF("sparse", sparse_fields);
#undef AT

static void read_sparse(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                        struct zr_gltf_sparse *sparse)
{
    struct given_sparse given = {0, NULL, NULL};
    zr_gltf_fields_at(file, place, path, &sparse_object, &given);
    if (!given.indices || !given.values) return;
    zr_gltf_fields_at(file, given.indices, ZR_JSON_KEY(path, "indices"), &indices_object, sparse);
    zr_gltf_fields_at(file, given.values, ZR_JSON_KEY(path, "values"), &values_object, sparse);
    sparse->count = given.count;
}

/* ---- accessors ---- */

struct given_accessor {
    struct zr_gltf_accessor accessor;
    const char *sparse; /* place, or NULL */
};

enum { TYPE, COUNT, SHAPE, VIEW, OFFSET, NORMALIZED, SPARSE };
#define AT(member) offsetof(struct given_accessor, member)
static const struct zr_json_field fields[] = {
    [TYPE] = {"componentType", read_type, AT(accessor.type), .required = true, .text = "type of the numbers"},
    [COUNT] = {"count", zr_json_whole, AT(accessor.count), .required = true, .text = "number of elements"},
    [SHAPE] = {"type", zr_json_choice, AT(accessor.shape), .words = &shapes, .required = true,
               .text = "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4"},
    [VIEW] = {.key = "bufferView", .read = zr_gltf_index, .offset = AT(accessor.view)},
    [OFFSET] = {.key = "byteOffset", .read = zr_json_whole, .offset = AT(accessor.offset)},
    [NORMALIZED] = {.key = "normalized", .read = zr_json_bool, .offset = AT(accessor.is_normalized)},
    [SPARSE] = {.key = "sparse", .read = zr_json_value_start, .offset = AT(sparse)},
    {.key = "min", .read = zr_gltf_ignore},
    {.key = "max", .read = zr_gltf_ignore},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("accessor", fields);

static void read_accessor(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_accessor given = {.accessor = {.view = ZR_GLTF_NONE}};
    zr_gltf_fields(file, json, path, &object, &given);
    if (given.sparse) read_sparse(file, ZR_JSON_KEY(path, fields[SPARSE].key), given.sparse, &given.accessor.sparse);
    file->accessors[number] = given.accessor;
}

bool zr_gltf_read_accessors(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    file->accessors = zr_arena_zero(arena, file->counts[ZR_GLTF_ACCESSORS], sizeof *file->accessors);
    return zr_arena_ok(arena) && zr_gltf_read_list(file, ZR_GLTF_ACCESSORS, read_accessor);
}

/* ---- bounds ---- */

/* Elements of `size` bytes, `stride` apart, from a byte of a view on. */
struct elements {
    uint32_t offset, count;
    size_t size, stride;
};

/* Sets *first to the first byte of the elements. False, and a fault, if they are not within the view. */
static bool find_elements(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_parsed_bytes *view,
                          const struct elements *of, const unsigned char **first)
{
    const uint64_t end = of->count == 0 ? of->offset : of->offset + (uint64_t)(of->count - 1) * of->stride + of->size;
    if (end > view->size)
        return zr_json_fault(&file->json, path, "%u elements end at byte %llu of a view of %zu", of->count,
                             (unsigned long long)end, view->size);
    *first = (const unsigned char *)view->bytes + of->offset;
    return true;
}

static bool open_sparse(struct zr_gltf *file, const struct zr_json_path *path, size_t size, struct zr_gltf_values *out)
{
    const struct zr_gltf_sparse *sparse = &out->accessor->sparse;
    const struct zr_json_path *at = ZR_JSON_KEY(path, fields[SPARSE].key), *indices = ZR_JSON_KEY(at, "indices"),
                              *values = ZR_JSON_KEY(at, "values");
    const size_t index_size = zr_gltf_type_bytes(sparse->indices_type);
    struct zr_parsed_bytes view;
    if (sparse->count > out->count)
        return zr_json_fault(&file->json, ZR_JSON_KEY(at, "count"), "%u of %u elements", sparse->count, out->count);
    const struct elements of_indices = {sparse->indices_offset, sparse->count, index_size, index_size},
                          of_values = {sparse->values_offset, sparse->count, size, size};
    return zr_gltf_find_view(file, ZR_JSON_KEY(indices, fields[VIEW].key), sparse->indices_view, &view) &&
           find_elements(file, indices, &view, &of_indices, &out->sparse_indices) &&
           zr_gltf_find_view(file, ZR_JSON_KEY(values, fields[VIEW].key), sparse->values_view, &view) &&
           find_elements(file, values, &view, &of_values, &out->sparse_values);
}

/* Limits the number of elements without a view, which use no bytes, by the size of the request. */
static bool zeros_are_few(struct zr_gltf *file, const struct zr_json_path *path, uint32_t count)
{
    if (count > file->size && file->assets.looked) *file->assets.looked = true; /* the sizes of other files */
    return count <= file->bytes ||
           zr_json_fault(&file->json, ZR_JSON_KEY(path, fields[COUNT].key),
                         "%u elements without a bufferView, more than the request has bytes", count);
}

bool zr_gltf_open(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, struct zr_gltf_values *out)
{
    static const uint32_t widths[ZR_GLTF_SHAPES] = {1, 2, 3, 4, 4, 9, 16};
    if (!zr_gltf_check_index(file, path, number, ZR_GLTF_ACCESSORS)) return false;
    const struct zr_gltf_accessor *accessor = &file->accessors[number];
    const struct zr_json_path *at = ZR_GLTF_ITEM(ZR_GLTF_ACCESSORS, number);
    const uint32_t width = widths[accessor->shape];
    const size_t size = width * zr_gltf_type_bytes(accessor->type);
    *out = (struct zr_gltf_values){.accessor = accessor,
                                   .number = number,
                                   .count = accessor->count,
                                   .width = width,
                                   .is_normalized = accessor->is_normalized,
                                   .stride = size,
                                   .limit = (double)FLT_MAX};
    if (accessor->decoded) {
        out->bytes = accessor->decoded;
        out->count = accessor->decoded_count;
    } else if (accessor->view == ZR_GLTF_NONE) {
        if (!zeros_are_few(file, at, accessor->count)) return false;
    } else {
        struct zr_parsed_bytes view;
        if (!zr_gltf_find_view(file, ZR_JSON_KEY(at, fields[VIEW].key), accessor->view, &view)) return false;
        const uint32_t stride = file->views[accessor->view].stride;
        if (stride > 0) out->stride = stride;
        if (out->stride < size)
            return zr_json_fault(&file->json, at, "elements of %zu bytes, %u apart in their view", size, stride);
        const struct elements of = {accessor->offset, accessor->count, size, out->stride};
        if (!find_elements(file, at, &view, &of, &out->bytes)) return false;
    }
    return accessor->sparse.count == 0 || open_sparse(file, at, size, out);
}
