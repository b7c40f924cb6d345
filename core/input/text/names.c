#include "input/text/names.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "input/text/nearest.h"
#include "input/text/text.h"
#include "parameter_kinds.h"
#include "scene/algorithm.h"
#include "scene/camera/mesh_up.h"
#include "scene/colormap.h"
#include "scene/light_types.h"
#include "scene/looks.h"

#define WORD(ID, word, ...) word,
static const char *const shadings[] = {ZR_SHADINGS(WORD)};
#undef WORD
#define WORD(ID, word) word,
static const char *const algorithms[] = {ZR_ALGORITHMS(WORD)};
#undef WORD
#define WORD(ID, word, ...) word,
static const char *const lights[] = {ZR_LIGHT_ROWS(WORD)};
#undef WORD
static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
static const char *const axes[] = {"y", "z"};
static const char *const annotations[] = {ZR_ANNOTATE_WORDS};
static const char *const mesh_axes[] = {"x", "-x", "y", "-y", "z", "-z", "auto"};
static const char *const colormaps[] = {"viridis", "turbo", "gray", "coolwarm"};
static const char *const compressions[] = {"fast", "small"};

const struct zr_names zr_shading_names = ZR_NAMES(ZR_SHADING_COUNT, shadings);

static const char *const alpha_modes[] = {"OPAQUE", "MASK", "BLEND"};
const struct zr_names zr_alpha_mode_names = ZR_NAMES(ZR_ALPHA_NAMES, alpha_modes);
const struct zr_names zr_preset_names = ZR_NAMES(ZR_PRESET_COUNT, presets);
const struct zr_names zr_algorithm_names = ZR_NAMES(ZR_ALGORITHM_COUNT, algorithms);
const struct zr_names zr_light_names = ZR_NAMES(ZR_LIGHT_TYPE_COUNT, lights);
const struct zr_names zr_up_names = ZR_NAMES(2, axes);
const struct zr_names zr_annotation_names = ZR_NAMES(ZR_ANNOTATE_COUNT, annotations);
const struct zr_names zr_mesh_up_names = ZR_NAMES(ZR_MESH_UP_COUNT, mesh_axes);
const struct zr_names zr_colormap_names = ZR_NAMES(ZR_COLORMAP_COUNT, colormaps);
const struct zr_names zr_compress_names = ZR_NAMES(ZR_COMPRESS_COUNT, compressions);

int zr_names_find(const struct zr_names *names, const char *word)
{
    for (int i = 0; i < names->all; i++)
        if (strcmp(names->words[i], word) == 0) return i;
    return -1;
}

int zr_names_of_query(const char *parameter, const struct zr_names *names, const char *word, struct zr_error *error)
{
    int found = zr_names_find(names, word);
    if (found >= 0 && found < names->count) return found;
    zr_error_add(error, ZR_BAD_REQUEST, NULL, "parameter %s: %s", parameter, zr_names_refuse(names, word).text);
    return -1;
}

struct zr_names_refusal zr_names_refuse(const struct zr_names *names, const char *word)
{
    const bool is_known = zr_names_find(names, word) >= 0;
    struct zr_names_refusal refusal;
    struct zr_nearest nearest = {.word = word};
    for (int i = 0; !is_known && i < names->count; i++)
        zr_nearest_offer(&nearest, names->words[i]);
    snprintf(refusal.text, sizeof refusal.text, "%s is %s%s; allowed: %.200s", zr_quote(word, strlen(word)).text,
             !is_known       ? "unknown"
             : names->others ? names->others
                             : "not supported in this version",
             zr_nearest_text(&nearest).text, zr_names_join(names).text);
    return refusal;
}

/* Returns whether `word` is the look's name, followed by @. */
static bool has_name_of(const char *word, const struct zr_look *look)
{
    const size_t length = strlen(look->name);
    return strncmp(word, look->name, length) == 0 && word[length] == '@';
}

/* Refuses an unknown version of a look. False: `word` is the name of no look, followed by @. */
static bool refuse_version(const char *word, struct zr_names_refusal *refusal)
{
    const char *name = NULL;
    struct zr_names_text versions = {""};
    for (int i = 0; i < zr_look_count; i++) {
        if (!has_name_of(word, &zr_looks[i])) continue;
        name = zr_looks[i].name;
        zr_names_text_add(&versions, zr_look_pin_of(&zr_looks[i]).text);
    }
    if (!name) return false;
    snprintf(refusal->text, sizeof refusal->text, "%s is unknown; versions of %s: %.200s",
             zr_quote(word, strlen(word)).text, name, versions.text);
    return true;
}

/* Versions of a look are adjacent and share a name, which is listed once. */
struct zr_names_refusal zr_looks_refuse(const char *word)
{
    struct zr_names_refusal refusal;
    if (refuse_version(word, &refusal)) return refusal;
    enum { NAMES_MOST = 64 };
    const char *words[NAMES_MOST];
    struct zr_names names = {.words = words};
    for (int i = 0; i < zr_look_count && names.count < NAMES_MOST; i++)
        if (names.count == 0 || strcmp(words[names.count - 1], zr_looks[i].name) != 0)
            words[names.count++] = zr_looks[i].name;
    names.all = names.count;
    refusal = zr_names_refuse(&names, word);
    const size_t used = strlen(refusal.text);
    snprintf(refusal.text + used, sizeof refusal.text - used, "; or one of these with @ and a version that it has");
    return refusal;
}

struct zr_names_text zr_names_join(const struct zr_names *names)
{
    struct zr_names_text joined = {""};
    for (int i = 0; i < names->count; i++)
        zr_names_text_add(&joined, names->words[i]);
    return joined;
}

struct zr_names_text zr_names_join_set(const struct zr_names *names, uint32_t set)
{
    struct zr_names_text joined = {""};
    for (int i = 0; i < names->count; i++)
        if (set >> i & 1u) zr_names_text_add(&joined, names->words[i]);
    return joined;
}

void zr_names_text_add(struct zr_names_text *text, const char *word)
{
    const size_t used = strlen(text->text);
    snprintf(text->text + used, sizeof text->text - used, "%s%s", used ? ", " : "", word);
}
