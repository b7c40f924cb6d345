/* slices.h - sections: splits the rings of a mesh by planes, and closes closed parts again by caps.
 *
 * Space:  object space; distances from a plane in double, in the units of the plane.
 * Why:    a sectioned mesh is drawn as any other mesh, so every channel, algorithm and effect shows the section.
 * How:    each ring is clipped (Sutherland & Hodgman, "Reentrant polygon clipping", 1974). A clipped ring gets a chord
 *         from each corner where it leaves the kept side to the next one where it comes back. If a part is closed, as
 *         many chords end at a vertex as begin there; reversed, they form closed loops around the cap. The winding
 *         number of the loops at a point of the plane is that of the part. Caps are faces: later planes clip them, too.
 * Exact:  corners are welded (weld.h). Sides are decided per vertex. The vertex on an edge is computed once per edge,
 *         in double from its ends in the order of their numbers, and is rounded once. Faces that share the edge, and
 *         the cap, share this vertex: there is no crack.
 * Ties:   a vertex within ZR_SLICE_ON of the plane lies on it and counts as cut away. A face in the plane is thus
 *         replaced by a cap if the solid continues on the kept side, and disappears otherwise.
 */
#ifndef ZR_SLICES_H
#define ZR_SLICES_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/scene.h"
#include "scene/section.h"

/* Treatment of a part. */
enum { ZR_SLICE_OPEN, /* cut, without caps */ ZR_SLICE_CLOSED, /* cut, with caps */ ZR_SLICE_UNCUT };

/* A point x is kept if n.x + offset > on. */
struct zr_slice_plane {
    double normal[3], offset;
    double on; /* tolerance; at least 0 */
};

/* Returns the signed distance of a position; 0 if it lies on the plane. */
static inline double zr_slice_distance(const struct zr_slice_plane *plane, zr_vec4 position)
{
    const zr_vec3 p = zr_vec4_over_w(position);
    const double distance =
        ((plane->normal[0] * (double)p.x + plane->normal[1] * (double)p.y) + plane->normal[2] * (double)p.z) +
        plane->offset;
    return fabs(distance) <= plane->on ? 0.0 : distance;
}

/* The planes of a section in object space. */
struct zr_section_cut {
    uint32_t plane_count; /* 1..ZR_SECTION_PLANES_MAX */
    struct zr_slice_plane planes[ZR_SECTION_PLANES_MAX];
    bool is_corner;
};

/* Tolerance relative to the diagonal of the scene. */
#define ZR_SLICE_ON 1e-12

#define ZR_SLICE_NONE UINT32_MAX

/* A corner made by a plane: between two earlier corners at `t`, or a corner of a cap, with a and b ZR_SLICE_NONE.
 * Corners below zr_slices.slot_count are those of the mesh, by slot. */
struct zr_slice_corner {
    uint32_t a, b;
    double t; /* 0 at a, 1 at b */
    uint32_t vertex;
};

/* Faces as lists of rings, and rings as lists of corners. The first face, ring and corner have number 0. */
struct zr_slice_faces {
    uint32_t face_count, ring_count, corner_count;
    uint32_t *numbers;   /* per face: its number in the mesh, ascending; mesh->face_count + c: cap c */
    bool *is_saved;      /* per face: later planes split it and drop nothing */
    uint32_t *face_ends; /* per face: end of its rings */
    uint32_t *ring_ends; /* per ring: end of its corners */
    uint32_t *corners;
};

struct zr_slice_cap {
    uint32_t part;  /* of the mesh */
    uint32_t plane; /* number of the zr_slice_plane that made it */
    uint32_t face;  /* of the mesh: one that the cap touches */
};

/* A mesh that is split by one plane after the other. */
struct zr_slices {
    const struct zr_mesh *mesh;
    const struct zr_cancel *cancel;
    const uint8_t *parts;  /* per part of the mesh: ZR_SLICE_OPEN and so on */
    uint32_t slot_count;   /* corners of the mesh */
    uint32_t corner_count; /* with those made by planes */
    struct zr_slice_corner *made;
    uint32_t vertex_count;
    const uint32_t *vertices; /* per position of the mesh */
    zr_vec3 *points;          /* per vertex */
    uint32_t cap_count, plane_count;
    struct zr_slice_cap *caps;
};

/* Returns the vertex of a corner. */
static inline uint32_t zr_slice_vertex(const struct zr_slices *slices, uint32_t corner)
{
    return corner < slices->slot_count ? slices->vertices[slices->mesh->indices[corner]]
                                       : slices->made[corner - slices->slot_count].vertex;
}

/* Welds the mesh and lists the faces that are cut and, apart, those of uncut parts. A ring behind the first one is
 * turned against it. Everything lies in the arena. The positions of the mesh have w > 0. Fails with ZR_NO_MEMORY or
 * ZR_CANCELLED. */
enum zr_status zr_slices_begin(const struct zr_run *run, const struct zr_mesh *mesh, const uint8_t *parts,
                               struct zr_slices *slices, struct zr_slice_faces *faces, struct zr_slice_faces *uncut);

/* Which side of a plane stays. */
enum zr_slice_mode {
    ZR_SLICE_KEEPS, /* the kept one; what lies on the plane is cut away */
    ZR_SLICE_SAVES  /* the other one and what lies on the plane; the kept side is saved without its caps */
};

/* Splits `faces` by a plane, and closes the side that stays by caps. Faces come in the order of `faces`. Fails with
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_slices_split(struct zr_arena *arena, struct zr_slices *slices, const struct zr_slice_plane *plane,
                               enum zr_slice_mode mode, const struct zr_slice_faces *faces, struct zr_slice_faces *out);

/* ---- slice_caps.c ---- */

/* A chord, reversed: an edge of a cap. */
struct zr_slice_segment {
    uint32_t part, from, to; /* vertices */
    uint32_t face;           /* of the mesh */
};

/* Joins the segments of each part into loops, and appends one face per part to `faces`, whose arrays have room for one
 * face, one ring and one corner per segment. Sorts the segments. Makes one corner per segment; `made` has room for
 * them. */
enum zr_status zr_slice_caps_add(struct zr_arena *arena, struct zr_slices *slices, struct zr_slice_segment *segments,
                                 uint32_t count, struct zr_slice_faces *faces);

#endif
