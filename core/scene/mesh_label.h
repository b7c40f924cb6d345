/* mesh_label.h - scene: what a mesh is called in what is said to people: "mesh 3 'bunny'", by its number in the scene,
 * counted from 0, and its name, if it has one. All polygons together are 'polygons'. */
#ifndef ZR_MESH_LABEL_H
#define ZR_MESH_LABEL_H

#include <stdint.h>

/* A name that is too long is cut at a whole character; what is not printable in ASCII terms is a '?'. */
struct zr_mesh_label {
    char text[64];
};
struct zr_mesh_label zr_mesh_label_of(uint64_t number, const char *name);

#endif
