/* solids.h - support: closed meshes for tests, each within 2 of the origin. */
#ifndef ZR_TEST_SOLIDS_H
#define ZR_TEST_SOLIDS_H

#include "base/arena.h"
#include "scene/scene.h"

enum solid {
    SOLID_CUBE,        /* quads */
    SOLID_SPHERE,      /* triangles without shared positions */
    SOLID_TORUS,       /* triangles */
    SOLID_RING,        /* a torus of quads */
    SOLID_HOLLOW,      /* a cube with a cubic cavity */
    SOLID_OVERLAPPING, /* three cubes, one inside another; winding numbers up to 3 */
    SOLID_PLATE,       /* faces with holes */
    SOLID_INSIDE_OUT,  /* a sphere with its faces turned inwards */
    SOLIDS
};

extern const char *const solid_names[SOLIDS];

/* Makes the mesh in the arena. */
struct zr_mesh solid_make(struct zr_arena *arena, enum solid solid);

/* Returns the volume that its faces enclose: the sum over the fans of all rings, in double. */
double solid_volume(const struct zr_mesh *mesh);

#endif
