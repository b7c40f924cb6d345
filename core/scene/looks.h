/* looks.h - scene: looks: what a scene has where neither it nor a query says otherwise, a row of values each.
 *
 * A look is no code: it is the values that a scene could say key by key. A row that was released never changes again;
 * what is to look better gets a row of the same name and the next version, behind it, so that a scene that says "NAME"
 * gets the newest one and a scene that says "NAME@1" keeps its pixels.
 */
#ifndef ZR_LOOKS_H
#define ZR_LOOKS_H

#include "scene/scene.h"

/* Where a scene is seen from that has no view of its own; all of it is shown. */
struct zr_look_view {
    enum zr_pose pose; /* ZR_POSE_PRESET or ZR_POSE_ORBIT */
    enum zr_preset preset;
    double azimuth_degrees, elevation_degrees;
    enum zr_projection projection; /* ZR_PROJECTION_PERSPECTIVE or ZR_PROJECTION_ORTHOGRAPHIC */
    float fov_radians;             /* of perspective views, over the smaller side of the window */
    float padding;                 /* share of the window left free on each side */
};

struct zr_look {
    const char *name;
    uint32_t version;
    struct zr_picture picture;
    zr_vec4 background; /* opaque; not seen where the picture has a gradient */

    /* What faces have. The colour is that of what has neither a material nor colours of its own. */
    struct zr_material material;
    bool shades_by_mesh; /* gouraud where there are normals or vertex colours, else flat; else as the material says */

    /* Lamps, where the scene names none. ZR_LIT_CLASSIC ones stand in for the environment in shadings that it does not
     * light. */
    zr_vec3 ambient;
    uint32_t light_count;
    const struct zr_light *lights;

    struct zr_look_view view;
};

/* All looks. Those of one name stand together, the oldest version first. */
extern const struct zr_look zr_looks[];
extern const int zr_look_count;

/* The look of a scene in JSON that names none: drawn as GL 2.1 would, with values that go to pixels as they are. */
const struct zr_look *zr_look_textbook(void);

/* "studio": its newest version; "studio@2": that one, the number without leading zeros. NULL: there is none. */
const struct zr_look *zr_look_find(const char *text);

/* "studio@1": the row for ever. */
struct zr_look_pin {
    char text[48];
};

struct zr_look_pin zr_look_pin_of(const struct zr_look *look);

/* "studio, technical, ...": each name once. */
struct zr_look_names {
    char text[256];
};

struct zr_look_names zr_looks_join(void);

/* The scene gets all that the look has: picture, background, lamps, ambient light; of views nothing. */
void zr_look_apply(const struct zr_look *look, struct zr_scene *scene);

/* Pose and projection of a look, in a window whose size is known; y is up. */
void zr_look_set_view(const struct zr_look *look, struct zr_view *view);

/* An angle of view over the smaller side of the window. */
void zr_view_set_fov(struct zr_view *view, float radians);

#endif
