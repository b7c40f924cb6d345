#include <math.h>
#include <string.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/scene/outputs.h"
#include "scene/output.h"

#define RANGE_MAX 1e30 /* scene units */
#define DPI_MAX   65535

enum { UNSET = -1, OUTPUTS_MAX = ZR_CHANNEL_COUNT * ZR_ENCODING_COUNT };

struct given_output {
    int channel, encoding, space;
    float scale, dpi, range[2];
    uint32_t x, y, quality, max_bytes;
    bool is_lossless;
    struct zr_parsed_flow to;
};

/* int: any space; check_space refuses one that the channel lacks. */
static bool read_space(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_choice_of(json, path, &zr_space_names, out);
}

/* float[2]: a nearest and a farthest depth. */
static bool read_range(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double ends[2] = {0, 0};
    const struct zr_json_row row = {2, 2, path->field->low, path->field->high};
    if (!zr_json_numbers(json, path, row, ends, NULL)) return false;
    ((float *)out)[0] = (float)ends[0];
    ((float *)out)[1] = (float)ends[1];
    return ends[0] < ends[1] ||
           zr_json_fault(json, path, "%.9g to %.9g: the nearest depth must come first", ends[0], ends[1]);
}

/* uint32_t: an integer from field->low to field->high. */
static bool read_count(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_whole(json, path, out) &&
           zr_json_check_range(json, path, path->field->low, path->field->high, *(uint32_t *)out);
}

enum { CHANNEL, ENCODING, SPACE, SCALE, RANGE, X, Y, QUALITY, LOSSLESS, MAX_BYTES, TO, DPI };
#define AT(member) offsetof(struct given_output, member)
static const struct zr_json_field fields[] = {
    [CHANNEL] = {"channel", zr_json_choice, AT(channel), .words = &zr_channel_names, .required = true,
                 .text = "quantity per pixel"},
    [ENCODING] = {"encoding", zr_json_choice, AT(encoding), .words = &zr_encoding_names,
                  .otherwise = "the first of the channel", .text = "format of the file"},
    [SPACE] = {"space", read_space, AT(space), .otherwise = "camera", .text = "space of positions and normals",
               .words = &zr_space_names},
    [SCALE] = {"scale", zr_json_positive, AT(scale), .unit = "scene units",
               .otherwise = "for depth: the far plane is 65535",
               .text = "size of a png16's step; distance and thickness need it"},
    [RANGE] = {"range", read_range, AT(range), 0, RANGE_MAX, .unit = "scene units", .otherwise = "all depths",
               .text = "least and greatest depth of an image: nearer pixels are 0, farther and uncovered ones the "
                       "greatest value",
               .schema = ZR_SCHEMA({
                   "type" : "array",
                   "prefixItems" : [
                       {"type" : "number", "minimum" : 0, "maximum" : 1e30},
                       {"type" : "number", "minimum" : 0, "maximum" : 1e30}
                   ],
                   "items" : false,
                   "minItems" : 2
               })},
    [X] = {"x", zr_json_whole, AT(x), .unit = "pixels",
           .text = "column of the pixel for the channel fragments, from 0 at the left"},
    [Y] = {"y", zr_json_whole, AT(y), .unit = "pixels", .text = "row of that pixel, from 0 at the top"},
    [QUALITY] = {"quality", read_count, AT(quality), 1, 100, .otherwise = "85",
                 .text = "quality of a jpeg or webp, from small to good; with maxBytes, the best that is tried",
                 .schema = ZR_SCHEMA({"type" : "integer"})},
    [LOSSLESS] = {"lossless", zr_json_bool, AT(is_lossless), .otherwise = "false",
                  .text = "a webp with exactly the colours of the pixels"},
    [MAX_BYTES] = {"maxBytes", read_count, AT(max_bytes), 1, UINT32_MAX, .unit = "bytes", .otherwise = "any",
                   .text = "most bytes of the file: a jpeg or webp gets the best quality that fits",
                   .schema = ZR_SCHEMA({"type" : "integer"})},
    [TO] = {"to", zr_read_flow, AT(to), .object = &zr_json_object_flow,
            .text = "the other view, or the other poses of nodes, for the channel flow"},
    [DPI] = {"dpi", zr_json_float, AT(dpi), 1, DPI_MAX, .unit = "pixels per inch", .otherwise = "none",
             .text = "pixels per inch that a png or jpeg names, for the size of prints"}};
