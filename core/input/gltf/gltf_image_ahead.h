/* gltf_image_ahead.h - input: decodes the images of glTF by several threads, before the meshes are read.
 *
 * How:   in a rehearsal, a copy of the reader reads the materials of the drawn primitives in the order of the meshes,
 *        and lists their images. Faults and counts of the rehearsal are dropped. The later reading reports them.
 * Exact: scene, faults, warnings and memory are the same for every team (image_ahead.h). */
#ifndef ZR_GLTF_IMAGE_AHEAD_H
#define ZR_GLTF_IMAGE_AHEAD_H

#include "input/gltf/gltf_file.h"

/* Decodes the images of all drawn materials before the first material is read. */
void zr_gltf_read_images_ahead(struct zr_gltf *file);

#endif
