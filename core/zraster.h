/* zraster.h - the renderer, whole: bytes of a scene in, bytes of images out.
 *
 *     zr_scene_read          bytes                -> scene
 *     zr_resolved_view_find  scene                -> resolved view
 *     zr_render              scene, resolved view -> frame      (core/render.c is the pipeline)
 *     zr_encode              frame                -> answer
 *
 * Nothing here reads a file, a clock or the environment, keeps state between
 * calls, or exits; the program must leave LC_NUMERIC as "C", as it is at start. Results
 * live in the arena that was handed in, until its reset.
 * Any number of threads may work at once, each with an arena of its own.
 */
#ifndef ZRASTER_H
#define ZRASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/status.h"
#include "base/team.h"
#include "format_rows.h"
#include "parameter_rows.h"
#include "version.h"

/* ---- limits: what one request may ask for ---- */

struct zr_limits {
    uint32_t json_depth_max;    /* nesting of arrays and objects */
    uint32_t window_side_max;   /* pixels */
    uint64_t window_pixels_max; /* pixels, summed over all outputs */
    uint32_t polygon_vertices_max;
    uint32_t instances_max;    /* of meshes, that nodes may place */
    uint64_t image_pixels_max; /* pixels, summed over all images of textures */
    float coordinate_max;      /* magnitude of every number that is a place */
};

struct zr_limits zr_limits_default(void);

/* ---- a request: bytes, and what its URL says ---- */

enum zr_format {
#define ZR_FORMAT_ENUM(ID, ...) ZR_FORMAT_##ID,
    ZR_FORMAT_ROWS(ZR_FORMAT_ENUM)
#undef ZR_FORMAT_ENUM
        ZR_FORMAT_COUNT,
    ZR_FORMAT_UNKNOWN = ZR_FORMAT_COUNT /* its bytes say what it is */
};

/* Bytes that came beside a scene, which it asks for by {"asset": name}. */
struct zr_asset {
    const char *name;
    const void *bytes;
    size_t size;
};

/* Bytes that are kept somewhere under their SHA-256, which a scene asks for by {"asset":
 * "sha256:..."}. `read` is given 64 lower-case hexadecimal digits and a final zero, and puts the bytes into the arena.
 * It fails with ZR_BAD_SCENE where none are kept, ZR_NO_MEMORY of the arena, ZR_INTERNAL where they cannot be read, and
 * ZR_CANCELLED. */
struct zr_stored {
    enum zr_status (*read)(void *context, const char *sha256, struct zr_arena *arena, const void **bytes, size_t *size);
    void *context;
};

/* Limits for who has a few milliseconds alone. Beyond one of them reading ends with ZR_CANCELLED, and is_exceeded. */
struct zr_quick {
    uint64_t image_pixels_max; /* of each image of a base, and of all images of textures together */
    uint64_t node_visits_max;  /* scene/nodes.h */
    bool is_exceeded;
};

struct zr_request {
    enum zr_format format;
    const char *bytes;
    size_t size;
    const struct zr_asset *assets; /* no two of one name; formats other than JSON have none */
    size_t asset_count;
    struct zr_stored stored; /* read may be NULL: nothing is kept */
    /* What the query says: NULL, not given; parameter_rows.h says what it is. */
#define ZR_PARAMETER_FIELD(name, ...) const char *name;
    ZR_PARAMETER_ROWS(ZR_PARAMETER_FIELD)
#undef ZR_PARAMETER_FIELD
    const struct zr_cancel *cancel; /* of reading; may be NULL: never */
    struct zr_quick *quick;         /* may be NULL: reading may take as long as it takes */
};

/* ---- the four steps, and a look ahead ---- */

struct zr_scene;         /* scene/scene.h */
struct zr_resolved_view; /* scene/resolved_view.h */
struct zr_frame;         /* shade/frame.h */
struct zr_cost;          /* cost.h */

enum { ZR_WARNINGS_SIZE = 2048 }; /* of a line of warnings and the zero behind it: a header that proxies let pass */

struct zr_answer {
    const char *content_type;
    const void *bytes;
    size_t size;
    const char *look;     /* that the scene has, pinned: "studio@1" */
    const char *warnings; /* one line of whole warnings; "; and 3 more" at its end where not all have room; "": none */
};

/* Keeps pointers into request->bytes and the assets. `team` may be NULL (one thread). On failure, which may be any
 * status, *error says what and where, and *scene is left alone. Scene and error are the same for every team. Cancelled,
 * it ends soon; but what of an OBJ or STL file cannot be cut, such as a line of megabytes, is read to its end. */
enum zr_status zr_scene_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                             const struct zr_limits *limits, const struct zr_scene **scene, struct zr_error *error);

/* Where the scene is seen from. A view that shows all of the geometry, or whose depth is fitted to it, takes some walks
 * over all placed points. `team` may be NULL (one thread) and `cancel` may be NULL (never). Fails with ZR_BAD_SCENE,
 * which *error explains; with ZR_NO_MEMORY, *resolved being NULL, or ZR_CANCELLED, *resolved being what was found until
 * then, nothing is added to *error. */
enum zr_status zr_resolved_view_find(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                     const struct zr_cancel *cancel, const struct zr_resolved_view **resolved,
                                     struct zr_error *error);

/* What rendering and encoding will take (cost.h). Takes a millisecond or two at most, beside a walk over all instances.
 */
struct zr_cost zr_scene_cost(const struct zr_scene *scene, const struct zr_resolved_view *resolved);

/* `resolved` may be NULL: it is found first. `team` may be NULL (one thread) and `cancel` may be NULL (never). The
 * frame is the same, byte for byte, for every team. Fails with ZR_BAD_SCENE, ZR_NO_MEMORY, ZR_CANCELLED or ZR_INTERNAL,
 * which *error explains; *frame is then not to be read. */
enum zr_status zr_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                         const struct zr_resolved_view *resolved, const struct zr_cancel *cancel,
                         const struct zr_frame **frame, struct zr_error *error);

/* The outputs of the view that the frame shows. One: its bytes. Several: a ZIP of channel.extension. `team` may be NULL
 * (one thread). The same frame gives the same bytes for every team, wherever in memory it is encoded
 * (output/deflate.h). Fails with ZR_BAD_SCENE where something is warned of and the request is strict, ZR_NO_MEMORY,
 * ZR_CANCELLED or ZR_INTERNAL, which *error explains; *answer is then not to be read. */
enum zr_status zr_encode(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                         const struct zr_frame *frame, const struct zr_cancel *cancel, struct zr_answer *answer,
                         struct zr_error *error);

#endif
