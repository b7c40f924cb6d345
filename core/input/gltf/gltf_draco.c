/* KHR_draco_mesh_compression: primitives whose faces and attributes are compressed. */
#include <string.h>

#include "base/cancel.h"
#include "input/codecs/draco.h"
#include "input/gltf/gltf_extensions.h"
#include "input/gltf/gltf_parts.h"

/* Numbers between checks for cancellation. */
enum { AT_ONCE = 4096 };

/* ---- the extension ---- */

struct given_mesh {
    uint32_t view;
    const char *attributes; /* place */
};
enum { VIEW, ATTRIBUTES };
#define AT(member) offsetof(struct given_mesh, member)
static const struct zr_json_field fields[] = {
    [VIEW] = {"bufferView", zr_gltf_index, AT(view), .required = true, .text = "number of the view"},
    [ATTRIBUTES] = {"attributes", zr_json_value_start, AT(attributes), .required = true,
                    .text = "ids of the attributes"},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF(ZR_GLTF_DRACO, fields);

static bool read_extension(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                           struct given_mesh *out, struct zr_gltf_attributes *ids)
{
    const struct zr_error *error = file->json.error;
    const size_t faults = error->count;
    if (!zr_gltf_fields_at(file, place, path, &object, out) || !out->attributes) return false;
    zr_gltf_read_attributes(file, ZR_JSON_KEY(path, fields[ATTRIBUTES].key), out->attributes, ids);
    return error->count == faults;
}

/* ---- the mesh ---- */

static struct zr_draco_mesh *decode(struct zr_gltf *file, const struct zr_json_path *path,
                                    const struct zr_parsed_bytes *packed)
{
    struct zr_json *json = &file->json;
    struct zr_reason reason;
    /* A quick reading decodes only few bytes, since each may stand for many faces. */
    if (!zr_json_has_time(&file->json, packed->size * ZR_DRACO_PER_BYTE)) return NULL;
    struct zr_draco_mesh *mesh = zr_arena_alloc(json->arena, 1, sizeof *mesh);
    if (mesh && zr_draco_decode(json->arena, json->cancel, packed->bytes, packed->size, mesh, &reason)) return mesh;
    if (mesh && reason.text[0]) zr_json_fault(json, path, "%s", reason.text);
    return NULL;
}

static const struct zr_draco_mesh *find_mesh(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number)
{
    const struct zr_json_path *at = ZR_JSON_KEY(path, fields[VIEW].key);
    struct zr_parsed_bytes packed;
    if (!zr_gltf_find_view(file, at, number, &packed)) return NULL;
    struct zr_gltf_view *view = &file->views[number];
    if (view->mesh_state == ZR_GLTF_UNREAD) {
        view->mesh = decode(file, path, &packed);
        view->mesh_state = view->mesh ? ZR_GLTF_READ : ZR_GLTF_REFUSED;
    }
    return view->mesh;
}

/* ---- attributes ---- */

/* Returns the componentType for a type of Draco, or 0. */
static uint32_t component_type(int type)
{
    static const uint32_t types[] = {
        [ZR_DRACO_INT8] = ZR_GLTF_INT8,     [ZR_DRACO_UINT8] = ZR_GLTF_UINT8,   [ZR_DRACO_INT16] = ZR_GLTF_INT16,
        [ZR_DRACO_UINT16] = ZR_GLTF_UINT16, [ZR_DRACO_UINT32] = ZR_GLTF_UINT32, [ZR_DRACO_FLOAT32] = ZR_GLTF_FLOAT32};
    return (size_t)type < sizeof types / sizeof *types ? types[type] : 0;
}

/* Reads an integer of a type of Draco. */
static int64_t read_integer(const unsigned char *at, int type)
{
    const size_t bytes = zr_draco_type_bytes(type);
    const bool is_signed = type == ZR_DRACO_INT8 || type == ZR_DRACO_INT16 || type == ZR_DRACO_INT32;
    const int64_t span = INT64_C(1) << 8 * bytes;
    int64_t value = 0;
    for (size_t k = 0; k < bytes; k++)
        value |= (int64_t)at[k] << 8 * k;
    return is_signed && value >= span / 2 ? value - span : value;
}

/* Writes an integer as a number of an accessor. False if it is beyond the range of the accessor's type. */
static bool put_integer(unsigned char *out, uint32_t type, int64_t value)
{
    const size_t bytes = zr_gltf_type_bytes(type);
    const int64_t span = INT64_C(1) << 8 * bytes;
    const bool is_signed = type == ZR_GLTF_INT8 || type == ZR_GLTF_INT16;
    const float number = (float)value;
    uint32_t bits = (uint32_t)value;
    if (type == ZR_GLTF_FLOAT32) memcpy(&bits, &number, sizeof bits);
    for (size_t k = 0; k < bytes; k++)
        out[k] = (unsigned char)(bits >> 8 * k & 0xFF);
    return type == ZR_GLTF_FLOAT32 || (is_signed ? value >= -span / 2 && value < span / 2 : value >= 0 && value < span);
}

/* Refuses floats and normalized integers for an accessor of another type, in which they have other values. */
static bool check_type(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_draco_attribute *of,
                       uint32_t type)
{
    const uint32_t found = component_type(of->type);
    if (of->type != ZR_DRACO_FLOAT32 && !of->is_normalized) return true;
    if (found == 0)
        return zr_json_fault(&file->json, path, "%u; the compressed attribute has normalized integers of 32 bits",
                             type);
    return zr_json_fault(&file->json, path, "%u; the compressed attribute has %snumbers of the type %u", type,
                         of->is_normalized ? "normalized " : "", found);
}

/* Converts integers to the type of the accessor. */
static const unsigned char *convert(struct zr_gltf *file, const struct zr_json_path *path,
                                    const struct zr_draco_attribute *of, uint32_t points, uint32_t type)
{
    const size_t count = (size_t)points * of->width, from = zr_draco_type_bytes(of->type),
                 to = zr_gltf_type_bytes(type);
    struct zr_json *json = &file->json;
    if (!check_type(file, path, of, type)) return NULL;
    unsigned char *out = zr_gltf_allocate(file, count, to);
    for (size_t i = 0; out && i < count; i++) {
        const int64_t value = read_integer(of->values + i * from, of->type);
        if (i % AT_ONCE == 0 && zr_is_cancelled(json->cancel)) return NULL;
        if (put_integer(out + i * to, type, value)) continue;
        zr_json_fault(json, path, "%u; element %zu has the compressed number %lld", type, i / of->width,
                      (long long)value);
        return NULL;
    }
    return out;
}

static const struct zr_draco_attribute *find_attribute(const struct zr_draco_mesh *mesh, uint32_t id)
{
    for (uint32_t i = 0; i < mesh->attribute_count; i++)
        if (mesh->attributes[i].id == id) return &mesh->attributes[i];
    return NULL;
}

/* Notes another count than that of the compressed data, unless it may be that of uncompressed data. */
static void note_count(struct zr_gltf *file, uint32_t number, uint32_t count)
{
    const struct zr_gltf_accessor *accessor = &file->accessors[number];
    if (accessor->count != count && (file->requires_draco || accessor->view == ZR_GLTF_NONE))
        zr_gltf_note(&file->other_counts, ZR_JSON_KEY(ZR_GLTF_ITEM(ZR_GLTF_ACCESSORS, number), "count"));
}

/* Gives an accessor the values of an attribute. `path` leads to its id. */
static bool open_attribute(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_draco_mesh *mesh,
                           uint32_t id, uint32_t number)
{
    static const uint32_t widths[ZR_GLTF_SHAPES] = {1, 2, 3, 4, 4, 9, 16};
    const struct zr_draco_attribute *of = find_attribute(mesh, id);
    if (!of) return zr_json_fault(&file->json, path, "the compressed data have no attribute %u", id);
    struct zr_gltf_accessor *accessor = &file->accessors[number];
    const struct zr_json_path *at = ZR_GLTF_ITEM(ZR_GLTF_ACCESSORS, number);
    note_count(file, number, mesh->point_count);
    if (widths[accessor->shape] != of->width)
        return zr_json_fault(&file->json, ZR_JSON_KEY(at, "type"),
                             "elements of %u numbers; the compressed attribute has %u", widths[accessor->shape],
                             of->width);
    if (accessor->view != ZR_GLTF_NONE) file->has_fallbacks = true;
    accessor->decoded_count = mesh->point_count;
    accessor->decoded = component_type(of->type) == accessor->type
                            ? of->values
                            : convert(file, ZR_JSON_KEY(at, "componentType"), of, mesh->point_count, accessor->type);
    return accessor->decoded;
}

/* ---- primitives ---- */

static uint32_t number_at(const struct zr_gltf_attributes *of, size_t offset)
{
    uint32_t number;
    memcpy(&number, (const char *)of + offset, sizeof number);
    return number;
}

/* Refuses a second compressed attribute for the accessor of attribute `at`. */
static bool check_alone(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_attributes *ids,
                        const struct zr_gltf_attributes *numbers, uint32_t at)
{
    size_t offset, other;
    zr_gltf_attribute_of(at, &offset);
    const uint32_t id = number_at(ids, offset), number = number_at(numbers, offset);
    for (uint32_t i = 0; i < at && zr_gltf_attribute_of(i, &other); i++) {
        const uint32_t other_id = number_at(ids, other);
        if (number_at(numbers, other) == number && other_id != id && other_id != ZR_GLTF_NONE)
            return zr_json_fault(&file->json, path, "%u; accessor %u already has the compressed attribute %u", id,
                                 number, other_id);
    }
    return true;
}

/* Notes an attribute that only one of the lists has, unless its accessor has own data. */
static void note_lone(struct zr_gltf *file, const struct zr_json_path *list, const struct zr_json_path *numbers,
                      const char *name, uint32_t number)
{
    if (number == ZR_GLTF_NONE) {
        zr_gltf_note(&file->not_drawn, ZR_JSON_KEY(list, name));
    } else if (number < file->counts[ZR_GLTF_ACCESSORS]) {
        const struct zr_gltf_accessor *accessor = &file->accessors[number];
        if (accessor->view == ZR_GLTF_NONE && accessor->sparse.count == 0)
            zr_gltf_note(&file->not_compressed, ZR_JSON_KEY(numbers, name));
    }
}

static bool open_attributes(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_attributes *ids,
                            const struct zr_gltf_primitive *given)
{
    const struct zr_json_path *list = ZR_JSON_KEY(path, fields[ATTRIBUTES].key),
                              *numbers = ZR_JSON_KEY(path->parent->parent, fields[ATTRIBUTES].key);
    const char *name;
    size_t offset;
    for (uint32_t i = 0; (name = zr_gltf_attribute_of(i, &offset)); i++) {
        const uint32_t id = number_at(ids, offset), number = number_at(&given->attributes, offset);
        if ((id == ZR_GLTF_NONE) != (number == ZR_GLTF_NONE)) note_lone(file, list, numbers, name, number);
        if (id == ZR_GLTF_NONE || number == ZR_GLTF_NONE) continue;
        if (!zr_gltf_check_index(file, ZR_JSON_KEY(numbers, name), number, ZR_GLTF_ACCESSORS) ||
            !check_alone(file, ZR_JSON_KEY(list, name), ids, &given->attributes, i) ||
            !open_attribute(file, ZR_JSON_KEY(list, name), given->draco, id, number))
            return false;
    }
    return true;
}

static bool check_faces(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_primitive *given)
{
    if (given->mode != ZR_GLTF_TRIANGLES && given->mode != ZR_GLTF_TRIANGLE_STRIP)
        return zr_json_fault(&file->json, ZR_JSON_KEY(path, "mode"), "%u; compressed primitives have the modes 4 and 5",
                             given->mode);
    if (given->indices == ZR_GLTF_NONE || given->mode != ZR_GLTF_TRIANGLES) return true;
    if (!zr_gltf_check_index(file, ZR_JSON_KEY(path, "indices"), given->indices, ZR_GLTF_ACCESSORS)) return false;
    note_count(file, given->indices, 3 * given->draco->face_count);
    return true;
}

/* True if the request lacks the compressed data, and the accessors have uncompressed ones. */
static bool falls_back(struct zr_gltf *file, const struct zr_gltf_primitive *given, uint32_t view)
{
    const uint32_t number = given->attributes.position;
    return !file->requires_draco && number < file->counts[ZR_GLTF_ACCESSORS] &&
           file->accessors[number].view != ZR_GLTF_NONE && view < file->counts[ZR_GLTF_BUFFER_VIEWS] &&
           !zr_gltf_has_view(file, view) && zr_arena_ok(file->json.arena);
}

bool zr_gltf_open_draco(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                        struct zr_gltf_primitive *given)
{
    const struct zr_json_path *at = ZR_JSON_KEY(path, ZR_GLTF_DRACO);
    struct zr_gltf_attributes ids = ZR_GLTF_NO_ATTRIBUTES;
    struct given_mesh mesh = {ZR_GLTF_NONE, NULL};
    const char *place = NULL;
    if (!zr_gltf_find_extension(file, path, extensions, ZR_GLTF_DRACO, &place)) return false;
    if (!place) return true;
    if (!read_extension(file, at, place, &mesh, &ids)) return false;
    if (falls_back(file, given, mesh.view)) return true;
    given->draco = find_mesh(file, at, mesh.view);
    const bool good = given->draco && check_faces(file, path->parent, given) && open_attributes(file, at, &ids, given);
    if (!good) zr_gltf_close_draco(file, given);
    if (good) given->mode = ZR_GLTF_TRIANGLES; /* a strip is decoded to triangles */
    return good;
}

void zr_gltf_close_draco(struct zr_gltf *file, const struct zr_gltf_primitive *given)
{
    size_t offset;
    for (uint32_t i = 0; given->draco && zr_gltf_attribute_of(i, &offset); i++) {
        const uint32_t number = number_at(&given->attributes, offset);
        if (number < file->counts[ZR_GLTF_ACCESSORS]) file->accessors[number].decoded = NULL;
    }
}