/* clang-format off */
const struct zr_json_object zr_json_object_output = {ZR_JSON_FIELDS("output", fields),
    .schema = ZR_SCHEMA({
        "dependentRequired": {"scale": ["encoding"], "quality": ["encoding"]},
        "dependentSchemas": {
            "scale": {"properties": {"encoding": {"const": "png16"}}},
            "range": {"properties": {"channel": {"const": "depth"}}},
            "encoding": {
                "if": {"properties": {"channel": {"const": "position"}, "encoding": {"const": "png"}}},
                "then": {"not": {"properties": {"space": false}}, "properties": {"space": {"const": "nocs"}}}
            },
            "quality": {"properties": {"encoding": {"enum": ["jpeg", "webp"]}, "lossless": {"const": false}}},
            "lossless": {
                "if": {"properties": {"lossless": {"const": true}}},
                "then": {"not": {"properties": {"encoding": false}}, "properties": {"encoding": {"const": "webp"}}}
            },
            "maxBytes": {
                "if": {"properties": {"encoding": false}}, "then": {"properties": {"channel": {"const": "color"}}},
                "else": {"properties": {"encoding": {"enum": ["png", "png16", "jpeg", "webp"]}}}
            },
            "dpi": {
                "if": {"properties": {"encoding": false}}, "then": {"properties": {"channel": {"const": "color"}}},
                "else": {
                    "properties": {"encoding": {"enum": ["png", "png16", "png32", "jpeg"]}},
                    "if": {"properties": {"encoding": {"const": "jpeg"}}},
                    "then": {"properties": {"dpi": {"multipleOf": 1}}}
                }
            },
            "to": {"properties": {"channel": {"const": "flow"}}},
            "x": {"properties": {"channel": {"const": "fragments"}}},
            "y": {"properties": {"channel": {"const": "fragments"}}}
        }
    }),
    .examples = ZR_SCHEMA([
        {"channel": "color"}, {"channel": "depth", "encoding": "png16", "scale": 0.001},
        {"channel": "fragments", "x": 320, "y": 240}
    ])};
/* clang-format on */

static void check_encoding(struct zr_json *json, const struct zr_json_path *path, const struct given_output *given,
                           struct zr_output *output)
{
    output->encoding = zr_channel_rows[output->channel].encodings[0];
    if (given->encoding == UNSET) return;
    output->encoding = (enum zr_encoding)given->encoding;
    if (!zr_channel_has(output->channel, output->encoding))
        zr_json_fault(json, ZR_JSON_KEY(path, fields[ENCODING].key),
                      "the channel %s cannot be encoded as %s; allowed: %s", zr_channel_names.words[output->channel],
                      zr_encoding_names.words[given->encoding], zr_channel_encodings_join(output->channel).text);
}

/* Reports a key that other encodings have. */
static void fault_encoding(struct zr_json *json, const struct zr_json_path *path, unsigned property, const char *it)
{
    const struct zr_names_text words = zr_encodings_having(property);
    const bool are_several = strchr(words.text, ' ');
    zr_json_fault(json, path, "only the encoding%s %s %s %s", are_several ? "s" : "", words.text,
                  are_several ? "have" : "has", it);
}

/* A scale with an unknown encoding, which is reported, may be right. */
static void check_scale(struct zr_json *json, const struct zr_json_path *path, uint64_t keys,
                        const struct given_output *given, const struct zr_output *output)
{
    const bool is_unknown = zr_json_gives(keys, ENCODING) && given->encoding == UNSET;
    if (zr_json_gives(keys, SCALE) && !zr_encoding_has(output->encoding, ZR_ENCODING_HAS_SCALE) && !is_unknown)
        fault_encoding(json, ZR_JSON_KEY(path, fields[SCALE].key), ZR_ENCODING_HAS_SCALE, "one");
    if (!zr_json_gives(keys, SCALE) && zr_encoding_has(output->encoding, ZR_ENCODING_HAS_SCALE) &&
        output->channel != ZR_CHANNEL_DEPTH)
        zr_json_fault(json, path, "missing the key scale: a %s of %s has no default",
                      zr_encoding_names.words[output->encoding], zr_channel_names.words[output->channel]);
}

