#include "file_list.h"

#include <cjson/cJSON.h>
#include <dirent.h>
#include <errno.h>
#include <glob.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/say.h"
#include "files/scene_key.h"
#include "options/endings.h"
#include "options/parameters.h"
#include "options/words.h"

static int no_memory(void)
{
    fputs("zraster: out of memory\n", stderr);
    return STATUS_FAILED;
}

/* A file of the list, of any shard. */
struct listed {
    char *file, *out;                /* `out`: NULL unless a line names it */
    const char *stem;                /* in `file` */
    bool keeps_ending;               /* another file has the same stem but for its ending */
    bool needs_ending, needs_folder; /* from the next pass on: its ending, one more folder */
    struct options *options;         /* of the line; NULL: those of the batch */
    size_t line;
};

/* Adds a file with a copy of its name, whose last `stem_length` characters are its name in the folder of the outputs.
 * Returns NULL without memory. */
static struct listed *add(struct file_list *list, const char *file, size_t stem_length)
{
    if (list->file_count == list->room) {
        const size_t room = list->room ? 2 * list->room : 256;
        struct listed *files = realloc(list->files, room * sizeof *files);
        if (!files) return NULL;
        list->files = files;
        list->room = room;
    }
    struct listed *listed = &list->files[list->file_count];
    *listed = (struct listed){.file = strdup(file)};
    if (!listed->file) return NULL;
    listed->stem = listed->file + strlen(file) - stem_length;
    list->file_count++;
    return listed;
}

static struct listed *add_base(struct file_list *list, const char *file)
{
    return add(list, file, strlen(output_base(file)));
}

/* Returns true if the file that is added next belongs to the shard. */
static bool is_next_own(const struct file_list *list)
{
    return list->file_count % list->shard.count == list->shard.index;
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

/* Returns true for a folder, but no link to one. lstat is for folders and unknown types only: it takes long on network
 * file systems. */
static bool is_folder(const struct dirent *entry, const char *path, struct stat *about)
{
    if (entry->d_type != DT_DIR && entry->d_type != DT_UNKNOWN) return false;
    return lstat(path, about) == 0 && S_ISDIR(about->st_mode);
}

/* Returns true for a file or a link to one. Pipes and devices in a folder are no inputs. */
static bool is_regular(const struct dirent *entry, const char *path)
{
    struct stat about;
    return entry->d_type == DT_REG || (stat(path, &about) == 0 && S_ISREG(about.st_mode));
}

/* Returns true for a file to draw: it has an ending of a format, and is a scene if this is .json. */
static bool is_input(struct file_list *list, const struct dirent *entry, const char *path)
{
    static const struct options no_options;
    if (!input_has_ending(path) || !is_regular(entry, path)) return false;
    if (input_kind_of(path, &no_options) != INPUT_SCENE || scene_key_found(path)) return true;
    if (list->other_count++ == 0) snprintf(list->first_other, sizeof list->first_other, "%s", path);
    return false;
}

/* Adds the files below a folder. The first `above` characters of their paths are the folder of the argument. */
static int add_folder(struct file_list *list, const char *folder, size_t above)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_visible, alphasort);
    int status = count < 0 ? options_wrong("%s: the folder cannot be read", folder) : 0;
    for (int i = 0; i < count; i++) {
        char *path = NULL;
        struct stat about;
        if (status != 0) {
        } else if (asprintf(&path, "%s/%s", folder, entries[i]->d_name) < 0)
            status = no_memory();
        else if (is_folder(entries[i], path, &about)) {
            if (!is_output_folder(list, &about)) status = add_folder(list, path, above);
        } else if (is_input(list, entries[i], path) && !add(list, path, strlen(path) - above))
            status = no_memory();
        free(path);
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

/* Sets options of a file by the members of an object. Without options, only its output is set. */
static int set_members(struct listed *listed, const cJSON *object)
{
    struct options *options = listed->options;
    const cJSON *member;
    cJSON_ArrayForEach(member, object)
    {
        char number[40];
        const char *value = cJSON_GetStringValue(member);
        const bool is_output = strcmp(member->string, "output") == 0;
        if (strcmp(member->string, "file") == 0 || (!options && !(is_output && value))) continue;
        if (cJSON_IsBool(member)) value = cJSON_IsTrue(member) ? "true" : "false";
        if (cJSON_IsNumber(member)) {
            snprintf(number, sizeof number, "%.15g", member->valuedouble);
            value = number;
        }
        if (strcmp(member->string, "width") == 0 || strcmp(member->string, "height") == 0)
            options->own[OPTION_SIZE] = NULL; /* faults name the key, not --size */
        if (!value)
            return options_wrong("line %zu: \"%s\" must be a text, number or boolean", listed->line, member->string);
        char *kept = strdup(value);
        if (!kept) return no_memory();
        if (is_output)
            listed->out = kept;
        else if (!options_set(options, member->string, kept)) {
            free(kept);
            return refuse_key(member->string, listed->line);
        }
    }
    return 0;
}

static int add_object(struct file_list *list, const cJSON *object, const char *file, size_t line)
{
    struct options *options = is_next_own(list) ? malloc(sizeof *options) : NULL;
    struct listed *listed = options || !is_next_own(list) ? add_base(list, file) : NULL;
    if (!listed) {
        free(options);
        return no_memory();
    }
    if (options) *options = *list->options;
    listed->options = options;
    listed->line = line;
    return set_members(listed, object);
}

static int add_line(struct file_list *list, const char *text, size_t line)
{
    if (!*text) return 0;
    if (*text != '{') {
        struct listed *listed = add_base(list, text);
        if (listed) listed->line = line;
        return listed ? 0 : no_memory();
    }
    cJSON *object = cJSON_Parse(text);
    const char *file = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, "file"));
    int status;
    if (file)
        status = add_object(list, object, file, line);
    else if (cJSON_IsObject(object))
        status = options_wrong(
            "line %zu: \"file\" is missing or not a text; a line looks like {\"file\": \"part.stl\"}", line);
    else
        status =
            options_wrong("line %zu is not a JSON object such as {\"file\": \"part.stl\", \"look\": \"clay\"}", line);
    cJSON_Delete(object);
    return status;
}

