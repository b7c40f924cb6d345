/* reference_gl.h - reference: what the files that draw with GL share. */
#ifndef ZR_TEST_REFERENCE_GL_H
#define ZR_TEST_REFERENCE_GL_H

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include "reference/gl/reference_program.h"

/* The program that lights, and where its uniforms are. */
struct reference_lighter {
    GLuint program; /* 0: not made yet */
    GLint ambient, light_count, to_light, light_color, normal_rows, side;
    GLint lamp_at, lamp_axis, lamp_fall;                             /* of lamps that have a place */
    GLint to_eye, model, specular, shininess, eye, in_fog, textured; /* of what is shaded late */
};

struct reference {
    void *context;
    char name[160];
    int mesa_version;
    uint32_t width, height;
    bool stencil;
    GLuint frame_buffer, color, depth;
    GLuint float_frame_buffer, float_color; /* 0: not made yet; its depth is that above */
    struct reference_lighter lighter, late_lighter;
    struct reference_lighter placed_lighter, placed_late_lighter; /* the same where some lamp has a place */
    uint8_t *row;                                                 /* of the widest attachment */
    GLuint buffers[3];                                            /* of what is kept: positions, front, indices */
    const zr_vec4 *kept;                                          /* whose positions these are; NULL: nothing is kept */

    /* For benchmarks, GLSL that late lighters to come have as constants: "#define FIXED", and declarations of all that
     * are uniforms without it, since branches of a uniform are computed on both sides. NULL: they are uniforms. */
    const char *fixed;
};

/* Says in *error what failed, with GL's error code, and returns false. */
bool reference_failed(struct reference_error *error, const char *what);

/* The same where GL has an error to tell, else true. */
bool reference_gl_ok(struct reference_error *error, const char *what);

/* Of lines and outlines from now on; false where the driver has none so wide. */
bool reference_set_line_width(float pixels, struct reference_error *error);

/* The same of points, for all that are to come. */
bool reference_has_point_sizes(const struct reference_arrays *arrays, struct reference_error *error);

/* Clears the frame buffer that is bound, draws into it, and waits. `program` 0: the batches choose theirs. */
bool reference_draw_batches(struct reference *reference, const struct reference_arrays *arrays, GLuint program,
                            struct reference_error *error);

/* Chooses a program of a test's own, and gives it what it gets from each batch. */
void reference_program_batch(GLuint program, const struct reference_batch *batch, const struct zr_scene *textures_of);

/* Turns rows around: GL's row 0 is the bottom. */
void reference_flip(const struct reference *reference, void *pixels, size_t pixel_bytes);

/* Gives the program that lights what it needs, and makes it when it is first wanted: that takes some ms. */
bool reference_light_begin(struct reference *reference, const struct reference_arrays *arrays,
                           struct reference_error *error);

/* Chooses the program of one batch: the one that lights, or the fixed functions. */
void reference_light_batch(struct reference *reference, const struct reference_arrays *arrays,
                           const struct reference_batch *batch);

/* reference_fixed.c: whether the fixed functions can light a batch, so that no program need; and turns them on, or off
 * again. */
bool reference_fixed_can(const struct reference_arrays *arrays, const struct reference_batch *batch);
void reference_fixed_begin(const struct reference_arrays *arrays);
void reference_fixed_end(const struct reference_arrays *arrays);

#endif
