/* mtl.h - input: materials of Wavefront MTL files, converted to materials of a scene.
 *
 *     mtl = zr_mtl_open(builder, request, limits, error)
 *     zr_mtl_add(mtl, name, length) for each file that mtllib names; then zr_mtl_has_maps(mtl)
 *     zr_mtl_use(mtl, name, length) for each usemtl: the number of the material in zr_mtl_made(mtl)
 *     zr_mtl_make_used(mtl): the values and images of these materials
 *     zr_mtl_close: the warnings
 *
 * Source: Wavefront, "MTL material format" 4.2 (1995); Clara.io, "Extending Wavefront MTL for physically-based
 *         rendering" (2013), for Pr, Pm, map_Pr, map_Pm, map_Ke and norm.
 * Values: Kd and Ke are sRGB-encoded, as in three.js. Values are clamped to 0..1; Ke may be larger.
 * Base:   Kd; its alpha is d, or 1 - Tr if d is not given. An alpha of 0 is taken as 1, as in obj2gltf, since some
 *         programs write Tr 1 or d 0 for opaque. An alpha below 1 or a map_d means BLEND. map_Kd multiplies Kd, as in
 *         the format and three.js. A Kd of 0, 0, 0 beside a map_Kd would draw black: it is taken as 1, as in Blender
 *         and obj2gltf. map_d is the alpha channel of its image if that is not 1 everywhere, else the red one.
 * Rough:  Pr, else the formula of obj2gltf: 1 - Ns / 1000, times 1 - s if the luminance s = 0.2125 r + 0.7154 g +
 *         0.0721 b of Ks is below 0.1. Without Pr and Ns, the look's roughness.
 * Metal:  Pm, else 0 if Ns or Ks is given, else the look's metalness. Ks has no other effect.
 * Normal: norm, else map_Bump or bump, if the image has colours: recent programs write normal maps there. -bm is its
 *         factor. A grey image holds heights, which are not drawn.
 * Lazy:   zr_mtl_add only indexes lines. Only used materials and their images are read.
 * Thread: one struct zr_mtl belongs to one thread.
 */
#ifndef ZR_MTL_H
#define ZR_MTL_H

#include "input/model/model_scene.h"
#include "input/text/text.h"

struct zr_mtl; /* mtl_file.h */

/* Makes a reader without files; zr_mtl_add finds them among the request's assets.
 * Allocates from the builder's arena. Returns NULL without memory. */
struct zr_mtl *zr_mtl_open(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error);

/* mtl_index.c: indexes the file of this name.
 * False if the request has none, after a failure (zr_mtl_status), or beyond ZR_MTL_SOUGHT_MAX names. */
enum { ZR_MTL_SOUGHT_MAX = 4096 };
bool zr_mtl_add(struct zr_mtl *mtl, const char *name, size_t length);

/* Indexes the only asset whose name ends in .mtl, for files that were renamed. Returns its name, or NULL. */
const char *zr_mtl_add_only(struct zr_mtl *mtl);

/* Returns the number of a material in zr_mtl_made(mtl), or ZR_MODEL_MATERIAL_NONE. zr_mtl_make_used sets its values. */
uint32_t zr_mtl_use(struct zr_mtl *mtl, const char *name, size_t length);

/* mtl_used.c: reads the used materials, in the order of their first uses. Decodes their images by several threads.
 * Failures are in zr_mtl_status. */
void zr_mtl_make_used(struct zr_mtl *mtl);

/* Warns of properties that are not drawn, and of unused assets. */
void zr_mtl_close(struct zr_mtl *mtl);

/* ZR_OK, or the failure that stopped the reading. */
enum zr_status zr_mtl_status(const struct zr_mtl *mtl);

/* The materials that are used, and the number of indexed files. True for maps: a material of theirs has one. */
struct zr_model_scene *zr_mtl_made(const struct zr_mtl *mtl);
uint32_t zr_mtl_file_count(const struct zr_mtl *mtl);
bool zr_mtl_has_maps(const struct zr_mtl *mtl);

/* True if a name ends in .mtl. */
bool zr_mtl_is_file_name(const char *name, const char *end);

#endif
