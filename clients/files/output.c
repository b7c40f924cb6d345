#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands/tables.h"
#include "input.h"
#include "mcp/unzip.h"
#include "options/parameters.h"
#include "scene/encodings.h"

struct format {
    const char *encoding, *ending, *spelling, *type, *name;
    unsigned properties;
};

/* Formats of answers. */
#define FORMAT(ID, word, ending, spelling, type, noun, properties, ...)                                                \
    {word, ending, spelling, type, noun, properties},
static const struct format FORMATS[] = {ZR_ENCODING_ROWS(FORMAT)};
enum { FORMAT_COUNT = sizeof FORMATS / sizeof *FORMATS };

/* Endings of well-known formats that are never written: a word with one of them is the name of an output. */
static const char *const PICTURES[] = {"gif", "bmp", "ppm", "pgm", "exr",  "hdr", "tga", "jp2", "jxl",  "avif",
                                       "ico", "pdf", "npz", "gz",  "svgz", "eps", "ps",  "txt", "html", "csv"},
                         *const VIDEOS[] = {"mp4", "webm", "mov", "mkv", "avi", "m4v", "ogv"};

static const struct format *format_of(const char *type)
{
    static const struct format unknown = {.ending = "bin", .spelling = "", .name = "of an unknown type"};
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (strcasecmp(type, FORMATS[i].type) == 0) return &FORMATS[i];
    return &unknown;
}

/* ---- names ---- */

const char *output_base(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Returns the dot before the ending of a file name, or the end of the name. */
static const char *dot_of(const char *path)
{
    const char *base = output_base(path), *dot = strrchr(base, '.');
    return dot && dot > base ? dot : base + strlen(base);
}

static const char *ending_of(const char *path)
{
    const char *dot = dot_of(path);
    return *dot ? dot + 1 : dot;
}

void output_make_folders(char *path)
{
    for (char *at = path; (at = strchr(at + 1, '/')) != NULL; *at = '/') {
        *at = '\0';
        mkdir(path, 0777);
    }
}

bool output_is_folder(const char *path)
{
    struct stat status;
    return path[strlen(path) - 1] == '/' || (stat(path, &status) == 0 && S_ISDIR(status.st_mode));
}

/* Returns true if the ending of a name means this format. */
static bool is_ending(const char *given, const struct format *format)
{
    return strcasecmp(given, format->ending) == 0 || (*given && strcasecmp(given, format->spelling) == 0);
}

static bool is_video(const char *ending)
{
    for (size_t i = 0; i < sizeof VIDEOS / sizeof *VIDEOS; i++)
        if (strcasecmp(ending, VIDEOS[i]) == 0) return true;
    return false;
}

static bool is_foreign(const char *ending)
{
    for (size_t i = 0; i < sizeof PICTURES / sizeof *PICTURES; i++)
        if (strcasecmp(ending, PICTURES[i]) == 0) return true;
    return is_video(ending);
}

static bool is_written(const char *ending)
{
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (is_ending(ending, &FORMATS[i])) return true;
    return false;
}

bool output_is_name(const char *name)
{
    const char *ending = ending_of(name);
    if (is_written(ending) && !input_has_ending(name)) return true;
    return strcmp(name, "-") == 0 || is_foreign(ending) || output_is_folder(name);
}

/* Returns true if the only input is a scene with outputs of its own. */
static bool has_outputs(const struct options *options)
{
    struct bytes body = {.data = NULL};
    struct stat about; /* a pipe can be read only once */
    const char *path = options->file_count == 1 ? options->files[0] : "-", key[] = "\"outputs\"";
    const bool is_file = strcasecmp(ending_of(path), "json") == 0 && stat(path, &about) == 0 && S_ISREG(about.st_mode);
    const bool has = is_file && bytes_read(&body, path) && memmem(body.data, body.size, key, strlen(key));
    bytes_free(&body);
    return has;
}

/* Sets the encoding that an ending selects. Without a channel, the output is color, or depth if color lacks the
 * encoding.
 */
static void set_encoding(struct options *options, const char *encoding)
{
    const char *channel = options->parameters[PARAMETER_channel];
    const char *own = tables_extension("color", encoding)   ? "color"
                      : tables_extension("depth", encoding) ? "depth"
                                                            : NULL;
    if (channel ? !tables_extension(channel, encoding) : !own) return;
    if (!channel && strcmp(encoding, "svg") != 0 && has_outputs(options)) return;
    if (!channel) options->parameters[PARAMETER_channel] = own;
    options->parameters[PARAMETER_encoding] = encoding;
}

void output_set_encoding(struct options *options)
{
    const char *out = options->own[OPTION_OUTPUT];
    if (!out || options->parameters[PARAMETER_encoding]) return;
    const bool has_frames = options->parameters[PARAMETER_turntable] || options->parameters[PARAMETER_frames];
    if (has_frames && strcasecmp(ending_of(out), "png") == 0 && !options->parameters[PARAMETER_channel])
        options->parameters[PARAMETER_encoding] = "apng";
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (FORMATS[i].properties & ZR_ENCODING_BY_ENDING && is_ending(ending_of(out), &FORMATS[i]))
            set_encoding(options, FORMATS[i].encoding);
}

bool output_may_be_folder(const char *path)
{
    struct stat status; /* of one call: another process may make the folder between two */
    if (path[strlen(path) - 1] == '/') return true;
    if (stat(path, &status) == 0) return S_ISDIR(status.st_mode);
    return !output_is_name(path) && !input_has_ending(path);
}

/* Returns true for a device or a pipe, such as /dev/stdout. */
static bool is_special(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode);
}

