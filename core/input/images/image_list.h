/* image_list.h - input: images of a scene or a model file while it is read. Each is decoded once.
 *
 * Ahead:  a reader may list the files of images before the textures that use them are read. Several threads decode the
 *         listed files (image_ahead.h); later readings take the results.
 * Thread: one list belongs to one thread.
 */
#ifndef ZR_IMAGE_LIST_H
#define ZR_IMAGE_LIST_H

#include "base/team.h"
#include "input/files/assets.h"
#include "input/images/image_ahead.h"
#include "input/text/text.h"

/* Images per list, since each name is compared with all others; files that are decoded ahead. */
enum { ZR_IMAGE_LIST_MAX = 1024, ZR_AHEAD_MAX = 128 };

struct zr_listed_image; /* private to image_list.c */

struct zr_image_list {
    struct zr_scene_builder *builder; /* receives the images */
    uint64_t pixels_max;
    uint64_t pixels;            /* decoded pixels, all images */
    struct zr_kept_images kept; /* the request's */
    struct zr_quick *quick;     /* likewise; may be NULL */

    size_t count, room;
    struct zr_listed_image *items;

    size_t ahead_count;
    const struct zr_bytes_name *ahead_names; /* one per file; NULL: the files have no names */
    struct zr_image_file *ahead;             /* found, and perhaps decoded */
};

/* Returns an empty list. */
struct zr_image_list zr_image_list_of(struct zr_scene_builder *builder, const struct zr_request *request,
                                      const struct zr_limits *limits);

/* Finds the number, in the builder's scene, of the image with these bytes, which stay where they are; decodes it if it
 * is new. ZR_OK, ZR_NO_MEMORY, or ZR_CANCELLED or ZR_BAD_SCENE with the reason. */
enum zr_status zr_image_list_add(struct zr_image_list *list, const struct zr_parsed_bytes *bytes, uint32_t *number,
                                 struct zr_reason *reason);

/* The same for bytes with a name, under which zr_image_list_find finds the image later, without its bytes. The caller
 * checks zr_image_list_is_full before. */
enum zr_status zr_image_list_add_named(struct zr_image_list *list, const struct zr_bytes_name *name,
                                       const struct zr_parsed_bytes *bytes, uint32_t *number, struct zr_reason *reason);
bool zr_image_list_find(const struct zr_image_list *list, const struct zr_bytes_name *name, uint32_t *number);
bool zr_image_list_is_full(const struct zr_image_list *list, struct zr_reason *reason);

/* Counts the texels of an image that the reader makes, like those of decoded images. ZR_BAD_SCENE beyond the limit,
 * ZR_CANCELLED beyond the limit of a quick reading, which is marked as exceeded. */
enum zr_status zr_image_list_count(struct zr_image_list *list, uint64_t pixels);

/* True if all alphas of the image are 1. Scans its texels once. */
bool zr_image_list_is_opaque(const struct zr_image_list *list, uint32_t number);

/* Lists a file for decoding ahead, without a name, unless the list has its bytes or is full. The bytes must outlive the
 * reading. */
void zr_image_list_expect(struct zr_image_list *list, const struct zr_parsed_bytes *bytes);

/* Decodes the listed files by several threads. Faults are reported when the textures are read. */
void zr_image_list_decode(struct zr_image_list *list);

/* Returns the listed file with this name, or NULL. */
const struct zr_image_file *zr_image_list_ahead(const struct zr_image_list *list, const struct zr_bytes_name *name);

#endif
