/* Distinguishes scenes in JSON from glTF in JSON. */
#include <string.h>

#include "input/formats/input.h"
#include "input/json/json.h"
#include "input/text/text.h"

/* True if `at` begins `word` as a string, followed by a colon. */
static bool is_key(const char *at, const char *end, const char *word)
{
    const size_t length = strlen(word);
    if ((size_t)(end - at) < length + 2 || memcmp(at + 1, word, length) != 0 || at[length + 1] != '"') return false;
    at = zr_json_skip_space(at + length + 2, end);
    return at < end && *at == ':';
}

/* Returns the end of the string at `at`, or `end`. */
static const char *skip_string(const char *at, const char *end)
{
    for (at++; at < end && *at != '"'; at++)
        at += *at == '\\';
    return at < end ? at + 1 : end;
}

/* True if the root has one of the keys, in the first ZR_BLANKS_MAX bytes. */
static bool has_key(const char *bytes, size_t size, const char *const *words, size_t count)
{
    const char *at = bytes + zr_count_blanks(bytes, size), *const end =
                                                               bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX);
    int depth = 0;
    if (at >= end || *at != '{') return false;
    while (at < end) {
        if (*at == '"') {
            for (size_t i = 0; depth == 1 && i < count; i++)
                if (is_key(at, end, words[i])) return true;
            at = skip_string(at, end);
            continue;
        }
        depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
        at++;
    }
    return false;
}

/* True if the root has a key of glTF that is no key of scenes. */
bool zr_looks_so_GLTF(const char *bytes, size_t size)
{
    static const char *const words[] = {"asset", "accessors", "bufferViews", "buffers", "scenes"};
    return has_key(bytes, size, words, sizeof words / sizeof *words);
}

bool zr_has_geometry_key(const char *bytes, size_t size)
{
    static const char *const words[] = {"meshes", "polygons"};
    return has_key(bytes, size, words, sizeof words / sizeof *words);
}

/* A scene is always an object. Lists also count as JSON, for a better message. */
bool zr_looks_so_JSON(const char *bytes, size_t size)
{
    const size_t blanks = zr_count_blanks(bytes, size);
    return blanks < size && (bytes[blanks] == '{' || bytes[blanks] == '[') && !zr_looks_so_GLTF(bytes, size);
}
