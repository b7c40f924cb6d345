/* zraster.h - renders 3D scenes to PNG, depth, normals and ids, within the calling process.
 *
 *     zraster *renderer;
 *     zraster_picture *picture;
 *     struct zraster_bytes png;
 *     struct zraster_request request = {sizeof request};
 *     request.body = stl;
 *     request.body_size = size;
 *     request.query = "look=technical";
 *     if (zraster_open(NULL, &renderer) == ZRASTER_OK &&
 *         zraster_draw(renderer, &request, &picture, NULL) == ZRASTER_OK &&
 *         zraster_picture_encode(picture, NULL, &png, NULL) == ZRASTER_OK)
 *         fwrite(png.data, 1, png.size, file);
 *     zraster_picture_free(picture);
 *     zraster_close(renderer);
 *
 * A request equals the body and query of POST /v1/render. A picture encodes to the daemon's answer, byte for byte.
 * server/api/v1.md describes scenes, parameters and channels; this header adds no vocabulary of its own.
 *
 * Ownership  Results belong to the caller. The function beside each type frees it; freeing NULL does nothing. A failed
 *            call sets its result to NULL. Bodies, queries and parts are borrowed for the call alone.
 * NULL       `error` may be NULL, and so may arguments whose comment allows it. No other argument is NULL.
 * Threads    Any number of threads may call with one renderer, scene or cancel at once. They share the renderer's
 *            helper threads. A picture or an error belongs to one thread at a time.
 * fork       Renderers and scenes work in a child process, which starts helper threads of its own.
 * State      None outside of these objects. The library changes no global, signal handler or locale, opens no file or
 *            socket, reads no clock or environment variable, and never prints or exits. Results do not depend on
 *            LC_NUMERIC. Helper threads block all signals.
 * ABI        libzraster.so.0, with symbols of version ZRASTER_0.2. Opaque types may change. Structs that begin with
 *            struct_size may grow at the end: set it to sizeof, and all other unused members to zero. Other structs
 *            never change.
 * Promised   The same request gives the same pixels on every machine, for every number of threads and every instruction
 *            set, as long as zraster_rules() is the same. One build of the library gives the same bytes.
 * Not        Bytes of PNG and ZIP across versions; texts of messages; memory and time. New versions may add values to
 * promised   an enum: treat an unknown status as ZRASTER_INTERNAL.
 *
 * Daemon     zrasterd calls the internal header core/core.h instead. It needs three things that this header lacks:
 *            assets that are read from a store while a scene is parsed, the predicted cost of a scene before it is
 *            drawn, and cancels that end with another one. They may be appended here later.
 */
#ifndef ZRASTER_H
#define ZRASTER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined __GNUC__
#define ZRASTER_API __attribute__((visibility("default")))
#else
#define ZRASTER_API
#endif

#define ZRASTER_VERSION        "0.2.0"
#define ZRASTER_VERSION_NUMBER 200 /* major * 10000 + minor * 100 + patch */

typedef struct zraster zraster;                 /* a renderer: threads, limits, and memory kept for the next call */
typedef struct zraster_scene zraster_scene;     /* a scene that was read; never changes; may be drawn many times */
typedef struct zraster_picture zraster_picture; /* the channels of a drawing */
typedef struct zraster_comparison zraster_comparison; /* the numbers of two models */
typedef struct zraster_drawing zraster_drawing;       /* a technical drawing */
typedef struct zraster_error zraster_error;           /* faults, with their places */
typedef struct zraster_cancel zraster_cancel;         /* a flag that stops calls */

/* ---- errors ----
 * Each call that can fail returns its status. Unless `error` is NULL, it also sets *error: to NULL after success, else
 * to an object that is never NULL, even without memory. */

typedef enum zraster_status {
    ZRASTER_OK,
    ZRASTER_BAD_SYNTAX,  /* the body violates its format; the detail names a line or byte */
    ZRASTER_BAD_TYPE,    /* the type is unknown, or no type is given and the bytes fit no format */
    ZRASTER_BAD_REQUEST, /* a parameter is wrong, or a struct has no struct_size */
    ZRASTER_BAD_SCENE,   /* well-formed, but it cannot be drawn; with strict=true, also a scene with warnings */
    ZRASTER_NO_MEMORY,   /* beyond memory_max, or the system has no more */
    ZRASTER_CANCELLED,
    ZRASTER_INTERNAL /* a fault of the library: please report it */
} zraster_status;