static int add_lines(struct file_list *list, FILE *from)
{
    char *text = NULL;
    size_t room = 0, line = 0;
    int status = 0;
    for (ssize_t length; status == 0 && (length = getline(&text, &room, from)) >= 0;) {
        while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == '\r'))
            text[--length] = '\0';
        status = add_line(list, text, ++line);
    }
    free(text);
    return status;
}

static int add_list(struct file_list *list, const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) return options_wrong("--list %s: %s", path, strerror(errno));
    int status = add_lines(list, file);
    if (status == 0 && ferror(file)) status = options_wrong("--list %s: %s", path, strerror(errno));
    fclose(file);
    return status;
}

/* ---- arguments ---- */

static int add_glob(struct file_list *list, const char *pattern)
{
    glob_t found;
    int status = glob(pattern, 0, NULL, &found) == 0 ? 0 : options_wrong("no file matches %s", pattern);
    if (status != 0) return status;
    for (size_t i = 0; i < found.gl_pathc && status == 0; i++)
        if (!add_base(list, found.gl_pathv[i])) status = no_memory();
    globfree(&found);
    return status;
}

static int add_argument(struct file_list *list, const char *argument)
{
    struct stat about;
    if (strcmp(argument, "-") == 0) return add_lines(list, stdin);
    if (stat(argument, &about) != 0 && strpbrk(argument, "*?[")) return add_glob(list, argument);
    if (stat(argument, &about) == 0 && S_ISDIR(about.st_mode)) {
        const size_t before = list->file_count;
        const int status = add_folder(list, argument, strlen(argument) + 1);
        if (status != 0 || list->file_count > before) return status;
        if (list->other_count > 0)
            return options_wrong("the folder %s has no file to draw: %s is no scene, as it has no meshes or polygons",
                                 argument, list->first_other);
        return options_wrong("the folder %s has no file ending with one of" OPTIONS_TYPES, argument);
    }
    return add_base(list, argument) ? 0 : no_memory();
}

/* ---- names ---- */

/* Returns the name of the outputs of a file, as far as it is known before drawing. */
static char *main_name(const struct file_list *list, const struct listed *listed)
{
    const struct target target = {.folder = list->folder, .stem = listed->stem, .keeps_ending = listed->keeps_ending};
    return listed->out ? strdup(listed->out) : output_name_begin(&target);
}

/* A file by the hash of its main name: names of a million files would fill memory twice. */
struct named {
    uint64_t hash;
    size_t index;
};

static uint64_t hash_of(const char *name)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325); /* FNV-1a */
    for (; *name; name++)
        hash = (hash ^ (unsigned char)*name) * UINT64_C(0x100000001b3);
    return hash;
}

static int compare_names(const void *a, const void *b)
{
    const struct named *s = a, *t = b;
    if (s->hash != t->hash) return s->hash < t->hash ? -1 : 1;
    return (s->index > t->index) - (s->index < t->index);
}

static int refuse_names(const struct listed *a, const struct listed *b, const char *name)
{
    if (a->line && b->line)
        return options_wrong(
            "lines %zu and %zu, %s and %s, would have the same output, %s; {\"file\": \"%s\", \"output\": "
            "\"NAME.png\"} names another one",
            a->line, b->line, a->file, b->file, name, b->file);
    if (strcmp(a->file, b->file) == 0 || bytes_same_file(a->file, b->file))
        return options_wrong("%s is given twice; leave one out", b->file);
    return options_wrong("%s and %s would have the same output, %s; draw them in two calls with -o FOLDER", a->file,
                         b->file, name);
}

