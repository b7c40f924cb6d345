#include "input/images/image_file.h"

#include <inttypes.h>

bool zr_image_fits(uint32_t width, uint32_t height, uint64_t texels_max, struct zr_reason *reason)
{
    const uint64_t texels = (uint64_t)width * height;
    if (texels == 0)
        zr_reason_give(reason, "an image of %" PRIu32 " x %" PRIu32 " texels; both sides must be at least 1", width,
                       height);
    else if (width > ZR_IMAGE_SIDE_MAX || height > ZR_IMAGE_SIDE_MAX)
        zr_reason_give(reason, "an image of %" PRIu32 " x %" PRIu32 " texels; up to %d per side are allowed", width,
                       height, ZR_IMAGE_SIDE_MAX);
    else if (texels > texels_max)
        zr_reason_give(reason,
                       "an image of %" PRIu32 " x %" PRIu32 " texels; %" PRIu64
                       " are left of imagePixelsMax, which all images of a request share",
                       width, height, texels_max);
    else
        return true;
    return false;
}
