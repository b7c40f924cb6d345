/* mesh_tables.h - mesh: tables of meshes that depend on no view: made once, for several views of a scene.
 *
 * Why:     without them, 36 views of the bunny take 1.2 times the processor time in `technical`, 1.06 in `studio`, and
 *          1.13 in `textbook` with the shading gouraud.
 * Exact:   a table equals the one that a single view computes.
 * Threads: nothing here changes once it is made. */
#ifndef ZR_MESH_TABLES_H
#define ZR_MESH_TABLES_H

#include "base/run.h"
#include "mesh/crease_normals.h"
#include "mesh/edge_mesh.h"

struct zr_mesh_tables {
    const struct zr_mesh *meshes; /* of the scene they were made from */
    uint32_t count;
    float crease_degrees;
    const struct zr_crease_normals *const *creases; /* by mesh, or NULL; NULL: none */
    const zr_vec4 *const *normals;                  /* by mesh: vertex normals, or NULL; NULL: none */
    const struct zr_edge_mesh *edges;               /* by mesh; NULL: none */
};

/* Makes the tables that the scene's picture needs, as far as they fit into an eighth of the memory that is left.
 * Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_mesh_tables_make(const struct zr_run *run, const struct zr_scene *scene, struct zr_mesh_tables *out);

/* Returns the table of a mesh of a scene; NULL if there is none. `tables` may be NULL. */
const struct zr_crease_normals *zr_mesh_table_creases(const struct zr_mesh_tables *tables, const struct zr_scene *scene,
                                                      uint32_t mesh);
const zr_vec4 *zr_mesh_table_normals(const struct zr_mesh_tables *tables, const struct zr_scene *scene, uint32_t mesh);
const struct zr_edge_mesh *zr_mesh_table_edges(const struct zr_mesh_tables *tables, const struct zr_scene *scene,
                                               uint32_t mesh);

#endif
