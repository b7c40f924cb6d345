/* stl_text.h - input: ASCII STL, its triangles' vertices.
 *
 * Source: 3D Systems, StereoLithography Interface Specification, 1989; words in any case, blanks of any kind.
 */
#ifndef ZR_STL_TEXT_H
#define ZR_STL_TEXT_H

#include "scene/scene.h"
#include "zraster.h"

/* Most triangles that an STL file may have. */
enum { ZR_STL_TRIANGLES_MAX = 1 << 29 };

/* Is its first word "solid"? So it is in many binary files, too. */
bool zr_stl_is_text(const char *bytes, size_t size);

/* For zr_parts_cut: behind a line that is nothing but "endfacet", of which there are few that do not end a facet (a
 * normal may be any words). There are more than `size` bytes, which are no fewer than the word's. */
const char *zr_stl_cut(const char *at, size_t size, const char *end);

/* Three vertices a triangle; the normals in the file are passed over. `team` may be NULL. Fails with ZR_BAD_SYNTAX or
 * ZR_BAD_SCENE, which *error explains, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_stl_text_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                                const struct zr_limits *limits, zr_vec4 **positions, size_t *triangles,
                                struct zr_error *error);

#endif
