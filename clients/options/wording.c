#include "wording.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/neighbours.h"
#include "format_rows.h"
#include "parameters.h"

static const char parameter_word[] = "parameter ";
static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

bool wording_is_option(const char *line)
{
    const size_t length = strcspn(line, ":\n");
    return strncmp(line, "--", 2) == 0 && line[length] == ':' && strcspn(line, " ") > length;
}

/* ---- names of parameters ---- */

static bool is_parameter(const char *word, size_t length)
{
    for (size_t i = 0; i < PARAMETER_COUNT; i++)
        if (strlen(parameter_rows[i].name) == length && memcmp(parameter_rows[i].name, word, length) == 0) return true;
    return false;
}

/* Writes a word as an option if it is the name of a parameter. After the first word, which `is_first`, only names of
 * several words, such as lightPosition, are written so: others may be plain words. */
static bool find_flag(const char *word, size_t length, bool is_first, bool has_size, char flag[FLAG_SIZE])
{
    options_flag_of(word, length, flag);
    if (!is_parameter(word, length)) return false;
    if (is_first && has_size && (strcmp(flag, "--width") == 0 || strcmp(flag, "--height") == 0))
        snprintf(flag, FLAG_SIZE, "--size");
    return is_first || strlen(flag) > length + 2;
}

/* ---- phrases about requests ---- */

#define FORMAT_PHRASE(ID, suffix, media_types, ...) {media_types, suffix},
static const struct phrase {
    const char *from, *to;
} PHRASES[] = {{"no type is given; the body looks like", "it looks like"},
               {"hand the bytes over as a part of the request",
                "{\"asset\": \"FILE\"} in the scene names a file of its folder"}},
  TYPES[] = {ZR_FORMAT_ROWS(FORMAT_PHRASE)}; /* the first media type of each */
#undef FORMAT_PHRASE

/* Returns the replacement of the phrase at the beginning of `text`, and sets the length of that phrase; NULL: there is
 * none. In a list of formats, media types are replaced, too. */
static const char *find_phrase(const char *text, bool is_list, size_t *length)
{
    for (size_t i = 0; i < sizeof PHRASES / sizeof *PHRASES; i++)
        if (strncmp(text, PHRASES[i].from, *length = strlen(PHRASES[i].from)) == 0) return PHRASES[i].to;
    for (size_t i = 0; is_list && i < sizeof TYPES / sizeof *TYPES; i++)
        if (strncmp(text, TYPES[i].from, *length = strcspn(TYPES[i].from, " ")) == 0) return TYPES[i].to;
    return NULL;
}

/* Adds the reason why a missing part is not read, and the option that gives it, if the line is about one. */
static bool add_part(struct bytes *out, const char *line, size_t length, const struct input *input,
                     const struct options *options)
{
    static const char phrase[] = "no part of the request has the name '";
    const char *at = memmem(line, length, phrase, sizeof phrase - 1);
    const char *begin = at ? at + sizeof phrase - 1 : NULL, *end = at ? memrchr(line, '\'', length) : NULL;
    const bool is_whole = begin < end && strncmp(end, "'...", 4) != 0; /* else it is empty, or cut off */
    if (!is_whole) return true;
    char *name = strndup(begin, (size_t)(end - begin));
    const bool ok = name && neighbours_explain(input, options->own[OPTION_ROOT], name, out) &&
                    bytes_print(out, "; --part %s=FILE gives it", name);
    free(name);
    return ok;
}

/* ---- lines ---- */

static bool add_line(struct bytes *out, const char *line, size_t length, const struct input *input,
                     const struct options *options)
{
    const bool has_size = options->own[OPTION_SIZE] != NULL;
    const bool is_option = strncmp(line, parameter_word, sizeof parameter_word - 1) == 0;
    const char *at = is_option ? line + sizeof parameter_word - 1 : line, *end = line + length, *first = at;
    const char *list = memmem(line, length, "none of: ", strlen("none of: "));
    bool ok = true;
    while (ok && at < end) {
        char flag[FLAG_SIZE];
        const size_t word = strspn(at, letters), left = (size_t)(end - at);
        size_t some = word ? word : strcspn(at, letters), replaced;
        const char *phrase = find_phrase(at, list && at > list, &replaced);
        if (phrase)
            some = replaced;
        else if (is_option && find_flag(at, word, at == first, has_size, flag))
            phrase = flag;
        ok = phrase ? bytes_print(out, "%s", phrase) : bytes_add(out, at, some < left ? some : left);
        at += some;
    }
    return ok && add_part(out, line, length, input, options) && bytes_print(out, "\n");
}

/* Removes the last line, which begins at `last`, if the one before it, which begins at `before`, equals it. */
static void remove_repetition(struct bytes *lines, size_t before, size_t last)
{
    const size_t length = lines->size - last;
    if (last - before == length && memcmp(lines->data + before, lines->data + last, length) == 0) lines->size = last;
}

void wording_translate(struct bytes *faults, const struct input *input, const struct options *options)
{
    const char *line = bytes_text(faults);
    struct bytes out = {.data = NULL};
    size_t before = 0;
    bool ok = faults->size > 0;
    for (size_t length; ok && *line; line += length + (line[length] == '\n')) {
        const size_t last = out.size;
        length = strcspn(line, "\n");
        ok = add_line(&out, line, length, input, options);
        if (ok) remove_repetition(&out, before, last);
        before = last;
    }
    if (ok) out.data[--out.size] = '\0'; /* without the last line break */
    bytes_free(ok ? faults : &out);
    if (ok) *faults = out;
}
