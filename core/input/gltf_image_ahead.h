/* gltf_image_ahead.h - input: images of glTF that are decoded by several threads, before the meshes are read.
 *
 * How:   a rehearsal with a copy of the reader reads the materials of the drawn primitives, in the order of the meshes,
 *        and lists their images. Its faults and counts are dropped: the meshes, which are read afterwards, report them.
 * Exact: scene, faults, warnings and memory are the same for every team (image_ahead.h). */
#ifndef ZR_GLTF_IMAGE_AHEAD_H
#define ZR_GLTF_IMAGE_AHEAD_H

#include "input/gltf.h"
#include "input/json_image_ahead.h"

/* In a rehearsal, textures add their images to root->ahead, and are not made. */
struct zr_gltf_listing {
    struct zr_parsed_scene *root;
    bool *has_material; /* one per material: it is listed */
};

/* Decodes the images of all drawn materials, before the first of them is read. */
void zr_gltf_read_images_ahead(struct zr_gltf *file);

/* gltf_material.c: lists the images of a material in a rehearsal. */
void zr_gltf_list_images_of(struct zr_gltf *file, uint32_t material);

#endif
