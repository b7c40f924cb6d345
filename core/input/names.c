#include "input/names.h"

#include <stdio.h>
#include <string.h>

#include "input/text.h"
#include "scene/scene.h"

static const char *const shadings[] = {"unlit", "flat", "gouraud", "phong", "normals"};
static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
static const char *const algorithms[] = {"halfspace", "edgelist", "trapezoid", "scanline", "painter"};
static const char *const compressions[] = {"fast", "small"};

const struct zr_names zr_shading_names = ZR_NAMES(ZR_SHADING_COUNT, shadings);
const struct zr_names zr_preset_names = ZR_NAMES(ZR_PRESET_COUNT, presets);
const struct zr_names zr_algorithm_names = ZR_NAMES(ZR_ALGORITHM_COUNT, algorithms);
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
    zr_error_add(error, ZR_BAD_REQUEST, NULL, "query parameter %s: %s is %s; allowed: %s", parameter,
                 zr_quote(word, strlen(word)).text, found < 0 ? "unknown" : "not supported in this version",
                 zr_names_join(names).text);
    return -1;
}

struct zr_names_text zr_names_join(const struct zr_names *names)
{
    struct zr_names_text joined = {""};
    size_t used = 0;
    for (int i = 0; i < names->count && used < sizeof joined.text; i++) {
        int length = snprintf(joined.text + used, sizeof joined.text - used, "%s%s", i ? ", " : "", names->words[i]);
        used += (size_t)length;
    }
    return joined;
}
