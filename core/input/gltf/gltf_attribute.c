/* Reads the lists of attributes of primitives, and opens attributes. */
#include "input/gltf/gltf_parts.h"

#define AT(member) offsetof(struct zr_gltf_attributes, member)
static const struct zr_json_field fields[] = {{.key = "POSITION", .read = zr_gltf_index, .offset = AT(position)},
                                              {.key = "NORMAL", .read = zr_gltf_index, .offset = AT(normal)},
                                              {.key = "TANGENT", .read = zr_gltf_index, .offset = AT(tangent)},
                                              {.key = "TEXCOORD_0", .read = zr_gltf_index, .offset = AT(texcoords[0])},
                                              {.key = "TEXCOORD_1", .read = zr_gltf_index, .offset = AT(texcoords[1])},
                                              {.key = "TEXCOORD_2", .read = zr_gltf_index, .offset = AT(texcoords[2])},
                                              {.key = "TEXCOORD_3", .read = zr_gltf_index, .offset = AT(texcoords[3])},
                                              {.key = "TEXCOORD_4", .read = zr_gltf_index, .offset = AT(texcoords[4])},
                                              {.key = "TEXCOORD_5", .read = zr_gltf_index, .offset = AT(texcoords[5])},
                                              {.key = "TEXCOORD_6", .read = zr_gltf_index, .offset = AT(texcoords[6])},
                                              {.key = "TEXCOORD_7", .read = zr_gltf_index, .offset = AT(texcoords[7])},
                                              {.key = "JOINTS_0", .read = zr_gltf_index, .offset = AT(joints[0])},
                                              {.key = "JOINTS_1", .read = zr_gltf_index, .offset = AT(joints[1])},
                                              {.key = "WEIGHTS_0", .read = zr_gltf_index, .offset = AT(weights[0])},
                                              {.key = "WEIGHTS_1", .read = zr_gltf_index, .offset = AT(weights[1])},
                                              {.key = "COLOR_0", .read = zr_gltf_index, .offset = AT(color)}};
#undef AT
static const struct zr_json_object object = {ZR_JSON_FIELDS("attributes", fields), .is_open = true};

void zr_gltf_read_attributes(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                             struct zr_gltf_attributes *out)
{
    zr_gltf_fields_at(file, place, path, &object, out);
}

const char *zr_gltf_attribute_of(uint32_t number, size_t *offset)
{
    if (number >= sizeof fields / sizeof *fields) return NULL;
    *offset = fields[number].offset;
    return fields[number].key;
}

bool zr_gltf_open_attribute(struct zr_gltf *file, const struct zr_gltf_attribute *attribute, struct zr_gltf_values *out)
{
    static const char *const words[ZR_GLTF_SHAPES] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const struct zr_json_path *at = ZR_JSON_KEY(attribute->path, attribute->name);
    if (!zr_gltf_open(file, at, attribute->accessor, out)) return false;
    const int found = out->accessor->shape;
    if (found != attribute->shape)
        return zr_json_fault(&file->json, at, "accessor %u is %s; %s is needed", attribute->accessor, words[found],
                             words[attribute->shape]);
    return out->count >= attribute->least ||
           zr_json_fault(&file->json, at, "accessor %u has %u elements for %u vertices", attribute->accessor,
                         out->count, attribute->least);
}

float *zr_gltf_read_vectors(struct zr_gltf *file, const struct zr_gltf_attribute *attribute,
                            const struct zr_gltf_range *range)
{
    struct zr_gltf_values values;
    if (!zr_gltf_open_attribute(file, attribute, &values)) return NULL;
    values.mends = true;
    float *out = zr_gltf_allocate(file, range->count, values.width * sizeof *out);
    return out && zr_gltf_read_floats(file, &values, range, out, values.width) ? out : NULL;
}
