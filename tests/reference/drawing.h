/* drawing.h - reference: one picture's worth of polygons, lines and points, as generators and models make them.
 *
 * Both sides get the same floats: subject_make puts a scene around the polygons, past
 * input/, and the scene is what is compared.
 */
#ifndef ZR_TEST_DRAWING_H
#define ZR_TEST_DRAWING_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/scene.h"

/* Indexed polygons, lines and points as in struct zr_mesh, in memory of its own that is kept from
 * one picture to the next. `failed` is sticky: memory ran out. */
enum { DRAWING_LIGHTS_MAX = 8 };

struct drawing {
    uint32_t width, height;
    bool smooth;       /* compare colours per vertex; else each face has one colour, that of its number, */
    bool first_corner; /* or that of its first corner */
    bool failed;
    uint32_t side;    /* samples per pixel are side x side */
    float line_width; /* pixels */
    zr_mat4 modelview, projection;

    uint32_t position_count, position_room;
    zr_vec4 *positions, *colors; /* colours 0..1; alpha is looked at where see_through */
    zr_vec3 *normals;            /* looked at where given_normals */

    bool lit, given_normals; /* lit: a vertex or, where colours are not smooth, a face */
    zr_vec3 ambient;
    uint32_t light_count;
    struct zr_light lights[DRAWING_LIGHTS_MAX];

    uint32_t face_count, face_room;
    uint32_t *face_offsets; /* face_count + 1 */
    uint32_t *face_rings;   /* face_count + 1 */
    zr_vec4 *face_colors;
    bool see_through;         /* some faces are: then each has */
    uint32_t *face_materials; /* an enum zr_alpha_mode */
    float alpha_cutoff;

    uint32_t ring_count, ring_room;
    uint32_t *ring_offsets; /* ring_count + 1 */

    uint32_t line_count, line_room;
    uint32_t *lines; /* two positions each */

    uint32_t point_count, point_room;
    uint32_t *points; /* positions */
    float point_size; /* pixels */

    enum zr_outline outline;
    bool unfilled; /* outlines alone */

    uint32_t corner_count, corner_room;
    uint32_t *indices;
};

/* Zero-initialise before the first use. */
void drawing_start(struct drawing *drawing, uint32_t width, uint32_t height);
void drawing_free(struct drawing *drawing);

/* Returns the position's index. */
uint32_t drawing_position(struct drawing *drawing, zr_vec4 position, zr_vec4 color);
void drawing_face(struct drawing *drawing, const uint32_t *indices, uint32_t count);
/* One more ring of the last face. */
void drawing_hole(struct drawing *drawing, const uint32_t *indices, uint32_t count);
void drawing_line(struct drawing *drawing, uint32_t a, uint32_t b);
void drawing_point(struct drawing *drawing, uint32_t position);
void drawing_triangle(struct drawing *drawing, uint32_t a, uint32_t b, uint32_t c);

/* Triangles after cutting polygons to fans; a line or a point counts as one. */
uint32_t drawing_triangles(const struct drawing *drawing);

#endif
