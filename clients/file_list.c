#include "file_list.h"

#include <cjson/cJSON.h>
#include <dirent.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "words.h"

static int no_memory(void)
{
    fputs("zraster: out of memory\n", stderr);
    return STATUS_FAILED;
}

/* Adds a job with copies of the texts. Returns NULL without memory. */
static struct job *add(struct file_list *list, const char *file, const char *stem)
{
    if (list->count == list->room) {
        const size_t room = list->room ? 2 * list->room : 256;
        struct job *jobs = realloc(list->jobs, room * sizeof *jobs);
        if (!jobs) return NULL;
        list->jobs = jobs;
        list->room = room;
    }
    struct job *job = &list->jobs[list->count];
    *job = (struct job){.options = list->options,
                        .target = {.file = strdup(file), .folder = list->folder, .stem = strdup(stem)}};
    if (!job->target.file || !job->target.stem) return NULL;
    list->count++;
    return job;
}

/* ---- folders ---- */

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

/* Returns true for the folder of the outputs, whose files are no inputs. */
static bool is_output_folder(const struct file_list *list, const struct stat *folder)
{
    struct stat output;
    return *list->folder && stat(list->folder, &output) == 0 && output.st_dev == folder->st_dev &&
           output.st_ino == folder->st_ino;
}

static int add_folder(struct file_list *list, const char *folder, const char *below)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_visible, alphasort);
    int status = count < 0 ? options_wrong("%s: the folder cannot be read", folder) : 0;
    for (int i = 0; i < count; i++) {
        char *path = NULL, *stem = NULL;
        struct stat about;
        if (status != 0) {
        } else if (asprintf(&path, "%s/%s", folder, entries[i]->d_name) < 0 ||
                   asprintf(&stem, "%s%s", below, entries[i]->d_name) < 0)
            status = no_memory();
        else if (lstat(path, &about) == 0 && S_ISDIR(about.st_mode)) {
            char *deeper = NULL;
            if (asprintf(&deeper, "%s/", stem) < 0)
                status = no_memory();
            else if (!is_output_folder(list, &about))
                status = add_folder(list, path, deeper);
            free(deeper);
        } else if (input_has_ending(path) && !add(list, path, stem))
            status = no_memory();
        free(path);
        free(stem);
        free(entries[i]);
    }
    if (count >= 0) free(entries);
    return status;
}

/* ---- lines of standard input ---- */

static int refuse_key(const char *key, size_t line)
{
    struct near_word near = {.word = key};
    for (size_t i = 0; i < PARAMETER_COUNT; i++)
        near_offer(&near, parameter_rows[i].name);
    near_offer(&near, "output");
    if (near.best) return options_wrong("line %zu: unknown key \"%s\"; did you mean %s?", line, key, near.best);
    return options_wrong("line %zu: unknown key \"%s\"; allowed: \"file\", \"output\" and parameters", line, key);
}

/* Sets options of a job by the members of an object. */
static int set_members(struct job *job, struct options *options, const cJSON *object, size_t line)
{
    const cJSON *member;
    cJSON_ArrayForEach(member, object)
    {
        char number[40];
        const char *value = cJSON_GetStringValue(member);
        if (cJSON_IsBool(member)) value = cJSON_IsTrue(member) ? "true" : "false";
        if (cJSON_IsNumber(member)) {
            snprintf(number, sizeof number, "%.15g", member->valuedouble);
            value = number;
        }
        if (strcmp(member->string, "file") == 0) continue;
        if (strcmp(member->string, "width") == 0 || strcmp(member->string, "height") == 0)
            options->own[OPTION_SIZE] = NULL; /* faults name the key, not --size */
        if (!value) return options_wrong("line %zu: \"%s\" must be a text, number or boolean", line, member->string);
        char *kept = strdup(value);
        if (!kept) return no_memory();
        if (strcmp(member->string, "output") == 0)
            job->target.out = kept;
        else if (!options_set(options, member->string, kept)) {
            free(kept);
            return refuse_key(member->string, line);
        }
    }
    return 0;
}

static int add_line(struct file_list *list, const char *text, size_t line)
{
    if (!*text) return 0;
    if (*text != '{') {
        struct job *job = add(list, text, output_base(text));
        if (job) job->line = line;
        return job ? 0 : no_memory();
    }
    cJSON *object = cJSON_Parse(text);
    const char *file = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, "file"));
    struct options *options = malloc(sizeof *options);
    struct job *job = file && options ? add(list, file, output_base(file)) : NULL;
    int status = 0;
    if (cJSON_IsObject(object) && !file)
        status = options_wrong(
            "line %zu: \"file\" is missing or not a text; a line looks like {\"file\": \"part.stl\"}", line);
    else if (!file)
        status =
            options_wrong("line %zu is not a JSON object such as {\"file\": \"part.stl\", \"look\": \"clay\"}", line);
    else if (!job)
        status = no_memory();
    else {
        *options = *list->options;
        job->options = options;
        job->line = line;
        status = set_members(job, options, object, line);
    }
    if (!job) free(options);
    cJSON_Delete(object);
    return status;
}

