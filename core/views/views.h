/* views.h - views: several views of a scene that is read once.
 *
 *     zr_views_read   bytes  -> scene, and the views it asks for
 *     zr_views_plan   views  -> their cost, before any is drawn
 *     zr_views_draw   views  -> files, all at the end
 *     zr_views_draw_each     -> files, as soon as a view is drawn
 *
 * Exact:   each view equals that of a request for it alone, byte for byte.
 * Memory:  a few views are drawn at once, each in an arena of its own within the request's memory. It depends on the
 *          sizes of the windows, not on the number of views. Only zr_views_draw keeps their files.
 */
#ifndef ZR_VIEWS_H
#define ZR_VIEWS_H

#include "base/run.h"
#include "cost/cost.h"
#include "request/encode.h"
#include "scene/camera/view_set.h"
#include "views/sheet_layout.h"

struct zr_kept;

struct zr_views {
    const struct zr_scene *scene;  /* as read */
    const struct zr_view_set *set; /* NULL: one view, that of the scene */
    const struct zr_kept *kept;    /* source of the views */

    /* Set by zr_views_plan. */
    struct zr_shared_camera camera; /* of a turntable, an orbit, a sheet or an animation */
    struct zr_sheet_layout layout;  /* of a sheet */
    struct zr_bounds bounds;        /* of the scene without changes */
    bool has_one_window;            /* all views have windows of the size */
    uint32_t width, height;
    bool shares_parts;   /* the info of some view lists the parts of the scene as read */
    struct zr_cost cost; /* of all views; memory: of the largest */

    /* Shared by the views; set by zr_views_draw_each. */
    const struct zr_mesh_tables *tables;
    const struct zr_known_parts *known_parts; /* NULL: none */

    /* Set by the caller. Called for each view that is drawn, on the thread of the call; NULL: none. */
    void (*progress)(void *context, uint32_t done, uint32_t total);
    void *progress_context;
};

/* Reads a scene as zr_scene_read does. */
enum zr_status zr_views_read(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_views *views);

/* Returns the views of a kept scene. */
struct zr_views zr_views_of_kept(const struct zr_kept *kept);

/* Returns the part of the cost that is known before the views are read: frames of an animation read the file again, for
 * their common camera and to be drawn. `views->set` is not NULL. */
struct zr_cost zr_views_foretell(const struct zr_views *views);

/* Checks all views, finds the camera that they share, and predicts their cost. `views->set` is not NULL. Errors: those
 * of each view, at its place such as /views/3/view/eye; ZR_BAD_SCENE if views have the same name, or more pixels
 * together than limits.view_pixels_max. */
enum zr_status zr_views_plan(const struct zr_run *run, struct zr_views *views);

/* A view and its files, whose names are channel.extension. They are valid until `take` returns. */
struct zr_drawn_view {
    uint32_t number;
    const char *name; /* of its files, without the channel */
    const struct zr_files *files;
    const struct zr_frame *frame;
    void *memory; /* for zr_drawn_view_shrink */
};

/* Returns the memory of the request to the system, but for its scene and the files of the views that are drawn: for a
 * taker that waits. Their frames are gone. Returns the bytes that stay. Call it within `take` only. */
size_t zr_drawn_view_shrink(void *memory);

struct zr_views_taker {
    /* Another status than ZR_OK ends the drawing. */
    enum zr_status (*take)(void *context, const struct zr_drawn_view *view, struct zr_error *error);
    void *context;
    size_t most_bytes; /* predicted memory of the views that are drawn at once, but for one; 0: no bound of its own */
};

/* Draws and encodes all views, and hands them on in order, on the thread of the call. No file is joined, not even on a
 * sheet. Drawing pauses while `take` runs. Errors: those of zr_render, zr_encode and `take`. */
enum zr_status zr_views_draw_each(const struct zr_run *run, struct zr_views *views, struct zr_views_taker taker);

/* Draws and encodes all views. Files are NAME.channel.extension, one for each view and output, with these exceptions:
 * outputs with the encoding apng, and webp of a turntable or an animation, are one animation, and arrays (npy) of
 * windows of one size are one array, whose first axis is the number of the view. On a sheet, outputs with the channel
 * color are one picture, and info is that of the first view, with the places of all. Errors: those of zr_render and
 * zr_encode. */
enum zr_status zr_views_draw(const struct zr_run *run, struct zr_views *views, struct zr_files *files);

#endif
