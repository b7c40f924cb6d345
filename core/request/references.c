/* references.c - request: lists the files that a model file refers to. */
#include <string.h>
#include <strings.h>

#include "core.h"
#include "input/files/assets.h"
#include "input/formats/formats.h"
#include "input/formats/sniff.h"
#include "input/json/json.h"
#include "input/text/text.h"

/* LINE_MAX: bytes of a line with names; the rest of a longer one is not read. NAMES_MAX: bytes of names with
 * escapes. */
enum { LINE_MAX = 64 << 10, NAMES_MAX = 64 << 20 };

struct list {
    char *out;
    size_t room, used; /* `used` counts all names; may exceed `room` */
};

static bool begins_with(const char *at, const char *end, const char *word)
{
    const size_t length = strlen(word);
    return (size_t)(end - at) >= length && strncasecmp(at, word, length) == 0;
}

/* True for data: URIs, other URIs that name a scheme, and the hashes of stored assets. */
static bool is_no_file(const char *at, const char *end)
{
    if (begins_with(at, end, "data:") || begins_with(at, end, "sha256:")) return true;
    const char *scheme = memmem(at, (size_t)(end - at), "://", 3);
    return scheme && scheme - at < 16;
}

static void add(struct list *list, const char *at, const char *end)
{
    const size_t length = (size_t)(end - at);
    if (length == 0 || is_no_file(at, end) || memchr(at, '\0', length)) return;
    if (list->used <= list->room && length < list->room - list->used) {
        memcpy(list->out + list->used, at, length);
        list->out[list->used + length] = '\0';
    }
    list->used += length + 1;
}

/* ---- lines of OBJ and MTL ---- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

static const char *skip_blanks(const char *at, const char *end)
{
    while (at < end && is_blank(*at))
        at++;
    return at;
}

static const char *skip_word(const char *at, const char *end)
{
    while (at < end && !is_blank(*at))
        at++;
    return at;
}

/* Returns the end of the line, without trailing blanks. */
static const char *end_of_line(const char *at, const char *end)
{
    if (end - at > LINE_MAX) end = at + LINE_MAX;
    const char *line = memchr(at, '\n', (size_t)(end - at));
    const char *cut = memchr(at, '\r', (size_t)((line ? line : end) - at));
    if (cut) line = cut;
    if (!line) line = end;
    while (line > at && is_blank(line[-1]))
        line--;
    return line;
}

/* Adds each word of a line; of several words also all together, since names may have blanks. */
static void add_words(struct list *list, const char *at, const char *end)
{
    const char *first = skip_blanks(at, end);
    if (skip_word(first, end) < end) add(list, first, end);
    for (at = first; at < end; at = skip_blanks(at, end)) {
        const char *word = at;
        at = skip_word(at, end);
        add(list, word, at);
    }
}

/* True if a line, after blanks, begins at `at`. */
static bool begins_line(const char *bytes, const char *at)
{
    while (at > bytes && (at[-1] == ' ' || at[-1] == '\t'))
        at--;
    return at == bytes || at[-1] == '\n' || at[-1] == '\r';
}

/* Searches for the letter b, which is rare in OBJ: memchr is ten times as fast as memmem. */
static void list_obj(struct list *list, const char *bytes, const char *end)
{
    static const char word[] = "mtllib";
    enum { LENGTH = sizeof word - 1 };
    for (const char *at = bytes; at < end && (at = memchr(at, 'b', (size_t)(end - at))) != NULL;) {
        const char *begin = ++at - bytes < LENGTH ? at : at - LENGTH;
        if (at < end && is_blank(*at) && at - begin == LENGTH && memcmp(begin, word, LENGTH) == 0 &&
            begins_line(bytes, begin))
            add_words(list, at, end_of_line(at, end));
    }
}

