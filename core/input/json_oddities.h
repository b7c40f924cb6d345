/* json_oddities.h - input: what meshes of a JSON scene say that shows nothing, or not what is meant: opacities that
 * nothing is made of, or that hide all of a mesh, and keys that nothing uses. Each kind is one warning, of the first
 * mesh and how many more there are.
 */
#ifndef ZR_JSON_ODDITIES_H
#define ZR_JSON_ODDITIES_H

#include "input/face_style.h"

struct zr_given_scene;

/* Of which colours have the alpha that they say. */
struct zr_alpha_range {
    float least, most;
};
static const struct zr_alpha_range zr_alpha_opaque = {1.0f, 1.0f};

/* Of colours, and of products of two such; opaque where there are none. */
struct zr_alpha_range zr_alpha_range_of(const zr_vec4 *colors, size_t count);
struct zr_alpha_range zr_alpha_range_times(struct zr_alpha_range a, struct zr_alpha_range b);

enum zr_oddity {
    ZR_ODD_ALPHA,      /* an alpha below 1, and no word of what it is for */
    ZR_ODD_UNSEEN,     /* BLEND, with an alpha of 0 everywhere */
    ZR_ODD_MASKED,     /* MASK, with an alpha below the cutoff everywhere */
    ZR_ODD_CUTOFF,     /* an alphaCutoff of its own, without MASK */
    ZR_ODD_POINT_SIZE, /* a pointSize without points */
    ZR_ODDITIES
};

/* What has it first: a mesh, or a polygon, by its number. */
struct zr_oddity_note {
    uint32_t count, number;
    bool is_polygon;
};

void zr_given_note_oddity(struct zr_given_scene *root, enum zr_oddity oddity, uint32_t number, bool is_polygon);

/* All that have been noted, once there are meshes. */
void zr_given_warn_of_oddities(struct zr_given_scene *root);

#endif
