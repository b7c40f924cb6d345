/* look.h - input: what may be said of how faces look: by any part of a scene, and by a query of a bare mesh. */
#ifndef ZR_LOOK_H
#define ZR_LOOK_H

#include "scene/scene.h"

enum { ZR_UNSET = -1 };

enum zr_outline_setting { ZR_OUTLINE_SET_OFF, ZR_OUTLINE_SET_ON, ZR_OUTLINE_SET_COLOR };

/* ZR_UNSET where it is not. */
struct zr_look {
    int shading, double_sided, fill;
    int outline; /* enum zr_outline_setting */
    zr_vec4 outline_color;
};

extern const struct zr_look zr_look_unset;

/* What `first` leaves unset is as `second` says. */
struct zr_look zr_look_merge(const struct zr_look *first, const struct zr_look *second);

/* The material that faces of this look have. */
struct zr_material zr_look_material(const struct zr_look *look, zr_vec4 base_color, bool smooth);

#endif
