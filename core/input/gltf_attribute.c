/* Opens attributes of primitives. */
#include "input/gltf.h"

bool zr_gltf_open_attribute(struct zr_gltf *file, const struct zr_json_path *path, const char *name, uint32_t number,
                            int shape, int other, uint32_t vertices, struct zr_gltf_values *out)
{
    static const char *const words[ZR_GLTF_SHAPES] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const struct zr_json_path *at = ZR_JSON_KEY(path, name);
    if (!zr_gltf_open(file, at, number, out)) return false;
    const int found = out->accessor->shape;
    if (found != shape && found != other)
        return zr_json_fault(&file->root.json, at, "accessor %u is %s; %s is needed", number, words[found],
                             words[shape]);
    return out->count >= vertices || zr_json_fault(&file->root.json, at, "accessor %u has %u elements for %u vertices",
                                                   number, out->count, vertices);
}
