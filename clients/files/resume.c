#include "resume.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands/tables.h"
#include "options/parameters.h"

enum { CHANNEL_SIZE = 64 };

/* Returns true for a file that is not empty. After a power cut, a file system may have the names of files, but not
 * their bytes. */
static bool has_bytes(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && (about.st_size > 0 || !S_ISREG(about.st_mode));
}

/* Returns true if an output exists. The only output of a file has no channel in its name. */
static bool exists(const struct target *target, const char *channel, const char *encoding, bool is_only)
{
    const char *extension = tables_extension(channel, encoding);
    char *name = extension ? output_name(target, is_only ? "color" : channel, extension) : NULL;
    const bool is_there = name && has_bytes(name);
    free(name);
    return is_there;
}

/* Returns true if all outputs of a list "color,depth" exist. Channels without the encoding have their default one. */
static bool has_channels(const struct target *target, const char *list, const char *encoding)
{
    const bool is_only = strchr(list, ',') == NULL;
    bool is_used = !*encoding;
    for (const char *at = list;; at++) {
        char channel[CHANNEL_SIZE];
        const size_t length = strcspn(at, ",");
        snprintf(channel, sizeof channel, "%.*s", (int)length, at);
        const bool has_it = tables_extension(channel, encoding) != NULL;
        if (!exists(target, channel, has_it ? encoding : "", is_only)) return false;
        is_used = is_used || has_it;
        at += length;
        if (!*at) return is_used;
    }
}

/* Returns true if all outputs of a scene exist. */
static bool has_outputs(const struct target *target, const cJSON *scene)
{
    const cJSON *outputs = cJSON_GetObjectItemCaseSensitive(scene, "outputs"), *output;
    const bool is_only = cJSON_GetArraySize(outputs) == 1;
    if (!cJSON_IsObject(scene)) return false;
    if (!outputs) return exists(target, "color", "", true);
    cJSON_ArrayForEach(output, outputs)
    {
        const char *channel = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(output, "channel"));
        const char *encoding = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(output, "encoding"));
        if (!channel || !exists(target, channel, encoding ? encoding : "", is_only)) return false;
    }
    return outputs->child != NULL;
}

/* Checks the outputs of a file that is a scene or may be one. */
static bool has_file(const struct target *target, bool is_scene)
{
    static const char space[] = " \t\r\n";
    struct bytes body = {NULL, 0, 0};
    struct stat about; /* a pipe can be read only once */
    bool has_all = stat(target->file, &about) == 0 && S_ISREG(about.st_mode) && bytes_read(&body, target->file);
    const char *text = bytes_text(&body);
    if (has_all && !is_scene && text[strspn(text, space)] != '{')
        has_all = exists(target, "color", "", true);
    else if (has_all) {
        cJSON *scene = cJSON_ParseWithLength(text, body.size);
        has_all = has_outputs(target, scene);
        cJSON_Delete(scene);
    }
    bytes_free(&body);
    return has_all;
}

bool resume_has_all(const struct job *job)
{
    const struct target *target = &job->target;
    const char *channels = job->options->parameters[PARAMETER_channel];
    const char *encoding = job->options->parameters[PARAMETER_encoding];
    const enum input_kind kind = input_kind_of(target->file, job->options);
    if (target->out) return has_bytes(target->out);
    if (channels || encoding) return has_channels(target, channels ? channels : "color", encoding ? encoding : "");
    return kind == INPUT_MESH ? exists(target, "color", "", true) : has_file(target, kind == INPUT_SCENE);
}
