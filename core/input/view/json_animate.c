/* Reads the key animate: nodes that turn, or move through keys. */
#include <stdlib.h>
#include <string.h>

#include "input/json/json_list.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/text/recenter.h"
#include "input/text/text.h"
#include "scene/camera/view_set.h"
#include "scene/parts/animation.h"

#define SECONDS_MAX 3600
#define DEGREES_MAX 1e6

/* ---- a track ---- */

struct given_track {
    struct zr_track track;
    struct zr_growing times, translations, rotations, scales;
    int interpolation;
};

/* Reads rows of `width` numbers into a list of doubles. */
static bool read_rows(struct zr_json *json, const struct zr_json_path *path, size_t width, double limit,
                      struct zr_growing *list)
{
    const struct zr_json_row bounds = {width, width, -limit, limit};
    size_t number = 0;
    bool is_good = true;
    *list = (struct zr_growing){.size = width * sizeof(double)};
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); number++) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, number);
        double *row = zr_growing_next(list, json);
        if (!row) return false;
        if (!zr_json_numbers(json, at, bounds, row, NULL)) {
            is_good = false;
            continue;
        }
        if (width == 4 && (float)row[0] == 0.0f && (float)row[1] == 0.0f && (float)row[2] == 0.0f &&
            (float)row[3] == 0.0f)
            is_good = zr_json_fault(json, at, "the quaternion has the length 0; 0 0 0 1 is no rotation");
        list->count++;
    }
    return is_good;
}

/* struct zr_growing of three or four doubles per key. */
static bool read_places(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_rows(json, path, 3, zr_recenter_limit(json->limits), out);
}

static bool read_vectors(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_rows(json, path, 3, (double)json->limits->coordinate_max, out);
}

static bool read_quaternions(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_rows(json, path, 4, (double)json->limits->coordinate_max, out);
}

/* struct zr_growing of doubles, ascending. */
static bool read_times(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_growing *list = out;
    double before = -1.0;
    size_t number = 0;
    bool is_good = true;
    *list = (struct zr_growing){.size = sizeof before};
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_any_item(json); number++) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, number);
        double *time = zr_growing_next(list, json);
        if (!time) return false;
        if (!zr_json_number_in(json, at, 0, SECONDS_MAX, time)) {
            is_good = false;
            continue;
        }
        if (!(*time > before))
            is_good = zr_json_fault(json, at, "%.9g seconds, after %.9g; times ascend", *time, before);
        before = *time;
        list->count++;
    }
    if (number == 0) return zr_json_fault(json, path, "no times; at least one is needed");
    return is_good;
}

/* zr_vec3: x, y, z or a vector. */
static bool read_axis(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const char *const words[] = {"x", "y", "z"};
    static const struct zr_names names = ZR_NAMES(3, words);
    static const zr_vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    zr_vec3 *axis = out;
    int number;
    if (zr_json_type(json) == ZR_JSON_STRING) {
        if (!zr_json_choice_of(json, path, &names, &number)) return false;
        *axis = axes[number];
        return true;
    }
    if (!zr_json_vec3(json, path, axis)) return false;
    return axis->x != 0.0f || axis->y != 0.0f || axis->z != 0.0f ||
           zr_json_fault(json, path, "the axis has the length 0; x, y, z or a vector such as [0, 1, 0]");
}

#define AT(member) offsetof(struct zr_track, member)
static const struct zr_json_field rotate_fields[] = {
    {"axis", read_axis, AT(axis), .required = true, .text = "x, y, z or a vector, in the node's own axes",
     .schema = ZR_SCHEMA({"anyOf" : [ {"enum" : [ "x", "y", "z" ]}, {"$ref" : "#/$defs/direction"} ]})},
    {"degrees", zr_json_number, AT(degrees), -DEGREES_MAX, DEGREES_MAX, .unit = "degrees", .otherwise = "360",
     .text = "angle of all frames together, counter-clockwise seen against the axis"}};
