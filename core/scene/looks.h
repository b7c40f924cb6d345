/* looks.h - scene: looks, rows of default values for the keys of a scene.
 *
 * A look contains values only, which a scene or a query overrides key by key. A released row never changes. An improved
 * look is a new row behind it, with the same name and the next version: "NAME" selects the newest version, and "NAME@1"
 * keeps its pixels.
 */
#ifndef ZR_LOOKS_H
#define ZR_LOOKS_H

#include "scene/scene.h"

/* Default view of a scene; it fits all geometry. */
struct zr_look_view {
    enum zr_pose pose; /* ZR_POSE_PRESET or ZR_POSE_ORBIT */
    enum zr_preset preset;
    double azimuth_degrees, elevation_degrees;
    enum zr_projection projection; /* ZR_PROJECTION_PERSPECTIVE or ZR_PROJECTION_ORTHOGRAPHIC */
    float fov_radians;             /* perspective: full angle over the smaller side of the window, */
    float wide_fov_radians; /* or over the larger one, if that is more than 16/9 of the smaller: the same in 16:9 */
    float padding;          /* share of the window left free on each side */
};

struct zr_look {
    const char *name;
    uint32_t version;
    const char *text; /* purpose, for people; of the first version of a name, else NULL */
    const struct zr_picture *picture;
    zr_vec4 background; /* opaque; unused if the picture has a gradient */

    /* Default material of faces; its base colour is for meshes without a material and without colours. */
    struct zr_material material;
    zr_vec4 cloud;       /* base colour of bare clouds of points, in looks drawn with ink; 0: colour of the edges */
    zr_vec4 wire;        /* base colour of bare meshes of lines only, which no light makes darker; 0: as of faces */
    bool is_material;    /* replaces the materials of model files */
    bool shades_by_mesh; /* gouraud for meshes with normals or vertex colours, else flat; false: material.shading */

    /* Lights of scenes without `lights`. ZR_LIT_CLASSIC ones replace the environment in shadings that do not use it. */
    zr_vec3 ambient;
    uint32_t light_count;
    const struct zr_light *lights;

    struct zr_look_view view;
};

/* All looks. Versions of one name are adjacent, the oldest first. */
extern const struct zr_look zr_looks[];
extern const int zr_look_count;

/* Returns the default look of scenes in JSON. It draws as GL 2.1 does, without linear light. */
const struct zr_look *zr_look_textbook(void);

/* Finds a look: "studio" is its newest version, "studio@1" version 1 (no leading zeros). NULL if none matches. */
const struct zr_look *zr_look_find(const char *text);

/* Name with version, such as "studio@1", which always selects the same row. */
struct zr_look_pin {
    char text[48];
};

struct zr_look_pin zr_look_pin_of(const struct zr_look *look);

/* "studio, technical, ...": each name once, in the order of the rows. */
struct zr_look_names {
    char text[256];
};

struct zr_look_names zr_looks_join(void);

/* Sets the scene's look, picture, background, ambient light and lights. Does not change its view. */
void zr_look_apply(const struct zr_look *look, struct zr_scene *scene);

/* Sets pose, projection and padding from the look; y is up. Needs the view's width and height. */
void zr_look_set_view(const struct zr_look *look, struct zr_view *view);

/* Sets the look's angle of view. Needs the view's width and height. */
void zr_look_set_fov(const struct zr_look_view *from, struct zr_view *view);

#endif
