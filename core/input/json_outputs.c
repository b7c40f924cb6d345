#include "input/json_scene.h"
#include "input/outputs.h"

enum { CHANNEL, ENCODING, SCALE, SPACE, KEYS };
static const char *const words[] = {"channel", "encoding", "scale", "space"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static bool read_encoding(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                          struct zr_output *output)
{
    int encoding;
    output->encoding = zr_channel_rows[output->channel].encodings[0];
    if (!node) return true;
    if (!zr_json_choice(json, path, node, &zr_encoding_names, &encoding)) return false;
    output->encoding = (enum zr_encoding)encoding;
    return zr_channel_has(output->channel, output->encoding) ||
           zr_json_fault(json, path, "the channel %s cannot be had as %s; allowed: %s",
                         zr_channel_names.words[output->channel], zr_encoding_names.words[encoding],
                         zr_channel_encodings_join(output->channel).text);
}

static bool read_space(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                       struct zr_output *output)
{
    const int count = zr_channel_rows[output->channel].space_count;
    const struct zr_names allowed = {count, ZR_SPACE_COUNT, zr_space_names.words};
    int space;
    if (!node) return true;
    if (count == 0)
        return zr_json_fault(json, path, "the channel %s lies in no space", zr_channel_names.words[output->channel]);
    if (!zr_json_choice(json, path, node, &allowed, &space)) return false;
    output->space = (enum zr_space)space;
    return true;
}

static bool read_output(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                        struct zr_output *output)
{
    const cJSON *found[KEYS];
    int channel;
    if (!zr_json_object(json, path, node, &keys, found)) return false;
    if (!found[CHANNEL]) return zr_json_fault(json, path, "channel is missing");
    if (!zr_json_choice(json, ZR_JSON_KEY(path, words[CHANNEL]), found[CHANNEL], &zr_channel_names, &channel))
        return false;
    *output = (struct zr_output){.channel = (enum zr_channel)channel};
    if (!read_encoding(json, ZR_JSON_KEY(path, words[ENCODING]), found[ENCODING], output)) return false;
    if (!read_space(json, ZR_JSON_KEY(path, words[SPACE]), found[SPACE], output)) return false;
    if (!found[SCALE]) return true;
    const struct zr_json_path *scale = ZR_JSON_KEY(path, words[SCALE]);
    if (output->encoding != ZR_ENCODING_PNG16) return zr_json_fault(json, scale, "only the encoding png16 has one");
    return zr_json_positive(json, scale, found[SCALE], &output->scale);
}

/* More outputs than there are file names must clash, so that few are ever compared. */
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

void zr_draft_read_outputs(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list)
{
    enum { OUTPUTS_MAX = ZR_CHANNEL_COUNT * ZR_ENCODING_COUNT };
    struct zr_json *json = &draft->json;
    size_t given, count = 0, number = 0;
    if (!zr_json_array(json, path, list, &given)) return;
    if (given == 0) {
        zr_json_fault(json, path, "an empty list; leave it out for a colour image");
        return;
    }
    struct zr_output *outputs = zr_arena_alloc(json->arena, OUTPUTS_MAX, sizeof *outputs);
    if (!outputs) return;
    for (const cJSON *node = list->child; node && !zr_json_full(json); node = node->next, number++) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, number);
        struct zr_output output;
        if (read_output(json, at, node, &output) && !clashes(json, at, outputs, count, &output))
            outputs[count++] = output;
    }
    draft->scene->views[0].outputs = outputs;
    draft->scene->views[0].output_count = (uint32_t)count;
}