ZRASTER_API const char *zraster_error_text(const zraster_error *error); /* all faults, one per line: "/view/eye: ..." */
ZRASTER_API size_t zraster_error_count(const zraster_error *error);     /* up to 20 faults, in the order of the body */
ZRASTER_API const char *zraster_error_pointer(const zraster_error *error, size_t i); /* JSON Pointer, or "" */
ZRASTER_API const char *zraster_error_detail(const zraster_error *error, size_t i);
ZRASTER_API void zraster_error_free(zraster_error *error);

/* ---- renderer ---- */

struct zraster_options {
    size_t struct_size;
    size_t memory_max;  /* bytes that a scene and the drawing of it may hold together, and its picture as many; 0: three
                           quarters of zraster_spare_memory, at least 1 GiB. A ceiling, checked before allocating */
    size_t memory_keep; /* bytes that the renderer keeps for its next calls, all together; 0: 64 MiB; SIZE_MAX: all */
    uint32_t threads;   /* threads that share the work of a call, the caller included; 0: one per processor */
    uint32_t window_side_max; /* limits as in GET /v1/limits; 0: the default */
    uint64_t window_pixels_max, image_pixels_max;
    uint32_t instances_max;
};

/* `options` may be NULL: all defaults. */
ZRASTER_API zraster_status zraster_open(const struct zraster_options *options, zraster **renderer);
ZRASTER_API size_t zraster_spare_memory(void); /* bytes that this process can still take, of its machine, control groups
                                                  and limits; SIZE_MAX: unknown */
ZRASTER_API void zraster_trim(zraster *renderer);  /* returns kept memory to the system */
ZRASTER_API void zraster_close(zraster *renderer); /* its scenes and pictures stay valid until they are freed */

/* ---- cancel ----
 * Any thread and any signal handler may raise it. Running calls then end with ZRASTER_CANCELLED, usually within 10 ms,
 * and later calls at once. A picture keeps its request's cancel for its encoding; the caller may free it before. */

ZRASTER_API zraster_cancel *zraster_cancel_new(void); /* NULL without memory */
ZRASTER_API void zraster_cancel_raise(zraster_cancel *cancel);
ZRASTER_API void zraster_cancel_free(zraster_cancel *cancel);

/* ---- request ---- */

enum { ZRASTER_BYTES, ZRASTER_F4, ZRASTER_F8, ZRASTER_U1, ZRASTER_I4, ZRASTER_U4, ZRASTER_I8, ZRASTER_U8 };

struct zraster_array { /* numbers in C order and the machine's byte order, or bytes */
    const void *data;
    uint32_t type, ndim; /* one of the above; 1 to 4 */
    size_t shape[4];
};

/* A scene refers to a part by {"asset": name}. It is a file, PNG, JPEG or NPY: type ZRASTER_BYTES, ndim 1, shape[0]
 * bytes; or an array, which stands for a list of numbers as an NPY file does, with the same checks ("Arrays" in v1.md):
 * positions (n, 3) or (n, 4), faces (m, k), normals (n, 3), colors (n, 3) or (n, 4) (u1: 0 to 255), scalars (n,), ...
 * Data need no alignment. The call converts or copies them while it reads them. Other threads may write to them
 * meanwhile: the numbers then have any value, and do no other harm.
 *
 * ZRASTER_LEND: the caller keeps the data unchanged until the scene and all its pictures are freed. Then neither
 * zraster_scene_read nor the scene copies them if they are u4 or i4 indices, or f4 of the needed columns other than
 * positions. This saves some 0.1 ms per megabyte. Indices that change meanwhile crash the process.
 *
 * ZRASTER_OPTIONAL: no warning if the scene does not use the part. For files that zraster_references lists. */
enum { ZRASTER_LEND = 1, ZRASTER_OPTIONAL = 2 };

struct zraster_part {
    const char *name;
    struct zraster_array array;
    uint32_t flags; /* sum of ZRASTER_LEND and ZRASTER_OPTIONAL */
};

