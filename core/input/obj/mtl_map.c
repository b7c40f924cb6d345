/* Reads the options and the name of a map: map_Kd -s 2 2 1 -o 0.5 0 0 oak planks.png */
#include <string.h>

#include "input/files/file_parts.h"
#include "input/obj/mtl_file.h"
#include "input/text/number.h"
#include "scene/texture.h"

/* Magnitude of -bm, as of normals of glTF. */
#define STRENGTH_MAX 1000.0f

struct option {
    const char *word;
    int words;     /* number of words after it; NUMBERS: up to three numbers */
    bool is_noted; /* not drawn */
};
enum { NUMBERS = -1, NAME_MAX_BYTES = 4096 };

static const struct option options[] = {{"-s", NUMBERS, false}, {"-o", NUMBERS, false},  {"-bm", 1, false},
                                        {"-clamp", 1, false},   {"-blendu", 1, false},   {"-blendv", 1, false},
                                        {"-texres", 1, false},  {"-boost", 1, false},    {"-cc", 1, false},
                                        {"-imfchan", 1, true},  {"-mm", 2, true},        {"-t", NUMBERS, true},
                                        {"-type", 1, true},     {"-colorspace", 1, true}};
enum { SCALE, OFFSET, STRENGTH, CLAMP };

static const struct option *find_option(const struct zr_mtl_text *word)
{
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (zr_mtl_is_word(word, options[i].word)) return &options[i];
    return NULL;
}

static bool read_number(const struct zr_mtl_text *word, float *out)
{
    double value;
    if (zr_number_read(word->at, word->end, &value) != word->end || !(value >= -1e30 && value <= 1e30)) return false;
    *out = (float)value;
    return true;
}

/* Reads up to three numbers. The last word of the line is always the file's name. */
static int read_numbers(struct zr_mtl_text *line, float out[3])
{
    int count = 0;
    while (count < 3) {
        struct zr_mtl_text behind = *line;
        const struct zr_mtl_text word = zr_mtl_word(&behind);
        if (behind.at == behind.end || !read_number(&word, &out[count])) break;
        count++;
        *line = behind;
    }
    return count;
}

static bool is_within(const float v[3], int count, float most)
{
    for (int k = 0; k < count; k++)
        if (!(v[k] >= -most && v[k] <= most)) return false;
    return count > 0;
}

/* False if the option's value is invalid. */
static bool read_option(struct zr_mtl_text *line, const struct option *option, struct zr_mtl_given_map *out)
{
    float v[3] = {0, 0, 0};
    if (option->words == NUMBERS) {
        const bool is_scale = option == &options[SCALE];
        const int count = read_numbers(line, v);
        if (option->is_noted) return true;
        if (!is_within(v, count, ZR_TEXCOORD_MAX)) return false;
        if (is_scale) out->scale[1] = 1.0f;
        memcpy(is_scale ? out->scale : out->offset, v, (size_t)(count < 2 ? count : 2) * sizeof *v);
        return true;
    }
    for (int k = 0; k < option->words; k++) {
        const struct zr_mtl_text word = zr_mtl_word(line);
        if (option == &options[CLAMP]) out->is_clamped = zr_mtl_is_word(&word, "on");
        if (option == &options[STRENGTH] && (!read_number(&word, v) || !is_within(v, 1, STRENGTH_MAX))) return false;
        if (option == &options[STRENGTH]) out->strength = v[0];
    }
    return true;
}

/* Some programs write names in quotes. */
static struct zr_mtl_text unquote(struct zr_mtl_text name)
{
    if (name.end - name.at < 2 || *name.at != '"' || name.end[-1] != '"') return name;
    name.at++;
    name.end--;
    return name;
}

const struct zr_asset *zr_mtl_find_file(struct zr_mtl *mtl, const struct zr_mtl_text *given)
{
    const struct zr_mtl_text plain = unquote(*given), *name = &plain;
    const size_t length = (size_t)(name->end - name->at);
    char text[NAME_MAX_BYTES + 1];
    if (length == 0 || length > NAME_MAX_BYTES || memchr(name->at, '\0', length)) return NULL;
    memcpy(text, name->at, length);
    text[length] = '\0';
    const struct zr_asset *asset = zr_file_part_find(&mtl->assets, mtl->arena, text);
    return asset && asset->array.type == ZR_BYTES ? asset : NULL;
}

void zr_mtl_read_map(struct zr_mtl *mtl, const struct zr_mtl_text *whole, struct zr_mtl_text line,
                     struct zr_mtl_given_map *out)
{
    struct zr_mtl_given_map map = {.is_given = true, .whole = *whole, .scale = {1, 1}, .strength = 1};
    while (line.at < line.end) {
        struct zr_mtl_text behind = line;
        const struct zr_mtl_text word = zr_mtl_word(&behind);
        const struct option *option = find_option(&word);
        if (!option) break;
        if (option->is_noted) zr_mtl_note(mtl, ZR_MTL_NOTE_OPTION, whole);
        if (!read_option(&behind, option, &map)) zr_mtl_note(mtl, ZR_MTL_NOTE_BAD_VALUE, whole);
        line = behind;
    }
    map.name = line;
    if (line.at == line.end)
        zr_mtl_note(mtl, ZR_MTL_NOTE_BAD_VALUE, whole);
    else
        *out = map;
}
