#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

struct format {
    const char *type, *ending, *name, *instead;
};

/* Formats of answers, and advice for getting another format. */
static const struct format FORMATS[] = {
    {"image/png", "png", "a PNG", ""},
    {"application/x-npy", "npy", "an array (NPY)", "; depth has a PNG, too: --encoding png16"},
    {"application/json", "json", "JSON", ""},
    {"application/zip", "zip", "a ZIP archive of several outputs", "; or get one of them: --channel color"},
};

/* Endings of formats that the server never sends. Other endings, such as .part, name no format. */
static const char *const FOREIGN[] = {"jpg", "jpeg", "gif", "tif", "tiff", "webp", "bmp",  "ppm", "pgm",
                                      "exr", "hdr",  "svg", "pdf", "npz",  "gz",   "html", "txt", "csv"};

/* Endings of request bodies. Endings that are also in FORMATS are found there first. */
#define ENDING(ID, suffix, ...) suffix,
static const char *const BODIES[] = {ZR_FORMAT_ROWS(ENDING)};
#undef ENDING

static const struct format *format_of(const char *type)
{
    for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; i++)
        if (strcasecmp(type, FORMATS[i].type) == 0) return &FORMATS[i];
    return NULL;
}

/* Returns the last part of a path. */
static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Returns the dot before the ending of a file name, or the end of the name. */
static const char *dot_of(const char *base)
{
    const char *dot = strrchr(base, '.');
    return dot && dot > base ? dot : base + strlen(base);
}

/* Returns true if an ending names a known format other than this one. */
static bool says_another_format(const char *ending, const struct format *format)
{
    if (strcasecmp(ending, format->ending) == 0) return false;
    for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; i++)
        if (strcasecmp(ending, FORMATS[i].ending) == 0) return true;
    for (size_t i = 0; i < sizeof FOREIGN / sizeof *FOREIGN; i++)
        if (strcasecmp(ending, FOREIGN[i]) == 0) return true;
    for (size_t i = 0; i < sizeof BODIES / sizeof *BODIES; i++)
        if (strcasecmp(ending, BODIES[i]) == 0) return true;
    return false;
}

/* Returns, to be freed, `path` without its ending, `between`, and the ending of the format. */
static char *renamed(const char *path, const char *between, const struct format *format)
{
    const int length = (int)(dot_of(base_of(path)) - path);
    const size_t size = (size_t)length + strlen(between) + strlen(format->ending) + 2;
    char *name = malloc(size);
    if (name) snprintf(name, size, "%.*s%s.%s", length, path, between, format->ending);
    return name;
}

static bool ending_fits(const char *out, const struct format *format)
{
    const char *dot = dot_of(base_of(out));
    if (*dot == '\0' || !says_another_format(dot + 1, format)) return true;
    char *better = renamed(out, "", format);
    fprintf(stderr, "zraster: %s: nothing is saved, since what came back is %s; -o %s takes it%s\n", out, format->name,
            better ? better : format->ending, strcasecmp(dot + 1, "png") == 0 ? format->instead : "");
    free(better);
    return false;
}

bool output_is_input(const struct options *options, const char *out)
{
    if (strcmp(out, "-") == 0 || !bytes_same_file(options->file, out)) return false;
    fprintf(stderr, "zraster: %s would overwrite its own input; -o names another file\n", out);
    return true;
}

static bool save(const struct options *options, const struct bytes *picture, const char *out)
{
    const bool to_stdout = strcmp(out, "-") == 0;
    if (output_is_input(options, out)) return false;
    if (!bytes_write(picture, out)) {
        fprintf(stderr, "zraster: cannot write %s: %s\n", to_stdout ? "to standard output" : out, strerror(errno));
        return false;
    }
    if (!to_stdout) puts(out);
    return true;
}

bool output_save(const struct options *options, const struct bytes *picture, const char *type)
{
    const struct format *format = format_of(type);
    if (!format) {
        fprintf(stderr, "zraster: what answers is no zrasterd: it sent %s; --server names another\n",
                *type ? type : "something without a type");
        return false;
    }
    const char *out = options->out ? options->out : strcmp(options->file, "-") == 0 ? "-" : NULL;
    if (out && strcmp(out, "-") == 0 && strcmp(format->ending, "json") != 0 && isatty(STDOUT_FILENO)) {
        fprintf(stderr, "zraster: %s is nothing for a terminal; -o FILE saves it\n", format->name);
        return false;
    }
    if (out) return ending_fits(out, format) && save(options, picture, out);
    const char *base = base_of(options->file);
    char *name = renamed(base, "", format);
    if (name && strcmp(name, options->file) == 0) { /* the input is never overwritten */
        free(name);
        name = renamed(base, ".out", format);
    }
    const bool saved = name && save(options, picture, name);
    free(name);
    return saved;
}
