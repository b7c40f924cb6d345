/* Textures, composite materials and multiproperties of 3MF. Source: Materials and Properties 1.2.1. */
#include "input/threemf/threemf_file.h"
#include "scene/texture.h"

enum { LAYERS_MAX = 16 };

#define WHITE 0xFFFFFFFFu

/* True if the current element has this name, in the namespace of materials or of the core, as some programs write. */
static bool is_child(const struct zr_threemf *file, const char *name)
{
    return zr_threemf_is(file, ZR_THREEMF_SPACE_MATERIAL, name) || zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, name);
}

/* ---- texture2d ---- */

/* Returns the index of an attribute's word; 0 without the attribute; -1 after a fault. */
static int read_word(struct zr_threemf *file, const char *name, const char *const *words, int count)
{
    const struct zr_xml_text value = zr_xml_value(&file->tag, name);
    if (!value.at) return 0;
    for (int i = 0; i < count; i++)
        if (zr_xml_text_is(value, words[i])) return i;
    zr_threemf_fault(file, file->tag.at, "%s: %s is not known", name, zr_quote(value.at, value.length).text);
    return -1;
}

void zr_threemf_read_texture(struct zr_threemf *file)
{
    static const char *const tiles[] = {"wrap", "mirror", "clamp", "none"}, *const filters[] = {"auto", "linear",
                                                                                                "nearest"};
    static const enum zr_wrap wraps[] = {ZR_WRAP_REPEAT, ZR_WRAP_MIRROR, ZR_WRAP_CLAMP, ZR_WRAP_CLAMP};
    struct zr_threemf_resource *texture = zr_threemf_add(file, ZR_THREEMF_TEXTURE);
    if (!texture) return;
    const struct zr_xml_text path = zr_xml_value(&file->tag, "path");
    const int u = read_word(file, "tilestyleu", tiles, 4), v = read_word(file, "tilestylev", tiles, 4);
    const int filter = read_word(file, "filter", filters, 3);
    if (!path.at) zr_threemf_fault(file, file->tag.at, "the attribute path is missing");
    if (!path.at || u < 0 || v < 0 || filter < 0) return;
    texture->image = zr_threemf_find_member(file, path);
    texture->wrap_s = (int)wraps[u];
    texture->wrap_t = (int)wraps[v];
    texture->ends = u == 3 || v == 3;
    texture->filter = (int)(filter == 2 ? ZR_FILTER_NEAREST : ZR_FILTER_LINEAR);
}

/* ---- groups ---- */

/* Sets the values of a group. Takes the group's number, since groups move as their list grows. */
static void set_values(struct zr_threemf *file, uint32_t group, const struct zr_threemf_list *values)
{
    zr_threemf_resources(file)[group].values = values->items;
    zr_threemf_resources(file)[group].value_count = values->count;
}

static bool read_coordinate(struct zr_threemf *file, const char *name, float *out)
{
    const double most = (double)ZR_TEXCOORD_MAX;
    const struct zr_xml_text value = zr_xml_value(&file->tag, name);
    double number = 0.0;
    if (!value.at) return zr_threemf_fault(file, file->tag.at, "the attribute %s is missing", name);
    if (!zr_threemf_number(&file->xml, value, &number) || !(number >= -most && number <= most))
        return zr_threemf_fault(file, file->tag.at, "%s: a number within %g is needed, not %s", name, most,
                                zr_quote(value.at, value.length).text);
    *out = (float)number;
    return true;
}

void zr_threemf_read_coords(struct zr_threemf *file)
{
    struct zr_threemf_list values = {0};
    const size_t depth = file->xml.depth;
    uint32_t id = 0;
    const struct zr_threemf_resource *group = zr_threemf_add(file, ZR_THREEMF_COORDS);
    if (!group || !zr_threemf_count(file, "texid", true, &id)) return;
    const uint32_t number = file->resources.count - 1;
    const struct zr_threemf_resource *texture = zr_threemf_find(file, file->part, id);
    if (!texture || texture->kind != ZR_THREEMF_TEXTURE) {
        zr_threemf_fault(file, file->tag.at, "texid %u names no preceding texture2d", id);
        return;
    }
    const uint32_t of = (uint32_t)(texture - zr_threemf_resources(file));
    while (zr_threemf_child(file, depth)) {
        struct zr_threemf_value value = {WHITE, of, 0, 0};
        if (!is_child(file, "tex2coord")) continue;
        if (!read_coordinate(file, "u", &value.u) || !read_coordinate(file, "v", &value.v)) continue;
        if (value.u < 0.0f || value.u > 1.0f || value.v < 0.0f || value.v > 1.0f)
            zr_threemf_resources(file)[number].is_outside = true;
        struct zr_threemf_value *made = zr_threemf_list_add(file->arena, &values, sizeof *made);
        if (made) *made = value;
    }
    set_values(file, number, &values);
}

