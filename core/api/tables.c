/* tables.c - api: parameters, keys of scenes, looks, channels, encodings, formats and limits as JSON, for programs
 * that offer them as options; and the schema of scenes. */
#include <stdlib.h>
#include <string.h>

#include "api/renderer.h"
#include "input/formats/formats.h"
#include "input/scene/json_objects.h"
#include "input/scene/outputs.h"
#include "output/json/json_print.h"
#include "parameter_rows.h"
#include "scene/looks.h"
#include "scene/encodings.h"
#include "scene/shadings.h"
#include "schema/schema.h"

static const struct {
    const char *name, *key, *bodies, *value, *help;
} parameters[] = {
#define ANY                               "all"
#define MESH                              "mesh"
#define ROW(name, key, scope, kind, help) {#name, key, scope, #kind, help},
    ZR_PARAMETER_ROWS(ROW)
#undef ROW
#undef ANY
#undef MESH
};

static void print_parameters(struct zr_print *print)
{
    zr_print_begin(print, "parameters", '[');
    for (size_t i = 0; i < sizeof parameters / sizeof *parameters; i++) {
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "name", parameters[i].name);
        zr_print_string(print, "key", parameters[i].key);
        zr_print_string(print, "bodies", parameters[i].bodies);
        zr_print_string(print, "value", parameters[i].value);
        zr_print_string(print, "help", parameters[i].help);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static void print_keys(struct zr_print *print)
{
    const struct zr_json_object *scene = &zr_json_object_scene;
    zr_print_begin(print, "keys", '[');
    for (size_t i = 0; i < scene->count; i++) {
        if (!scene->fields[i].read) continue;
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "name", scene->fields[i].key);
        zr_print_string(print, "help", scene->fields[i].text);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static void print_looks(struct zr_print *print)
{
    zr_print_begin(print, "looks", '[');
    for (int i = 0; i < zr_look_count; i++)
        zr_print_string(print, NULL, zr_look_pin_of(&zr_looks[i]).text);
    zr_print_end(print, ']');
}

static void print_channels(struct zr_print *print)
{
    zr_print_begin(print, "channels", '[');
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        const struct zr_channel_row *row = &zr_channel_rows[c];
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "name", row->name);
        zr_print_begin(print, "encodings", '[');
        for (int k = 0; k < row->encoding_count; k++)
            zr_print_string(print, NULL, zr_encoding_names.words[row->encodings[k]]);
        zr_print_end(print, ']');
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static void print_encodings(struct zr_print *print)
{
    zr_print_begin(print, "encodings", '[');
    for (int i = 0; i < ZR_ENCODING_COUNT; i++) {
        const struct zr_encoding_row *row = &zr_encoding_rows[i];
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "name", row->word);
        zr_print_string(print, "suffix", row->ending);
        if (*row->spelling) zr_print_string(print, "spelling", row->spelling);
        zr_print_string(print, "type", row->type);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static void print_formats(struct zr_print *print)
{
    zr_print_begin(print, "formats", '[');
    for (int i = 0; i < ZR_FORMAT_COUNT; i++) {
        const struct zr_format_row *row = &zr_format_rows[i];
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "name", row->name);
        zr_print_string(print, "suffix", row->suffix);
        zr_print_string(print, "types", row->media_types);
        zr_print_bool(print, "isScene", row->has_view);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

/* ---- words: values of keys with their meaning ---- */

static void print_word(struct zr_print *print, const char *kind, const char *name, const char *text)
{
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "kind", kind);
    zr_print_string(print, "name", name);
    zr_print_string(print, "text", text);
    zr_print_end(print, '}');
}

static void print_words(struct zr_print *print)
{
#define TEXT(ID, word, text, ...) text,
    static const char *const shading_texts[] = {ZR_SHADINGS(TEXT)};
#undef TEXT
    zr_print_begin(print, "words", '[');
    for (int i = 0; i < ZR_CHANNEL_COUNT; i++)
        print_word(print, "channel", zr_channel_rows[i].name, zr_channel_rows[i].text);
    for (int i = 0; i < ZR_ENCODING_COUNT; i++)
        print_word(print, "encoding", zr_encoding_rows[i].word, zr_encoding_rows[i].text);
    for (int i = 0; i < ZR_SPACE_COUNT; i++)
        print_word(print, "space", zr_space_names.words[i], zr_space_texts[i]);
    for (int i = 0; i < zr_look_count; i++)
        if (zr_looks[i].text) print_word(print, "look", zr_looks[i].name, zr_looks[i].text);
    for (int i = 0; i < ZR_SHADING_COUNT; i++)
        print_word(print, "shading", zr_shading_names.words[i], shading_texts[i]);
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        print_word(print, "format", zr_format_rows[i].suffix, zr_format_rows[i].text);
    zr_print_end(print, ']');
}

static void print_limits(struct zr_print *print, const zraster *renderer)
{
    const struct zr_limits *limits = &renderer->limits;
    zr_print_begin(print, "limits", '{');
    zr_print_count(print, "memoryMax", renderer->memory_max);
    zr_print_count(print, "windowSideMax", limits->window_side_max);
    zr_print_count(print, "windowPixelsMax", limits->window_pixels_max);
    zr_print_count(print, "imagePixelsMax", limits->image_pixels_max);
    zr_print_count(print, "instancesMax", limits->instances_max);
    zr_print_end(print, '}');
}

static void print_tables(const zraster *renderer, struct zr_buffer *out)
{
    struct zr_print print = {.out = out};
    zr_print_begin(&print, NULL, '{');
    print_parameters(&print);
    print_keys(&print);
    print_looks(&print);
    print_channels(&print);
    print_encodings(&print);
    print_formats(&print);
    print_words(&print);
    print_limits(&print, renderer);
    zr_print_end(&print, '}');
}

static void print_schema(const zraster *renderer, struct zr_buffer *out)
{
    zr_schema_print(out, &renderer->limits, NULL, NULL);
}

/* Returns a text in malloc'd memory, or NULL. */
static char *make(const zraster *renderer, void (*print)(const zraster *renderer, struct zr_buffer *out))
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 24);
    struct zr_buffer out = {.arena = &arena};
    print(renderer, &out);
    char *text = zr_buffer_add(&out, "", 1) && zr_arena_ok(&arena) ? strdup((const char *)out.bytes) : NULL;
    zr_arena_free(&arena);
    return text;
}

/* Returns the text at `place`, made if it is not there yet. */
static const char *text_at(zraster *renderer, _Atomic(char *) *place,
                           void (*print)(const zraster *renderer, struct zr_buffer *out))
{
    char *there = atomic_load(place);
    if (there) return there;
    char *made = make(renderer, print);
    if (!made || atomic_compare_exchange_strong(place, &there, made)) return made;
    free(made); /* another thread was first */
    return there;
}

const char *zraster_tables(zraster *renderer)
{
    return text_at(renderer, &renderer->tables, print_tables);
}

const char *zraster_schema(zraster *renderer)
{
    return text_at(renderer, &renderer->schema, print_schema);
}