static int add_lines(struct file_list *list)
{
    char *text = NULL;
    size_t room = 0, line = 0;
    int status = 0;
    for (ssize_t length; status == 0 && (length = getline(&text, &room, stdin)) >= 0;) {
        while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == '\r'))
            text[--length] = '\0';
        status = add_line(list, text, ++line);
    }
    free(text);
    return status;
}

/* ---- arguments ---- */

static int add_glob(struct file_list *list, const char *pattern)
{
    glob_t found;
    int status = glob(pattern, 0, NULL, &found) == 0 ? 0 : options_wrong("no file matches %s", pattern);
    if (status != 0) return status;
    for (size_t i = 0; i < found.gl_pathc && status == 0; i++)
        if (!add(list, found.gl_pathv[i], output_base(found.gl_pathv[i]))) status = no_memory();
    globfree(&found);
    return status;
}

static int add_argument(struct file_list *list, const char *argument)
{
    struct stat about;
    if (strcmp(argument, "-") == 0) return add_lines(list);
    if (stat(argument, &about) != 0 && strpbrk(argument, "*?[")) return add_glob(list, argument);
    if (stat(argument, &about) == 0 && S_ISDIR(about.st_mode)) {
        const size_t before = list->count;
        const int status = add_folder(list, argument, "");
        if (status != 0 || list->count > before) return status;
        return options_wrong("the folder %s has no file ending with one of" OPTIONS_TYPES, argument);
    }
    return add(list, argument, output_base(argument)) ? 0 : no_memory();
}

/* ---- names ---- */

/* Returns the name of the outputs of a job, as far as it is known before drawing. */
static char *main_name(const struct job *job)
{
    char *name = job->target.out ? strdup(job->target.out) : output_name(&job->target, "color", "");
    const size_t length = name ? strlen(name) : 0;
    if (length && !job->target.out) name[length - 1] = '\0'; /* the dot before the ending */
    return name;
}

struct named {
    char *name;
    const struct job *job;
};

static int compare_names(const void *a, const void *b)
{
    const struct named *s = a, *t = b;
    const int order = strcmp(s->name, t->name);
    return order ? order : (s->job > t->job) - (s->job < t->job);
}

static int refuse_names(const struct job *a, const struct job *b, const char *name)
{
    if (a->line && b->line)
        return options_wrong(
            "lines %zu and %zu, %s and %s, would have the same output, %s; {\"file\": \"%s\", \"output\": "
            "\"NAME.png\"} names another one",
            a->line, b->line, a->target.file, b->target.file, name, b->target.file);
    if (strcmp(a->target.file, b->target.file) == 0 || bytes_same_file(a->target.file, b->target.file))
        return options_wrong("%s is given twice; leave one out", b->target.file);
    return options_wrong("%s and %s would have the same output, %s; draw them in two calls with -o FOLDER",
                         a->target.file, b->target.file, name);
}

/* Refuses files whose outputs would have the same name. */
static int check_names(const struct file_list *list)
{
    struct named *named = calloc(list->count + 1, sizeof *named);
    int status = named ? 0 : no_memory();
    size_t count = 0;
    for (; status == 0 && count < list->count; count++) {
        named[count] = (struct named){main_name(&list->jobs[count]), &list->jobs[count]};
        if (!named[count].name) status = no_memory();
    }
    if (status == 0) qsort(named, count, sizeof *named, compare_names);
    for (size_t i = 1; status == 0 && i < count; i++)
        if (strcmp(named[i].name, named[i - 1].name) == 0)
            status = refuse_names(named[i - 1].job, named[i].job, named[i].name);
    for (size_t i = 0; named && i < count; i++)
        free(named[i].name);
    free(named);
    return status;
}

int file_list_make(struct file_list *list, const struct options *options)
{
    const char *folder = options->own[OPTION_OUTPUT];
    *list = (struct file_list){.folder = folder ? folder : "", .options = options};
    int status = 0;
    for (size_t i = 0; status == 0 && i < options->file_count; i++)
        status = add_argument(list, options->files[i]);
    return status ? status : check_names(list);
}
