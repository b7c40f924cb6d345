/* Reads textures, samplers and images of glTF. Decodes an image at its first use by a drawn material. */
#include "input/gltf/gltf_extensions.h"

#include <string.h>

#include "scene/texture.h"

/* ---- samplers ---- */

enum { MAGNIFY, MINIFY, WRAP_S, WRAP_T, NUMBERS };
#define AT(key) ((key) * sizeof(uint32_t))
static const struct zr_json_field sampler_fields[] = {
    [MAGNIFY] = {.key = "magFilter", .read = zr_json_whole, .offset = AT(MAGNIFY)},
    [MINIFY] = {.key = "minFilter", .read = zr_json_whole, .offset = AT(MINIFY)},
    [WRAP_S] = {.key = "wrapS", .read = zr_json_whole, .offset = AT(WRAP_S)},
    [WRAP_T] = {.key = "wrapT", .read = zr_json_whole, .offset = AT(WRAP_T)},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object sampler_object = ZR_JSON_OBJECT_OF("sampler", sampler_fields);

static const struct zr_parsed_sampler sampler_default = {ZR_FILTER_LINEAR, ZR_FILTER_LINEAR_MIPMAP_LINEAR,
                                                         ZR_WRAP_REPEAT, ZR_WRAP_REPEAT};

static void read_sampler(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    uint32_t given[NUMBERS] = {[MAGNIFY] = zr_filter_numbers[sampler_default.magnify],
                               [MINIFY] = zr_filter_numbers[sampler_default.minify],
                               [WRAP_S] = zr_wrap_numbers[sampler_default.wrap_s],
                               [WRAP_T] = zr_wrap_numbers[sampler_default.wrap_t]};
    zr_gltf_fields(file, json, path, &sampler_object, given);
    const int found[NUMBERS] = {[MAGNIFY] = zr_filter_of_number(given[MAGNIFY]),
                                [MINIFY] = zr_filter_of_number(given[MINIFY]),
                                [WRAP_S] = zr_wrap_of_number(given[WRAP_S]),
                                [WRAP_T] = zr_wrap_of_number(given[WRAP_T])};
    for (int key = 0; key < NUMBERS; key++)
        if (found[key] < 0 || (key == MAGNIFY && zr_filter_has_levels((enum zr_filter)found[key])))
            zr_json_fault(json, ZR_JSON_KEY(path, sampler_fields[key].key), "%u is none of the numbers that glTF has",
                          given[key]);
    file->samplers[number] = (struct zr_parsed_sampler){found[MAGNIFY], found[MINIFY], found[WRAP_S], found[WRAP_T]};
}

/* ---- images ---- */

enum { IMAGE_URI, IMAGE_VIEW };
#define AT(member) offsetof(struct zr_gltf_image, member)
static const struct zr_json_field image_fields[] = {
    [IMAGE_URI] = {.key = "uri", .read = zr_gltf_uri, .offset = AT(uri)},
    [IMAGE_VIEW] = {.key = "bufferView", .read = zr_gltf_index, .offset = AT(view)},
    {.key = "mimeType", .read = zr_gltf_ignore},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object image_object = ZR_JSON_OBJECT_OF("image", image_fields);

static void read_image(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct zr_gltf_image *image = &file->images[number];
    image->view = ZR_GLTF_NONE;
    zr_gltf_fields(file, json, path, &image_object, image);
}

static bool find_bytes(struct zr_gltf *file, const struct zr_json_path *path, struct zr_gltf_image *image)
{
    struct zr_parsed_bytes found;
    if (image->bytes.bytes) return true;
    if (!image->uri.text == (image->view == ZR_GLTF_NONE))
        return zr_json_fault(&file->json, path, "%s of uri and bufferView is needed",
                             image->uri.text ? "only one" : "one");
    if (!(image->uri.text
              ? zr_gltf_find_uri(file, ZR_JSON_KEY(path, image_fields[IMAGE_URI].key), &image->uri, &found)
              : zr_gltf_find_view(file, ZR_JSON_KEY(path, image_fields[IMAGE_VIEW].key), image->view, &found)))
        return false;
    image->bytes = found;
    return true;
}

static bool decode(struct zr_gltf *file, const struct zr_json_path *path, struct zr_gltf_image *image)
{
    const struct zr_json_path *at = ZR_JSON_KEY(path, image_fields[image->uri.text ? IMAGE_URI : IMAGE_VIEW].key);
    struct zr_reason reason;
    if (!find_bytes(file, path, image) || zr_json_stops(&file->json)) return false;
    const enum zr_status status = zr_image_list_add(&file->decoded, &image->bytes, &image->number, &reason);
    return zr_json_check_read(&file->json, at, status, &reason);
}

/* Adds the file of an image to those that are decoded ahead. */
static void list_image(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number)
{
    if (!zr_gltf_check_index(file, path, number, ZR_GLTF_IMAGES)) return;
    struct zr_gltf_image *image = &file->images[number];
    if (image->state == ZR_GLTF_UNREAD && find_bytes(file, ZR_GLTF_ITEM(ZR_GLTF_IMAGES, number), image))
        zr_image_list_expect(file->listing->images, &image->bytes);
}

static bool find_image(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, uint32_t *out)
{
    if (!zr_gltf_check_index(file, path, number, ZR_GLTF_IMAGES)) return false;
    struct zr_gltf_image *image = &file->images[number];
    if (image->state == ZR_GLTF_UNREAD && zr_gltf_is_missing(file, &image->uri)) {
        zr_gltf_note(&file->missing_images,
                     ZR_JSON_KEY(ZR_GLTF_ITEM(ZR_GLTF_IMAGES, number), image_fields[IMAGE_URI].key));
        zr_gltf_note_name(&file->missing_images, image->uri.text);
        image->state = ZR_GLTF_REFUSED;
    }
    if (image->state == ZR_GLTF_UNREAD)
        image->state = decode(file, ZR_GLTF_ITEM(ZR_GLTF_IMAGES, number), image) ? ZR_GLTF_READ : ZR_GLTF_REFUSED;
    *out = image->number;
    return image->state == ZR_GLTF_READ;
}

/* ---- textures ---- */

struct listed_texture {
    struct zr_gltf_texture texture;
    const char *extensions; /* JSON text */
};
enum { SOURCE, SAMPLER };
#define AT(member) offsetof(struct listed_texture, member)
static const struct zr_json_field texture_fields[] = {
    [SOURCE] = {.key = "source", .read = zr_gltf_index, .offset = AT(texture.source)},
    [SAMPLER] = {.key = "sampler", .read = zr_gltf_index, .offset = AT(texture.sampler)},
    {.key = "extensions", .read = zr_json_value_start, .offset = AT(extensions)},
    {.key = "extras", .read = zr_gltf_ignore},
    ZR_GLTF_NAME};
#undef AT
static const struct zr_json_object texture_object = ZR_JSON_OBJECT_OF("texture", texture_fields);

static const struct zr_json_field webp_fields[] = {{.key = "source", .read = zr_gltf_index, .offset = 0},
                                                   ZR_GLTF_COMMON};
static const struct zr_json_object webp_object = ZR_JSON_OBJECT_OF("EXT_texture_webp", webp_fields);

/* Replaces the texture's image by the image of EXT_texture_webp. */
static void read_webp(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                      struct zr_gltf_texture *texture)
{
    const char *webp = NULL;
    uint32_t source = ZR_GLTF_NONE;
    zr_gltf_find_extension(file, path, extensions, webp_object.name, &webp);
    if (!webp) return;
    zr_gltf_fields_at(file, webp, ZR_JSON_KEY(path, webp_object.name), &webp_object, &source);
    if (source == ZR_GLTF_NONE) return;
    texture->source = source;
    file->has_fallbacks = true;
}

static void read_texture(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct listed_texture given = {{ZR_GLTF_NONE, ZR_GLTF_NONE}, NULL};
    struct zr_gltf_texture *texture = &file->textures[number];
    zr_gltf_fields(file, json, path, &texture_object, &given);
    *texture = given.texture;
    if (given.extensions) read_webp(file, ZR_JSON_KEY(path, "extensions"), given.extensions, texture);
    if (texture->sampler != ZR_GLTF_NONE)
        zr_gltf_check_index(file, ZR_JSON_KEY(path, texture_fields[SAMPLER].key), texture->sampler, ZR_GLTF_SAMPLERS);
}

bool zr_gltf_read_textures(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    file->samplers = zr_arena_alloc(arena, file->counts[ZR_GLTF_SAMPLERS], sizeof *file->samplers);
    file->images = zr_arena_zero(arena, file->counts[ZR_GLTF_IMAGES], sizeof *file->images);
    file->textures = zr_arena_alloc(arena, file->counts[ZR_GLTF_TEXTURES], sizeof *file->textures);
    return zr_arena_ok(arena) && zr_gltf_read_list(file, ZR_GLTF_SAMPLERS, read_sampler) &&
           zr_gltf_read_list(file, ZR_GLTF_IMAGES, read_image) &&
           zr_gltf_read_list(file, ZR_GLTF_TEXTURES, read_texture);
}

/* ---- textures of materials ---- */

struct given_transform {
    float offset[2], scale[2];
    double rotation;
    uint32_t texcoord;
};

enum { OFFSET, ROTATION, SCALE, TEXCOORD };
#define AT(member) offsetof(struct given_transform, member)
static const struct zr_json_field transform_fields[] = {
    [OFFSET] = {.key = "offset",
                .read = zr_json_float2,
                .offset = AT(offset),
                .low = -(double)ZR_TEXCOORD_MAX,
                .high = (double)ZR_TEXCOORD_MAX},
    [ROTATION] = {.key = "rotation", .read = zr_json_number, .offset = AT(rotation), .low = -1e6, .high = 1e6},
    [SCALE] = {.key = "scale",
               .read = zr_json_float2,
               .offset = AT(scale),
               .low = -(double)ZR_TEXCOORD_MAX,
               .high = (double)ZR_TEXCOORD_MAX},
    [TEXCOORD] = {.key = "texCoord", .read = zr_json_whole, .offset = AT(texcoord)},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object transform_object = ZR_JSON_OBJECT_OF("KHR_texture_transform", transform_fields);

/* `path`, `extensions`: of the extensions of a texture of a material. */
static void read_transform(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                           struct zr_parsed_texture *out)
{
    const char *transform = NULL;
    struct given_transform given = {.scale = {1, 1}, .texcoord = out->texcoord};
    zr_gltf_find_extension(file, path, extensions, transform_object.name, &transform);
    if (!transform) return;
    zr_gltf_fields_at(file, transform, ZR_JSON_KEY(path, transform_object.name), &transform_object, &given);
    memcpy(out->offset, given.offset, sizeof out->offset);
    memcpy(out->scale, given.scale, sizeof out->scale);
    out->rotation = given.rotation;
    out->texcoord = given.texcoord;
}

struct given_texture {
    uint32_t index, texcoord;
    float scale, strength;
    const char *extensions;
};
enum { INDEX, SET, NORMAL_SCALE, STRENGTH };
#define AT(member) offsetof(struct given_texture, member)
static const struct zr_json_field info_fields[] = {
    [INDEX] = {"index", zr_gltf_index, AT(index), .required = true, .text = "number of the texture"},
    [SET] = {.key = "texCoord", .read = zr_json_whole, .offset = AT(texcoord)},
    [NORMAL_SCALE] = {.key = "scale", .read = zr_json_float, .offset = AT(scale), .low = -1000, .high = 1000},
    [STRENGTH] = {.key = "strength", .read = zr_json_float, .offset = AT(strength), .low = 0, .high = 1},
    {.key = "extensions", .read = zr_json_value_start, .offset = AT(extensions)},
    {.key = "extras", .read = zr_gltf_ignore}};
#undef AT
static const struct zr_json_object info_object = ZR_JSON_OBJECT_OF("textureInfo", info_fields);

/* Finds the image and the sampler of a texture. False after a fault, in a rehearsal, or without an image, which is
 * noted. */
static bool find(struct zr_gltf *file, enum zr_texture_slot slot, uint32_t number,
                 const struct zr_parsed_texture *given, struct zr_texture *out)
{
    const struct zr_gltf_texture *of = &file->textures[number];
    const struct zr_json_path *at = ZR_GLTF_ITEM(ZR_GLTF_TEXTURES, number);
    const struct zr_parsed_sampler *sampler =
        of->sampler < file->counts[ZR_GLTF_SAMPLERS] ? &file->samplers[of->sampler] : &sampler_default;
    *out = (struct zr_texture){.texcoord = given->texcoord,
                               .wrap_s = (enum zr_wrap)sampler->wrap_s,
                               .wrap_t = (enum zr_wrap)sampler->wrap_t,
                               .magnify = (enum zr_filter)sampler->magnify,
                               .minify = (enum zr_filter)sampler->minify,
                               .is_color = zr_slot_is_color(slot)};
    zr_parsed_put_transform(given, out);
    if (of->source == ZR_GLTF_NONE) {
        zr_gltf_note(&file->no_source, at);
        return false;
    }
    const struct zr_json_path *source = ZR_JSON_KEY(at, texture_fields[SOURCE].key);
    if (!file->listing) return find_image(file, source, of->source, &out->image);
    list_image(file, source, of->source);
    return false;
}

bool zr_gltf_add_texture(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_texture *texture,
                         struct zr_parsed_texture *out)
{
    if (file->builder->scene->texture_count >= ZR_TEXTURES_MAX)
        return zr_json_fault(&file->json, path, "more than the %d textures that are allowed", ZR_TEXTURES_MAX);
    out->number = 1 + zr_scene_builder_texture(file->builder, texture);
    return zr_arena_ok(file->json.arena);
}

/* Gives a set of texture coordinates a place, 0 or 1, of the two that a mesh has: its own if it is free. False if both
 * have other sets. */
static bool place_set(struct zr_gltf_sets *sets, uint32_t set, uint32_t *place)
{
    const uint32_t first = set == 1;
    for (uint32_t i = 0; i < 2; i++)
        if (sets->of[i] == set) return *place = i, true;
    *place = sets->of[first] == ZR_GLTF_NONE ? first : !first;
    if (sets->of[*place] != ZR_GLTF_NONE || set >= ZR_GLTF_SETS) return false;
    sets->of[*place] = set;
    return true;
}

bool zr_gltf_find_texture(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                          enum zr_texture_slot slot, struct zr_parsed_texture *out, struct zr_texture *texture)
{
    struct given_texture given = {.scale = 1, .strength = 1};
    if (!zr_gltf_fields_at(file, place, path, &info_object, &given)) return false;
    *out = (struct zr_parsed_texture){
        .is_given = true,
        .scale = {1, 1},
        .texcoord = given.texcoord,
        .strength = slot == ZR_TEXTURE_NORMAL || slot == ZR_TEXTURE_COAT_NORMAL ? given.scale : given.strength};
    if (given.extensions) read_transform(file, ZR_JSON_KEY(path, "extensions"), given.extensions, out);
    if (!place_set(&file->sets, out->texcoord, &out->texcoord)) {
        if (!file->listing) zr_gltf_note(&file->third_sets, path);
        return false;
    }
    return zr_gltf_check_index(file, ZR_JSON_KEY(path, info_fields[INDEX].key), given.index, ZR_GLTF_TEXTURES) &&
           find(file, slot, given.index, out, texture);
}

void zr_gltf_read_texture(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                          enum zr_texture_slot slot, struct zr_parsed_texture *out)
{
    struct zr_texture texture;
    if (zr_gltf_find_texture(file, place, path, slot, out, &texture)) zr_gltf_add_texture(file, path, &texture, out);
}
