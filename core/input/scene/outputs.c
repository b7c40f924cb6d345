#include "input/scene/outputs.h"

#include <stdio.h>
#include <string.h>

#include "scene/output.h"

/* WORD(word, meaning for people), in the order of enum zr_space */
#define ZR_SPACE_WORDS(WORD)                                                                                           \
    WORD("camera", "x right, y up, looking along -z")                                                                  \
    WORD("world", "space of the scene, after the nodes")                                                               \
    WORD("object", "the mesh's own space, before the nodes")                                                           \
    WORD("nocs", "normalized object coordinates: the box of the mesh has its centre at 0.5 and a diagonal of 1")

#define NAME(ID, NAME, ...) NAME,
static const char *const channels[] = {ZR_CHANNEL_ROWS(NAME) "coverage", "overdraw"};
#define WORD(word, text) word,
#define TEXT(word, text) text,
static const char *const encodings[] = {ZR_ENCODING_ROWS(NAME)};
static const char *const spaces[] = {ZR_SPACE_WORDS(WORD)};
const char *const zr_space_texts[ZR_SPACE_COUNT] = {ZR_SPACE_WORDS(TEXT)};

const struct zr_names zr_channel_names = ZR_NAMES(ZR_CHANNEL_COUNT, channels);
const struct zr_names zr_encoding_names = ZR_NAMES(ZR_ENCODING_COUNT, encodings);
const struct zr_names zr_space_names = ZR_NAMES(ZR_SPACE_COUNT, spaces);

struct zr_names_text zr_channel_encodings_join(enum zr_channel channel)
{
    const struct zr_channel_row *row = &zr_channel_rows[channel];
    const char *words[ZR_ENCODING_COUNT];
    for (int i = 0; i < row->encoding_count; i++)
        words[i] = encodings[row->encodings[i]];
    return zr_names_join(&(struct zr_names){row->encoding_count, row->encoding_count, words, NULL});
}

struct zr_names_text zr_encodings_having(unsigned property)
{
    struct zr_names_text text = {""};
    int left = 0;
    for (int i = 0; i < ZR_ENCODING_COUNT; i++)
        left += zr_encoding_has((enum zr_encoding)i, property);
    for (int i = 0, count = left; i < ZR_ENCODING_COUNT; i++) {
        if (!zr_encoding_has((enum zr_encoding)i, property)) continue;
        const size_t used = strlen(text.text);
        snprintf(text.text + used, sizeof text.text - used, "%s%s",
                 left == count ? ""
                 : left == 1   ? " and "
                               : ", ",
                 encodings[i]);
        left--;
    }
    return text;
}

bool zr_outputs_clash(const struct zr_output *a, const struct zr_output *b)
{
    return a->channel == b->channel &&
           strcmp(zr_encoding_rows[a->encoding].ending, zr_encoding_rows[b->encoding].ending) == 0;
}