/* Options of maps, and the most values of each. Values of -o, -s and -t after the first may be left out. */
static const struct {
    const char *name;
    int least, most;
} map_options[] = {{"-blendu", 1, 1},  {"-blendv", 1, 1}, {"-boost", 1, 1},  {"-mm", 2, 2},        {"-o", 1, 3},
                   {"-s", 1, 3},       {"-t", 1, 3},      {"-texres", 1, 1}, {"-clamp", 1, 1},     {"-bm", 1, 1},
                   {"-imfchan", 1, 1}, {"-type", 1, 1},   {"-cc", 1, 1},     {"-colorspace", 1, 1}};

/* True if a word is a number such as -0.5. */
static bool is_number(const char *at, const char *end)
{
    bool has_digit = false;
    for (; at < end; at++) {
        has_digit |= *at >= '0' && *at <= '9';
        if (!memchr("0123456789+-.eE", *at, 15)) return false;
    }
    return has_digit;
}

/* Returns the first byte after the option at `at`; `at` itself if it is none. */
static const char *skip_option(const char *at, const char *end)
{
    const char *word_end = skip_word(at, end);
    const size_t length = (size_t)(word_end - at);
    for (size_t i = 0; i < sizeof map_options / sizeof *map_options; i++) {
        if (strlen(map_options[i].name) != length || strncasecmp(map_options[i].name, at, length) != 0) continue;
        at = skip_blanks(word_end, end);
        for (int k = 0; k < map_options[i].most && at < end; k++) {
            const char *value_end = skip_word(at, end);
            if (k >= map_options[i].least && !is_number(at, value_end)) break;
            at = skip_blanks(value_end, end);
        }
        return at;
    }
    return at;
}

static bool is_map(const char *at, const char *end)
{
    static const char *const words[] = {"bump", "disp", "norm", "decal", "refl"};
    if (begins_with(at, end, "map_")) return true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if ((size_t)(end - at) == strlen(words[i]) && begins_with(at, end, words[i])) return true;
    return false;
}

static void list_mtl(struct list *list, const char *bytes, const char *end)
{
    for (const char *at = bytes; at < end;) {
        const char *line_end = end_of_line(at, end), *word = skip_blanks(at, line_end);
        const char *word_end = skip_word(word, line_end);
        if (is_map(word, word_end)) {
            const char *name = skip_blanks(word_end, line_end), *next;
            while ((next = skip_option(name, line_end)) != name)
                name = next;
            add(list, name, line_end);
        }
        at = line_end;
        while (at < end && *at != '\n' && *at != '\r')
            at++;
        at += at < end;
    }
}

/* ---- JSON ---- */

/* Adds a name that ends with `ending`. */
static void add_string(struct list *list, struct zr_json *json, const char *ending)
{
    struct zr_json_text text;
    const size_t length = strlen(ending);
    if (!zr_json_take_string(json, &text)) return;
    const char *name = text.has_escapes ? zr_json_decode(json, &text) : NULL;
    if (text.has_escapes && !name) return;
    const char *at = name ? name : text.at, *end = name ? name + strlen(name) : text.end;
    if ((size_t)(end - at) >= length && memcmp(end - length, ending, length) == 0) add(list, at, end);
}

/* glTF: lists the key "uri" of the items of "buffers" and "images". */
static void list_uris(struct list *list, struct zr_json *json)
{
    struct zr_json_text key;
    for (zr_json_enter(json, '['); zr_json_item(json);) {
        if (zr_json_type(json) != ZR_JSON_OBJECT) {
            zr_json_skip(json);
            continue;
        }
        for (zr_json_enter(json, '{'); zr_json_member(json, &key);)
            if (zr_json_is(&key, "uri") && zr_json_type(json) == ZR_JSON_STRING)
                add_string(list, json, "");
            else
                zr_json_skip(json);
    }
}

static void list_gltf(struct list *list, struct zr_json *json)
{
    struct zr_json_text key;
    for (zr_json_enter(json, '{'); zr_json_member(json, &key);)
        if ((zr_json_is(&key, "buffers") || zr_json_is(&key, "images")) && zr_json_type(json) == ZR_JSON_LIST)
            list_uris(list, json);
        else
            zr_json_skip(json);
}

/* Scenes: lists the key "asset", and an image of the key "environment", anywhere. A list that begins with a number has
 * none. */
