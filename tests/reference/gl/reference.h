/* reference.h - reference: the renderer that ours is held against.
 *
 * What it must be: Mesa's llvmpipe (or softpipe, where that is asked for), drawing
 * into a frame buffer object with RGBA8 colour and 32-bit float depth; dither off,
 * depth test LESS, cleared to the background and depth 1.
 * reference_gl.c draws, in plain GL; what is lit is lit by a program that the reference
 * runs (reference_light.c). How one gets hold of a context differs, so each way is a back
 * end in a file of its own, and a program is linked with one of them: reference_osmesa.c,
 * reference_egl.c.
 * A reference that is missing, or is some other renderer, is a failure.
 */
#ifndef ZR_TEST_REFERENCE_H
#define ZR_TEST_REFERENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"
#include "scene/scene.h"

struct reference_options {
    const char *driver; /* "llvmpipe" or "softpipe" */
    /* false: generated code without fused multiply-add, which is what our own
     * arithmetic equals. true: all that the machine has, for benchmarks. */
    bool native;
    int threads; /* that rasterize; 0: the driver's choice */
};

enum reference_mode {
    REFERENCE_TRIANGLES,
    REFERENCE_POLYGON, /* one convex polygon */
    REFERENCE_PARITY,  /* one polygon of any shape: the odd-even rule over its rings */
    REFERENCE_LINES,
    REFERENCE_POINTS
};

/* Which colours a batch has. The two lit colours of a corner are those of its normal and of the opposite one. */
enum reference_light {
    REFERENCE_UNLIT,     /* those given */
    REFERENCE_LIT,       /* fronts have that of the normal, backs the other */
    REFERENCE_LIT_FRONT, /* both sides have that of the normal */
    REFERENCE_LIT_BACK   /* both sides have the other */
};

/* A lamp that has a place, in eye space, counted from the eye as `light_points` are; by KHR_lights_punctual. */
struct reference_place {
    float position[4];   /* w: 1 where the lamp has a place, else 0, and nothing else is looked at */
    float axis[4];       /* of a spot: unit, against its light; else 0; w: 1 / range^2, or 0 */
    float scale, offset; /* of the cosine of the angle from the axis */
    float unit, least;   /* the square of a scene unit; the least square of a distance */
};

/* Ambient light and lights, in eye space. */
enum { REFERENCE_LIGHTS_MAX = 1024, REFERENCE_PLACED_MAX = 64, REFERENCE_FIXED_MAX = 8 };
struct reference_lighting {
    zr_vec3 ambient;
    uint32_t count;          /* at most REFERENCE_LIGHTS_MAX */
    const zr_vec3 *to_light; /* unit vectors towards the lights */
    const zr_vec3 *colors;
    const struct reference_place *places; /* one a light, at most REFERENCE_PLACED_MAX; NULL: no light has one */
    bool is_fixed; /* the fixed functions can light: all are point lamps without a range, and the eye is the origin */
};

/* A run of primitives of one mode, drawn with one state. Counts are of corners. */
struct reference_batch {
    enum reference_mode mode;
    uint32_t first, count;
    /* REFERENCE_PARITY: the fans of its rings, as triangles, whose parity tells what is inside; the
     * triangles of first and count then tell depth and colour there, the first that covers a sample. */
    uint32_t rings_first, rings_count;
    bool winding;  /* of REFERENCE_PARITY: the non-zero rule instead, for winding numbers from -15 to 15 */
    uint8_t claim; /* of winding: a stencil bit of its plane, above those of the number; samples that have it are left
                      to the batch that set it; 0: none */
    const zr_mat4 *modelview;
    enum reference_light light;
    const zr_vec3
        *normal_rows; /* of what is lit: the three rows of the matrix from object-space normals to eye space */
    /* Of what is shaded by normals, pixel by pixel; else NULL. It is lit, too, and smooth. */
    const struct zr_material *late;
    const struct zr_material *material; /* of areas drawn by a program that looks at it; else NULL */
    const struct zr_material *textured; /* of what shows textures, whose these are; else NULL */
    const zr_mat4 *to_eye;              /* positions -> eye space, for points */
    const zr_mat4 *to_world;            /* positions -> world space, for programs that look at it */
    uint32_t instance;                  /* of the scene; from 0 */
    zr_vec4 eye;                        /* zr_camera_eye */
    bool smooth;         /* false: all corners of a primitive must have one colour, but for first_provokes */
    bool first_provokes; /* a flat triangle has the colour of its first corner, GL's own rule is the last */
    bool cull;           /* what shows its back is not drawn */
    bool mirrored;       /* clockwise is the front */
    bool outline;        /* edges instead of areas (glPolygonMode) */
    float point_size;    /* of points, pixels */
    bool depth_offset;   /* moved back by glPolygonOffset(1, 1), to make room for outlines */
};

