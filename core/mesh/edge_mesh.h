/* edge_mesh.h - mesh: the triangles of a mesh, joined by welded edges.
 *
 * Space:  object space.
 * Why:    lines of drawings are edges of the mesh: borders, creases and contours (lines/features.h).
 * How:    positions are welded (weld.h). Convex faces are cut as fans, others by geometry/triangulate.h. Triangles with
 *         fewer than three different vertices, or with a corner at infinity, are left out. Vertices are numbered in the
 *         order of the triangles. Each side of a triangle is listed at the lower of its vertices, and the lists are
 *         sorted. Pieces are connected across edges of two triangles: where more meet, solids touch or cut one another.
 * Exact:  the same for all instruction sets and numbers of threads. */
#ifndef ZR_EDGE_MESH_H
#define ZR_EDGE_MESH_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/scene.h"

/* Side k of triangle t has the number 3 t + k and leads from corner k to corner (k + 1) % 3. */
struct zr_mesh_edge {
    uint32_t low, high;  /* vertices, low < high */
    uint32_t first_side; /* index into `sides`; they end where those of the next edge begin */
};

struct zr_edge_mesh {
    uint32_t vertex_count, triangle_count, edge_count, piece_count;
    const uint32_t *positions;        /* by vertex: its first position */
    const uint32_t *corners;          /* three vertices per triangle */
    const uint32_t *slots;            /* three per triangle: into mesh->indices */
    const uint32_t *faces;            /* by triangle, ascending */
    const uint32_t *pieces;           /* by triangle: its piece, numbered in the order of triangles */
    const struct zr_mesh_edge *edges; /* edge_count + 1, ascending by (low, high); the last has first_side only */
    const uint32_t *sides;            /* 3 * triangle_count: numbers of sides by edge, ascending within an edge */
    const uint32_t *side_edges;       /* by number of side: its edge */
};

/* Makes the table in the arena. Takes about 110 bytes per triangle, of which 52 stay. Returns ZR_OK, ZR_NO_MEMORY or
 * ZR_CANCELLED. */
enum zr_status zr_edge_mesh_make(const struct zr_run *run, const struct zr_mesh *mesh, struct zr_edge_mesh *out);

static inline uint32_t zr_edge_side_count(const struct zr_edge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge + 1].first_side - mesh->edges[edge].first_side;
}

/* Returns true if the side leads from the lower to the higher vertex of its edge. */
static inline bool zr_side_is_upward(const struct zr_edge_mesh *mesh, uint32_t side)
{
    const uint32_t *corners = mesh->corners + side / 3 * 3, k = side % 3;
    return corners[k] < corners[(k + 1) % 3];
}

/* Returns true if the edge is a diagonal of a polygon: two of its triangles are cut from one face. */
bool zr_edge_is_diagonal(const struct zr_edge_mesh *mesh, uint32_t edge);

#endif
