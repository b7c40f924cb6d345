/* kept_mesh.h - input: reads model files, and keeps them between requests if the caller wants it (core.h).
 *
 * A value is what the reader of a format leaves in a builder: all that depends on the file alone. Looks, views, nodes
 * and parameters are applied to it for each request. So bare meshes and the models of scenes share the same functions,
 * and a scene of many models reads only those that are new.
 *
 * Equality: a stored asset is found by the SHA-256 in its name and is not read at all. Hashing other bytes would take
 *           longer than reading many of them. They are found by a hash of their size and some samples, and all of them
 *           are then compared with a copy. A file that differs from the kept one of its hash has a next hash, made of
 *           the first difference: so changed files are kept, too. If the reader has looked for other files, names and
 *           sizes of all assets are part of the hash, and those that it found are compared with copies. The format, the
 *           pose (animation, time) and the limit of pixels are parts of the hash, too.
 * Memory:   reading is a part of the arena (base/arena.h), also if nothing is kept. A request that shares a kept file
 *           is charged for that part, so it has the same memory left as one that reads the file. If the file would not
 *           fit, it is read, and fails as it does anew.
 * Left out: files below 64 KiB, which are read in less than a millisecond, and models in a ZIP archive.
 */
#ifndef ZR_KEPT_MESH_H
#define ZR_KEPT_MESH_H

#include "input/files/assets.h"

/* A model file that is to be read. */
struct zr_mesh_file {
    struct zr_scene_builder *builder; /* asset_uses: flags that the file's own are added to; NULL: a bare mesh */
    const struct zr_request *request; /* the file's: its bytes, and the assets that it may refer to */
    const struct zr_limits *limits;   /* of this file */
    struct zr_assets_hash *assets;    /* of the request */
    bool is_stored;                   /* `hashes` begin with the SHA-256 of a stored asset */
    bool is_hashed;                   /* for zr_mesh_file_find and zr_mesh_file_read: `hashes` are made */
    bool is_taken;                    /* many files of its hashes are kept, or this one does not fit */
    struct zr_file_hash hashes[2];    /* if no other file is looked for, and if one is */
};

/* Gives a kept file to the builder. False if there is none. */
bool zr_mesh_file_find(struct zr_mesh_file *file);

/* Reads the file with `read`, and completes its meshes. Errors are those of `read`. */
enum zr_status zr_mesh_file_read(struct zr_mesh_file *file, zr_model_read_fn *read, struct zr_error *error);

#endif
