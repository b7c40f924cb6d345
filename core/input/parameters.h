/* parameters.h - input: what the query of a request says (parameter_rows.h), read and checked.
 *
 * A new parameter is a row there, a function here that reads it, and a test.
 */
#ifndef ZR_PARAMETERS_H
#define ZR_PARAMETERS_H

#include "scene/face_style.h"
#include "scene/parsed_picture.h"
#include "zraster.h"

/* What it says, over what a bare mesh has where nobody says anything. */
struct zr_query {
    bool has_output, has_compress;
    struct zr_output output;
    enum zr_compress compress;
    bool is_strict;
    bool has_color_bar;
    int color_bar; /* 0 or 1, where it says which */

    /* Of bare meshes. */
    const struct zr_look *look; /* studio, where none is said */
    struct zr_parsed_picture picture;
    struct zr_view view; /* over the look's */
    zr_vec4 background;  /* likewise; with ZR_PICTURE_BACKGROUND where it is said */
    bool has_color, z_is_up;
    zr_vec4 color;
    struct zr_face_style face_style;
};

/* Fails with ZR_BAD_REQUEST, or ZR_BAD_SCENE for what is well-formed and more than may be drawn. `defaults` are of a
 * scene. */
enum zr_status zr_query_read(const struct zr_request *request, const struct zr_limits *limits,
                             const struct zr_scene *defaults, struct zr_query *query, struct zr_error *error);

#endif