static void list_assets(struct list *list, struct zr_json *json)
{
    struct zr_json_text key;
    const enum zr_json_type type = zr_json_type(json);
    struct zr_json inside = *json;
    if (type == ZR_JSON_OBJECT) {
        for (zr_json_enter(json, '{'); zr_json_member(json, &key);)
            if (zr_json_is(&key, "asset") && zr_json_type(json) == ZR_JSON_STRING)
                add_string(list, json, "");
            else if (zr_json_is(&key, "environment") && zr_json_type(json) == ZR_JSON_STRING)
                add_string(list, json, ZR_ENVIRONMENT_ENDING);
            else
                list_assets(list, json);
    } else if (type == ZR_JSON_LIST && zr_json_enter(&inside, '[') && zr_json_type(&inside) != ZR_JSON_NUMBER) {
        for (zr_json_enter(json, '['); zr_json_item(json);)
            list_assets(list, json);
    } else {
        zr_json_skip(json);
    }
}

/* Reads a text of JSON as far as it is well-formed. Without memory, names are missing. */
static void list_json(struct list *list, const char *bytes, size_t size, void (*read)(struct list *, struct zr_json *))
{
    static const struct zr_limits limits = {.json_depth_max = ZR_JSON_DEPTH_MAX};
    struct zr_arena arena;
    struct zr_error error = {0};
    struct zr_json json = {.arena = &arena, .limits = &limits, .error = &error};
    zr_arena_init(&arena, NAMES_MAX);
    const size_t mark = zr_byte_order_mark(bytes, size);
    zr_json_open(&json, bytes + mark, size - mark);
    read(list, &json);
    zr_arena_free(&arena);
}

static uint32_t read_u32(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* The JSON of binary glTF is its first chunk. */
static void list_glb(struct list *list, const char *bytes, size_t size)
{
    enum { JSON_AT = 20 };
    if (size < JSON_AT) return;
    const uint32_t length = read_u32(bytes + JSON_AT - 8);
    const size_t room = size - JSON_AT;
    list_json(list, bytes + JSON_AT, length < room ? length : room, list_gltf);
}

/* ---- interface ---- */

static bool is_type(const char *type, const char *name)
{
    return type && strcasecmp(type, name) == 0;
}

static enum zr_format find_format(const char *type, const char *bytes, size_t size)
{
    for (int i = 0; type && i < ZR_FORMAT_COUNT; i++)
        if (strcasecmp(type, zr_format_rows[i].suffix) == 0) return (enum zr_format)i;
    const enum zr_format format = zr_format_of_type(type);
    if (format != ZR_FORMAT_UNKNOWN || !zr_media_type_is_generic(type)) return format;
    return zr_format_of_bytes(bytes, size);
}

size_t zr_references_list(const char *bytes, size_t size, const char *type, char *names, size_t room)
{
    static const char asset[] = "\"asset\"";
    struct list list = {.out = names, .room = room};
    if (size == 0) return 0;
    if (is_type(type, "mtl") || is_type(type, "model/mtl")) {
        list_mtl(&list, bytes, bytes + size);
        return list.used;
    }
    switch (find_format(type, bytes, size)) {
    case ZR_FORMAT_OBJ:
        list_obj(&list, bytes, bytes + size);
        break;
    case ZR_FORMAT_GLTF:
        list_json(&list, bytes, size, list_gltf);
        break;
    case ZR_FORMAT_GLB:
        list_glb(&list, bytes, size);
        break;
    case ZR_FORMAT_JSON:
        if (zr_looks_so_GLTF(bytes, size))
            list_json(&list, bytes, size, list_gltf);
        else if (memmem(bytes, size, asset,
                        sizeof asset - 1) || /* most large scenes have none: they are not read twice */
                 memmem(bytes, size, ZR_ENVIRONMENT_ENDING, sizeof ZR_ENVIRONMENT_ENDING - 1))
            list_json(&list, bytes, size, list_assets);
        break;
    default:
        break;
    }
    return list.used;
}
