/* light_types.h - scene: types of lights, one row each. */
#ifndef ZR_LIGHT_TYPES_H
#define ZR_LIGHT_TYPES_H

/* ROW(ID, word, has a position, may cast shadows)
 *     directional: parallel, like the sun
 *     hemisphere:  from all around, from a sky colour above to a ground colour below
 *     point:       from a position, in all directions
 *     spot:        from a position, within a cone */
#define ZR_LIGHT_ROWS(ROW)                                                                                             \
    ROW(DIRECTIONAL, "directional", false, true)                                                                       \
    ROW(HEMISPHERE, "hemisphere", false, false)                                                                        \
    ROW(POINT, "point", true, false)                                                                                   \
    ROW(SPOT, "spot", true, true)

#define ZR_LIGHT_TYPE(ID, ...) ZR_LIGHT_##ID,
enum zr_light_type { ZR_LIGHT_ROWS(ZR_LIGHT_TYPE) ZR_LIGHT_TYPE_COUNT };
#undef ZR_LIGHT_TYPE

/* Sets of types: bits 1 << enum zr_light_type. */
#define ZR_LIGHT_PLACED(ID, word, is_placed, has_shadows)   | (is_placed) << ZR_LIGHT_##ID
#define ZR_LIGHT_SHADOWED(ID, word, is_placed, has_shadows) | (has_shadows) << ZR_LIGHT_##ID
enum {
    ZR_LIGHT_SET_PLACED = 0 ZR_LIGHT_ROWS(ZR_LIGHT_PLACED),
    ZR_LIGHT_SET_SHADOWED = 0 ZR_LIGHT_ROWS(ZR_LIGHT_SHADOWED)
};
#undef ZR_LIGHT_PLACED
#undef ZR_LIGHT_SHADOWED

#endif
