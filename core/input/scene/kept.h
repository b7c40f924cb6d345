/* kept.h - input: the meshes of a scene that was read, for drawing it again with other keys.
 *
 * A changed scene is read from a short text: the keys of the first one without meshes and polygons, in the order of its
 * text, then the keys of the change, which replace those of the same name. The readers of other scenes read it, too,
 * and take the meshes from here. So it equals one scene that has all of these keys.
 * Threads: nothing here changes once the first scene is read; any number of threads may read changed scenes.
 */
#ifndef ZR_KEPT_H
#define ZR_KEPT_H

#include "core.h"
#include "input/json/json_list.h"
#include "input/model/read_model.h"
#include "scene/parts/animation.h"

struct zr_image_record;
struct zr_soup;

/* A key of the root and its value, as written. */
struct zr_kept_key {
    const char *name;            /* decoded */
    struct zr_json_text written; /* of a change: the name as written */
    const char *value;
    size_t size; /* of the value, bytes */
};

struct zr_kept {
    struct zr_request *request;   /* without its body; its texts and assets outlive this */
    struct zr_limits limits;      /* of the first reading */
    const struct zr_scene *scene; /* the scene without a change */
    struct zr_image_record *images;
    const struct zr_mesh_tables *tables; /* of its meshes, for all changes; NULL: none */

    const char *body; /* of frames of a file, in the format of `request`; else NULL */
    size_t body_size;

    size_t key_count; /* of a JSON scene: the root's keys other than meshes, polygons and several views */
    const struct zr_kept_key *keys;
    struct zr_growing meshes;   /* struct zr_parsed_mesh */
    const uint8_t *uses;        /* of its assets: 1 if the meshes or polygons use it */
    const struct zr_soup *soup; /* or NULL */
    const struct zr_far *far;   /* of a far scene (text/recenter.h); or NULL */

    struct zr_read_model bare; /* of a bare mesh */
};

/* The key of poses in a change. */
#define ZR_POSES "poses"

/* The reading of a scene that is kept or changed; a builder may point to one. */
struct zr_keeping {
    struct zr_kept *into;       /* receives the meshes; or NULL */
    bool if_views;              /* `into` is filled only if the scene has several views */
    const struct zr_kept *from; /* has the meshes; or NULL */
    const char *keys;           /* changed keys of a bare mesh: a JSON object; or NULL */
    size_t keys_size;
    bool has_view;     /* `keys` has a view */
    const char *poses; /* JSON object: matrices by names of nodes; or NULL */
    size_t poses_size;
    const struct zr_animation *animation; /* moves nodes; or NULL */
    struct zr_moment moment;              /* of `animation` */
};

/* json_soup.c: a copy in the arena that making a mesh may change. `texts`: copies the names of materials, too. NULL
 * without memory. */
struct zr_soup *zr_soup_copy(struct zr_arena *arena, const struct zr_soup *soup, bool texts);

#endif