struct zraster_request {
    size_t struct_size;
    const void *body; /* a scene (JSON) or a mesh; needs no final zero */
    size_t body_size;
    const char *type;  /* "stl", "model/stl", ...; NULL: detected from the bytes */
    const char *query; /* "look=technical&width=800", percent-encoded; NULL: none */
    const struct zraster_part *parts;
    size_t part_count;
    zraster_cancel *cancel; /* NULL: none */

    /* zraster_draw calls it for each of several views that is drawn, on the thread of the call; NULL: none. It may
     * raise the cancel, and calls no other function with this renderer. */
    void (*progress)(void *context, uint32_t done, uint32_t total);
    void *progress_context;
};

/* Reads a scene and draws it. */
ZRASTER_API zraster_status zraster_draw(zraster *renderer, const struct zraster_request *request,
                                        zraster_picture **picture, zraster_error **error);

/* ---- several views: one after the other, in memory that does not grow with their number ---- */

struct zraster_file {
    const char *name; /* "0001.color.png" */
    const void *data;
    size_t size;
    const char *type; /* "image/png" */
};

struct zraster_view {
    size_t struct_size; /* of the library */
    uint32_t number;    /* from 0 */
    uint32_t count;     /* of all views */
    size_t file_count;
    const struct zraster_file *files; /* in the order of the outputs */
    size_t warning_count;
    const char *const *warnings;
};

/* Receives a view and its files, which are valid until it returns. Drawing pauses meanwhile. Another result than 0 ends
 * the call with ZRASTER_CANCELLED. */
typedef int (*zraster_take_view)(void *context, const struct zraster_view *view);

/* Draws a request with several views (views, turntable, orbit, animate or frames) and hands them on in order, on the
 * thread of the call. No files are joined, as in a stream of POST /v1/render. ZRASTER_BAD_SCENE: it has one view, or a
 * sheet. */
ZRASTER_API zraster_status zraster_draw_views(zraster *renderer, const struct zraster_request *request,
                                              zraster_take_view take, void *context, zraster_error **error);

/* ---- scene: read once, drawn with other views, poses and looks ---- */

ZRASTER_API zraster_status zraster_scene_read(zraster *renderer, const struct zraster_request *request,
                                              zraster_scene **scene, zraster_error **error);

/* Draws a scene. `change` may be NULL. Its body is a JSON object: each key, such as view, window, outputs, look,
 * lights, materials or nodes, replaces the scene's own. "poses": {"node": matrix} replaces the matrices of named nodes.
 * Meshes and polygons stay. Parameters of its query replace those of the scene's, and its parts join those of the
 * scene. A change may refer to the members of a ZIP archive that the scene uses. The result equals that of one scene
 * that gives all of this. A bare mesh accepts parameters such as look in the query; its change may have the other keys,
 * but no materials, nodes, base or poses. */
ZRASTER_API zraster_status zraster_scene_draw(const zraster_scene *scene, const struct zraster_request *change,
                                              zraster_picture **picture, zraster_error **error);
ZRASTER_API size_t zraster_scene_memory(const zraster_scene *scene); /* bytes */
ZRASTER_API void zraster_scene_free(zraster_scene *scene);           /* its pictures stay valid */

/* ---- picture: holds its channels and its scene; free it soon ---- */

struct zraster_bytes {
    const void *data; /* the picture's */
    size_t size;
    const char *type; /* "image/png" */
};

/* Encodes the answer of POST /v1/render: the file of the only output, or a ZIP. With a `channel`, "depth" or a name in
 * the ZIP such as "depth.npy", the file of that output; ZRASTER_BAD_REQUEST if there is none. Files are encoded once.
 */
ZRASTER_API zraster_status zraster_picture_encode(zraster_picture *picture, const char *channel,
                                                  struct zraster_bytes *bytes, zraster_error **error);

/* Finds an output where it lies: color u1 (h, w, 4), depth f4 (h, w), normals f4 (h, w, 3), ids u4 (h, w), ... Row 0 is
 * the top. Returns 1, or 0 if no output has the channel or it has no pixels. */
ZRASTER_API int zraster_picture_channel(const zraster_picture *picture, const char *channel,
                                        struct zraster_array *array);