#undef AT
const struct zr_json_object zr_json_object_rotate = ZR_JSON_OBJECT_OF("rotate", rotate_fields);

static bool read_rotate(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_track *track = out;
    uint64_t keys;
    track->degrees = 360.0;
    return zr_json_fields(json, path, &zr_json_object_rotate, track, &keys);
}

static const char *const interpolation_words[] = {"linear", "step"};
static const struct zr_names interpolation_names = ZR_NAMES(2, interpolation_words);

enum { ROTATE, TIMES, TRANSLATION, ROTATION, SCALE, INTERPOLATION };
#define AT(member) offsetof(struct given_track, member)
static const struct zr_json_field track_fields[] = {
    [ROTATE] = {"rotate", read_rotate, AT(track), .object = &zr_json_object_rotate,
                .text = "turn about an axis through the node's origin: its matrix times the turn"},
    [TIMES] = {"times", read_times, AT(times), .unit = "seconds", .text = "times of the keys, ascending",
               .schema = ZR_SCHEMA(
                   {"type" : "array", "items" : {"type" : "number", "minimum" : 0, "maximum" : 3600}, "minItems" : 1})},
    [TRANSLATION] = {"translation", read_places, AT(translations), .unit = "scene units", .otherwise = "the node's own",
                     .text = "one vector per key",
                     .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/place"}})},
    [ROTATION] = {"rotation", read_quaternions, AT(rotations), .otherwise = "the node's own",
                  .text = "one quaternion x, y, z, w per key",
                  .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/quaternion"}})},
    [SCALE] = {"scale", read_vectors, AT(scales), .otherwise = "the node's own", .text = "one vector per key",
               .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/vec3"}})},
    [INTERPOLATION] = {"interpolation", zr_json_choice, AT(interpolation), .words = &interpolation_names,
                       .otherwise = "linear", .text = "poses between keys: linear, or step, which holds a key"}};
#undef AT
#define POSES (ZR_KEY(TRANSLATION) | ZR_KEY(ROTATION) | ZR_KEY(SCALE))
static const struct zr_json_rule track_rules[] = {
    {ZR_RULE_NEEDS, .text = "keys without times", .sets = {POSES, ZR_KEY(TIMES)}},
    {ZR_RULE_NEEDS, .text = "times without keys: translation, rotation or scale", .sets = {ZR_KEY(TIMES), POSES}},
    {ZR_RULE_SOME, .text = "no motion: give rotate, or times with translation, rotation or scale",
     .sets = {POSES | ZR_KEY(TIMES) | ZR_KEY(ROTATE)}}};
#undef POSES
const struct zr_json_object zr_json_object_track = {ZR_JSON_FIELDS("track", track_fields), ZR_JSON_RULES(track_rules)};

/* Takes a list of keys. False if their number is not that of the times. */
static bool take_keys(struct zr_json *json, const struct zr_json_path *path, const struct zr_growing *list,
                      size_t times, const double **out)
{
    *out = list->items;
    return list->count == times ||
           zr_json_fault(json, path, "%zu keys, but %zu times; each time has one key", list->count, times);
}

static bool read_track(struct zr_json *json, const struct zr_json_path *path, struct zr_track *track)
{
    struct given_track given = {.track = *track};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_track, &given, &keys) || json->error->count > faults) return false;
    const size_t times = given.times.count;
    given.track.key_count = (uint32_t)times;
    given.track.times = given.times.items;
    given.track.has_steps = given.interpolation == 1;
    *track = given.track;
    return (!zr_json_gives(keys, TRANSLATION) ||
            take_keys(json, ZR_JSON_KEY(path, "translation"), &given.translations, times, &track->translations)) &&
           (!zr_json_gives(keys, ROTATION) ||
            take_keys(json, ZR_JSON_KEY(path, "rotation"), &given.rotations, times, &track->rotations)) &&
           (!zr_json_gives(keys, SCALE) ||
            take_keys(json, ZR_JSON_KEY(path, "scale"), &given.scales, times, &track->scales));
}

/* ---- the animation ---- */

struct given_animate {
    struct zr_animation animation;
    uint32_t frames;
    double seconds;
};

static int compare_tracks(const void *left, const void *right)
{
    return strcmp(((const struct zr_track *)left)->node, ((const struct zr_track *)right)->node);
}

/* struct zr_animation. */
static bool read_tracks(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_animation *animation = out;
    struct zr_growing tracks = {.size = sizeof(struct zr_track)};
    struct zr_json_text key;
    bool is_good = true;
    if (zr_json_type(json) != ZR_JSON_OBJECT) return zr_json_expect(json, path, "an object: names of nodes");
    for (zr_json_enter(json, '{'); zr_json_member(json, &key);) {
        struct zr_track track = {.node = zr_json_decode(json, &key)};
        if (!track.node) return false;
        if (!read_track(json, ZR_JSON_KEY(path, track.node), &track)) {
            is_good = false;
            continue;
        }
        struct zr_track *next = zr_growing_next(&tracks, json);
        if (!next) return false;
        *next = track;
        tracks.count++;
    }
    if (is_good && tracks.count == 0) return zr_json_fault(json, path, "no node is animated");
    struct zr_track *items = tracks.items;
    if (tracks.count > 1) qsort(items, tracks.count, sizeof *items, compare_tracks);
    for (size_t i = 1; i < tracks.count; i++)
        if (strcmp(items[i - 1].node, items[i].node) == 0)
            is_good = zr_json_fault(json, ZR_JSON_KEY(path, items[i].node), "given twice");
    *animation = (struct zr_animation){(uint32_t)tracks.count, items};
    return is_good;
}

enum { NODES, FRAMES, SECONDS };
#define AT(member) offsetof(struct given_animate, member)
static const struct zr_json_field fields[] = {
    [NODES] = {"nodes", read_tracks, AT(animation), .required = true, .object = &zr_json_object_track,
               .text = "motions by the names of nodes",
               .schema = ZR_SCHEMA(
                   {"type" : "object", "additionalProperties" : {"$ref" : "#/$defs/track"}, "minProperties" : 1})},
    [FRAMES] = {"frames", zr_json_whole, AT(frames), 1, 4096, .otherwise = "36", .text = "number of views"},
    [SECONDS] = {"seconds", zr_json_number, AT(seconds), 0.02, SECONDS_MAX, .unit = "seconds",
                 .otherwise = "the last of all times, or 4", .text = "time from the first frame to its return"}};
#undef AT
const struct zr_json_object zr_json_object_animate = ZR_JSON_OBJECT_OF("animate", fields);

static double find_seconds(const struct zr_animation *animation)
{
    double last = 0.0;
    for (uint32_t i = 0; i < animation->count; i++) {
        const struct zr_track *track = &animation->tracks[i];
        if (track->key_count > 0 && track->times[track->key_count - 1] > last)
            last = track->times[track->key_count - 1];
    }
    return last >= 0.02 ? last : 4.0;
}

bool zr_read_animate(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct given_animate given = {.frames = 36};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_animate, &given, &keys) || json->error->count > faults ||
        !zr_json_gives(keys, NODES))
        return false;
    if (!zr_json_gives(keys, SECONDS)) given.seconds = find_seconds(&given.animation);
    struct zr_animation *animation = zr_arena_copy(json->arena, &given.animation, sizeof *animation);
    struct zr_view_set *set = NULL;
    if (!animation || !zr_view_count_check(json, ZR_JSON_KEY(path, fields[FRAMES].key), given.frames) ||
        !(set = zr_view_set_add(json, path, root->scene)))
        return false;
    *set = (struct zr_view_set){
        .kind = ZR_VIEW_SET_ANIMATE, .count = given.frames, .seconds = given.seconds, .animation = animation};
    return true;
}
