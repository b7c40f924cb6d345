/* face_style.h - scene: the style of faces, as any part of a scene or a query may give it. */
#ifndef ZR_FACE_STYLE_H
#define ZR_FACE_STYLE_H

#include "scene/looks.h"

enum { ZR_UNSET = -1 };

enum zr_outline_setting { ZR_OUTLINE_SET_OFF, ZR_OUTLINE_SET_ON, ZR_OUTLINE_SET_COLOR };

/* ZR_UNSET where it is not. */
struct zr_face_style {
    int shading, double_sided, fill;
    int outline; /* enum zr_outline_setting */
    zr_vec4 outline_color;
    int alpha_mode;
    float alpha_cutoff;
};

extern const struct zr_face_style zr_face_style_unset;

/* What `first` leaves unset is as `second` says. */
struct zr_face_style zr_face_style_merge(const struct zr_face_style *first, const struct zr_face_style *second);

/* The material that faces of this style have; the rest of it is the look's. */
struct zr_material zr_face_style_material(const struct zr_face_style *faces, const struct zr_look *look,
                                          zr_vec4 base_color, bool smooth);

#endif
