#include <float.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

/* ---- samplers ---- */

/* Words, and glTF's number for each. */
struct numbered {
    struct zr_names names;
    const uint32_t *numbers;
};

static const char *const filter_words[] = {
    "nearest", "linear", "nearestMipmapNearest", "linearMipmapNearest", "nearestMipmapLinear", "linearMipmapLinear"};
static const char *const wrap_words[] = {"repeat", "mirror", "clamp"};
static const struct numbered magnify = {{2, ZR_FILTER_COUNT, filter_words, "for minFilter; only minFilter has mipmaps"},
                                        zr_filter_numbers};
static const struct numbered minify = {ZR_NAMES(ZR_FILTER_COUNT, filter_words), zr_filter_numbers};
static const struct numbered wraps = {ZR_NAMES(ZR_WRAP_COUNT, wrap_words), zr_wrap_numbers};

/* int: the index of the word. field->words is the first member of a struct numbered. */
static bool read_numbered(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const struct numbered *of = (const struct numbered *)(const void *)path->field->words;
    uint32_t number;
    if (zr_json_type(json) != ZR_JSON_NUMBER) return zr_json_choice(json, path, out);
    if (!zr_json_whole(json, path, &number)) return false;
    for (int i = 0; i < of->names.count; i++)
        if (of->numbers[i] == number) {
            *(int *)out = i;
            return true;
        }
    for (int i = of->names.count; i < of->names.all; i++)
        if (of->numbers[i] == number)
            return zr_json_fault(json, path, "%u, %s", number, zr_names_refuse(&of->names, of->names.words[i]).text);
    return zr_json_fault(json, path, "%u is none of the numbers that glTF has for %s", number,
                         zr_names_join(&of->names).text);
}

#define WRAP            ZR_SCHEMA({"enum" : [ "repeat", "mirror", "clamp", 10497, 33648, 33071 ]})
#define SAMPLER(member) offsetof(struct zr_parsed_sampler, member)
static const struct zr_json_field sampler_fields[] = {
    {"magFilter", read_numbered, SAMPLER(magnify), .words = &magnify.names, .otherwise = "linear",
     .text = "filter for texels larger than a pixel",
     .schema = ZR_SCHEMA({"enum" : [ "nearest", "linear", 9728, 9729 ]})},
    {"minFilter", read_numbered, SAMPLER(minify), .words = &minify.names, .otherwise = "linearMipmapLinear",
     .text = "filter for texels smaller than a pixel",
     .schema = ZR_SCHEMA({
         "enum" : [
             "nearest", "linear", "nearestMipmapNearest", "linearMipmapNearest", "nearestMipmapLinear",
             "linearMipmapLinear", 9728, 9729, 9984, 9985, 9986, 9987
         ]
     })},
    {"wrapS", read_numbered, SAMPLER(wrap_s), .words = &wraps.names, .otherwise = "repeat",
     .text = "repetition of the image along u", .schema = WRAP},
    {"wrapT", read_numbered, SAMPLER(wrap_t), .words = &wraps.names, .otherwise = "repeat",
     .text = "repetition of the image along v", .schema = WRAP}};
const struct zr_json_object zr_json_object_sampler = ZR_JSON_OBJECT_OF("sampler", sampler_fields);

static bool read_sampler(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint64_t keys;
    return zr_json_fields(json, path, &zr_json_object_sampler, out, &keys);
}

/* ---- textures ---- */

#define NUMBER_MAX (double)ZR_TEXCOORD_MAX

/* uint32_t: 0 or 1 */
static bool read_texcoord(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double number;
    if (!zr_json_number_in(json, path, -DBL_MAX, DBL_MAX, &number)) return false;
    *(uint32_t *)out = number == 1.0;
    return number == 0.0 || number == 1.0 ||
           zr_json_fault(json, path, "%.9g; 0 and 1 are allowed, for the mesh's texcoords and texcoords1", number);
}

#define TEXTURE(member) offsetof(struct zr_parsed_texture, member)
#define TEXTURE_FIELDS                                                                                                 \
    ZR_BYTES_NAME_FIELDS(struct zr_parsed_texture, name),                                                              \
        {"texcoord",                                                                                                   \
         read_texcoord,                                                                                                \
         TEXTURE(texcoord),                                                                                            \
         .otherwise = "0",                                                                                             \
         .text = "texture coordinates of the mesh: 0 (texcoords) or 1",                                                \
         .schema = "{\"enum\": [0, 1]}"},                                                                              \
        {"sampler",                                                                                                    \
         read_sampler,                                                                                                 \
         TEXTURE(sampler),                                                                                             \
         .otherwise = "linear, with mipmaps, repeated",                                                                \
         .text = "filters and repetition of the image",                                                                \
         .schema = ZR_SCHEMA_OF("sampler")},                                                                           \
        {"offset",                                                                                                     \
         zr_json_float2,                                                                                               \
         TEXTURE(offset),                                                                                              \
         -NUMBER_MAX,                                                                                                  \
         NUMBER_MAX,                                                                                                   \
         .otherwise = "[0, 0]",                                                                                        \
         .text = "offset added to the coordinates"},                                                                   \
        {"rotation",                                                                                                   \
         zr_json_number,                                                                                               \
         TEXTURE(rotation),                                                                                            \
         -1e6,                                                                                                         \
         1e6,                                                                                                          \
         .unit = "radians",                                                                                            \
         .otherwise = "0",                                                                                             \
         .text = "rotation of the coordinates around [0, 0]; the image turns clockwise"},                              \
    {                                                                                                                  \
        "scale", zr_json_float2, TEXTURE(scale), -NUMBER_MAX, NUMBER_MAX,                                              \
            .otherwise = "[1, 1]", .text = "factor of the coordinates: 2 shows the image twice"                        \
    }
