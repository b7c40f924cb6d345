/* gltf_image_ahead.h - input: decodes the images of glTF by several threads, before the meshes are read.
 *
 * How:   in a rehearsal, a copy of the reader reads the materials of the drawn primitives in the order of the meshes,
 *        and lists their images. Faults and counts of the rehearsal are dropped. The later reading reports them.
 * Exact: scene, faults, warnings and memory are the same for every team (image_ahead.h). */
#ifndef ZR_GLTF_IMAGE_AHEAD_H
#define ZR_GLTF_IMAGE_AHEAD_H

#include "input/gltf/gltf.h"

/* State of a rehearsal. Textures list their images for decoding ahead, and are not made. */
struct zr_gltf_listing {
    struct zr_image_list *images;
    bool *has_material; /* one per material: true if it is listed */
};

/* Decodes the images of all drawn materials before the first material is read. */
void zr_gltf_read_images_ahead(struct zr_gltf *file);

/* gltf_material.c: lists the images of a material in a rehearsal. */
void zr_gltf_list_images_of(struct zr_gltf *file, uint32_t material);

#endif
