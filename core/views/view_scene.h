/* view_scene.h - views: the scene of one view. */
#ifndef ZR_VIEW_SCENE_H
#define ZR_VIEW_SCENE_H

#include "base/run.h"
#include "views/views.h"

/* Makes the scene of view `number`, in `arena`. Errors are at its place in the request. */
enum zr_status zr_view_scene(const struct zr_run *run, const struct zr_views *views, uint32_t number,
                             const struct zr_scene **scene);

/* True if the view has the parts of the scene as read. */
bool zr_view_shares_parts(const struct zr_view_set *set, uint32_t number);

/* Adds the faults of view `number` to *error, at its place. Returns `status`. */
enum zr_status zr_view_report(const struct zr_views *views, uint32_t number, enum zr_status status,
                              const struct zr_error *faults, struct zr_error *error);

/* Writes the name of a view's files. */
enum { ZR_VIEW_NAME_SIZE = 72 };
void zr_view_name(const struct zr_view_set *set, uint32_t number, char name[ZR_VIEW_NAME_SIZE]);

#endif
