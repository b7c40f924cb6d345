/* core.h - core: the public interface of the renderer: bytes of a scene in, bytes of images out.
 *
 *     zr_scene_read          bytes                -> scene
 *     zr_resolved_view_find  scene                -> resolved view
 *     zr_render              scene, resolved view -> frame      (render/render.c)
 *     zr_encode              frame                -> answer
 *
 * State:   none between calls. The functions read no file, clock or environment, and never exit. LC_NUMERIC must be
 *          "C", as at program start.
 * Memory:  results live in the arena of the call, until its reset.
 * Threads: any number of threads may call at once, each with its own arena.
 */
#ifndef ZR_CORE_H
#define ZR_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/array.h"
#include "base/cancel.h"
#include "base/run.h"
#include "base/status.h"
#include "base/team.h"
#include "version.h"

/* ---- limits of a request ---- */

struct zr_limits {
    uint32_t json_depth_max;    /* nesting of arrays and objects */
    uint32_t window_side_max;   /* pixels */
    uint64_t window_pixels_max; /* pixels, summed over all outputs */
    uint32_t polygon_vertices_max;
    uint32_t instances_max;      /* meshes that nodes place */
    uint64_t image_pixels_max;   /* pixels, summed over all images of textures */
    float coordinate_max;        /* largest magnitude of a coordinate */
    uint32_t views_max;          /* views of one request */
    uint64_t view_pixels_max;    /* pixels, summed over all outputs of all views */
    uint64_t unpacked_bytes_max; /* bytes of the members of an archive that are read, inflated */
};

struct zr_limits zr_limits_default(void);

/* ---- parts of a request (render_request.h) ---- */

struct zr_packed; /* input/zip/zip_read.h */

/* A file or an array sent with the scene; the scene refers to it by {"asset": name}. */
struct zr_asset {
    const char *name;
    const void *bytes; /* bytes of a file, or of the array */
    size_t size;
    struct zr_array array;    /* type ZR_BYTES: a file; the rest is not set */
    bool is_lent;             /* the data stay unchanged while the scene lives; numbers need no copy */
    bool is_optional;         /* no warning if the scene does not use it */
    struct zr_packed *packed; /* set by core/request/read.c: unread member of a ZIP body; callers set NULL */
};

/* Store of assets by their SHA-256; the scene refers to one by {"asset": "sha256:..."}. `read` takes 64 lower-case
 * hexadecimal digits and a final zero, and returns the bytes in the arena. Errors: ZR_BAD_SCENE if the store has no
 * such asset, ZR_NO_MEMORY of the arena, ZR_INTERNAL if the asset cannot be read, ZR_CANCELLED. `look` finds the size
 * of an asset that need not be read; it may be NULL. */
struct zr_stored {
    enum zr_status (*read)(void *context, const char *sha256, struct zr_arena *arena, const void **bytes, size_t *size);
    enum zr_status (*look)(void *context, const char *sha256, size_t *size);
    void *context;
    const char *advice; /* ends the message about a missing asset; NULL: advice to send a part */
};

struct zr_file_hash;  /* base/hash.h */
struct zr_kept_image; /* scene/image.h */

/* Decoded images that the caller keeps between requests, by the hash of their files. No answer depends on them. */
struct zr_kept_images {
    /* Computes the hash of a file and finds its image, whose texels stay until the scene is freed. Returns false if
     * there is none. NULL: no images are kept. Only the thread that reads the scene calls `find` and `keep`. */
    bool (*find)(void *context, const void *bytes, size_t size, struct zr_file_hash *hash, struct zr_kept_image *image);
    /* Offers an image that `find` did not have. The caller may copy the texels. It keeps no pointer to them. */
    void (*keep)(void *context, const struct zr_file_hash *hash, const struct zr_kept_image *image);
    void *context;
};

/* Long data: URIs, decoded, that the caller keeps between requests. No answer depends on them, and each request is
 * charged for decoding. Only the thread that reads the scene calls these functions. */
struct zr_kept_texts {
    /* Finds the bytes of an equal text, which stay until the scene is freed. Returns false if there are none, or if
     * cancelled; *hash is then for `keep`. NULL: nothing is kept. */
    bool (*find)(void *context, const char *text, size_t size, const struct zr_cancel *cancel,
                 struct zr_file_hash *hash, const void **bytes, size_t *byte_count);
    /* Offers a text that `find` did not have, and its bytes. The caller may copy both. It keeps no pointer to them. */
    void (*keep)(void *context, const struct zr_file_hash *hash, const char *text, size_t size, const void *bytes,
                 size_t byte_count);
    void *context;
};

struct zr_kept_mesh; /* input/model/kept_mesh.h */

/* Model files that the caller keeps between requests, as read: meshes, materials and images. No answer depends on them,
 * and each request is charged for the memory of reading. Only the thread that reads the scene calls these functions. */
