#include "input/images/image_list.h"

#include <string.h>

#include "base/cancel.h"
#include "input/images/image_read.h"
#include "render_request.h"

enum { ITEMS_AT_FIRST = 16 };

struct zr_listed_image {
    const char *name; /* the URI, or the name of the asset */
    size_t length;
    bool is_asset;
    uint32_t image;
    enum { UNKNOWN, OPAQUE, SEE_THROUGH } opacity; /* set by the first zr_image_list_is_opaque */
    struct zr_parsed_bytes bytes;
};

struct zr_image_list zr_image_list_of(struct zr_scene_builder *builder, const struct zr_request *request,
                                      const struct zr_limits *limits)
{
    return (struct zr_image_list){
        .builder = builder, .pixels_max = limits->image_pixels_max, .kept = request->images, .quick = request->quick};
}

/* ---- the list ---- */

static bool is_same_bytes(const struct zr_parsed_bytes *bytes, const void *others, size_t size)
{
    return bytes->size == size && (bytes->bytes == others || memcmp(bytes->bytes, others, size) == 0);
}

static struct zr_listed_image name_image(const struct zr_bytes_name *name)
{
    const char *text = name->asset ? name->asset : name->uri;
    return (struct zr_listed_image){.name = text, .length = text ? strlen(text) : 0, .is_asset = name->asset != NULL};
}

/* Compares names alone, so that no asset is read twice. */
bool zr_image_list_find(const struct zr_image_list *list, const struct zr_bytes_name *name, uint32_t *number)
{
    const struct zr_listed_image wanted = name_image(name);
    if (!name->uri == !name->asset) return false;
    for (size_t i = 0; i < list->count; i++) {
        const struct zr_listed_image *image = &list->items[i];
        if (image->is_asset != wanted.is_asset || image->length != wanted.length ||
            memcmp(image->name, wanted.name, wanted.length) != 0)
            continue;
        *number = image->image;
        return true;
    }
    return false;
}

static const struct zr_listed_image *find_bytes(const struct zr_image_list *list, const struct zr_parsed_bytes *wanted)
{
    for (size_t i = 0; i < list->count; i++)
        if (is_same_bytes(&list->items[i].bytes, wanted->bytes, wanted->size)) return &list->items[i];
    return NULL;
}

bool zr_image_list_is_full(const struct zr_image_list *list, struct zr_reason *reason)
{
    if (list->count < ZR_IMAGE_LIST_MAX) return false;
    zr_reason_give(reason, "more than the %d images that are allowed", ZR_IMAGE_LIST_MAX);
    return true;
}

/* Appends an image. */
static enum zr_status append(struct zr_image_list *list, const struct zr_listed_image *image)
{
    if (list->count == list->room) {
        const size_t room = list->room ? 2 * list->room : ITEMS_AT_FIRST;
        struct zr_listed_image *more =
            zr_arena_grow(list->builder->arena, list->items, list->count, room, sizeof *more);
        if (!more) return ZR_NO_MEMORY;
        list->items = more;
        list->room = room;
    }
    list->items[list->count++] = *image;
    return ZR_OK;
}

/* ---- decoding ---- */

static const struct zr_image_file *find_decoded(const struct zr_image_list *list, const struct zr_parsed_bytes *bytes)
{
    for (size_t i = 0; i < list->ahead_count; i++)
        if (list->ahead[i].bytes == bytes->bytes && list->ahead[i].size == bytes->size) return &list->ahead[i];
    return NULL;
}

/* Takes an image that was decoded ahead, or decodes it. */
static enum zr_status read_image(struct zr_image_list *list, const struct zr_parsed_bytes *bytes, uint64_t texels_max,
                                 struct zr_image *image, struct zr_reason *reason)
{
    const struct zr_image_file *file = find_decoded(list, bytes);
    if (!file || !file->is_decoded || texels_max < file->kept.texels_max)
        return zr_image_read_kept(list->builder->arena, &list->kept,
                                  &(struct zr_encoded_image){bytes->bytes, bytes->size, texels_max}, image, reason);
    *image = file->kept.image;
    return ZR_OK;
}

