/* meshes.h - model files as read, kept between requests (kept.h, core/input/model/kept_mesh.h).
 *
 * A file is kept when it is read for the second time, into an arena of its own.
 * Thread: one struct meshes_use belongs to one request.
 */
#ifndef ZRASTERD_MESHES_H
#define ZRASTERD_MESHES_H

#include <stdint.h>

#include "core.h"
#include "kept.h"

/* Keeps up to `max_bytes`, the copies of the files included; 0: none. NULL without memory. Close it by kept_close. */
struct kept *meshes_open(uint64_t max_bytes);

/* The meshes of one request. `meshes` may be NULL: none are kept. */
struct meshes_use {
    struct kept *meshes;
    struct kept_held *held;
};

/* Returns the functions for zr_request; `use` must outlive the scene. */
struct zr_kept_meshes meshes_lend(struct meshes_use *use);

/* Releases the meshes once the scene is no longer used. */
void meshes_release(struct meshes_use *use);

#endif
