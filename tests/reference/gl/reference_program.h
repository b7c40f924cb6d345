/* reference_program.h - reference: GLSL programs of a test's own, whose results are floats, four a pixel.
 *
 * What a program gets: gl_Vertex and the matrices as every batch has them, so that ftransform() puts its vertices where
 *         the comparison has them; attributes of its own, one a corner; uniforms. It may also look at gl_Color and
 *         gl_Normal of the arrays, and has from each batch `uniform vec3 normal_rows[3]`, `uniform mat4 to_world`,
 *         `uniform int shading` and what else a material says, where it declares them and the batch knows them.
 * What it gives: gl_FragColor, written to 32-bit floats, neither clamped nor rounded, in a frame buffer object that has
 *         the depth buffer of the other one. GL clamps gl_FrontColor and gl_BackColor, but no other varying.
 *
 *     unsigned program = reference_program(vertex, fragment, &error);
 *     const struct reference_attribute up = {"up", 3, &normals[0].x};
 *     const struct reference_shader shader = {.program = program, .attribute_count = 1, .attributes = &up};
 *     if (program && reference_resize(reference, width, height, false, &error) &&
 *         reference_draw_floats(reference, &arrays, &shader, rgba, &error)) ...
 *     reference_program_delete(program);
 */
#ifndef ZR_TEST_REFERENCE_PROGRAM_H
#define ZR_TEST_REFERENCE_PROGRAM_H

#include "reference/gl/reference.h"

struct reference_attribute {
    const char *name;
    int size;            /* floats a corner: 1..4 */
    const float *values; /* one a corner, or, where the arrays have indices, one a vertex */
};

struct reference_uniform {
    const char *name;
    int size;            /* floats an element: 1..4, or 16 of a mat4 by columns */
    int count;           /* elements; 1 but for arrays */
    const float *values; /* bool and int uniforms take these too */
};

struct reference_shader {
    unsigned program; /* 0: the batches are drawn as reference_draw does, lit where they are */
    uint32_t attribute_count, uniform_count;
    const struct reference_attribute *attributes;
    const struct reference_uniform *uniforms;
};

/* A program of these GLSL sources; `fragment` NULL: what the fixed functions do. 0 where it does not compile or link:
 * *error has the first lines of GL's log. */
unsigned reference_program(const char *vertex, const char *fragment, struct reference_error *error);
void reference_program_delete(unsigned program);

/* Of the program in use. A name that it does not have is an error. */
bool reference_uniform_set(unsigned program, const struct reference_uniform *uniform, struct reference_error *error);

/* Clears to the background and depth 1, and draws all batches by the program. Of a window of the size last given to
 * reference_resize: 4 floats a pixel to rgba, row 0 on top. A name that the program does not have, or does not use, is
 * an error. reference_read reads the depths of this draw. */
bool reference_draw_floats(struct reference *reference, const struct reference_arrays *arrays,
                           const struct reference_shader *shader, float *rgba, struct reference_error *error);

#endif