/* Adds the image of the bytes to the scene. */
static enum zr_status decode(struct zr_image_list *list, const struct zr_parsed_bytes *bytes, uint32_t *number,
                             struct zr_reason *reason)
{
    const uint64_t most = list->pixels_max - list->pixels;
    const uint64_t quick_most = list->quick ? list->quick->image_pixels_max - list->pixels : most;
    struct zr_image image;
    enum zr_status status = read_image(list, bytes, quick_most < most ? quick_most : most, &image, reason);
    if (status == ZR_BAD_SCENE && quick_most < most) {
        list->quick->is_exceeded = true;
        status = ZR_CANCELLED;
    }
    if (status == ZR_CANCELLED) zr_reason_give(reason, "reading was stopped");
    if (status != ZR_OK) return status;
    list->pixels += (uint64_t)image.width * image.height;
    *number = zr_scene_builder_image(list->builder, &image);
    return zr_arena_ok(list->builder->arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_image_list_add_named(struct zr_image_list *list, const struct zr_bytes_name *name,
                                       const struct zr_parsed_bytes *bytes, uint32_t *number, struct zr_reason *reason)
{
    struct zr_listed_image image = name_image(name);
    const struct zr_listed_image *same = find_bytes(list, bytes);
    image.bytes = *bytes;
    const enum zr_status status = same ? ZR_OK : decode(list, bytes, &image.image, reason);
    if (status != ZR_OK) return status;
    if (same) image.image = same->image;
    *number = image.image;
    return append(list, &image);
}

enum zr_status zr_image_list_add(struct zr_image_list *list, const struct zr_parsed_bytes *bytes, uint32_t *number,
                                 struct zr_reason *reason)
{
    const struct zr_listed_image *same = find_bytes(list, bytes);
    struct zr_listed_image image = {.name = "", .bytes = *bytes};
    if (same) {
        *number = same->image;
        return ZR_OK;
    }
    if (zr_image_list_is_full(list, reason)) return ZR_BAD_SCENE;
    const enum zr_status status = decode(list, bytes, &image.image, reason);
    if (status != ZR_OK) return status;
    *number = image.image;
    return append(list, &image);
}

enum zr_status zr_image_list_count(struct zr_image_list *list, uint64_t pixels)
{
    struct zr_quick *quick = list->quick;
    if (pixels > list->pixels_max - list->pixels) return ZR_BAD_SCENE;
    if (quick && (quick->image_pixels_max < list->pixels || pixels > quick->image_pixels_max - list->pixels)) {
        quick->is_exceeded = true;
        return ZR_CANCELLED;
    }
    list->pixels += pixels;
    return ZR_OK;
}

/* ---- opacity ---- */

/* True if all alphas are the largest value. One row at a time, so that compilers vectorise the loop. */
static bool is_opaque(const struct zr_image *image)
{
    for (uint32_t y = 0; y < image->height; y++) {
        uint32_t all = UINT32_MAX;
        const size_t first = 4 * (size_t)image->width * y;
        for (size_t x = 0; x < image->width; x++)
            all &= image->bits == 8 ? 0xFF00u | ((const uint8_t *)image->texels)[first + 4 * x + 3]
                                    : ((const uint16_t *)image->texels)[first + 4 * x + 3];
        if ((all & 0xFFFFu) != 0xFFFFu) return false;
    }
    return true;
}

bool zr_image_list_is_opaque(const struct zr_image_list *list, uint32_t number)
{
    for (size_t i = 0; i < list->count; i++) {
        struct zr_listed_image *image = &list->items[i];
        if (image->image != number) continue;
        if (image->opacity == UNKNOWN)
            image->opacity = is_opaque(&list->builder->scene->images[number]) ? OPAQUE : SEE_THROUGH;
        return image->opacity == OPAQUE;
    }
    return true;
}

/* ---- decoding ahead ---- */

static bool is_same(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

const struct zr_image_file *zr_image_list_ahead(const struct zr_image_list *list, const struct zr_bytes_name *name)
{
    for (size_t i = 0; list->ahead_names && i < list->ahead_count; i++)
        if (is_same(list->ahead_names[i].uri, name->uri) && is_same(list->ahead_names[i].asset, name->asset))
            return &list->ahead[i];
    return NULL;
}

void zr_image_list_decode(struct zr_image_list *list)
{
    uint64_t most = list->pixels_max;
    if (list->quick && list->quick->image_pixels_max < most) most = list->quick->image_pixels_max;
    if (list->ahead_count < 2 || list->pixels > most) return;
    const struct zr_run run = {.arena = list->builder->arena, .team = list->builder->team};
    zr_images_read_ahead(&run, &list->kept, most - list->pixels, list->ahead, list->ahead_count);
}

void zr_image_list_expect(struct zr_image_list *list, const struct zr_parsed_bytes *bytes)
{
    if (list->ahead_count == ZR_AHEAD_MAX || bytes->size == 0) return;
    for (size_t i = 0; i < list->ahead_count; i++)
        if (is_same_bytes(bytes, list->ahead[i].bytes, list->ahead[i].size)) return;
    if (!list->ahead) list->ahead = zr_arena_alloc(list->builder->arena, ZR_AHEAD_MAX, sizeof *list->ahead);
    if (!list->ahead) return;
    list->ahead[list->ahead_count++] = (struct zr_image_file){.bytes = bytes->bytes, .size = bytes->size};
}
