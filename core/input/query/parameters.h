/* parameters.h - input: reads the query of a request (parameter_rows.h) as keys of a scene.
 *
 * A bare mesh is a scene whose other keys come from the query. Each parameter becomes JSON and goes through the reader
 * of its key, with the same range and words. A new parameter is one row there.
 */
#ifndef ZR_PARAMETERS_H
#define ZR_PARAMETERS_H

#include "core.h"
#include "input/scene/json_scene.h"
#include "scene/camera/mesh_up.h"

struct zr_query {
    const struct zr_request *request;
    struct zr_parsed_scene given;   /* scene keys of the query; .scene: the builder's for a bare mesh, else `others` */
    struct zr_scene others;         /* values of the query that override a JSON scene: window, outputs and others */
    int compress, projection, up;   /* ZR_UNSET: not given; up: enum zr_mesh_up */
    const char *member;             /* NULL: zr_zip_body_open takes it */
    const char *camera, *animation; /* name or number of one of the file; NULL: not given */
    double time, time_end;          /* seconds */
    uint32_t frames;
    bool is_strict, has_file_lights;
    struct zr_instance *instances; /* of a bare mesh */
};

/* Returns the key that a row's pointer leads to, in a scene or in /query. */
const struct zr_json_field *zr_parameter_field(const char *pointer);

/* Reads the query before the body; the request's format is known. builder->scene has its defaults. Fails with
 * ZR_BAD_REQUEST, or with ZR_BAD_SCENE for a window larger than allowed. */
enum zr_status zr_query_read(const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_scene_builder *builder, struct zr_query *query, struct zr_error *error);

/* True if equal positions of a bare mesh may be stored once: its outputs are colours in linear light only, which
 * average normals by place. Other outputs, sections and keys of parts depend on which faces share a position. */
bool zr_query_shares_places(const struct zr_query *query);

/* Applies the query once the body is read: its keys override those of a JSON scene, or make a scene of a bare mesh.
 * Fails with ZR_BAD_SCENE or ZR_NO_MEMORY. */
enum zr_status zr_query_apply(struct zr_query *query, struct zr_error *error);

/* Turns a bare mesh upright and sizes its points. Sets the view of a flat mesh, unless the request gives one. Runs
 * once the builder is closed. Does nothing for scenes. */
void zr_query_orient(const struct zr_query *query);

/* Returns the axis that points up. ZR_MESH_UP_AUTO: zr_query_orient finds it; never returned for files with nodes. */
enum zr_mesh_up zr_query_up(const struct zr_query *query);

/* Reports faults of keys under the names of their parameters. Faults elsewhere keep their pointers. */
void zr_query_report(const struct zr_request *request, enum zr_status status, const struct zr_error *faults,
                     struct zr_error *error);

#endif
