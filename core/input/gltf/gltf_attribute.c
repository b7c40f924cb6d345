/* Reads the lists of attributes of primitives, and opens attributes. */
#include "input/gltf/gltf_parts.h"

#define AT(member) offsetof(struct zr_gltf_attributes, member)
static const struct zr_json_field fields[] = {{.key = "POSITION", .read = zr_gltf_index, .offset = AT(position)},
                                              {.key = "NORMAL", .read = zr_gltf_index, .offset = AT(normal)},
                                              {.key = "TANGENT", .read = zr_gltf_index, .offset = AT(tangent)},
                                              {.key = "TEXCOORD_0", .read = zr_gltf_index, .offset = AT(texcoords[0])},
                                              {.key = "TEXCOORD_1", .read = zr_gltf_index, .offset = AT(texcoords[1])},
                                              {.key = "JOINTS_0", .read = zr_gltf_index, .offset = AT(joints[0])},
                                              {.key = "JOINTS_1", .read = zr_gltf_index, .offset = AT(joints[1])},
                                              {.key = "WEIGHTS_0", .read = zr_gltf_index, .offset = AT(weights[0])},
                                              {.key = "WEIGHTS_1", .read = zr_gltf_index, .offset = AT(weights[1])},
                                              {.key = "COLOR_0", .read = zr_gltf_index, .offset = AT(color)}};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("attributes", fields);

void zr_gltf_read_attributes(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                             struct zr_gltf_attributes *out)
{
    struct zr_json there = zr_json_at(&file->json, place);
    const struct zr_gltf_note before = file->unknown;
    uint64_t keys;
    zr_gltf_fields(file, &there, path, &object, out, &keys);
    file->unknown = before;
}

const char *zr_gltf_attribute_of(uint32_t number, size_t *offset)
{
    if (number >= sizeof fields / sizeof *fields) return NULL;
    *offset = fields[number].offset;
    return fields[number].key;
}

bool zr_gltf_open_attribute(struct zr_gltf *file, const struct zr_json_path *path, const char *name, uint32_t number,
                            int shape, int other, uint32_t vertices, struct zr_gltf_values *out)
{
    static const char *const words[ZR_GLTF_SHAPES] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const struct zr_json_path *at = ZR_JSON_KEY(path, name);
    if (!zr_gltf_open(file, at, number, out)) return false;
    const int found = out->accessor->shape;
    if (found != shape && found != other)
        return zr_json_fault(&file->json, at, "accessor %u is %s; %s is needed", number, words[found], words[shape]);
    return out->count >= vertices ||
           zr_json_fault(&file->json, at, "accessor %u has %u elements for %u vertices", number, out->count, vertices);
}
