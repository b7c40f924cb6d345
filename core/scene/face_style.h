/* face_style.h - scene: style keys of faces, as a scene, a mesh, a material or a query may give them. */
#ifndef ZR_FACE_STYLE_H
#define ZR_FACE_STYLE_H

#include <stddef.h>

#include "base/vec.h"
#include "scene/looks.h"

/* Range of alpha over a list of colours. */
struct zr_alpha_range {
    float least, most;
};
static const struct zr_alpha_range zr_alpha_opaque = {1.0f, 1.0f};

/* Returns the range of the colours' alphas; {1, 1} if `colors` is NULL or empty. */
struct zr_alpha_range zr_alpha_range_of(const zr_vec4 *colors, size_t count);
/* Returns the range of products of an alpha of `a` and one of `b`. */
struct zr_alpha_range zr_alpha_range_times(struct zr_alpha_range a, struct zr_alpha_range b);

enum { ZR_UNSET = -1 };

enum zr_outline_setting { ZR_OUTLINE_SET_OFF, ZR_OUTLINE_SET_ON, ZR_OUTLINE_SET_COLOR };

/* ZR_UNSET marks a key that is not given. */
struct zr_face_style {
    int shading;            /* enum zr_shading */
    int double_sided, fill; /* 0 or 1 */
    int outline;            /* enum zr_outline_setting */
    zr_vec4 outline_color;  /* of ZR_OUTLINE_SET_COLOR */
    int alpha_mode;         /* enum zr_alpha_mode */
    float alpha_cutoff;     /* below 0: unset */
};

extern const struct zr_face_style zr_face_style_unset;

/* Returns `first` with its unset keys from `second`. */
struct zr_face_style zr_face_style_merge(const struct zr_face_style *first, const struct zr_face_style *second);

/* Returns the look's material with this style and base colour. smooth: the mesh has normals or vertex colours. */
struct zr_material zr_face_style_material(const struct zr_face_style *faces, const struct zr_look *look,
                                          zr_vec4 base_color, bool smooth);

#endif
