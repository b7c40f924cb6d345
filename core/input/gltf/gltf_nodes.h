/* gltf_nodes.h - input: the nodes of a glTF file, private to gltf_node.c, which reads them, and gltf_place.c. */
#ifndef ZR_GLTF_NODES_H
#define ZR_GLTF_NODES_H

#include "input/gltf/gltf_file.h"
#include "scene/parts/nodes.h"

struct zr_gltf_nodes {
    uint32_t count, child_count;
    struct zr_node *nodes; /* `mesh`: number of a mesh of the file, later of an entry of file->uses */
    uint32_t *children;
    const char **places;                /* JSON text of the lists of children, or NULL */
    uint32_t *parents;                  /* or NONE */
    bool *is_drawn;                     /* the node is a root of the scene or its descendant */
    uint32_t *skins, *cameras, *lights; /* or NONE */
    const char **names;
    const char **weights, **instancing;
    zr_mat4 *worlds;
    double (*exact)[3]; /* translations of the local matrices */
    uint32_t *stack;    /* numbers of nodes to visit */
    size_t stacked;
};

#endif
