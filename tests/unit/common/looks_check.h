/* looks_check.h - tests: scenes that name a look, and their pictures. */
#ifndef ZR_TESTS_LOOKS_CHECK_H
#define ZR_TESTS_LOOKS_CHECK_H

#include "json_check.h"

#include "scene/looks.h"
#include "scene/picture.h"

/* A polygon with "look": LOOK and the members `rest`. */
static inline struct reading *read_look(const char *look, const char *rest)
{
    char text[2048];
    snprintf(text, sizeof text, "\"look\": \"%s\"%s%s", look, *rest ? ", " : "", rest);
    struct reading *reading = read_rest(text);
    assert_read(reading);
    return reading;
}

static inline bool is_same_rgb(zr_vec3 a, zr_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Member by member: what is between them has no value. */
_Static_assert(sizeof(struct zr_picture) == 152, "a new member is compared here, too");
static inline bool is_same_picture(const struct zr_picture *a, const struct zr_picture *b)
{
    const struct zr_environment *ea = &a->environment, *eb = &b->environment;
    return a->is_linear == b->is_linear && a->side == b->side && a->line_width == b->line_width &&
           a->has_gradient == b->has_gradient && is_same_rgb(a->top, b->top) && is_same_rgb(a->bottom, b->bottom) &&
           ea->name == eb->name && ea->intensity == eb->intensity && ea->rotation_degrees == eb->rotation_degrees &&
           ea->camera_frame == eb->camera_frame && ea->map == eb->map && a->tone == b->tone &&
           a->exposure == b->exposure && a->occlusion.is_on == b->occlusion.is_on &&
           a->occlusion.radius == b->occlusion.radius && a->occlusion.strength == b->occlusion.strength &&
           a->has_ground == b->has_ground && a->has_ground_sun == b->has_ground_sun &&
           a->edges.silhouette_opacity == b->edges.silhouette_opacity &&
           a->edges.crease_opacity == b->edges.crease_opacity && a->edges.keeps_width == b->edges.keeps_width &&
           a->gooch.least == b->gooch.least && a->gooch.rise == b->gooch.rise && a->edges.is_on == b->edges.is_on &&
           is_same_rgb(a->edges.color, b->edges.color) && a->edges.width == b->edges.width &&
           a->edges.crease_degrees == b->edges.crease_degrees && a->crease_degrees == b->crease_degrees &&
           a->edges.is_from_mesh == b->edges.is_from_mesh && a->edges.has_hidden == b->edges.has_hidden &&
           a->edges.ignores_normals == b->edges.ignores_normals && a->z_is_up == b->z_is_up;
}

#endif
