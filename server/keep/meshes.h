/* meshes.h - model files as read, kept between requests (kept.h, core/input/model/kept_mesh.h).
 *
 * A file is kept when it is read for the second time, into an arena of its own. So files that are sent once displace
 * nothing and are not copied. The hashes of files that were read are noted in a small table; some may be forgotten.
 * Thread: struct meshes is thread-safe. One struct meshes_use belongs to one request.
 */
#ifndef ZRASTERD_MESHES_H
#define ZRASTERD_MESHES_H

#include <stdint.h>

#include "core.h"
#include "kept.h"

struct meshes;

/* Keeps up to `max_bytes`, the copies of the files included; 0: none. NULL without memory. */
struct meshes *meshes_open(uint64_t max_bytes);

/* Frees all meshes, which no request may use any more. NULL does nothing. */
void meshes_close(struct meshes *meshes);

/* The table of the meshes. NULL if `meshes` is NULL. */
struct kept *meshes_kept(struct meshes *meshes);

/* The meshes of one request. `meshes` may be NULL: none are kept. */
struct meshes_use {
    struct meshes *meshes;
    struct kept_held *held;
};

/* Returns the functions for zr_request; `use` must outlive the scene. */
struct zr_kept_meshes meshes_lend(struct meshes_use *use);

/* Releases the meshes once the scene is no longer used. */
void meshes_release(struct meshes_use *use);

#endif
