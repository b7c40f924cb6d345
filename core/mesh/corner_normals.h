/* corner_normals.h - mesh: normals per corner of a mesh, of which equal ones are stored once.
 *
 * Space:  object space. */
#ifndef ZR_CORNER_NORMALS_H
#define ZR_CORNER_NORMALS_H

#include <stdint.h>

#include "base/vec.h"

/* Unit normals, each of one corner or more, in the order of their first corners; 0 if no face of the vertex has an
 * area. w is undefined. */
struct zr_crease_normals {
    const zr_vec4 *normals;
    const uint32_t *numbers; /* per corner (slot of mesh->indices): index of its normal; NULL: the corner's own */
    uint32_t count;
};

static inline uint32_t zr_crease_number_of(const struct zr_crease_normals *creases, uint32_t corner)
{
    return creases->numbers ? creases->numbers[corner] : corner;
}

static inline zr_vec3 zr_crease_normal_of(const struct zr_crease_normals *creases, uint32_t corner)
{
    const zr_vec4 *normal = &creases->normals[zr_crease_number_of(creases, corner)];
    return (zr_vec3){normal->x, normal->y, normal->z};
}

#endif
