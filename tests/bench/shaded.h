/* shaded.h - bench: llvmpipe drawing a scene that is shaded pixel by pixel, by the GLSL of the reference.
 *
 * Before the first frame it gets indexed arrays in buffer objects, textures with all of their levels, and a program in
 * which what is the same all over the scene is a constant. In linear light textures are 32-bit floats, which llvmpipe
 * samples as fast as SRGB8_ALPHA8, and what is drawn is encoded by GL_FRAMEBUFFER_SRGB.
 * Scene:  triangles with normals at their vertices, one material a mesh, directional lamps, nothing see-through, no
 * fog, one sample a pixel. All materials are ZR_SHADING_PHONG and light is not linear, or all are ZR_SHADING_PBR and it
 * is; all have a texture of the base colour and no other one, or none has any.
 */
#ifndef ZR_BENCH_SHADED_H
#define ZR_BENCH_SHADED_H

#include "base/arena.h"
#include "reference/gl/reference.h"
#include "scene/camera/camera.h"
#include "shade/frame.h"

enum { SHADED_BUFFERS = 5 }; /* positions, colours, normals, texture coordinates, indices */

struct shaded {
    struct reference *reference;
    struct zr_arena arena;
    const struct zr_scene *scene;
    struct zr_camera camera;
    struct reference_arrays arrays; /* a batch an instance */
    unsigned *textures;
    unsigned program; /* of linear light; 0: the reference's own */
    unsigned buffers[SHADED_BUFFERS];
};

/* exact as of theirs_open. It ends with the child that opened it. False, explained on stderr. */
bool shaded_open(struct shaded *shaded, bool exact, int threads);

/* What is drawn from now on; the scene must stay. Once for each shaded_open. */
bool shaded_take(struct shaded *shaded, const struct zr_scene *scene);

/* Clears, draws, and waits for the result, which reference_read reads. */
bool shaded_draw(struct shaded *shaded);

/* After shaded_draw: over its depths the number of each instance, from 1, as the bytes of a colour, lowest first. */
bool shaded_draw_ids(struct shaded *shaded);

#endif
