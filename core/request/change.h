/* change.h - request: scenes that are read once and drawn with several views, outputs, poses and looks. */
#ifndef ZR_CHANGE_H
#define ZR_CHANGE_H

#include "core.h"

#include "base/run.h"

struct zr_kept; /* input/scene/kept.h */

/* Reads a scene as zr_scene_read does, with the same errors, and keeps the parts that changes need, with room for
 * mipmaps and, made at once, the tables of its meshes (mesh/mesh_tables.h). The body may be freed after the call. The
 * texts of parameters and the assets must stay as long as the arena. */
enum zr_status zr_scene_keep(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_kept **kept);

/* Keeps a scene in JSON, whose assets stay as long as the arena. run->cancel ends reading. */
enum zr_status zr_scene_keep_text(const struct zr_run *run, const char *text, size_t size,
                                  const struct zr_asset *assets, size_t asset_count, const struct zr_limits *limits,
                                  struct zr_kept **kept);

/* A model file, and the files that it may refer to. */
struct zr_scene_file {
    const char *type; /* media type; NULL, or a generic one: detected */
    const char *bytes;
    size_t size;
    const struct zr_asset *assets;
    size_t asset_count;
    const struct zr_stored *stored; /* NULL: no store */
};

/* Reads a file without parameters, as zr_scene_read does. Fails with ZR_BAD_TYPE for another type, too. */
enum zr_status zr_scene_read_file(const struct zr_run *run, const struct zr_scene_file *file,
                                  const struct zr_limits *limits, const struct zr_scene **scene);

/* Makes a kept scene with other parameters alone, "look=clay&width=800"; texts live in run->arena. Fails as
 * zr_scene_change. */
enum zr_status zr_scene_change_query(const struct zr_run *run, const struct zr_kept *kept, const char *query,
                                     const struct zr_scene **scene);

/* The same as zr_scene_keep without tables, for a scene that changes only if it has several views; other scenes are read as by
 * zr_scene_read. */
enum zr_status zr_scene_keep_for_views(const struct zr_run *run, const struct zr_request *request,
                                       const struct zr_limits *limits, struct zr_kept **kept);

/* Returns the scene without a change. */
const struct zr_scene *zr_kept_scene(const struct zr_kept *kept);

/* Makes a scene with other keys. The body of `change` is a JSON object, or empty: its keys replace those of the same
 * name. "poses" replaces the matrices of named nodes; meshes and polygons are refused. Parameters of `change` replace
 * those of the first request, and its assets join them. *scene equals the scene that zr_scene_read makes from all of
 * these keys, parameters and assets together. It lives in `arena` and points to the kept one. Any number of threads may
 * call at once, each with its own arena. Errors: those of zr_scene_read, with the same pointers. */
enum zr_status zr_scene_change(const struct zr_run *run, const struct zr_kept *kept, const struct zr_request *change,
                               const struct zr_scene **scene);

/* Makes frame `number` of a kept scene whose set of views is an animation. *scene equals the scene that is read with
 * the matrices of this frame. It lives in `arena` and points to the kept one; threads as for zr_scene_change. */
enum zr_status zr_scene_frame(const struct zr_run *run, const struct zr_kept *kept, uint32_t number,
                              const struct zr_scene **scene);

#endif
