/* images.h - decoded images of textures, kept between requests by the SHA-256 of their files (kept.h).
 *
 * The hash covers the whole file.
 * Thread: one struct images_use belongs to one request.
 */
#ifndef ZRASTERD_IMAGES_H
#define ZRASTERD_IMAGES_H

#include <stdint.h>

#include "core.h"
#include "kept.h"
#include "texts.h"

/* Keeps up to `max_bytes`; 0: none. NULL without memory. Close it by kept_close. */
struct kept *images_open(uint64_t max_bytes);

/* The images of one request. `images` may be NULL: none are kept. */
struct images_use {
    struct kept *images;
    const struct texts_use *texts; /* of the request; or NULL */
    struct kept_held *held;
};

/* Returns the functions for zr_request; `use` must outlive the scene. */
struct zr_kept_images images_lend(struct images_use *use);

/* Releases the images once the scene is no longer used. */
void images_release(struct images_use *use);

#endif