/* Returns true if an ending names a known format other than this one. An animated PNG may have the ending of a PNG,
 * which shows its first frame where animations are unknown. Several files in one need an ending: a name without one
 * may be that of a folder. */
static bool says_another_format(const char *out, const struct format *format)
{
    const char *ending = ending_of(out);
    if (!*ending && strcmp(format->ending, "zip") == 0) return strcmp(out, "-") != 0 && !is_special(out);
    if (is_ending(ending, format)) return false;
    if (strcmp(format->ending, "apng") == 0 && strcasecmp(ending, "png") == 0) return false;
    return is_written(ending) || is_foreign(ending) || input_has_ending(out);
}

struct target output_target(const char *file, const char *out)
{
    const bool is_pipe = strcmp(file, "-") == 0;
    struct target target = {.file = file, .out = out, .folder = "", .stem = is_pipe ? "stdin" : output_base(file)};
    if (!out && is_pipe) target.out = "-";
    if (!out || strcmp(out, "-") == 0 || !output_is_folder(out)) return target;
    target.out = NULL;
    target.folder = out;
    return target;
}

char *output_name_begin(const struct target *target)
{
    const char *folder = target->folder, *stem = target->stem;
    const bool slash = *folder && folder[strlen(folder) - 1] != '/';
    char *name = NULL;
    const size_t length = target->keeps_ending ? strlen(stem) : (size_t)(dot_of(stem) - stem);
    return asprintf(&name, "%s%s%.*s", folder, slash ? "/" : "", (int)length, stem) < 0 ? NULL : name;
}

char *output_name(const struct target *target, const char *channel, const char *extension)
{
    const bool is_main = strcmp(channel, "color") == 0;
    char *begin = output_name_begin(target), *name = NULL;
    for (int again = 0; begin && again < 2; again++) { /* the input is never overwritten */
        free(name);
        if (asprintf(&name, "%s%s%s%s.%s", begin, again ? ".out" : "", is_main ? "" : ".", is_main ? "" : channel,
                     extension) < 0)
            name = NULL;
        if (!name || strcmp(target->file, "-") == 0 || !bytes_same_file(target->file, name)) break;
    }
    free(begin);
    return name;
}

/* ---- checks ---- */

static bool is_input(const struct target *target, const char *out, struct bytes *faults)
{
    if (strcmp(out, "-") == 0 || !bytes_same_file(target->file, out)) return false;
    bytes_print(faults, "the output would overwrite its own input; -o names another file");
    return true;
}

/* Checks the folder that the first `length` characters of `path` name. Makes it if `path` ends with a slash. */
static bool check_folder(const char *path, size_t length, struct bytes *faults)
{
    char *folder = strndup(path, length);
    struct stat status;
    bool ok = folder && (length == 0 || (stat(folder, &status) == 0 && S_ISDIR(status.st_mode)));
    if (folder && !ok && path[length] == '/' && !path[length + 1]) ok = mkdir(folder, 0777) == 0;
    if (!ok) bytes_print(faults, "the folder %s does not exist; mkdir -p %s makes it", folder, folder);
    free(folder);
    return ok;
}

/* Refuses an ending of no format: a file of another format under that name would be a surprise. */
static bool check_ending(const char *out, bool has_encoding, struct bytes *faults)
{
    const char *ending = ending_of(out);
    const int stem = (int)(dot_of(out) - out);
    struct near_word near = {.word = ending};
    const bool is_free = has_encoding && !is_foreign(ending); /* a temporary file of a file manager */
    if (!*ending || is_free || is_written(ending) || input_has_ending(out)) return true;
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        near_offer(&near, FORMATS[i].ending);
    if (is_video(ending))
        bytes_print(
            faults,
            "-o %s: zraster writes no .%s; --turntable 36 -o %.*s.webp saves a moving picture, and --turntable 36 "
            "-o frames/ saves frames for a video: ffmpeg -framerate 12 -pattern_type glob -i 'frames/*.png' "
            "-pix_fmt yuv420p %s",
            out, ending, stem, out, out);
    else
        bytes_print(faults, "-o %s: zraster writes no .%s; -o %.*s.%s saves a picture", out, ending, stem, out,
                    near.best && !is_foreign(ending) ? near.best : "png");
    return false;
}

