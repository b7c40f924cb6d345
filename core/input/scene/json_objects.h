/* json_objects.h - input: tables of keys of all objects of a scene, for the schema, the manual and a test of their
 * rows.
 */
#ifndef ZR_JSON_OBJECTS_H
#define ZR_JSON_OBJECTS_H

#include "input/json/json_value.h"

#define ZR_JSON_OBJECTS(ROW)                                                                                           \
    ROW(scene)                                                                                                         \
    ROW(window)                                                                                                        \
    ROW(view)                                                                                                          \
    ROW(gradient)                                                                                                      \
    ROW(environment)                                                                                                   \
    ROW(occlusion)                                                                                                     \
    ROW(edges)                                                                                                         \
    ROW(sections)                                                                                                      \
    ROW(plane)                                                                                                         \
    ROW(views)                                                                                                         \
    ROW(turntable)                                                                                                     \
    ROW(orbit)                                                                                                         \
    ROW(sheet)                                                                                                         \
    ROW(animate)                                                                                                       \
    ROW(track)                                                                                                         \
    ROW(rotate)                                                                                                        \
    ROW(colorBar)                                                                                                      \
    ROW(dimension)                                                                                                     \
    ROW(mark)                                                                                                          \
    ROW(dimensionEnd)                                                                                                  \
    ROW(highlight)                                                                                                     \
    ROW(explode)                                                                                                       \
    ROW(csg)                                                                                                           \
    ROW(fit)                                                                                                           \
    ROW(perspective)                                                                                                   \
    ROW(orthographic)                                                                                                  \
    ROW(intrinsics)                                                                                                    \
    ROW(distortion)                                                                                                    \
    ROW(light)                                                                                                         \
    ROW(fog)                                                                                                           \
    ROW(material)                                                                                                      \
    ROW(texture)                                                                                                       \
    ROW(normalTexture)                                                                                                 \
    ROW(occlusionTexture)                                                                                              \
    ROW(sampler) ROW(mesh) ROW(heights) ROW(shape) ROW(polygon) ROW(node) ROW(output) ROW(flow) ROW(base) ROW(bytes)

#define ZR_JSON_OBJECT_DECLARED(name) extern const struct zr_json_object zr_json_object_##name;
ZR_JSON_OBJECTS(ZR_JSON_OBJECT_DECLARED)
#undef ZR_JSON_OBJECT_DECLARED

#endif
