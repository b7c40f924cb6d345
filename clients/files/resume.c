#include "resume.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands/tables.h"
#include "options/parameters.h"

enum { CHANNEL_SIZE = 64 };

static bool is_before(struct timespec a, struct timespec b)
{
    return a.tv_sec != b.tv_sec ? a.tv_sec < b.tv_sec : a.tv_nsec < b.tv_nsec;
}

/* ---- settings ---- */

/* Names of files tell channels, and most encodings. */
static bool is_setting(int parameter, const char *value)
{
    const bool is_in_names =
        parameter == PARAMETER_channel ||
        (parameter == PARAMETER_encoding && strcmp(value, "png16") != 0 && strcmp(value, "png32") != 0);
    return value && !is_in_names;
}

static void print_settings(struct bytes *text, const struct options *options)
{
    for (int i = 0; i < PARAMETER_COUNT; i++)
        if (options->parameters[i] && is_setting(i, options->parameters[i]))
            bytes_print(text, "%s = %s\n", parameter_rows[i].name, options->parameters[i]);
    if (options->own[OPTION_TYPE]) bytes_print(text, "type = %s\n", options->own[OPTION_TYPE]);
    if (options->own[OPTION_ROOT]) bytes_print(text, "root = %s\n", options->own[OPTION_ROOT]);
    for (size_t i = 0; i < options->part_count; i++)
        bytes_print(text, "part = %s\n", options->parts[i]);
}

/* Writes the settings, unless the file has them. */
static int write_settings(const char *path, const struct options *options)
{
    struct bytes before = {.data = NULL}, now = {.data = NULL};
    const bool had_some = bytes_read(&before, path);
    print_settings(&now, options);
    const bool are_same = had_some && strcmp(bytes_text(&before), bytes_text(&now)) == 0;
    const bool is_written = are_same || bytes_write(&now, path);
    if (!are_same && is_written && options->own[OPTION_RESUME])
        fprintf(stderr, "zraster: %s %s: all files are drawn again\n", path,
                had_some ? "has other settings" : "is not there, so the settings of earlier outputs are unknown");
    bytes_free(&before);
    bytes_free(&now);
    return is_written ? 0 : options_wrong("%s cannot be written: %s", path, strerror(errno));
}

int resume_open(struct resume *resume, const struct options *options)
{
    const char *folder = options->own[OPTION_OUTPUT], *list = options->own[OPTION_LIST];
    struct stat about;
    char *path;
    *resume = (struct resume){{0, 0}, {0, 0}};
    if (asprintf(&path, "%s/.zraster-batch", folder ? folder : ".") < 0) return options_wrong("out of memory");
    output_make_folders(path);
    const int status = write_settings(path, options);
    if (status == 0 && stat(path, &about) == 0) resume->since = about.st_mtim;
    if (list && stat(list, &about) == 0 && S_ISREG(about.st_mode)) resume->list = about.st_mtim;
    free(path);
    return status;
}

/* ---- outputs ---- */

/* Returns true for a file that is not empty, and not older than the settings. After a power cut, a file system may have
 * the names of files, but not their bytes. */
static bool has_bytes(const char *path, struct timespec since)
{
    struct stat about;
    return stat(path, &about) == 0 &&
           (!S_ISREG(about.st_mode) || (about.st_size > 0 && !is_before(about.st_mtim, since)));
}

/* Outputs of a target, no older than a time. */
struct wanted {
    const struct target *target;
    struct timespec since;
};

/* Returns true if an output exists. The only output of a file has no channel in its name. */
static bool exists(const struct wanted *wanted, const char *channel, const char *encoding, bool is_only)
{
    const char *extension = tables_extension(channel, encoding);
    char *name = extension ? output_name(wanted->target, is_only ? "color" : channel, extension) : NULL;
    const bool is_there = name && has_bytes(name, wanted->since);
    free(name);
    return is_there;
}

/* Returns true if all outputs of a list "color,depth" exist. Channels without the encoding have their default one. */
static bool has_channels(const struct wanted *wanted, const char *list, const char *encoding)
{
    const bool is_only = strchr(list, ',') == NULL;
    bool is_used = !*encoding;
    for (const char *at = list;; at++) {
        char channel[CHANNEL_SIZE];
        const size_t length = strcspn(at, ",");
        snprintf(channel, sizeof channel, "%.*s", (int)length, at);
        const bool has_it = tables_extension(channel, encoding) != NULL;
        if (!exists(wanted, channel, has_it ? encoding : "", is_only)) return false;
        is_used = is_used || has_it;
        at += length;
        if (!*at) return is_used;
    }
}

/* Returns true if all outputs of a scene exist. */
static bool has_outputs(const struct wanted *wanted, const cJSON *scene)
{
    const cJSON *outputs = cJSON_GetObjectItemCaseSensitive(scene, "outputs"), *output;
    const bool is_only = cJSON_GetArraySize(outputs) == 1;
    if (!cJSON_IsObject(scene)) return false;
    if (!outputs) return exists(wanted, "color", "", true);
    cJSON_ArrayForEach(output, outputs)
    {
        const char *channel = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(output, "channel"));
        const char *encoding = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(output, "encoding"));
        if (!channel || !exists(wanted, channel, encoding ? encoding : "", is_only)) return false;
    }
    return outputs->child != NULL;
}

/* Checks the outputs of a file that is a scene or may be one. */
static bool has_file(const struct wanted *wanted, bool is_scene)
{
    static const char space[] = " \t\r\n";
    struct bytes body = {.data = NULL};
    struct stat about; /* a pipe can be read only once */
    bool has_all =
        stat(wanted->target->file, &about) == 0 && S_ISREG(about.st_mode) && bytes_read(&body, wanted->target->file);
    const char *text = bytes_text(&body);
    if (has_all && !is_scene && text[strspn(text, space)] != '{')
        has_all = exists(wanted, "color", "", true);
    else if (has_all) {
        cJSON *scene = cJSON_ParseWithLength(text, body.size);
        has_all = has_outputs(wanted, scene);
        cJSON_Delete(scene);
    }
    bytes_free(&body);
    return has_all;
}

bool resume_has_all(const struct resume *resume, const struct job *job, bool has_own)
{
    const struct target *target = &job->target;
    const char *channels = job->options->parameters[PARAMETER_channel];
    const char *encoding = job->options->parameters[PARAMETER_encoding];
    const enum input_kind kind = input_kind_of(target->file, job->options);
    const bool is_list_newer = has_own && is_before(resume->since, resume->list);
    const struct wanted wanted = {target, is_list_newer ? resume->list : resume->since};
    if (target->out) return has_bytes(target->out, wanted.since);
    if (channels || encoding) return has_channels(&wanted, channels ? channels : "color", encoding ? encoding : "");
    return kind == INPUT_MESH ? exists(&wanted, "color", "", true) : has_file(&wanted, kind == INPUT_SCENE);
}
