/* stl_text.h - input: reads the facets of ASCII STL.
 *
 * Source: 3D Systems, StereoLithography Interface Specification, 1989; words in any case, any white space between.
 */
#ifndef ZR_STL_TEXT_H
#define ZR_STL_TEXT_H

#include "core.h"
#include "scene/scene_builder.h"

/* The largest number of triangles of an STL file. */
enum { ZR_STL_TRIANGLES_MAX = 1 << 29 };

/* Geometry of a file, in the arena. */
struct zr_stl {
    size_t vertices, facets;
    const zr_vec4 *positions;
    const uint32_t *offsets;    /* facets + 1: the first vertex of each; NULL: all facets are triangles */
    const zr_vec4 *face_colors; /* or NULL */
};

/* True if the first word is "solid", which many binary files begin with, too. */
bool zr_stl_is_text(const char *bytes, size_t size);

/* For zr_parts_cut: returns the end of a line that is only "endfacet", at least `size` bytes after `at`, or `end`.
 * Such a line nearly always ends a facet, but a normal may be any words. There are more than `size` bytes, and at least
 * as many as the word has. */
const char *zr_stl_cut(const char *at, size_t size, const char *end);

/* Reads vertices, and ignores normals. Adds a warning for each kind of oddity (stl_notes.h). Returns ZR_BAD_SYNTAX or
 * ZR_BAD_SCENE, with details in *error, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_stl_text_read(struct zr_scene_builder *builder, const struct zr_request *request,
                                const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error);

#endif
