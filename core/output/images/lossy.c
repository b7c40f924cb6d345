#include "output/images/lossy.h"

#include <string.h>

#include "base/run.h"

enum zr_status zr_lossy_end_try(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_buffer *out,
                                size_t most, enum zr_status status, struct zr_lossy_file *file)
{
    if (status == ZR_OK && file->size <= most) {
        file->bytes = zr_arena_alloc_beside(arena, scratch, file->size, 1);
        if (file->bytes) memcpy(file->bytes, out->bytes, file->size);
        if (!file->bytes) status = ZR_NO_MEMORY;
    }
    zr_arena_close_scratch(scratch, arena);
    return status;
}

/* Quality of the next to last try if none has fitted. The last one then has quality 1, and neither misses more than
 * three. */
enum { LOW = 5 };

enum zr_status zr_lossy_fit(const struct zr_run *run, zr_lossy_write_fn *write, const struct zr_lossy *image,
                            size_t most, struct zr_lossy_file *file)
{
    struct zr_lossy tried = *image;
    uint32_t fits = 0, fails = image->quality + 1; /* qualities up to `fits` fit, those from `fails` on do not */
    *file = (struct zr_lossy_file){.size = SIZE_MAX};
    for (int left = ZR_LOSSY_TRIES; left > 0 && fails - fits > 1; left--) {
        struct zr_lossy_file made;
        if (fits == 0 && left == 2 && tried.quality > LOW) tried.quality = LOW;
        if (fits == 0 && left == 1) tried.quality = 1;
        const enum zr_status status = write(run->arena, &tried, most, run->cancel, &made);
        if (status != ZR_OK) return status;
        if (made.bytes || (!file->bytes && made.size < file->size)) *file = made;
        if (made.bytes)
            fits = tried.quality;
        else
            fails = tried.quality;
        if (image->is_lossless) break;
        tried.quality = fits + (fails - fits) / 2;
    }
    return ZR_OK;
}