/* ---- lists of numbers ---- */

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Reads the next number of a list; false at its end or after a fault. */
static bool next_number(struct zr_threemf *file, struct zr_xml_text *list, const char *name, double *out)
{
    const char *const end = list->at + list->length;
    const char *at = list->at, *behind;
    while (at < end && is_blank(*at))
        at++;
    for (behind = at; behind < end && !is_blank(*behind);)
        behind++;
    const struct zr_xml_text word = {at, (size_t)(behind - at)};
    *list = (struct zr_xml_text){behind, (size_t)(end - behind)};
    if (word.length == 0) return false;
    if (zr_threemf_number(&file->xml, word, out) && *out >= 0.0 && *out < 4294967295.0) return true;
    return zr_threemf_fault(file, file->tag.at, "%s: numbers from 0 on are needed, not %s", name,
                            zr_quote(word.at, word.length).text);
}

/* Reads whole numbers; returns their count, at most LAYERS_MAX. */
static uint32_t read_indices(struct zr_threemf *file, const char *name, uint32_t *out)
{
    struct zr_xml_text list = zr_xml_value(&file->tag, name);
    uint32_t count = 0;
    double number;
    if (!list.at) {
        zr_threemf_fault(file, file->tag.at, "the attribute %s is missing", name);
        return 0;
    }
    while (next_number(file, &list, name, &number)) {
        if (count == LAYERS_MAX) {
            zr_threemf_fault(file, file->tag.at, "%s: more than %d", name, LAYERS_MAX);
            return 0;
        }
        out[count++] = (uint32_t)number;
    }
    return count;
}

/* ---- composite materials ---- */

/* Mixes the colours of materials by the shares of a composite. */
static uint32_t mix_composite(struct zr_threemf *file, const uint32_t *colors, uint32_t count)
{
    struct zr_xml_text list = zr_xml_value(&file->tag, "values");
    double sum[4] = {0}, all = 0.0, share;
    if (!list.at) zr_threemf_fault(file, file->tag.at, "the attribute values is missing");
    for (uint32_t i = 0; list.at && i < count && next_number(file, &list, "values", &share); i++) {
        all += share;
        for (int k = 0; k < 4; k++)
            sum[k] += share * (double)(colors[i] >> (8 * k) & 255);
    }
    uint32_t out = 0;
    for (int k = 0; k < 4; k++)
        out |= (uint32_t)(all > 0.0 ? sum[k] / all + 0.5 : (double)(colors[0] >> (8 * k) & 255)) << (8 * k);
    return out;
}

void zr_threemf_read_composites(struct zr_threemf *file)
{
    struct zr_threemf_list colors = {0};
    const size_t depth = file->xml.depth;
    uint32_t id = 0, indices[LAYERS_MAX], materials[LAYERS_MAX];
    if (!zr_threemf_add(file, ZR_THREEMF_COLORS) || !zr_threemf_count(file, "matid", true, &id)) return;
    const uint32_t number = file->resources.count - 1, count = read_indices(file, "matindices", indices);
    const struct zr_threemf_resource *base = zr_threemf_find(file, file->part, id);
    if (!base || base->kind != ZR_THREEMF_COLORS || !base->is_base) {
        zr_threemf_fault(file, file->tag.at, "matid %u names no preceding base materials", id);
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (indices[i] >= base->color_count) {
            zr_threemf_fault(file, file->tag.at, "matindices: %u, but there are %u materials", indices[i],
                             base->color_count);
            return;
        }
        materials[i] = base->colors[indices[i]];
    }
    if (count == 0) return;
    while (zr_threemf_child(file, depth)) {
        if (!is_child(file, "composite")) continue;
        const uint32_t mixed = mix_composite(file, materials, count);
        uint32_t *color = zr_threemf_list_add(file->arena, &colors, sizeof *color);
        if (color) *color = mixed;
    }
    zr_threemf_resources(file)[number].colors = colors.items;
    zr_threemf_resources(file)[number].color_count = colors.count;
}

/* ---- multiproperties ---- */

static uint32_t blend(uint32_t below, uint32_t above, bool multiplies)
{
    const unsigned alpha = above >> 24, alpha_below = below >> 24;
    uint32_t out = 0;
    for (int k = 0; k < 24; k += 8) {
        const unsigned a = above >> k & 255, b = below >> k & 255;
        out |= (multiplies ? (a * b + 127) / 255 : (a * alpha + b * (255 - alpha) + 127) / 255) << k;
    }
    return out | (multiplies ? (alpha * alpha_below + 127) / 255 : alpha + (alpha_below * (255 - alpha) + 127) / 255)
                     << 24;
}

