#include <string.h>

#include "input/obj/mtl_file.h"

static bool is_blank(char byte)
{
    return byte == ' ' || byte == '\t' || byte == '\v' || byte == '\f';
}

/* Sets *line to the next line without its end, and moves *rest after it. */
static void cut_line(struct zr_mtl_text *rest, struct zr_mtl_text *line)
{
    const char *at = rest->at;
    while (at < rest->end && *at != '\n' && *at != '\r')
        at++;
    *line = (struct zr_mtl_text){rest->at, at, rest->line++};
    if (at < rest->end) at += *at == '\r' && rest->end - at > 1 && at[1] == '\n' ? 2 : 1;
    rest->at = at;
}

bool zr_mtl_next(struct zr_mtl_text *rest, struct zr_mtl_text *line)
{
    while (rest->at < rest->end) {
        cut_line(rest, line);
        while (line->at < line->end && is_blank(*line->at))
            line->at++;
        while (line->at < line->end && is_blank(line->end[-1]))
            line->end--;
        if (line->at < line->end && *line->at != '#') return true;
    }
    return false;
}

struct zr_mtl_text zr_mtl_word(struct zr_mtl_text *line)
{
    struct zr_mtl_text word = *line;
    while (line->at < line->end && !is_blank(*line->at))
        line->at++;
    word.end = line->at;
    while (line->at < line->end && is_blank(*line->at))
        line->at++;
    return word;
}

bool zr_mtl_is_word(const struct zr_mtl_text *text, const char *word)
{
    const char *at = text->at;
    for (; at < text->end && *word; at++, word++) {
        const char lower = *at >= 'A' && *at <= 'Z' ? (char)(*at + 'a' - 'A') : *at;
        if (lower != *word) return false;
    }
    return at == text->end && !*word;
}
