/* Poses the nodes of glTF by one animation at one time. Source: glTF 2.0, section 3.11 and appendix C. */
#include "input/gltf/gltf_file.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "scene/parts/slerp.h"
#include "input/text/number.h"
#include "render_request.h"

/* ---- the animation of the request ---- */

struct given_animation {
    const char *name, *channels, *samplers; /* channels and samplers: JSON text */
};
enum { CHANNELS, SAMPLERS };
#define AT(member) offsetof(struct given_animation, member)
static const struct zr_json_field fields[] = {
    [CHANNELS] = {.key = "channels", .read = zr_json_value_start, .offset = AT(channels)},
    [SAMPLERS] = {.key = "samplers", .read = zr_json_value_start, .offset = AT(samplers)},
    {.key = "name", .read = zr_json_string, .offset = AT(name)},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("animation", fields);

struct zr_gltf_animation {
    const char **names; /* "" for an animation without a name */
    const char **places;
    uint32_t number;
    double time;
};

static void read_name(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_animation given = {.name = ""};
    zr_json_type(json);
    file->animation->places[number] = json->at;
    zr_gltf_fields(file, json, path, &object, &given);
    file->animation->names[number] = given.name;
}

bool zr_gltf_choose_animation(struct zr_gltf *file, const struct zr_request *request)
{
    struct zr_arena *arena = file->json.arena;
    const uint32_t count = file->counts[ZR_GLTF_ANIMATIONS];
    struct zr_gltf_animation *all;
    if (!request->animation && !request->time && !request->frames) return true;
    file->animation = all = zr_arena_zero(arena, 1, sizeof *all);
    if (!all) return false;
    all->names = zr_arena_zero(arena, count, sizeof *all->names);
    all->places = zr_arena_zero(arena, count, sizeof *all->places);
    if (!zr_arena_ok(arena) || !zr_gltf_read_list(file, ZR_GLTF_ANIMATIONS, read_name)) return false;
    file->made->animation_count = count;
    file->made->animation_names = all->names;
    if (request->time) zr_number_read(request->time, request->time + strlen(request->time), &all->time);
    if (!zr_model_scene_find_animation(file->made, request->animation, &all->number)) return true;
    file->poses = zr_arena_zero(arena, file->counts[ZR_GLTF_NODES], sizeof *file->poses);
    return zr_arena_ok(arena);
}

/* ---- samplers ---- */

enum { LINEAR, STEP, CUBICSPLINE };
static const char *const curve_words[] = {"LINEAR", "STEP", "CUBICSPLINE"};
static const struct zr_names curves = ZR_NAMES(3, curve_words);

struct sampler {
    uint32_t input, output;
    int curve;
};
enum { INPUT, OUTPUT };
#define AT(member) offsetof(struct sampler, member)
static const struct zr_json_field sampler_fields[] = {
    [INPUT] = {"input", zr_gltf_index, AT(input), .required = true, .text = "accessor of the times"},
    [OUTPUT] = {"output", zr_gltf_index, AT(output), .required = true, .text = "accessor of the values"},
    {.key = "interpolation", .read = zr_json_choice, .offset = AT(curve), .words = &curves},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object sampler_object = ZR_JSON_OBJECT_OF("sampler", sampler_fields);

/* Position of the time among the keys of an accessor. `share` is the fraction of the way from `key` to the next key,
 * which is `span` seconds later. A `span` of 0 means that the time is not between two keys. */
struct moment {
    bool is_found, is_refused;
    uint32_t count, key;
    double share, span;
};

/* State of reading one animation. */
struct reading {
    struct zr_gltf *file;
    uint32_t sampler_count;
    struct sampler *samplers;
    struct moment *moments; /* one per accessor */
};

/* Times between checks for cancellation. */
enum { AT_ONCE = 1024 };

static bool find_key(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_values *times,
                     struct moment *out)
{
    const double time = file->animation->time;
    double before = -DBL_MAX, start = 0, end = 0;
    bool has_start = false, has_end = false;
    float run[AT_ONCE];
    out->count = times->count;
    for (uint32_t first = 0; first < times->count; first += AT_ONCE) {
        const uint32_t count = times->count - first < AT_ONCE ? times->count - first : AT_ONCE;
        if (!zr_gltf_read_floats(file, times, &(struct zr_gltf_range){first, count}, run, 1)) return false;
        for (uint32_t i = 0; i < count; i++) {
            const double at = (double)run[i];
            if (at < before)
                return zr_json_fault(&file->json, path, "key %u is at %.9g seconds, before the key at %.9g", first + i,
                                     at, before);
            if (at <= time) {
                out->key = first + i;
                start = at;
                has_start = true;
            } else if (!has_end) {
                end = at;
                has_end = true;
            }
            before = at;
        }
    }
    if (before > file->made->animation_end) file->made->animation_end = before;
    if (has_start && has_end) {
        out->span = end - start;
        out->share = (time - start) / out->span;
    }
    return true;
}

/* Finds the time among the keys of the accessor `number`, once. NULL after a fault. */
static const struct moment *find_moment(const struct reading *r, const struct zr_json_path *path, uint32_t number)
{
    struct zr_gltf *file = r->file;
    struct zr_gltf_values times;
    if (!zr_gltf_open(file, path, number, &times)) return NULL;
    struct moment *out = &r->moments[number];
    if (out->is_refused) return NULL;
    if (out->is_found) return out;
    out->is_refused = true;
    if (times.width != 1 || times.accessor->type != ZR_GLTF_FLOAT32 || times.count == 0) {
        zr_json_fault(&file->json, path, "accessor %u has no times: floats of the type SCALAR, at least one", number);
        return NULL;
    }
    if (!find_key(file, path, &times, out)) return NULL;
    out->is_refused = false;
    out->is_found = true;
    return out;
}

/* ---- values ---- */

enum { TRANSLATION, ROTATION, SCALE, WEIGHTS, POINTER };
static const char *const path_words[] = {"translation", "rotation", "scale", "weights", "pointer"};
static const struct zr_names paths = ZR_NAMES(5, path_words);

/* Each key has an in-tangent, a value and an out-tangent of `n` numbers each. */
static void put_cubic(const float *from, const float *to, size_t n, const struct moment *at, float *out)
{
    const double u = at->share, u2 = u * u, u3 = u2 * u;
    for (size_t k = 0; k < n; k++)
        out[k] = (float)((2 * u3 - 3 * u2 + 1) * (double)from[n + k] +
                         at->span * (u3 - 2 * u2 + u) * (double)from[2 * n + k] +
                         (3 * u2 - 2 * u3) * (double)to[n + k] + at->span * (u3 - u2) * (double)to[k]);
}

static void put_linear(const float *from, const float *to, size_t n, const struct moment *at, float *out)
{
    for (size_t k = 0; k < n; k++)
        out[k] = (float)((1 - at->share) * (double)from[k] + at->share * (double)to[k]);
}

/* Returns the value of a sampler for a target, *width numbers. NULL after a fault. */
static float *find_value(const struct reading *r, const struct zr_json_path *path, const struct sampler *sampler,
                         int target, uint32_t *width)
{
    static const int shapes[] = {ZR_GLTF_VEC3, ZR_GLTF_VEC4, ZR_GLTF_VEC3, ZR_GLTF_SCALAR};
    struct zr_gltf *file = r->file;
    struct zr_json *json = &file->json;
    const struct zr_json_path *output = ZR_JSON_KEY(path, sampler_fields[OUTPUT].key);
    const struct moment *at = find_moment(r, ZR_JSON_KEY(path, sampler_fields[INPUT].key), sampler->input);
    struct zr_gltf_values values;
    if (!at || !zr_gltf_open(file, output, sampler->output, &values)) return NULL;
    const uint32_t keys = at->count, parts = sampler->curve == CUBICSPLINE ? 3 : 1,
                   each = values.count / keys; /* elements per key */
    if (values.accessor->shape != shapes[target] || each == 0 || values.count % keys != 0 || each % parts != 0 ||
        (target != WEIGHTS && each != parts)) {
        zr_json_fault(json, output, "accessor %u does not fit %u keys: it has %u elements of %u numbers",
                      sampler->output, keys, values.count, values.width);
        return NULL;
    }
    values.is_normalized = true; /* glTF requires this for integers */
    const size_t n = (size_t)each / parts * values.width, count = (size_t)each * values.width;
    float *from = zr_gltf_allocate(file, 2 * count, sizeof *from), *out = zr_arena_alloc(json->arena, n, sizeof *out);
    if (!from || !out) return NULL;
    float *const to = from + count;
    const struct zr_gltf_range here = {at->key * each, each}, next = {(at->key + 1) * each, each};
    if (!zr_gltf_read_floats(file, &values, &here, from, values.width) ||
        (at->span > 0 && !zr_gltf_read_floats(file, &values, &next, to, values.width)))
        return NULL;
    *width = (uint32_t)n;
    if (!(at->span > 0) || sampler->curve == STEP)
        memcpy(out, sampler->curve == CUBICSPLINE ? from + n : from, n * sizeof *out);
    else if (sampler->curve == CUBICSPLINE)
        put_cubic(from, to, n, at, out);
    else if (target == ROTATION)
        zr_slerp(from, to, at->share, out);
    else
        put_linear(from, to, n, at, out);
    for (size_t k = 0; k < n; k++)
        if (!isfinite(out[k])) {
            zr_json_fault(json, output, "the value at this time is not finite");
            return NULL;
        }
    return out;
}

/* ---- channels ---- */

struct target {
    uint32_t node;
    int path;
};
enum { NODE, PATH };
#define AT(member) offsetof(struct target, member)
static const struct zr_json_field target_fields[] = {
    [NODE] = {.key = "node", .read = zr_gltf_index, .offset = AT(node)},
    [PATH] = {.key = "path", .read = zr_json_choice, .offset = AT(path), .words = &paths},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object target_object = ZR_JSON_OBJECT_OF("target", target_fields);

struct channel {
    uint32_t sampler;
    const char *target; /* JSON text */
};
#define AT(member) offsetof(struct channel, member)
static const struct zr_json_field channel_fields[] = {
    {"sampler", zr_gltf_index, AT(sampler), .required = true, .text = "number of the sampler"},
    {"target", zr_json_value_start, AT(target), .required = true, .text = "node and property"},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object channel_object = ZR_JSON_OBJECT_OF("channel", channel_fields);

/* Moves a node by a sampler. False after a fault. */
static bool move(const struct reading *r, const struct zr_json_path *path, const struct target *target,
                 const struct sampler *sampler)
{
    struct zr_gltf_pose *pose = &r->file->poses[target->node];
    uint32_t width;
    const float *v = find_value(r, path, sampler, target->path, &width);
    if (!v) return false;
    switch (target->path) {
    case WEIGHTS:
        pose->weights = v;
        pose->weight_count = width;
        return true;
    case ROTATION:
        pose->rotation = (zr_vec4){v[0], v[1], v[2], v[3]};
        break;
    default:
        *(target->path == SCALE ? &pose->scale : &pose->translation) = (zr_vec3){v[0], v[1], v[2]};
    }
    pose->is_moved = true;
    return true;
}

static bool read_channel(const struct reading *r, struct zr_json *json, const struct zr_json_path *animation,
                         const struct zr_json_path *path)
{
    struct zr_gltf *file = r->file;
    struct channel channel = {0, NULL};
    struct target target = {ZR_GLTF_NONE, -1};
    const size_t faults = json->error->count;
    zr_gltf_fields(file, json, path, &channel_object, &channel);
    if (!channel.target) return false;
    const struct zr_json_path *at = ZR_JSON_KEY(path, "target");
    zr_gltf_fields_at(file, channel.target, at, &target_object, &target);
    if (json->error->count > faults) return false;
    if (channel.sampler >= r->sampler_count)
        return zr_json_bad_index(json, ZR_JSON_KEY(path, "sampler"), (double)channel.sampler, r->sampler_count,
                                 "samplers");
    if (target.path == POINTER) {
        zr_gltf_note(&file->unread_channels, path);
        return true;
    }
    if (target.node == ZR_GLTF_NONE || target.path < 0) return true; /* glTF: such channels are ignored */
    if (!zr_gltf_check_index(file, ZR_JSON_KEY(at, target_fields[NODE].key), target.node, ZR_GLTF_NODES)) return false;
    if (file->poses[target.node].has_matrix && target.path != WEIGHTS)
        return zr_json_fault(json, at, "node %u has a matrix; translation, rotation and scale can move", target.node);
    return move(r, ZR_JSON_ITEM(ZR_JSON_KEY(animation, fields[SAMPLERS].key), channel.sampler), &target,
                &r->samplers[channel.sampler]);
}

static bool read_samplers(struct reading *r, const struct zr_json_path *path, const char *place)
{
    struct zr_json there = zr_json_at(&r->file->json, place);
    size_t count = 0;
    if (!zr_json_count(&there, path, &count)) return false;
    r->samplers = zr_arena_zero(there.arena, count, sizeof *r->samplers);
    r->moments = zr_arena_zero(there.arena, r->file->counts[ZR_GLTF_ACCESSORS], sizeof *r->moments);
    if (!r->samplers || !r->moments) return false;
    zr_json_enter(&there, '[');
    for (; zr_json_any_item(&there); r->sampler_count++)
        zr_gltf_fields(r->file, &there, ZR_JSON_ITEM(path, r->sampler_count), &sampler_object,
                       &r->samplers[r->sampler_count]);
    return there.error->count == 0;
}

bool zr_gltf_animate(struct zr_gltf *file)
{
    const uint32_t number = file->animation->number;
    const struct zr_json_path *path = ZR_GLTF_ITEM(ZR_GLTF_ANIMATIONS, number),
                              *channels = ZR_JSON_KEY(path, fields[CHANNELS].key);
    struct given_animation given = {.name = ""};
    const struct zr_gltf_note before = file->unknown; /* read_name has counted the unknown keys */
    struct reading r = {.file = file};
    zr_gltf_fields_at(file, file->animation->places[number], path, &object, &given);
    file->unknown = before;
    if (!given.channels || !given.samplers) return true; /* moves no node */
    if (!read_samplers(&r, ZR_JSON_KEY(path, fields[SAMPLERS].key), given.samplers)) return false;
    struct zr_json there = zr_json_at(&file->json, given.channels);
    if (!zr_json_list(&there, channels)) return false;
    zr_json_enter(&there, '[');
    for (size_t i = 0; zr_json_any_item(&there); i++)
        if (zr_is_cancelled(there.cancel) || !read_channel(&r, &there, path, ZR_JSON_ITEM(channels, i))) return false;
    return there.error->count == 0;
}