/* Adds a layer to a value. Only a product of a colour and one texture can be drawn exactly. */
static void add_layer(struct zr_threemf *file, struct zr_threemf_value *value, const struct zr_threemf_value *layer,
                      bool multiplies)
{
    const bool has_both = value->texture != ZR_THREEMF_NONE && layer->texture != ZR_THREEMF_NONE;
    if ((has_both && multiplies) || (value->texture != ZR_THREEMF_NONE && layer->texture == ZR_THREEMF_NONE &&
                                     !multiplies && layer->color >> 24 < 255))
        zr_threemf_note(file, ZR_THREEMF_NOTE_LAYERS, file->tag.at, file->tag.name);
    if (layer->texture != ZR_THREEMF_NONE) {
        if (!multiplies && value->color >> 24 > 0) zr_threemf_resources(file)[layer->texture].is_over = true;
        const uint32_t color = multiplies ? blend(value->color, layer->color, true) : layer->color;
        *value = *layer;
        value->color = color;
    } else if (multiplies || value->texture == ZR_THREEMF_NONE) {
        value->color = blend(value->color, layer->color, multiplies);
    } else if (layer->color >> 24 == 255) {
        *value = *layer;
    }
}

/* Reads the property of one layer: an index into its group. False if there is none, which a warning counts. */
static bool find_layer(struct zr_threemf *file, uint32_t number, uint32_t index, struct zr_threemf_value *out)
{
    const struct zr_threemf_resource *group = number == ZR_THREEMF_NONE ? NULL : &zr_threemf_resources(file)[number];
    const uint32_t count = !group ? 0 : group->kind == ZR_THREEMF_COLORS ? group->color_count : group->value_count;
    if (index >= count) {
        zr_threemf_note(file, ZR_THREEMF_NOTE_NO_LAYER, file->tag.at, file->tag.name);
        return false;
    }
    if (group->kind == ZR_THREEMF_COLORS)
        *out = (struct zr_threemf_value){group->colors[index], ZR_THREEMF_NONE, 0, 0};
    else
        *out = group->values[index];
    return true;
}

/* Reads which layers multiply; the first blend method is that of the second layer. */
static void read_methods(struct zr_threemf *file, bool *multiplies)
{
    const struct zr_xml_text value = zr_xml_value(&file->tag, "blendmethods");
    const char *at = value.at, *const end = at ? at + value.length : at;
    for (int layer = 1; at < end && layer < LAYERS_MAX; at++) {
        if (is_blank(*at)) continue;
        multiplies[layer++] = *at == 'm' && end - at >= 2 && at[1] == 'u';
        while (at != end && *at > ' ')
            at++;
    }
}

void zr_threemf_read_multi(struct zr_threemf *file)
{
    struct zr_threemf_list values = {0};
    const size_t depth = file->xml.depth;
    uint32_t ids[LAYERS_MAX], groups[LAYERS_MAX], indices[LAYERS_MAX];
    bool multiplies[LAYERS_MAX] = {false};
    if (!zr_threemf_add(file, ZR_THREEMF_MULTI)) return;
    const uint32_t number = file->resources.count - 1, count = read_indices(file, "pids", ids);
    read_methods(file, multiplies);
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_threemf_resource *group = zr_threemf_find(file, file->part, ids[i]);
        const bool is_good = group && (group->kind == ZR_THREEMF_COLORS || group->kind == ZR_THREEMF_COORDS);
        groups[i] = is_good ? (uint32_t)(group - zr_threemf_resources(file)) : ZR_THREEMF_NONE;
        if (is_good && group->is_outside) zr_threemf_resources(file)[number].is_outside = true;
    }
    while (count > 0 && zr_threemf_child(file, depth)) {
        struct zr_threemf_value value = {WHITE, ZR_THREEMF_NONE, 0, 0}, layer = value;
        if (!is_child(file, "multi")) continue;
        const uint32_t given = read_indices(file, "pindices", indices);
        bool is_first = true;
        for (uint32_t i = 0; i < count; i++) {
            if (!find_layer(file, groups[i], i < given ? indices[i] : 0, &layer)) continue;
            if (is_first)
                value = layer;
            else
                add_layer(file, &value, &layer, multiplies[i]);
            is_first = false;
        }
        struct zr_threemf_value *made = zr_threemf_list_add(file->arena, &values, sizeof *made);
        if (made) *made = value;
    }
    set_values(file, number, &values);
}
