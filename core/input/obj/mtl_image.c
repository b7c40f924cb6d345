/* Finds the images of maps, and makes images of channels of other images. */
#include <string.h>

#include "base/cancel.h"
#include "input/images/image_read.h"
#include "input/obj/mtl_file.h"

enum {
    MADE_MAX = 1024, /* each is compared with all others */
    MADE_AT_FIRST = 4,
    GREY_TOLERANCE = 16 << 8 /* in 16-bit values: JPEG adds a little colour */
};

/* ---- images of maps ---- */

/* Counts a fault of an image for a warning. Other failures stop reading. */
static void note_bad(struct zr_mtl *mtl, const struct zr_mtl_text *whole, enum zr_status status,
                     const struct zr_reason *reason)
{
    struct zr_mtl_noted *noted = &mtl->notes[ZR_MTL_NOTE_BAD_IMAGE];
    if (!zr_arena_ok(mtl->arena)) {
        mtl->status = ZR_NO_MEMORY;
    } else if (status == ZR_CANCELLED || zr_is_cancelled(mtl->cancel)) {
        mtl->status = zr_error_add(mtl->error, ZR_CANCELLED, NULL, "reading was stopped");
    } else {
        if (noted->count == 0 && *reason->text) noted->reason = *reason;
        zr_mtl_note(mtl, ZR_MTL_NOTE_BAD_IMAGE, whole);
    }
}

bool zr_mtl_find_image(struct zr_mtl *mtl, const struct zr_mtl_given_map *map, uint32_t *number)
{
    if (!map->is_given || mtl->status != ZR_OK) return false;
    const struct zr_asset *asset = zr_mtl_find_file(mtl, &map->name);
    if (!asset) {
        zr_mtl_note(mtl, ZR_MTL_NOTE_MISSING, &map->whole);
        return false;
    }
    const struct zr_parsed_bytes bytes = {asset->bytes, asset->size};
    struct zr_reason reason = {""};
    const enum zr_status status = zr_image_list_add(&mtl->decoded, &bytes, number, &reason);
    if (status == ZR_OK) return true;
    note_bad(mtl, &map->whole, status, &reason);
    return false;
}

/* ---- texels ---- */

static uint32_t distance(uint32_t a, uint32_t b)
{
    return a < b ? b - a : a - b;
}

bool zr_mtl_is_grey(const struct zr_mtl *mtl, uint32_t number)
{
    const struct zr_image *image = &mtl->builder->scene->images[number];
    for (uint32_t y = 0; y < image->height && !zr_is_cancelled(mtl->cancel); y++)
        for (uint32_t x = 0; x < image->width; x++) {
            const uint32_t green = zr_image_texel(image, x, y, 1);
            if (distance(zr_image_texel(image, x, y, 0), green) > GREY_TOLERANCE ||
                distance(zr_image_texel(image, x, y, 2), green) > GREY_TOLERANCE)
                return false;
        }
    return true;
}

/* ---- made images ---- */

static bool is_same(const struct zr_mtl_made_image *made, const struct zr_mtl_channel channels[4])
{
    for (int k = 0; k < 4; k++)
        if (made->channels[k].image != channels[k].image || made->channels[k].channel != channels[k].channel)
            return false;
    return true;
}

/* Returns the image of a channel, or NULL. */
static const struct zr_image *image_of(const struct zr_mtl *mtl, const struct zr_mtl_channel *channel)
{
    return channel->image ? &mtl->builder->scene->images[channel->image - 1] : NULL;
}

/* Sets the size of the largest image. */
static struct zr_image size_of(const struct zr_mtl *mtl, const struct zr_mtl_channel channels[4])
{
    struct zr_image out = {.bits = 8};
    for (int k = 0; k < 4; k++) {
        const struct zr_image *image = image_of(mtl, &channels[k]);
        if (!image) continue;
        if (image->bits > out.bits) out.bits = image->bits;
        if ((uint64_t)image->width * image->height <= (uint64_t)out.width * out.height) continue;
        out.width = image->width;
        out.height = image->height;
    }
    return out;
}

/* Writes one channel. A smaller image is repeated texel by texel. */
static bool put_channel(const struct zr_mtl *mtl, const struct zr_image *out, void *texels, int k,
                        const struct zr_mtl_channel *of)
{
    const struct zr_image *from = image_of(mtl, of);
    for (uint32_t y = 0; y < out->height; y++) {
        const size_t row = from ? (size_t)((uint64_t)y * from->height / out->height) : 0;
        if (zr_is_cancelled(mtl->cancel)) return false;
        for (uint32_t x = 0; x < out->width; x++) {
            const size_t column = from ? (size_t)((uint64_t)x * from->width / out->width) : 0,
                         at = 4 * ((size_t)y * out->width + x) + (size_t)k;
            const uint32_t value = from ? zr_image_texel(from, column, row, of->channel) : UINT16_MAX;
            if (out->bits == 8)
                ((uint8_t *)texels)[at] = (uint8_t)(value >> 8);
            else
                ((uint16_t *)texels)[at] = (uint16_t)value;
        }
    }
    return true;
}

static enum zr_status fill(struct zr_mtl *mtl, const struct zr_mtl_channel channels[4], uint32_t *number,
                           struct zr_reason *reason)
{
    struct zr_image out = size_of(mtl, channels);
    const uint64_t pixels = (uint64_t)out.width * out.height;
    const enum zr_status status = zr_image_list_count(&mtl->decoded, pixels);
    if (status == ZR_BAD_SCENE) zr_reason_give(reason, "the images have more pixels than are allowed");
    if (status != ZR_OK) return status;
    void *texels = zr_arena_alloc(mtl->arena, (size_t)pixels, 4 * (out.bits / 8));
    if (!texels) return ZR_NO_MEMORY;
    for (int k = 0; k < 4; k++)
        if (!put_channel(mtl, &out, texels, k, &channels[k])) return ZR_CANCELLED;
    out.texels = texels;
    *number = zr_scene_builder_image(mtl->builder, &out);
    return zr_arena_ok(mtl->arena) ? ZR_OK : ZR_NO_MEMORY;
}

static struct zr_mtl_made_image *next_made(struct zr_mtl *mtl)
{
    if (mtl->image_count == mtl->image_room) {
        const uint32_t room = mtl->image_room ? 2 * mtl->image_room : MADE_AT_FIRST;
        struct zr_mtl_made_image *more = zr_arena_grow(mtl->arena, mtl->images, mtl->image_count, room, sizeof *more);
        if (!more) return NULL;
        mtl->images = more;
        mtl->image_room = room;
    }
    return &mtl->images[mtl->image_count];
}

bool zr_mtl_make_image(struct zr_mtl *mtl, const struct zr_mtl_text *whole, const struct zr_mtl_channel channels[4],
                       uint32_t *number)
{
    for (uint32_t i = 0; i < mtl->image_count; i++)
        if (is_same(&mtl->images[i], channels)) {
            *number = mtl->images[i].number;
            return true;
        }
    struct zr_mtl_made_image *made = mtl->image_count < MADE_MAX ? next_made(mtl) : NULL;
    struct zr_reason reason = {""};
    const enum zr_status status = made ? fill(mtl, channels, number, &reason) : ZR_BAD_SCENE;
    if (status != ZR_OK) {
        note_bad(mtl, whole, status, &reason);
        return false;
    }
    memcpy(made->channels, channels, sizeof made->channels);
    made->number = *number;
    mtl->image_count++;
    return true;
}
