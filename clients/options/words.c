#include "words.h"

#include <string.h>

void words_add(struct words *words, const char *word, size_t length)
{
    if (words->count == WORDS_MAX || length >= WORDS_SIZE - words->used) return;
    char *at = words->text + words->used;
    memcpy(at, word, length);
    at[length] = '\0';
    words->used += length + 1;
    words->list[words->count++] = at;
}

void words_of_help(struct words *words, const char *help)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789-@";
    const char *at = strstr(help, ": "), *stop = strstr(help, " (");
    if (!at || (stop && at > stop)) return;
    at += 2;
    const char *end = stop ? stop : at + strlen(at);
    while (at < end) {
        const char *comma = strstr(at, ", "), * or = strstr(at, " or ");
        const char *next = comma && (! or || comma < or) ? comma : or && or < end ? or : end;
        if (next > end) next = end;
        if (strncmp(at, "or ", 3) == 0) at += 3;
        const size_t length = (size_t)(next - at);
        if (length > 0 && strspn(at, letters) >= length) words_add(words, at, length);
        at = next + (next == comma ? 2 : 4);
    }
}
