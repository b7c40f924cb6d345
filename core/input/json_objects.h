/* json_objects.h - input: the tables of keys of all kinds of objects that a scene has, each in the file that reads it:
 * for whoever writes a schema or a manual of them, and for the test that holds them against what rows must have. */
#ifndef ZR_JSON_OBJECTS_H
#define ZR_JSON_OBJECTS_H

#include "input/json_value.h"

#define ZR_JSON_OBJECTS(ROW)                                                                                           \
    ROW(scene)                                                                                                         \
    ROW(window)                                                                                                        \
    ROW(view)                                                                                                          \
    ROW(gradient)                                                                                                      \
    ROW(environment)                                                                                                   \
    ROW(occlusion)                                                                                                     \
    ROW(edges)                                                                                                         \
    ROW(colorBar)                                                                                                      \
    ROW(fit)                                                                                                           \
    ROW(perspective)                                                                                                   \
    ROW(orthographic)                                                                                                  \
    ROW(intrinsics)                                                                                                    \
    ROW(light)                                                                                                         \
    ROW(fog)                                                                                                           \
    ROW(material)                                                                                                      \
    ROW(texture)                                                                                                       \
    ROW(normalTexture)                                                                                                 \
    ROW(occlusionTexture) ROW(sampler) ROW(mesh) ROW(heights) ROW(polygon) ROW(node) ROW(output) ROW(base) ROW(bytes)

#define ZR_JSON_OBJECT_DECLARED(name) extern const struct zr_json_object zr_json_object_##name;
ZR_JSON_OBJECTS(ZR_JSON_OBJECT_DECLARED)
#undef ZR_JSON_OBJECT_DECLARED

#endif
