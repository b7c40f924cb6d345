#include "scene_key.h"

#include <stdio.h>
#include <string.h>

#include "engine/interruption.h"

enum { WORD_SIZE = 16 };

/* Reads a string behind its first quote. The word is cut to its room. */
static bool read_string(FILE *file, char word[WORD_SIZE])
{
    size_t length = 0;
    int c = getc(file);
    for (; c != EOF && c != '"'; c = getc(file)) {
        if (length + 1 < WORD_SIZE) word[length++] = (char)c;
        if (c == '\\') getc(file);
    }
    word[length] = '\0';
    return c == '"';
}

/* Returns true if a colon follows, as after a key. */
static bool is_key(FILE *file)
{
    int c = getc(file);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        c = getc(file);
    if (c != ':' && c != EOF) ungetc(c, file);
    return c == ':';
}

static bool find_key(FILE *file)
{
    char word[WORD_SIZE];
    int depth = 0;
    for (int c = getc(file); c != EOF && !interrupted(); c = getc(file)) {
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        if (c != '"') continue;
        if (!read_string(file, word)) return false;
        if (depth != 1 || !is_key(file)) continue;
        if (strcmp(word, "meshes") == 0 || strcmp(word, "polygons") == 0) return true;
        if (strcmp(word, "rules") == 0) return false;
    }
    return false;
}

bool scene_key_found(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) return true;
    const bool is_found = find_key(file) || ferror(file);
    fclose(file);
    return is_found;
}
