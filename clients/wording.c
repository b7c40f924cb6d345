#include "wording.h"

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

/* Names in two cases are no words of the language, so that they are parameters wherever they stand. */
static bool add_line(struct bytes *out, const char *line, size_t length)
{
    const bool is_option = strncmp(line, parameter_word, sizeof parameter_word - 1) == 0;
    const char *at = is_option ? line + sizeof parameter_word - 1 : line, *end = line + length, *first = at;
    while (at < end) {
        const size_t word = strspn(at, letters), some = word ? word : strcspn(at, letters);
        const size_t left = (size_t)(end - at);
        char flag[FLAG_SIZE];
        options_flag_of(at, word, flag);
        const bool is_name = is_option && word && is_parameter(at, word) && (at == first || strlen(flag) > word + 2);
        if (!(is_name ? bytes_print(out, "%s", flag) : bytes_add(out, at, some < left ? some : left))) return false;
        at += some;
    }
    return true;
}

void wording_translate(struct bytes *faults)
{
    struct bytes out = {NULL, 0, 0};
    const char *line = bytes_text(faults);
    bool ok = faults->size > 0;
    for (size_t length; ok && *line; line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        ok = add_line(&out, line, length) && (!line[length] || bytes_print(&out, "\n"));
    }
    ok = ok && bytes_print(&out, "%s", ""); /* a final zero */
    bytes_free(ok ? faults : &out);
    if (ok) *faults = out;
}
