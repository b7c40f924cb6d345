/* image_ahead.h - input: decodes several images at once, by all threads, before a reader asks for them one by one.
 *
 * Exact: the reader takes an image only if its own decoding would have the same result, in its order and under its
 *        limits. It decodes all other files itself, such as broken ones, and reports their faults. So scene, errors and
 *        memory are the same for every team.
 */
#ifndef ZR_IMAGE_AHEAD_H
#define ZR_IMAGE_AHEAD_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/image.h"

struct zr_image_file {
    const void *bytes;
    size_t size;
    bool is_decoded; /* `kept` is set */
    struct zr_kept_image kept;
};

/* Decodes files, or takes them from `images`. All files together may have `texels_max` texels. Decodes none unless
 * memory is ample for all. Texels lie in the arena or in `images`. Returns early if arena->cancel is raised.
 * The run has arena and team. */
void zr_images_read_ahead(const struct zr_run *run, const struct zr_kept_images *images, uint64_t texels_max,
                          struct zr_image_file *files, size_t count);

#endif