static const struct zr_json_field fields[] = {TEXTURE_FIELDS};
static const struct zr_json_rule rules[] = {ZR_BYTES_NAME_RULES(0)};
const struct zr_json_object zr_json_object_texture = {ZR_JSON_FIELDS("texture", fields), ZR_JSON_RULES(rules)};

static const struct zr_json_field normal_fields[] = {TEXTURE_FIELDS,
                                                     {"normalScale", zr_json_float, TEXTURE(strength), -1000, 1000,
                                                      .otherwise = "1",
                                                      .text = "factor of the x and y of the normals"}};
const struct zr_json_object zr_json_object_normalTexture = {ZR_JSON_FIELDS("normalTexture", normal_fields),
                                                            ZR_JSON_RULES(rules)};

static const struct zr_json_field occlusion_fields[] = {
    TEXTURE_FIELDS,
    {"strength", zr_json_float, TEXTURE(strength), 0, 1, .otherwise = "1", .text = "strength of the effect"}};
const struct zr_json_object zr_json_object_occlusionTexture = {ZR_JSON_FIELDS("occlusionTexture", occlusion_fields),
                                                               ZR_JSON_RULES(rules)};

static bool read_by(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                    struct zr_parsed_texture *out)
{
    uint64_t keys;
    const size_t faults = json->error->count;
    *out = (struct zr_parsed_texture){
        .scale = {1, 1}, .strength = 1, .sampler = {1, ZR_FILTER_LINEAR_MIPMAP_LINEAR, 0, 0}};
    out->is_given = zr_json_fields(json, path, object, out, &keys) && !zr_json_failed_since(json, faults);
    return out->is_given;
}

bool zr_read_texture(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_by(json, path, &zr_json_object_texture, out);
}

bool zr_read_normal_texture(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_by(json, path, &zr_json_object_normalTexture, out);
}

bool zr_read_occlusion_texture(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_by(json, path, &zr_json_object_occlusionTexture, out);
}

/* ---- in the scene ---- */

static bool find_texture(struct zr_parsed_scene *root, const struct zr_json_path *path, enum zr_texture_slot slot,
                         struct zr_parsed_texture *given)
{
    struct zr_texture texture = {.texcoord = given->texcoord,
                                 .wrap_s = (enum zr_wrap)given->sampler.wrap_s,
                                 .wrap_t = (enum zr_wrap)given->sampler.wrap_t,
                                 .magnify = (enum zr_filter)given->sampler.magnify,
                                 .minify = (enum zr_filter)given->sampler.minify,
                                 .is_color = zr_slot_is_color(slot)};
    if (!zr_parsed_find_image(root, path, &given->name, &texture.image)) return false;
    if (root->scene->texture_count >= ZR_TEXTURES_MAX)
        return zr_json_fault(&root->json, path, "more than the %d textures that are allowed", ZR_TEXTURES_MAX);
    zr_parsed_put_transform(given, &texture);
    given->number = 1 + zr_scene_builder_texture(root->builder, &texture);
    return true;
}

void zr_parsed_find_textures(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    zr_parsed_read_ahead(root);
    for (size_t i = 0; i < root->material_count && !zr_json_stops(&root->json); i++) {
        struct zr_parsed_material *material = &root->materials[i];
        for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
            if (material->textures[slot].is_given)
                find_texture(root, ZR_JSON_KEY(ZR_JSON_ITEM(path, material->number), zr_texture_keys[slot]),
                             (enum zr_texture_slot)slot, &material->textures[slot]);
    }
}

bool zr_parsed_has_textures(const struct zr_parsed_scene *root, size_t material)
{
    for (int slot = 0; material < root->material_count && slot < ZR_TEXTURE_SLOTS; slot++)
        if (root->materials[material].textures[slot].is_given) return true;
    return false;
}

bool zr_parsed_check_texcoords(struct zr_parsed_scene *root, const struct zr_json_path *path, size_t material,
                               bool has_texcoords, bool has_texcoords1)
{
    if (material >= root->material_count) return true;
    const struct zr_parsed_material *given = &root->materials[material];
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++) {
        const struct zr_parsed_texture *texture = &given->textures[slot];
        if (!texture->is_given || (texture->texcoord == 0 ? has_texcoords : has_texcoords1)) continue;
        return zr_json_fault(&root->json, path, "%s of its material needs %s, which are missing", zr_texture_keys[slot],
                             texture->texcoord == 0 ? "texcoords" : "texcoords1");
    }
    return true;
}
