/* assets.h - input: the assets of a request, and names of bytes among them. */
#ifndef ZR_ASSETS_H
#define ZR_ASSETS_H

#include "base/hash.h"
#include "core.h"
#include "scene/scene_builder.h"

/* A name of bytes: one of two keys. */
struct zr_bytes_name {
    const char *uri, *asset; /* NULL: not given */
};

/* Bytes of a file, in the arena or in the request. */
struct zr_parsed_bytes {
    const void *bytes;
    size_t size;
};

/* Hash of the names and sizes of all assets of a request, made at its first use. Initially all zero. */
struct zr_assets_hash {
    bool is_made;
    struct zr_file_hash hash;
};

/* A kept scene also notes which assets its meshes and polygons use. */
enum { ZR_USED = 1, ZR_USED_BY_GEOMETRY = 2 };

struct zr_file_names; /* private to file_parts.c */

struct zr_parsed_assets {
    size_t count;
    const struct zr_asset *items;
    struct zr_file_names *names; /* NULL before the first search */
    const char *folder;          /* folder of the file that is read, with a final slash; NULL: the body is read */
    bool *looked;                /* the builder's */
    uint8_t *uses;               /* one per asset: a sum of ZR_USED and ZR_USED_BY_GEOMETRY */
    uint8_t use;                 /* sum for the part of the scene that is read now */
    struct zr_stored stored;
    struct zr_kept_texts texts;
    struct zr_kept_meshes meshes;
    struct zr_assets_hash hash; /* for model files of the scene */
    struct zr_quick *quick;     /* the request's; may be NULL */
    size_t array_bytes;         /* counted by zr_json_has_time */
};

/* Returns the assets of a request for its body, or for a file in a scene, which shares the scene's uses. `uses` is NULL
 * without memory. */
struct zr_parsed_assets zr_parsed_assets_of(const struct zr_scene_builder *builder, const struct zr_request *request);

/* Warns of assets that nothing uses. A file in a scene leaves that to the scene. */
void zr_parsed_warn_of_unused_assets(const struct zr_parsed_assets *assets, struct zr_scene_builder *builder);

void zr_warn_of_unused_asset(struct zr_scene_builder *builder, const struct zr_asset *asset);

/* Ending of the files that the key environment may name without an object. */
#define ZR_ENVIRONMENT_ENDING ".hdr"

/* Beginning of the name of a stored asset. */
#define ZR_STORED "sha256:"

/* Returns the 64 digits of the name of a stored asset, "sha256:..."; NULL: another name. */
const char *zr_stored_name(const char *asset);

#endif