/* Quality, maxBytes and dpi belong to encodings that lose, save or name something. */
static void check_compression(struct zr_json *json, const struct zr_json_path *path, uint64_t keys,
                              const struct given_output *given, const struct zr_output *output)
{
    if (zr_json_gives(keys, ENCODING) && given->encoding == UNSET) return;
    if (zr_json_gives(keys, QUALITY) && !zr_encoding_has(output->encoding, ZR_ENCODING_HAS_QUALITY))
        fault_encoding(json, ZR_JSON_KEY(path, fields[QUALITY].key), ZR_ENCODING_HAS_QUALITY, "one");
    if (zr_json_gives(keys, QUALITY) && output->is_lossless)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[QUALITY].key), "a lossless %s has none",
                      zr_encoding_names.words[output->encoding]);
    if (output->is_lossless && !zr_encoding_has(output->encoding, ZR_ENCODING_HAS_LOSSLESS))
        fault_encoding(json, ZR_JSON_KEY(path, fields[LOSSLESS].key), ZR_ENCODING_HAS_LOSSLESS, "it");
    if (zr_json_gives(keys, MAX_BYTES) && !zr_encoding_has(output->encoding, ZR_ENCODING_HAS_MAX_BYTES))
        fault_encoding(json, ZR_JSON_KEY(path, fields[MAX_BYTES].key), ZR_ENCODING_HAS_MAX_BYTES, "it");
    if (zr_json_gives(keys, DPI) && !zr_encoding_has(output->encoding, ZR_ENCODING_HAS_DPI))
        fault_encoding(json, ZR_JSON_KEY(path, fields[DPI].key), ZR_ENCODING_HAS_DPI, "it");
    if (output->encoding == ZR_ENCODING_JPEG && output->dpi != floorf(output->dpi))
        zr_json_fault(json, ZR_JSON_KEY(path, fields[DPI].key),
                      "%.9g is not a whole number, which a jpeg needs; a png takes fractions", (double)output->dpi);
}

static void check_range(struct zr_json *json, const struct zr_json_path *path, uint64_t keys,
                        const struct given_output *given, struct zr_output *output)
{
    output->has_range = zr_json_gives(keys, RANGE);
    output->range[0] = given->range[0];
    output->range[1] = given->range[1];
    if (output->has_range && output->channel != ZR_CHANNEL_DEPTH)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[RANGE].key), "only the channel depth has one");
}

static void check_space(struct zr_json *json, const struct zr_json_path *path, const struct given_output *given,
                        struct zr_output *output)
{
    const int count = zr_channel_rows[output->channel].space_count;
    const struct zr_names allowed = {count, ZR_SPACE_COUNT, zr_space_names.words, NULL};
    const struct zr_json_path *at = ZR_JSON_KEY(path, fields[SPACE].key);
    if (given->space == UNSET) return;
    if (count == 0)
        zr_json_fault(json, at, "the channel %s has no space", zr_channel_names.words[output->channel]);
    else if (given->space >= count)
        zr_json_fault(json, at, "%s", zr_names_refuse(&allowed, zr_space_names.words[given->space]).text);
    else
        output->space = (enum zr_space)given->space;
}

/* Positions fit 8 bits in the space nocs only. A refused space is not reported twice. */
static void check_position(struct zr_json *json, const struct zr_json_path *path, const struct given_output *given,
                           const struct zr_output *output)
{
    const bool is_known = given->space == UNSET || given->space == (int)output->space;
    if (output->channel == ZR_CHANNEL_POSITION && output->encoding == ZR_ENCODING_PNG &&
        output->space != ZR_SPACE_NOCS && is_known)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[ENCODING].key), "a png of positions needs the space nocs");
}