/* `front` is what is seen of unlit batches, and the surface's own colour of lit ones. */
struct reference_arrays {
    const zr_vec4 *positions, *front; /* one a corner, or, with `indices`, one a vertex */
    const zr_vec3 *normals;           /* in object space, of any length; NULL where no batch is lit */
    /* Where lighting->places: normals in eye space, unit, and the places where corners are lit. */
    const zr_vec3 *unit_normals, *light_points;
    const struct reference_lighting *lighting; /* NULL where no batch is lit */
    const uint32_t *indices;                   /* NULL, or one a corner */
    const zr_vec4 *texcoords;                  /* one a corner; NULL where no batch is textured */
    const zr_vec4 *tangents;                   /* likewise, object space; w = 0: there is none */
    const struct zr_scene *textures_of;        /* of what is textured */
    bool decode;                               /* textures are in linear light */
    uint32_t batch_count;
    const struct reference_batch *batches; /* drawn in this order */
    zr_mat4 projection;
    zr_vec4 background;
    struct zr_fog fog;
    float line_width; /* of lines and outlines, whole pixels; 0: 1 */
    bool blended;     /* all batches are, by their alpha, in the order in which they come, without depths */
};

struct reference_error {
    char text[200];
};

struct reference;

/* One context a process and a thread. Functions that return false explain it in
 * *error; the reference is then good for closing only. */

/* NULL on failure. Changes the environment of the process. */
struct reference *reference_open(const struct reference_options *options, struct reference_error *error);
void reference_close(struct reference *reference);

/* Back end, renderer and version, for people. */
const char *reference_name(const struct reference *reference);

/* The first known Mesa that follows the current rules (line_rule.h). */
enum { REFERENCE_CURRENT_MESA = 2500 };

/* 100 times Mesa's major version and its minor one: 2203 of 22.3.6. 0: unknown. */
int reference_mesa_version(const struct reference *reference);

/* `parity`: batches of REFERENCE_PARITY are to come, which need a stencil buffer. */
bool reference_resize(struct reference *reference, uint32_t width, uint32_t height, bool parity,
                      struct reference_error *error);

/* Copies positions, front colours and indices into buffer objects of the driver's own, where draws of these very
 * arrays find them from now on: the fastest way that GL has. For benchmarks; no batch may be lit. */
bool reference_keep(struct reference *reference, const struct reference_arrays *arrays, uint32_t vertex_count,
                    uint32_t index_count, struct reference_error *error);

/* Clears, draws, and waits for the result. */
bool reference_draw(struct reference *reference, const struct reference_arrays *arrays, struct reference_error *error);

/* Of the last draw, row 0 on top: 4 bytes RGBA a pixel, and window depth 0..1. Either may be NULL. */
bool reference_read(struct reference *reference, uint8_t *rgba, float *depth, struct reference_error *error);

/* 1 where a polygon of any shape covers the sample and none of its triangles does, else 0. */
bool reference_read_gaps(struct reference *reference, uint8_t *gaps, struct reference_error *error);

/* ---- what a back end is ---- */

struct reference_context {
    const char *name;
    /* Makes a context current that needs no surface, or returns NULL. The environment is set. */
    void *(*open)(struct reference_error *error);
    void (*close)(void *context);
};

extern const struct reference_context reference_context;

#endif
