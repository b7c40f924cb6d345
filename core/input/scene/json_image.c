/* Finds images by the names of their bytes. Each is decoded once, however many textures use it. */
#include <string.h>

#include "input/images/image_read.h"
#include "input/mesh/json_image_ahead.h"
#include "input/scene/json_scene.h"
#include "input/formats/quick.h"

/* Images per scene: each name is compared with all others. */
enum { NAMES_MAX = 1024 };

struct named {
    const char *text; /* the URI, or the name of the asset */
    size_t length;
    bool is_asset;
    uint32_t image;
    enum { UNKNOWN, OPAQUE, SEE_THROUGH } opacity; /* set by the first zr_parsed_image_is_opaque */
    struct zr_parsed_bytes bytes;
};

/* Compares names alone, so that no asset is read twice. */
static const struct named *find_name(const struct zr_growing *names, const struct named *wanted)
{
    const struct named *named = names->items;
    for (size_t i = 0; i < names->count; i++)
        if (named[i].is_asset == wanted->is_asset && named[i].length == wanted->length &&
            memcmp(named[i].text, wanted->text, wanted->length) == 0)
            return &named[i];
    return NULL;
}

static const struct named *find_bytes(const struct zr_growing *names, const struct zr_parsed_bytes *wanted)
{
    const struct named *named = names->items;
    for (size_t i = 0; i < names->count; i++)
        if (named[i].bytes.size == wanted->size &&
            (named[i].bytes.bytes == wanted->bytes || memcmp(named[i].bytes.bytes, wanted->bytes, wanted->size) == 0))
            return &named[i];
    return NULL;
}

/* Takes an image that was decoded ahead, or decodes it. */
static enum zr_status read_image(struct zr_parsed_scene *root, const struct zr_parsed_bytes *bytes, uint64_t texels_max,
                                 struct zr_image *image, struct zr_reason *reason)
{
    const struct zr_image_file *ahead = zr_parsed_ahead_bytes(&root->ahead, bytes);
    if (!ahead || !ahead->is_decoded || texels_max < ahead->kept.texels_max)
        return zr_image_read_kept(root->json.arena, &root->assets.images, bytes->bytes, bytes->size, texels_max, image,
                                  reason);
    *image = ahead->kept.image;
    return ZR_OK;
}

static bool decode(struct zr_parsed_scene *root, const struct zr_json_path *path, struct named *named)
{
    struct zr_json *json = &root->json;
    struct zr_quick *quick = root->assets.quick;
    const uint64_t most = json->limits->image_pixels_max - root->image_pixels;
    const uint64_t quick_most = quick ? quick->image_pixels_max - root->image_pixels : most;
    struct zr_image image;
    struct zr_reason reason;
    enum zr_status status = read_image(root, &named->bytes, quick_most < most ? quick_most : most, &image, &reason);
    if (status == ZR_BAD_SCENE && quick_most < most) {
        quick->is_exceeded = true;
        status = ZR_CANCELLED;
    }
    if (status == ZR_BAD_SCENE) return zr_json_fault(json, path, "%s", reason.text);
    if (status == ZR_CANCELLED) zr_error_add(json->error, ZR_CANCELLED, NULL, "reading was stopped");
    if (status != ZR_OK) return false;
    root->image_pixels += (uint64_t)image.width * image.height;
    named->image = zr_scene_builder_image(root->builder, &image);
    return zr_arena_ok(json->arena);
}

static bool read_named(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_bytes_name *name,
                       struct named *named)
{
    const struct zr_json_path *at = ZR_JSON_KEY(path, named->is_asset ? ZR_BYTES_ASSET : ZR_BYTES_URI);
    if (root->images.count == NAMES_MAX)
        return zr_json_fault(&root->json, at, "more than the %d images that are allowed", NAMES_MAX);
    const struct zr_image_file *ahead = zr_parsed_ahead_name(&root->ahead, name);
    if (ahead)
        named->bytes = (struct zr_parsed_bytes){ahead->bytes, ahead->size};
    else if (!zr_parsed_read_named(&root->json, path, name, &named->bytes))
        return false;
    const struct named *same = find_bytes(&root->images, &named->bytes);
    if (!same) return decode(root, at, named);
    named->image = same->image;
    return true;
}

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

bool zr_parsed_image_is_opaque(const struct zr_parsed_scene *root, uint32_t number)
{
    struct named *names = root->images.items;
    for (size_t i = 0; i < root->images.count; i++) {
        if (names[i].image != number) continue;
        if (names[i].opacity == UNKNOWN)
            names[i].opacity = is_opaque(&root->scene->images[number]) ? OPAQUE : SEE_THROUGH;
        return names[i].opacity == OPAQUE;
    }
    return true;
}

bool zr_parsed_count_pixels(struct zr_parsed_scene *root, uint64_t pixels)
{
    struct zr_quick *quick = root->assets.quick;
    if (pixels > root->json.limits->image_pixels_max - root->image_pixels) return false;
    if (quick &&
        (quick->image_pixels_max < root->image_pixels || pixels > quick->image_pixels_max - root->image_pixels)) {
        zr_quick_exceed(quick, root->json.error);
        return false;
    }
    root->image_pixels += pixels;
    return true;
}

bool zr_parsed_add_image(struct zr_parsed_scene *root, const struct zr_json_path *path,
                         const struct zr_parsed_bytes *bytes, uint32_t *number)
{
    struct named named = {.text = "", .bytes = *bytes};
    if (zr_json_stops(&root->json)) return false;
    root->images.size = sizeof named;
    const struct named *same = find_bytes(&root->images, bytes);
    if (!same) {
        if (root->images.count == NAMES_MAX)
            return zr_json_fault(&root->json, path, "more than the %d images that are allowed", NAMES_MAX);
        struct named *kept = decode(root, path, &named) ? zr_growing_next(&root->images, &root->json) : NULL;
        if (!kept) return false;
        *kept = named;
        root->images.count++;
        same = kept;
    }
    *number = same->image;
    return true;
}

bool zr_parsed_find_image(struct zr_parsed_scene *root, const struct zr_json_path *path,
                          const struct zr_bytes_name *name, uint32_t *number)
{
    const char *text = name->asset ? name->asset : name->uri;
    struct named named = {.text = text, .length = text ? strlen(text) : 0, .is_asset = name->asset != NULL};
    if (zr_json_stops(&root->json)) return false;
    root->images.size = sizeof named;
    const struct named *same = text && !(name->uri && name->asset) ? find_name(&root->images, &named) : NULL;
    if (!same) {
        if (!read_named(root, path, name, &named)) return false;
        struct named *kept = zr_growing_next(&root->images, &root->json);
        if (!kept) return false;
        *kept = named;
        root->images.count++;
        same = kept;
    }
    *number = same->image;
    return true;
}
