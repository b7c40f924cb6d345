/* eye_vectors.h - shade: the attribute POINT: vectors from the eye to the vertices of an instance.
 *
 * Space:  eye space. xyz: the vector times w, which is linear over a face; for a parallel projection, the point. w:
 *         distance along the view axis, for fog.
 * Exact:  the functions and the kernel (eye_values_simd.h) give the same bytes.
 */
#ifndef ZR_EYE_VECTORS_H
#define ZR_EYE_VECTORS_H

#include "base/mutant.h"
#include "base/run.h"
#include "base/vec.h"

/* Input of the vectors of one instance. */
struct zr_eye_vectors {
    const zr_vec4 *positions; /* of the mesh */
    uint32_t count;           /* positions */
    const zr_vec4 *cut;       /* vectors of the vertices that clipping made, numbered from `count` on; or NULL */
    zr_mat4 to_eye;
    zr_vec4 eye; /* zr_camera_eye */
};

/* Returns the distance of a vertex along the view axis, for fog; `p` is the vertex in eye space. */
static inline float zr_eye_vector_depth(const zr_mat4 *to_eye, zr_vec4 position, zr_vec4 p)
{
    const float *m = to_eye->m;
    const float from_last = ((m[14] * position.w + m[10] * position.z) + m[6] * position.y) + m[2] * position.x;
    const float right = ZR_MUTANT(older_mesa, p.z, from_last), wrong = ZR_MUTANT(older_mesa, from_last, p.z);
    const float z = ZR_MUTANT(fog_z_other_way, right, wrong);
    return fabsf(p.w != 0.0f ? z / p.w : z);
}

/* Returns the vector to a vertex. */
static inline zr_vec4 zr_eye_vector(const struct zr_eye_vectors *of, uint32_t vertex)
{
    if (vertex >= of->count) return of->cut[vertex - of->count];
    const zr_vec4 position = of->positions[vertex], eye = of->eye, p = zr_mat4_apply(&of->to_eye, position);
    zr_vec4 out = p;
    if (eye.w != 0.0f) out = (zr_vec4){p.x - eye.x * p.w, p.y - eye.y * p.w, p.z - eye.z * p.w, 0.0f};
    out.w = zr_eye_vector_depth(&of->to_eye, position, p);
    return out;
}

/* Writes the vectors of all positions to out[]. Returns early if cancelled. */
void zr_eye_vectors_make(const struct zr_run *run, const struct zr_eye_vectors *of, zr_vec4 *out);

#endif
