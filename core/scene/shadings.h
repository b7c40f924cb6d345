/* shadings.h - scene: table of shadings, one row each.
 *
 * The enum, the words and all predicates follow from the rows. A new shading is a row here and a file in shade/models/.
 * Predicates test masks known at compile time: in kernels each is one shift.
 */
#ifndef ZR_SHADINGS_H
#define ZR_SHADINGS_H

#include <stdbool.h>

/* Rate at which a surface is shaded. */
enum zr_shading_rate {
    ZR_SHADED_NEVER,      /* colours as given; vertex colours are interpolated */
    ZR_SHADED_PER_FACE,   /* one lit colour per polygon; its first vertex gives the colour */
    ZR_SHADED_PER_VERTEX, /* lit at each vertex, interpolated */
    ZR_SHADED_PER_PIXEL
};

/* Lights that a shading uses. */
enum zr_shading_light {
    ZR_SHADED_BY_NOTHING,
    ZR_SHADED_BY_LAMPS,   /* the scene's lights */
    ZR_SHADED_PHYSICALLY, /* the scene's lights and environment, by the metallic-roughness model of glTF 2.0 */
    ZR_SHADED_BY_OWN_LAMP,
    ZR_SHADED_BY_NORMALS /* none: normals are shown as colours */
};

/* ROW(ID, word, meaning for people, rate, light, needs smooth normals: vertex normals are computed if none are given,
 *     has the keys specular and shininess, needs linear light, is translucent in the channel color,
 *     model: zr_shade_by_MODEL, per pixel, without linear light (shade/models/models_simd.h)) */
#define ZR_SHADINGS(ROW)                                                                                               \
    ROW(UNLIT, "unlit", "colours as given", NEVER, BY_NOTHING, false, false, false, false, colors)                     \
    ROW(FLAT, "flat", "one lit colour per polygon", PER_FACE, BY_LAMPS, false, false, false, false, colors)            \
    ROW(GOURAUD, "gouraud", "lit at vertices, interpolated", PER_VERTEX, BY_LAMPS, true, false, false, false, colors)  \
    ROW(PHONG, "phong", "normals interpolated, lit at each pixel", PER_PIXEL, BY_LAMPS, true, true, false, false,      \
        phong)                                                                                                         \
    ROW(NORMALS, "normals", "normals in camera space as colours", PER_PIXEL, BY_NORMALS, true, false, false, false,    \
        normals)                                                                                                       \
    ROW(PBR, "pbr", "metals and plastics, as in glTF 2.0", PER_PIXEL, PHYSICALLY, false, false, true, false, colors)   \
    ROW(GOOCH, "gooch", "from a cool colour to the surface's own, by the angle to a light that moves with the camera", \
        PER_PIXEL, BY_OWN_LAMP, false, false, true, false, colors)                                                     \
    ROW(XRAY, "xray", "two-sided and translucent; opacity rises towards grazing angles", PER_PIXEL, BY_NOTHING, false, \
        false, true, true, colors)

enum zr_shading {
#define ZR_SHADING_ENUM(ID, ...) ZR_SHADING_##ID,
    ZR_SHADINGS(ZR_SHADING_ENUM)
#undef ZR_SHADING_ENUM
        ZR_SHADING_COUNT
};

/* "unlit, flat, ..., xray, ", for concatenated string literals. */
#define ZR_SHADING_LISTED(ID, word, ...) word ", "
#define ZR_SHADING_LIST                  ZR_SHADINGS(ZR_SHADING_LISTED)

/* ---- sets of shadings, one bit each ---- */

#define ZR_SHADING_ALL ((1u << ZR_SHADING_COUNT) - 1)

static inline unsigned zr_shadings_at(enum zr_shading_rate wanted)
{
#define ZR_SHADING_BIT(ID, word, text, rate, ...) (unsigned)(ZR_SHADED_##rate == wanted) << ZR_SHADING_##ID |
    return ZR_SHADINGS(ZR_SHADING_BIT) 0;
#undef ZR_SHADING_BIT
}

static inline unsigned zr_shadings_lit(enum zr_shading_light wanted)
{
#define ZR_SHADING_BIT(ID, word, text, rate, light, ...) (unsigned)(ZR_SHADED_##light == wanted) << ZR_SHADING_##ID |
    return ZR_SHADINGS(ZR_SHADING_BIT) 0;
#undef ZR_SHADING_BIT
}

#define ZR_SHADING_BIT_SMOOTH(ID, w, t, r, l, smooth, ...)              (unsigned)(smooth) << ZR_SHADING_##ID |
#define ZR_SHADING_BIT_SPECULAR(ID, w, t, r, l, s, specular, ...)       (unsigned)(specular) << ZR_SHADING_##ID |
#define ZR_SHADING_BIT_LINEAR(ID, w, t, r, l, s, p, linear, ...)        (unsigned)(linear) << ZR_SHADING_##ID |
#define ZR_SHADING_BIT_LAYERED(ID, w, t, r, l, s, p, n, layered, model) (unsigned)(layered) << ZR_SHADING_##ID |
enum {
    ZR_SHADINGS_SMOOTH = ZR_SHADINGS(ZR_SHADING_BIT_SMOOTH) 0,
    ZR_SHADINGS_SPECULAR = ZR_SHADINGS(ZR_SHADING_BIT_SPECULAR) 0,
    ZR_SHADINGS_LINEAR = ZR_SHADINGS(ZR_SHADING_BIT_LINEAR) 0,
    ZR_SHADINGS_LAYERED = ZR_SHADINGS(ZR_SHADING_BIT_LAYERED) 0
};
#undef ZR_SHADING_BIT_SMOOTH
#undef ZR_SHADING_BIT_SPECULAR
#undef ZR_SHADING_BIT_LINEAR
#undef ZR_SHADING_BIT_LAYERED

/* ---- predicates ---- */

static inline bool zr_shading_is_in(enum zr_shading shading, unsigned set)
{
    return set >> shading & 1u;
}

static inline bool zr_shading_is_at(enum zr_shading shading, enum zr_shading_rate rate)
{
    return zr_shading_is_in(shading, zr_shadings_at(rate));
}

/* True if its colour can vary over a face of one given colour. */
static inline bool zr_shading_varies(enum zr_shading shading)
{
    return zr_shading_is_in(shading, zr_shadings_at(ZR_SHADED_PER_VERTEX) | zr_shadings_at(ZR_SHADED_PER_PIXEL));
}

static inline bool zr_shading_needs_smooth_normals(enum zr_shading shading)
{
    return zr_shading_is_in(shading, ZR_SHADINGS_SMOOTH);
}

static inline bool zr_shading_has_specular(enum zr_shading shading)
{
    return zr_shading_is_in(shading, ZR_SHADINGS_SPECULAR);
}

static inline bool zr_shading_is_linear(enum zr_shading shading)
{
    return zr_shading_is_in(shading, ZR_SHADINGS_LINEAR);
}

static inline bool zr_shading_is_layered(enum zr_shading shading)
{
    return zr_shading_is_in(shading, ZR_SHADINGS_LAYERED);
}

#endif