/* x and y are required by the channel fragments and refused by others. */
static void check_pixel(struct zr_json *json, const struct zr_json_path *path, uint64_t keys,
                        const struct zr_output *output)
{
    static const char *const missing[] = {"s x and y", " y", " x"};
    const bool x = zr_json_gives(keys, X), y = zr_json_gives(keys, Y);
    if (output->channel != ZR_CHANNEL_FRAGMENTS && (x || y))
        zr_json_fault(json, ZR_JSON_KEY(path, fields[x ? X : Y].key), "only the channel fragments has one");
    if (output->channel == ZR_CHANNEL_FRAGMENTS && !(x && y))
        zr_json_fault(json, path, "missing the key%s: the channel fragments describes one pixel",
                      missing[x ? 1 : 2 * y]);
}

/* The channel flow needs a target, and others have none. A target with faults counts as given. */
static void check_flow(struct zr_json *json, const struct zr_json_path *path, uint64_t keys,
                       const struct zr_parsed_scene *root, const struct zr_output *output)
{
    const struct zr_json_path *to = ZR_JSON_KEY(path, fields[TO].key);
    const bool is_flow = output->channel == ZR_CHANNEL_FLOW;
    if (!is_flow && zr_json_gives(keys, TO)) zr_json_fault(json, to, "only the channel flow has one");
    if (is_flow && !zr_json_gives(keys, TO))
        zr_json_fault(json, path, "missing the key to: the view or the poses that the flow leads to");
    if (is_flow && root->is_bare) zr_json_fault(json, path, "a bare mesh has no flow; a scene in JSON has");
    if (is_flow && (root->flow.view || root->flow.poses))
        zr_json_fault(json, path, "a second flow; /outputs/%u is one, and a request has at most one",
                      root->flow.output);
}

static bool read_output(struct zr_json *json, const struct zr_json_path *path, struct zr_parsed_scene *root,
                        uint32_t number, struct zr_output *output)
{
    struct given_output given = {.channel = UNSET, .encoding = UNSET, .space = UNSET};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_output, &given, &keys) || given.channel == UNSET) return false;
    *output = (struct zr_output){.channel = (enum zr_channel)given.channel,
                                 .scale = given.scale,
                                 .x = given.x,
                                 .y = given.y,
                                 .quality = given.quality,
                                 .max_bytes = given.max_bytes,
                                 .is_lossless = given.is_lossless,
                                 .dpi = given.dpi};
    check_encoding(json, path, &given, output);
    check_scale(json, path, keys, &given, output);
    check_range(json, path, keys, &given, output);
    check_compression(json, path, keys, &given, output);
    check_space(json, path, &given, output);
    check_position(json, path, &given, output);
    check_pixel(json, path, keys, output);
    check_flow(json, path, keys, root, output);
    if (zr_json_failed_since(json, faults)) return false;
    if (output->channel == ZR_CHANNEL_FLOW) {
        root->flow = given.to;
        root->flow.output = number;
    }
    return true;
}

/* True, and reported, if an output has the file name of an earlier one, or its channel in another space. So few outputs
 * are kept, and few are compared. */
static bool clashes(struct zr_json *json, const struct zr_json_path *path, const struct zr_output *outputs,
                    size_t count, const struct zr_output *output)
{
    for (size_t i = 0; i < count; i++) {
        if (outputs[i].channel == output->channel && outputs[i].space != output->space) {
            zr_json_fault(json, path, "another space than /outputs/%zu, which is %s, too", i,
                          zr_channel_names.words[output->channel]);
            return true;
        }
        if (zr_outputs_clash(&outputs[i], output)) {
            zr_json_fault(json, path, "the same file name as /outputs/%zu: %s", i,
                          zr_channel_names.words[output->channel]);
            return true;
        }
    }
    return false;
}

bool zr_read_outputs(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    size_t count = 0, number = 0;
    if (!zr_json_list(json, path)) return false;
    struct zr_output *outputs = zr_arena_alloc(json->arena, OUTPUTS_MAX, sizeof *outputs);
    if (!outputs) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); number++) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, number);
        struct zr_output output;
        if (read_output(json, at, root, (uint32_t)number, &output) && !clashes(json, at, outputs, count, &output))
            outputs[count++] = output;
    }
    if (number == 0) return zr_json_fault(json, path, "an empty list; leave it out for a colour image");
    root->scene->views[0].outputs = outputs;
    root->scene->views[0].output_count = (uint32_t)count;
    return true;
}
