#include "input/image_read.h"

#include "input/image_size.h"
#include "input/jpeg_read.h"
#include "input/png_read.h"
#include "input/sniff.h"

static enum zr_status read_png(struct zr_arena *arena, struct zr_arena *scratch, const void *bytes, size_t size,
                               const struct zr_png_head *head, uint64_t texels_max, struct zr_image *image,
                               struct zr_reason *reason)
{
    if (!zr_image_fits(head->width, head->height, texels_max, reason)) return ZR_BAD_SCENE;
    const size_t texel_bytes = head->bits == 16 ? 8 : 4;
    void *rgba = zr_arena_alloc_beside(arena, scratch, (size_t)head->width * head->height, texel_bytes);
    if (!rgba) return ZR_NO_MEMORY;
    *image = (struct zr_image){head->width, head->height, head->bits == 16 ? 16 : 8, rgba};
    return zr_png_read_whole(scratch, bytes, size, head, rgba, reason);
}

static enum zr_status refuse(const void *bytes, size_t size, struct zr_reason *reason)
{
    const char *words = zr_bytes_in_words(bytes, size);
    if (size == 0)
        zr_reason_give(reason, "no bytes; a PNG or a JPEG picture is needed");
    else if (words)
        zr_reason_give(reason, "it looks like %s; a PNG or a JPEG picture is needed", words);
    else
        zr_reason_give(reason, "it begins with %s, as no picture does that is known here; a PNG or a JPEG is needed",
                       zr_quote(bytes, size < 8 ? size : 8).text);
    return ZR_BAD_SCENE;
}

enum zr_status zr_image_read(struct zr_arena *arena, const void *bytes, size_t size, uint64_t texels_max,
                             struct zr_image *image, struct zr_reason *reason)
{
    struct zr_png_head head;
    const bool is_png = zr_png_head_read(bytes, size, &head);
    if (!is_png && !zr_jpeg_looks_so(bytes, size)) return refuse(bytes, size, reason);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    const enum zr_status status = is_png ? read_png(arena, &scratch, bytes, size, &head, texels_max, image, reason)
                                         : zr_jpeg_read(arena, &scratch, bytes, size, texels_max, image, reason);
    zr_arena_close_scratch(&scratch, arena);
    return status;
}