/* Returns 1 if the file of the colours has alpha, since the background is not opaque; else 0. */
ZRASTER_API int zraster_picture_has_alpha(const zraster_picture *picture);
ZRASTER_API const char *zraster_picture_look(const zraster_picture *picture); /* "studio@1" */

/* Returns warning i: those of reading and drawing, then, once the picture is encoded, of encoding. NULL behind the
 * last. */
ZRASTER_API const char *zraster_picture_warning(const zraster_picture *picture, size_t i);
ZRASTER_API size_t zraster_picture_memory(const zraster_picture *picture); /* bytes, without its scene's */
ZRASTER_API void zraster_picture_free(zraster_picture *picture);

/* ---- comparison of two models ----
 * Volumes that both share, distances between their surfaces, and what only one of them has, as JSON: "Comparing models" in
 * measure.md lists the keys. `query` may be NULL: "tolerance=0.01&show=difference". `cancel` may be NULL. Both scenes
 * may be of different renderers; that of `a` compares. ZRASTER_BAD_SCENE: a scene has no faces, or csg. */

ZRASTER_API zraster_status zraster_compare(const zraster_scene *a, const zraster_scene *b, const char *query,
                                           zraster_cancel *cancel, zraster_comparison **comparison,
                                           zraster_error **error);
ZRASTER_API const char *zraster_comparison_json(const zraster_comparison *comparison); /* the comparison's */
ZRASTER_API int zraster_comparison_same(const zraster_comparison *comparison); /* 1: equal within the tolerance */
/* Returns the scene that "show=difference", deviation or side asks for, to draw by zraster_scene_draw; NULL: none. It is
 * the comparison's. */
ZRASTER_API const zraster_scene *zraster_comparison_scene(const zraster_comparison *comparison);
ZRASTER_API void zraster_comparison_free(zraster_comparison *comparison);

/* ---- technical drawing ----
 * Front, top, right and isometric view at one standard scale, with hidden lines, sizes, holes, a section if asked for, and
 * a title block: "Technical drawings" in drawing.md. `query` may be NULL: "page=a4&section=x&title=Plate&format=png".
 * `cancel` may be NULL. ZRASTER_BAD_SCENE: no faces, several views, or no room at the scale. */

ZRASTER_API zraster_status zraster_drawing_make(const zraster_scene *scene, const char *query, zraster_cancel *cancel,
                                                zraster_drawing **drawing, zraster_error **error);
ZRASTER_API struct zraster_bytes zraster_drawing_file(const zraster_drawing *drawing); /* the drawing's */
ZRASTER_API const char *zraster_drawing_warning(const zraster_drawing *drawing, size_t i); /* NULL behind the last */
ZRASTER_API const char *zraster_drawing_json(const zraster_drawing *drawing); /* page, scale, sizes, holes; likewise */
ZRASTER_API void zraster_drawing_free(zraster_drawing *drawing);

/* ---- files that a file refers to ----
 * glTF, OBJ, MTL and scenes refer to other files, which a request needs as parts. Their names are paths from the folder
 * of the file that refers to them. Parts have their paths from the folder of the body as names.
 *
 * Writes the names in a file, each with a final zero; they may repeat. Returns the bytes of all names. If these exceed
 * `room`, names are missing, and the caller calls again with more room; `names` may be NULL if `room` is 0. "mtllib a
 * b" gives "a b", "a" and "b". `type`: as for a request, "mtl" too; NULL: detected. */
ZRASTER_API size_t zraster_references(const void *body, size_t body_size, const char *type, char *names, size_t room);

/* ---- the library itself ---- */

ZRASTER_API const char *zraster_version(void); /* of the library that runs; ZRASTER_VERSION is the header's */
ZRASTER_API uint32_t zraster_rules(void);      /* rises when the same scene gets other pixels */

/* Returns JSON with the parameters of queries, keys of scenes, looks, channels, encodings, formats, limits, and words
 * with their meaning, for help and bindings. The text is the renderer's. NULL without memory. */
ZRASTER_API const char *zraster_tables(zraster *renderer);

/* Returns the JSON Schema (2020-12) of a scene, with the meaning, unit, default and bounds of each key. The text is the
 * renderer's. NULL without memory. */
ZRASTER_API const char *zraster_schema(zraster *renderer);

#ifdef __cplusplus
}
#endif

#endif
