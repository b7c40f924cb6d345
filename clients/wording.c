#include "wording.h"

#include <stdio.h>
#include <string.h>

static const char parameter_word[] = "parameter ";
static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

bool wording_is_option(const char *line)
{
    const size_t length = strcspn(line, ":\n");
    return strncmp(line, "--", 2) == 0 && line[length] == ':' && strcspn(line, " ") > length;
}

static bool is_parameter(const char *word, size_t length)
{
    for (size_t i = 0; i < PARAMETER_COUNT; i++)
        if (strlen(parameter_rows[i].name) == length && memcmp(parameter_rows[i].name, word, length) == 0) return true;
    return false;
}

/* Writes a word as an option if it is the name of a parameter. Behind the first one, which `is_first`, only names in
 * two cases are: they are no words of the language. */
static bool find_flag(const char *word, size_t length, bool is_first, bool has_size, char flag[FLAG_SIZE])
{
    options_flag_of(word, length, flag);
    if (!is_parameter(word, length)) return false;
    if (is_first && has_size && (strcmp(flag, "--width") == 0 || strcmp(flag, "--height") == 0))
        snprintf(flag, FLAG_SIZE, "--size");
    return is_first || strlen(flag) > length + 2;
}

static bool add_line(struct bytes *out, const char *line, size_t length, bool has_size)
{
    const bool is_option = strncmp(line, parameter_word, sizeof parameter_word - 1) == 0;
    const char *at = is_option ? line + sizeof parameter_word - 1 : line, *end = line + length, *first = at;
    while (at < end) {
        const size_t word = strspn(at, letters), some = word ? word : strcspn(at, letters);
        const size_t left = (size_t)(end - at);
        char flag[FLAG_SIZE];
        const bool is_flag = is_option && find_flag(at, word, at == first, has_size, flag);
        if (!(is_flag ? bytes_print(out, "%s", flag) : bytes_add(out, at, some < left ? some : left))) return false;
        at += some;
    }
    return bytes_print(out, "\n");
}

/* Removes the last line, which begins at `last`, if the one before it, which begins at `before`, equals it. */
static void remove_repetition(struct bytes *lines, size_t before, size_t last)
{
    const size_t length = lines->size - last;
    if (last - before == length && memcmp(lines->data + before, lines->data + last, length) == 0) lines->size = last;
}

void wording_translate(struct bytes *faults, const struct options *options)
{
    const char *line = bytes_text(faults);
    struct bytes out = {NULL, 0, 0};
    size_t before = 0;
    bool ok = faults->size > 0;
    for (size_t length; ok && *line; line += length + (line[length] == '\n')) {
        const size_t last = out.size;
        length = strcspn(line, "\n");
        ok = add_line(&out, line, length, options->own[OPTION_SIZE] != NULL);
        if (ok) remove_repetition(&out, before, last);
        before = last;
    }
    if (ok) out.data[--out.size] = '\0'; /* without the last line break */
    bytes_free(ok ? faults : &out);
    if (ok) *faults = out;
}