/* Lengthens the stem by the folder before it. Returns false if there is none, or if it is "." or "..". */
static bool take_folder(struct listed *listed)
{
    if (listed->stem < listed->file + 2) return false;
    const char *end = listed->stem - 1;
    while (end > listed->file && end[-1] == '/')
        end--;
    const char *begin = end;
    while (begin > listed->file && begin[-1] != '/')
        begin--;
    const size_t length = (size_t)(end - begin);
    if (length == 0 || (begin[0] == '.' && (length == 1 || (length == 2 && begin[1] == '.')))) return false;
    listed->stem = begin;
    return true;
}

/* Files whose stems differ in their endings, such as part.stl and part.obj, keep these. Others, such as a/part.stl and
 * b/part.stl, take their folders. Returns false if one has no folder: it would keep its name, and --resume would take an
 * earlier picture of the other file for its own. */
static bool tell_apart(struct listed *a, struct listed *b)
{
    if (a->out || b->out) return false;
    if (strcmp(a->stem, b->stem) != 0) {
        a->needs_ending = b->needs_ending = true;
        return true;
    }
    struct listed longer_a = *a, longer_b = *b;
    if (bytes_same_file(a->file, b->file) || !take_folder(&longer_a) || !take_folder(&longer_b)) return false;
    a->needs_folder = b->needs_folder = true;
    return true;
}

/* Compares two files whose main names have the same hash. Refuses them if nothing tells the names apart. */
static int check_pair(const struct file_list *list, struct listed *a, struct listed *b, bool *changes)
{
    char *name = main_name(list, a), *other = main_name(list, b);
    int status = 0;
    if (!name || !other)
        status = no_memory();
    else if (strcmp(name, other) == 0) {
        *changes = true;
        if (!tell_apart(a, b)) status = refuse_names(a, b, name);
    }
    free(name);
    free(other);
    return status;
}

/* Compares the names of all outputs. Lengthens equal ones and sets `changes`, or refuses the files. */
static int compare_all(struct file_list *list, struct named *named, bool *changes)
{
    const size_t count = list->file_count;
    int status = 0;
    for (size_t i = 0; status == 0 && i < count; i++) {
        char *name = main_name(list, &list->files[i]);
        if (name)
            named[i] = (struct named){hash_of(name), i};
        else
            status = no_memory();
        free(name);
    }
    if (status == 0) qsort(named, count, sizeof *named, compare_names);
    for (size_t i = 1; status == 0 && i < count; i++)
        for (size_t k = i; status == 0 && k > 0 && named[k - 1].hash == named[i].hash; k--)
            status = check_pair(list, &list->files[named[k - 1].index], &list->files[named[i].index], changes);
    for (size_t i = 0; i < count; i++) {
        struct listed *listed = &list->files[i];
        if (listed->needs_folder) take_folder(listed);
        listed->keeps_ending |= listed->needs_ending;
        listed->needs_folder = listed->needs_ending = false;
    }
    return status;
}

/* Gives each file outputs of its own, or refuses the files. Each pass lengthens names, at most to whole paths. */
static int check_names(struct file_list *list)
{
    struct named *named = calloc(list->file_count + 1, sizeof *named);
    int status = named ? 0 : no_memory();
    for (bool changes = true; status == 0 && changes;) {
        changes = false;
        status = compare_all(list, named, &changes);
    }
    free(named);
    return status;
}

/* Makes jobs of the files of the shard, and forgets the others. */
static int make_jobs(struct file_list *list)
{
    const struct shard shard = list->shard;
    list->jobs = calloc(list->file_count / shard.count + 1, sizeof *list->jobs);
    for (size_t i = 0; list->jobs && i < list->file_count; i++) {
        const struct listed *listed = &list->files[i];
        if (i % shard.count != shard.index) {
            free(listed->file);
            free(listed->out);
            continue;
        }
        list->jobs[list->count++] = (struct job){.options = listed->options ? listed->options : list->options,
                                                 .target = {.file = listed->file,
                                                            .out = listed->out,
                                                            .folder = list->folder,
                                                            .stem = listed->stem,
                                                            .keeps_ending = listed->keeps_ending},
                                                 .line = listed->line};
    }
    free(list->files);
    list->files = NULL;
    return list->jobs ? 0 : no_memory();
}

int file_list_make(struct file_list *list, const struct options *options)
{
    const char *folder = options->own[OPTION_OUTPUT];
    *list = (struct file_list){.folder = folder ? folder : "", .options = options, .shard = options_shard(options)};
    int status = 0;
    for (size_t i = 0; status == 0 && i < options->file_count; i++)
        status = add_argument(list, options->files[i]);
    if (status == 0 && options->own[OPTION_LIST]) status = add_list(list, options->own[OPTION_LIST]);
    if (status == 0) status = check_names(list);
    if (status == 0 && list->other_count > 0 && !options->own[OPTION_QUIET])
        say("left out: JSON files without meshes or polygons, which are no scenes: %zu; the first is %s",
            list->other_count, list->first_other);
    return status ? status : make_jobs(list);
}
