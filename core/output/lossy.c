#include "output/lossy.h"

/* The last try but one if none has fitted yet: the last one is then 1, and neither misses more than three. */
enum { LOW = 5 };

enum zr_status zr_lossy_fit(zr_lossy_write_fn *write, struct zr_arena *arena, const struct zr_lossy *image, size_t most,
                            const struct zr_cancel *cancel, struct zr_lossy_file *file)
{
    struct zr_lossy tried = *image;
    uint32_t fits = 0, fails = image->quality + 1; /* qualities up to `fits` fit, those from `fails` on do not */
    *file = (struct zr_lossy_file){.size = SIZE_MAX};
    for (int left = ZR_LOSSY_TRIES; left > 0 && fails - fits > 1; left--) {
        struct zr_lossy_file made;
        if (fits == 0 && left == 2 && tried.quality > LOW) tried.quality = LOW;
        if (fits == 0 && left == 1) tried.quality = 1;
        const enum zr_status status = write(arena, &tried, most, cancel, &made);
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
