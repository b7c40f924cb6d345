/* json_soup.h - input: the polygons of a scene read so far, which become one mesh once the root is read. Each is a face
 * with its own vertices and style.
 */
#ifndef ZR_JSON_SOUP_H
#define ZR_JSON_SOUP_H

#include "input/json/json_list.h"
#include "input/scene/json_scene.h"

/* Kinds of polygons, by their optional colours and normals: a sum. */
enum { ZR_POLYGON_COLOR = 1, ZR_POLYGON_COLORS = 2, ZR_POLYGON_NORMALS = 4, ZR_POLYGON_KINDS = 8 };

/* The key of a polygon's material. */
#define ZR_POLYGON_MATERIAL "material"

/* The style of polygons; it becomes a material once the root is read. */
struct zr_polygon_style {
    uint32_t polygon;             /* the first with this style */
    int has;                      /* its kind */
    struct zr_json_text material; /* name as written, escapes unresolved; at is NULL if there is none */
    struct zr_face_style face_style;
};

/* An optional array is empty until a polygon has such a list; then the earlier polygons get defaults. */
struct zr_soup {
    struct zr_growing positions, colors, normals; /* one per vertex; colors and normals are optional */
    struct zr_growing offsets, face_styles;       /* one per polygon */
    struct zr_growing face_colors;                /* one per polygon; optional */
    struct zr_growing rings, ring_offsets;        /* of all polygons; empty without holes */
    struct zr_growing styles;                     /* struct zr_polygon_style */
    /* the last style of each kind, for comparison: consecutive polygons often share it */
    uint32_t last_styles[ZR_POLYGON_KINDS];
};

_Static_assert(sizeof(struct zr_soup) <= ZR_JSON_STATE_MAX, "a state of json_list.h");

/* Defaults of colours, and of normals, which are computed later. */
extern const zr_vec4 zr_soup_white;
extern const zr_vec3 zr_soup_computed;

struct zr_soup zr_soup_empty(void);

/* Finds the number of an equal style, or adds the style. */
bool zr_soup_find_style(struct zr_json *json, struct zr_soup *soup, const struct zr_polygon_style *style,
                        uint32_t *number);

/* begin_part and join of a list of polygons (json_list.h). Parts have no holes. */
bool zr_soup_begin_part(struct zr_json *json, const void *state, void *part, double share);
bool zr_soup_join(struct zr_json *json, void *state, const void *part);

#endif
