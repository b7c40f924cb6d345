/* mesh_label.h - scene: label of a mesh in messages, such as "mesh 3 'bunny'": its number in the scene, from 0, and its
 * name, if it has one. The mesh of the key `polygons` is named 'polygons'. */
#ifndef ZR_MESH_LABEL_H
#define ZR_MESH_LABEL_H

#include <stdint.h>

/* Names are cut to 32 bytes at a whole UTF-8 character; ASCII control characters become '?'. */
struct zr_mesh_label {
    char text[64];
};
struct zr_mesh_label zr_mesh_label_of(uint64_t number, const char *name);

#endif