int output_check(const struct target *target, bool has_encoding, struct bytes *faults)
{
    const char *out = target->out ? target->out : target->folder;
    const char *slash = strrchr(out, '/');
    if (target->out && !check_ending(out, has_encoding, faults)) return STATUS_USAGE;
    if (slash && slash > out && !check_folder(out, (size_t)(slash - out), faults))
        return STATUS_USAGE;
    else if (!target->out || !is_input(target, out, faults))
        return STATUS_DONE;
    return STATUS_USAGE;
}

/* ---- saving ---- */

static int save(const struct target *target, const char *out, const void *data, size_t size, bool no_clobber,
                struct bytes *names, struct bytes *faults)
{
    const struct bytes bytes = {.data = (char *)data, .size = size};
    if (is_input(target, out, faults)) return STATUS_USAGE;
    if (no_clobber && strcmp(out, "-") != 0 && access(out, F_OK) == 0) {
        bytes_print(faults, "%s exists; leave out -n to overwrite it, or choose another name with -o", out);
        return STATUS_FAILED;
    }
    if (!bytes_write(&bytes, out)) {
        bytes_print(faults, "cannot write %s: %s", strcmp(out, "-") == 0 ? "standard output" : out, strerror(errno));
        return STATUS_FAILED;
    }
    bytes_add(names, out, strlen(out) + 1);
    return STATUS_DONE;
}

/* Returns true for the channel masks, an archive by itself: its files are in the folder masks, or there are none. */
static bool is_masks(const struct zraster_bytes *archive)
{
    static const char folder[] = "masks/", end[] = {'P', 'K', 5, 6};
    enum { NAME_AT = 30 };
    const char *at = archive->data;
    return (archive->size > NAME_AT + strlen(folder) && memcmp(at + NAME_AT, folder, strlen(folder)) == 0) ||
           (archive->size > sizeof end && memcmp(at, end, sizeof end) == 0);
}

/* Saves each file of an archive. The first one is saved last: once it exists, all do. */
static int save_all(const struct target *target, const struct answer *answer, bool no_clobber, struct bytes *names,
                    struct bytes *faults)
{
    struct unzip unzip = {answer->file.data, (const unsigned char *)answer->file.data + answer->file.size};
    struct unzip_file file, first = {.size = 0};
    int status = unzip_next(&unzip, &first) ? STATUS_DONE : STATUS_FAILED;
    for (bool more = true; status == STATUS_DONE && more;) {
        more = unzip_next(&unzip, &file);
        if (!more) file = first;
        char *dot = strrchr(file.name, '.');
        *dot = '\0';
        char *channel = strrchr(file.name, '.');
        if (channel && strcmp(channel, ".color") == 0) *channel = '\0'; /* part.front.png */
        char *name = output_name(target, file.name, dot + 1);
        status = name ? save(target, name, file.data, file.size, no_clobber, names, faults) : STATUS_FAILED;
        free(name);
    }
    if (!unzip.at) bytes_print(faults, "the archive of the server is broken");
    return unzip.at ? status : STATUS_FAILED;
}

/* Returns advice for getting a PNG instead. */
static const char *advice_of(const struct format *format)
{
    return strcmp(format->ending, "npy") == 0   ? "; depth has a PNG, too: --encoding png16"
           : strcmp(format->ending, "zip") == 0 ? "; or save its files: -o FOLDER/"
                                                : "";
}

static int save_as(const struct target *target, const struct answer *answer, const struct format *format,
                   bool no_clobber, struct bytes *names, struct bytes *faults)
{
    const char *out = target->out;
    if (strcmp(out, "-") == 0 && strcmp(format->ending, "json") != 0 && isatty(STDOUT_FILENO)) {
        bytes_print(faults, "standard output is a terminal, and the output is %s; -o FILE saves it, --show draws it",
                    format->name);
        return STATUS_USAGE;
    }
    if (!says_another_format(out, format))
        return save(target, out, answer->file.data, answer->file.size, no_clobber, names, faults);
    bytes_print(faults, "nothing is saved: the output is %s; -o %.*s.%s saves it%s", format->name,
                (int)(dot_of(out) - out), out, format->ending,
                strcasecmp(ending_of(out), "png") == 0 || !*ending_of(out) ? advice_of(format) : "");
    return STATUS_USAGE;
}

int output_save(const struct target *target, const struct answer *answer, bool no_clobber, struct bytes *names,
                struct bytes *faults)
{
    const struct format *format = format_of(answer->file.type);
    if (target->out) return save_as(target, answer, format, no_clobber, names, faults);
    const bool is_zip = strcmp(format->ending, "zip") == 0;
    if (is_zip && !is_masks(&answer->file)) return save_all(target, answer, no_clobber, names, faults);
    char *name = output_name(target, is_zip ? "masks" : "color", format->ending);
    const int status =
        name ? save(target, name, answer->file.data, answer->file.size, no_clobber, names, faults) : STATUS_FAILED;
    free(name);
    return status;
}