struct zr_kept_meshes {
    /* Replaces a strong hash, such as SHA-256, by that of itself and the bytes. NULL: nothing is kept. */
    void (*hash)(void *context, struct zr_file_hash *hash, const void *bytes, size_t size);
    /* Returns the file, which stays until the scene is freed. NULL: it is not kept. */
    const struct zr_kept_mesh *(*find)(void *context, const struct zr_file_hash *hash);
    /* Notes that a file of this hash was read, so that it may be kept the next time. */
    void (*note)(void *context, const struct zr_file_hash *hash);
    /* Called before a file of `size` bytes is read that has one of these hashes. Returns an empty arena if the file
     * will be kept: it is then read into that arena. NULL: it is read into the request's. */
    struct zr_arena *(*begin)(void *context, const struct zr_file_hash *hashes, size_t count, size_t size);
    /* Takes over the arena with the file, which stays until the scene is freed. NULL: reading failed. False if the
     * arena was freed. */
    bool (*end)(void *context, struct zr_arena *arena, const struct zr_file_hash *hash,
                const struct zr_kept_mesh *mesh);
    void *context;
};

/* Limits for a caller that can spend only a few milliseconds on reading. Beyond one of them, reading returns
 * ZR_CANCELLED and sets is_exceeded. */
struct zr_quick {
    uint64_t image_pixels_max; /* per image of a base, and for all images of textures together */
    uint64_t node_visits_max;  /* scene/parts/nodes.h */
    size_t array_bytes_max;    /* for all arrays that stand for lists together */
    bool is_exceeded;
};

/* Lists the files that a model file refers to: buffers and images of glTF, material libraries of OBJ, images of MTL,
 * and assets of scenes. Writes their names in the order of the file, each with a final zero. Names may repeat. A line
 * "mtllib a b" gives "a b", "a" and "b", since names may have blanks. URIs with a scheme and stored assets are left
 * out. `type`: a media type or the ending of the file's name; NULL: detected; "mtl" or "model/mtl" for MTL. Returns the
 * bytes of all names; if they exceed `room`, some names are not written, and the caller calls again. `names` may be
 * NULL if `room` is 0. Wrong or hostile bytes give other names, or none. */
size_t zr_references_list(const char *bytes, size_t size, const char *type, char *names, size_t room);

/* ---- the four steps, and the cost of the last two ---- */

struct zr_request;       /* render_request.h */
struct zr_scene;         /* scene/scene.h */
struct zr_resolved_view; /* scene/camera/resolved_view.h */
struct zr_frame;         /* shade/frame.h */
struct zr_cost;          /* cost.h */

enum { ZR_WARNINGS_SIZE = 2048 }; /* bytes of a line of warnings with its final zero; fits a header that proxies pass */

struct zr_answer {
    const char *content_type;
    const void *bytes;
    size_t size;
    const char *look;     /* the scene's look with its version: "studio@1" */
    const char *encoders; /* libraries whose version decides the bytes: "libwebp 1.2.4; quality=80", "": none */
    const char *warnings; /* one line of whole warnings, with "; and 3 more" at its end if not all fit; "": none */
    size_t warning_count;
};

/* Reads and checks the scene of a request. The scene keeps pointers into request->bytes and the assets. `team` may be
 * NULL (one thread). On failure, with any status, *error lists the faults and their places, and *scene is unchanged.
 * Scene and error are the same for every team. If cancelled, returns soon; indivisible parts of OBJ and STL files, such
 * as a line of megabytes, are read to their end first. */
enum zr_status zr_scene_read(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                             const struct zr_scene **scene);

/* Resolves the scene's view into a camera. A view or depth range that is fitted to the geometry takes some walks over
 * the points of all instances; with sections, it frames the remaining part. `team` may be NULL (one thread) and
 * `cancel` may be NULL (never).
 * Errors: ZR_BAD_SCENE, explained by *error. ZR_NO_MEMORY, with *resolved NULL, and ZR_CANCELLED, with an incomplete
 *         *resolved, add nothing to *error. */
enum zr_status zr_resolved_view_find(const struct zr_run *run, const struct zr_scene *scene,
                                     const struct zr_resolved_view **resolved);

/* Predicts the cost of rendering and encoding (cost.h). Takes at most a millisecond or two, plus a walk over all
 * instances. */
struct zr_cost zr_scene_cost(const struct zr_scene *scene, const struct zr_resolved_view *resolved);

/* Renders a frame. If `resolved` is NULL, the view is resolved first. `team` may be NULL (one thread) and `cancel` may
 * be NULL (never). The frame is the same, byte for byte, for every team. Fails with ZR_BAD_SCENE, ZR_NO_MEMORY,
 * ZR_CANCELLED or ZR_INTERNAL, explained by *error; *frame is then undefined. */
enum zr_status zr_render(const struct zr_run *run, const struct zr_scene *scene,
                         const struct zr_resolved_view *resolved, const struct zr_frame **frame);

/* The same with two arenas: the frame lives in `arena`, and `scratch` holds data of drawing alone, such as the sorted
 * scene, shadow maps and G-buffers. The caller may reset `scratch` as soon as the function returns. */
enum zr_status zr_render_apart(const struct zr_run *run, const struct zr_scene *scene,
                               const struct zr_resolved_view *resolved, const struct zr_frame **frame);

/* Encodes the outputs of the frame's view: a single output as its file, several as a ZIP of files channel.extension.
 * `team` may be NULL (one thread). Equal frames give equal bytes, for every team and memory address
 * (output/images/idat.h); those of JPEG and WebP depend on the version of a library. Fails with ZR_BAD_SCENE if a
 * strict request has warnings, if a file has more than its max_bytes, or if a ZIP would have 4 GiB or more; with
 * ZR_NO_MEMORY, ZR_CANCELLED or ZR_INTERNAL. *error explains each; *answer is then undefined. */
enum zr_status zr_encode(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                         struct zr_answer *answer);

#endif
