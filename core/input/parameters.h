/* parameters.h - input: the query of a request (parameter_rows.h) -> values of a scene.
 *
 * A bare mesh is a scene whose only other keys are those of the query: each parameter becomes JSON and is read by the
 * reader of its key, which has its range and its words. A new parameter is a row there.
 */
#ifndef ZR_PARAMETERS_H
#define ZR_PARAMETERS_H

#include "input/json_scene.h"
#include "zraster.h"

struct zr_query {
    const struct zr_request *request;
    struct zr_parsed_scene given; /* its keys of a scene; .scene is the builder's for a bare mesh, else `others` */
    struct zr_scene others;       /* what a scene in JSON gets of it: outputs and whether there is a colour bar */
    int compress, projection;     /* ZR_UNSET where not given */
    bool is_strict, z_is_up;
};

/* Reads the query of the request, whose format is known, before its body. builder->scene has its defaults. Fails with
 * ZR_BAD_REQUEST, or with ZR_BAD_SCENE for a window larger than allowed. */
enum zr_status zr_query_read(const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_scene_builder *builder, struct zr_query *query, struct zr_error *error);

/* Once the body is read: the keys of the query override those of a scene in JSON; a bare mesh becomes a scene. Fails
 * with ZR_BAD_SCENE, or ZR_NO_MEMORY. */
enum zr_status zr_query_apply(struct zr_query *query, struct zr_error *error);

/* Reports faults of keys under the names of their parameters. */
void zr_query_report(const struct zr_request *request, enum zr_status status, const struct zr_error *faults,
                     struct zr_error *error);

#endif
