/* images.h - decoded images of textures, kept between requests by the SHA-256 of their files.
 *
 * Safe:   the hash covers the whole file, so a client cannot change the image of another client's file. It can only
 *         displace images, which are then decoded again. Answers are the same with and without kept images.
 * Bounds: the bytes of all images, in blocks of 4096. The least recently used ones make room for new ones. An image
 *         that a request uses stays, and its bytes count, until that request has ended.
 * Thread: struct images is thread-safe. One struct images_use belongs to one request.
 */
#ifndef ZRASTERD_IMAGES_H
#define ZRASTERD_IMAGES_H

#include <stdint.h>

#include "core.h"

struct images;

/* Keeps up to `max_bytes`; 0: none. NULL without memory. */
struct images *images_open(uint64_t max_bytes);

/* Frees all images, which no request may use any more. NULL does nothing. */
void images_close(struct images *images);

/* Drops all images that no request uses, and returns their memory to the system. False if there are none. */
bool images_drop(struct images *images);

struct images_state {
    uint64_t count, bytes;          /* kept now */
    uint64_t hits, misses, dropped; /* since the start: found, decoded, and displaced by others */
};

/* Returns the counts; `images` is not NULL. */
struct images_state images_look(struct images *images);

/* The images of one request. `images` may be NULL: none are kept. */
struct images_use {
    struct images *images;
    struct images_held *held;
};

/* Returns the functions for zr_request; `use` must outlive the scene. */
struct zr_kept_images images_lend(struct images_use *use);

/* Releases the images once the scene is no longer used. */
void images_release(struct images_use *use);

#endif
