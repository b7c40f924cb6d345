#include "input/images/image_read.h"

#include "base/cancel.h"
#include "input/formats/sniff.h"

static enum zr_status read_png(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                               struct zr_image *image, struct zr_reason *reason)
{
    struct zr_png_head head;
    if (!zr_png_head_read(file->bytes, file->size, &head) ||
        !zr_image_fits(head.width, head.height, file->texels_max, reason))
        return ZR_BAD_SCENE;
    const size_t texel_bytes = head.bits == 16 ? 8 : 4;
    void *rgba = zr_arena_alloc_beside(arena, scratch, (size_t)head.width * head.height, texel_bytes);
    if (!rgba) return ZR_NO_MEMORY;
    *image = (struct zr_image){head.width, head.height, head.bits == 16 ? 16 : 8, rgba, NULL};
    return zr_png_read_whole(scratch, file, &head, rgba, reason);
}

static enum zr_status refuse(const void *bytes, size_t size, struct zr_reason *reason)
{
    const char *words = zr_bytes_in_words(bytes, size);
    if (size == 0)
        zr_reason_give(reason, "no bytes; a PNG, JPEG or WebP picture is needed");
    else if (words)
        zr_reason_give(reason, "it looks like %s; a PNG, JPEG or WebP picture is needed", words);
    else
        zr_reason_give(reason, "it begins with %s, which is no known picture format; a PNG, JPEG or WebP is needed",
                       zr_quote(bytes, size < 8 ? size : 8).text);
    return ZR_BAD_SCENE;
}

bool zr_image_head_read(const struct zr_encoded_image *file, struct zr_image *head)
{
    struct zr_png_head png;
    struct zr_reason reason;
    *head = (struct zr_image){.bits = 8};
    if (zr_png_head_read(file->bytes, file->size, &png))
        *head = (struct zr_image){png.width, png.height, png.bits == 16 ? 16 : 8, NULL, NULL};
    else if (!zr_jpeg_size_read(file->bytes, file->size, &head->width, &head->height))
        return false;
    return zr_image_fits(head->width, head->height, file->texels_max, &reason);
}

enum zr_status zr_image_decode(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                               struct zr_kept_image *out, struct zr_reason *reason)
{
    struct zr_png_head head;
    const bool is_png = zr_png_head_read(file->bytes, file->size, &head),
               is_jpeg = zr_jpeg_looks_so(file->bytes, file->size);
    if (!is_png && !is_jpeg && !zr_webp_looks_so(file->bytes, file->size))
        return refuse(file->bytes, file->size, reason);
    const enum zr_status status = (is_png    ? read_png
                                   : is_jpeg ? zr_jpeg_read
                                             : zr_webp_read)(arena, scratch, file, &out->image, reason);
    out->texels_max = file->texels_max;
    out->scratch_bytes = scratch->peak > scratch->held ? scratch->peak : scratch->held;
    return status;
}

static enum zr_status decode(struct zr_arena *arena, const struct zr_encoded_image *file, struct zr_kept_image *out,
                             struct zr_reason *reason)
{
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    const enum zr_status status = zr_image_decode(arena, &scratch, file, out, reason);
    zr_arena_close_scratch(&scratch, arena);
    return status;
}

enum zr_status zr_image_read(struct zr_arena *arena, const struct zr_encoded_image *file, struct zr_image *image,
                             struct zr_reason *reason)
{
    struct zr_kept_image decoded = {.scratch_bytes = 0};
    const enum zr_status status = decode(arena, file, &decoded, reason);
    *image = decoded.image;
    return status;
}

/* Bytes at the ends of blocks that decoding may leave unused. */
enum { SLACK_BYTES = 4 * ZR_ARENA_BLOCK };

/* True if decoding would succeed. Charges the arena for as much memory as decoding, so that a request has the same
 * memory left with and without kept images. */
static bool accept(struct zr_arena *arena, const struct zr_kept_image *kept, uint64_t texels_max)
{
    const size_t bytes = zr_image_bytes(&kept->image), left = zr_arena_left(arena);
    if (texels_max < kept->texels_max || !zr_arena_ok(arena) || zr_is_cancelled(arena->cancel)) return false;
    if (left < SLACK_BYTES || left - SLACK_BYTES < bytes + bytes / 4 ||
        left - SLACK_BYTES - bytes - bytes / 4 < kept->scratch_bytes)
        return false;
    return zr_arena_alloc(arena, bytes, 1) != NULL;
}

enum zr_status zr_image_read_kept(struct zr_arena *arena, const struct zr_kept_images *images,
                                  const struct zr_encoded_image *file, struct zr_image *image, struct zr_reason *reason)
{
    struct zr_file_hash hash;
    struct zr_kept_image kept;
    enum zr_status status = ZR_OK;
    if (!images->find || !images->find(images->context, file->bytes, file->size, &hash, &kept) ||
        !accept(arena, &kept, file->texels_max)) {
        status = decode(arena, file, &kept, reason);
        if (status == ZR_OK && images->keep) images->keep(images->context, &hash, &kept);
    }
    if (status == ZR_OK) *image = kept.image;
    return status;
}
