#include "input/json/json_value.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "input/text/color_text.h"
#include "input/text/nearest.h"
#include "input/text/recenter.h"
#include "input/text/text.h"
#include "scene/scene.h"

static const char *const kinds[] = {"nothing", "null", "a boolean", "a number", "a string", "a list", "an object"};

bool zr_json_expect(struct zr_json *json, const struct zr_json_path *path, const char *what)
{
    const enum zr_json_type type = zr_json_type(json);
    if (zr_json_skip(json)) zr_json_fault(json, path, "expected %s, found %s", what, kinds[type]);
    return false;
}

/* True if the next value has this type; else reports it. */
static bool expect(struct zr_json *json, const struct zr_json_path *path, enum zr_json_type type, const char *what)
{
    return zr_json_type(json) == type || zr_json_expect(json, path, what);
}

/* ---- objects ---- */

static void report_unknown(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                           const char *key)
{
    const char *words[64];
    struct zr_names known = {.words = words};
    struct zr_nearest nearest = {.word = key};
    for (size_t i = 0; i < object->count; i++) {
        if (!object->fields[i].read) continue;
        words[known.count++] = object->fields[i].key;
        zr_nearest_offer(&nearest, object->fields[i].key);
    }
    zr_json_fault(json, ZR_JSON_KEY(path, key), "unknown key%s; known here: %s", zr_nearest_text(&nearest).text,
                  zr_names_join(&known).text);
}

/* Begins the search at `first`: keys in the order of the table match at once. */
static size_t find_field(const struct zr_json_object *object, const struct zr_json_text *key, size_t first)
{
    for (size_t i = first; i < object->count; i++)
        if (zr_json_is(key, object->fields[i].key)) return i;
    for (size_t i = 0; i < first; i++)
        if (zr_json_is(key, object->fields[i].key)) return i;
    return object->count;
}

static void read_field(struct zr_json_reading *reading, const struct zr_json_text *key, size_t number)
{
    struct zr_json *json = reading->json;
    const struct zr_json_path *path = reading->path;
    const struct zr_json_object *object = reading->object;
    const struct zr_json_field *field = &object->fields[number];
    const uint64_t bit = ZR_KEY(number & 63);
    if (number < object->count && field->read && !(*reading->given & bit)) {
        *reading->given |= bit;
        char *out = reading->out;
        if (field->through) out = *(char **)(void *)(out + field->through);
        field->read(json, ZR_JSON_FIELD(path, field), out + field->offset);
        return;
    }
    const char *word = zr_json_decode(json, key);
    if (!zr_json_skip(json) || !word) return;
    reading->has_unknown |= number == object->count;
    if (number == object->count)
        report_unknown(json, path, object, word);
    else
        zr_json_fault(json, ZR_JSON_KEY(path, word), "%s",
                      field->read ? "given twice" : "not supported in this version");
}

/* Moves to the value of the first key if it is `key`, without escapes or spaces, as in most items of large lists. Saves
 * a sixteenth of the time of reading polygons. */
static bool take_first(struct zr_json *json, const char *key)
{
    const char *at = json->at, *end = json->look; /* no check for cancellation is due before */
    if (at >= end || *at++ != '"') return false;
    for (; at < end && *key && *at == *key; at++)
        key++;
    if (*key || end - at < 2 || at[0] != '"' || at[1] != ':') return false;
    json->at = at + 2;
    return true;
}

bool zr_json_fields(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                    void *out, uint64_t *given)
{
    struct zr_json_reading reading = {json, path, object, out, given, 0, false};
    struct zr_json_text key = {NULL, NULL, false};
    size_t number = 0;
    *given = 0;
    if (!expect(json, path, ZR_JSON_OBJECT, "an object") || !zr_json_enter(json, '{')) return false;
    if (object->fields[0].read && take_first(json, object->fields[0].key)) read_field(&reading, &key, 0);
    while (zr_json_member(json, &key)) {
        number = find_field(object, &key, number < object->count ? number : 0);
        read_field(&reading, &key, number);
    }
    for (size_t i = 0; i < object->count && object->fields[i].required; i++)
        if (!zr_json_gives(*given, (int)i))
            zr_json_fault(json, path, "%s is missing: %s", object->fields[i].key, object->fields[i].text);
    if (object->rule_count || object->has_types) zr_json_check_rules(&reading);
    return true;
}

bool zr_json_value_start(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    (void)path;
    zr_json_type(json);
    const char *place = json->at;
    if (!zr_json_skip(json)) return false;
    *(const char **)out = place;
    return true;
}

/* ---- numbers ---- */

bool zr_json_check_range(struct zr_json *json, const struct zr_json_path *path, double low, double high, double value)
{
    if (value >= low && value <= high) return true;
    if (isnan(value)) return zr_json_fault(json, path, "not a number; %.9g to %.9g is allowed", low, high);
    if (!isfinite(value)) return zr_json_fault(json, path, "a number too large; %.9g to %.9g is allowed", low, high);
    return zr_json_fault(json, path, "%.10g is outside of %.10g to %.10g", value, low, high);
}

bool zr_json_number_in(struct zr_json *json, const struct zr_json_path *path, double low, double high, double *out)
{
    double value;
    if (!expect(json, path, ZR_JSON_NUMBER, "a number") || !zr_json_take_number(json, &value) ||
        !zr_json_check_range(json, path, low, high, value))
        return false;
    *out = value;
    return true;
}

bool zr_json_number(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_number_in(json, path, path->field->low, path->field->high, out);
}

static bool read_float(struct zr_json *json, const struct zr_json_path *path, double low, double high, float *out)
{
    double value;
    if (!zr_json_number_in(json, path, low, high, &value)) return false;
    *out = (float)value;
    return true;
}

bool zr_json_float(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_float(json, path, path->field->low, path->field->high, out);
}

bool zr_json_coordinate(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max;
    return read_float(json, path, -limit, limit, out);
}

bool zr_json_length(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max * ZR_JSON_LENGTHS_PER_COORDINATE;
    return read_float(json, path, -limit, limit, out);
}

bool zr_json_positive(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max * ZR_JSON_LENGTHS_PER_COORDINATE;
    double value;
    if (!zr_json_number_in(json, path, -limit, limit, &value)) return false;
    if (!((float)value > 0.0f)) return zr_json_fault(json, path, "%.9g is not greater than 0", value);
    *(float *)out = (float)value;
    return true;
}

bool zr_json_whole(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const bool has_range = path->field && path->field->high > path->field->low; /* for the message; callers check it */
    double value;
    if (!zr_json_number_in(json, path, -DBL_MAX, DBL_MAX, &value)) return false;
    if (!(value >= 0 && value <= UINT32_MAX))
        return zr_json_check_range(json, path, has_range ? path->field->low : 0,
                                   has_range ? path->field->high : UINT32_MAX, value);
    if ((double)(uint32_t)value != value) return zr_json_fault(json, path, "%.9g is not a whole number", value);
    *(uint32_t *)out = (uint32_t)value;
    return true;
}

bool zr_json_bad_index(struct zr_json *json, const struct zr_json_path *path, double value, uint32_t count,
                       const char *of)
{
    if (value != floor(value)) return zr_json_fault(json, path, "index %.9g is not a whole number", value);
    return zr_json_fault(json, path, "index %.15g of %u %s%s", value, count, of,
                         count > 0 && value == (double)count ? "; they count from 0" : "");
}

bool zr_json_check_index(struct zr_json *json, const struct zr_json_path *path, double value, uint32_t count,
                         const char *of)
{
    if (value >= 0 && value < (double)count && (double)(uint32_t)value == value) return true;
    if (count < UINT32_MAX) return zr_json_bad_index(json, path, value, count, of);
    return zr_json_fault(json, path, "index %.15g is not a whole number from 0 on", value);
}

bool zr_json_index(struct zr_json *json, const struct zr_json_path *path, uint32_t count, const char *of, uint32_t *out)
{
    double value;
    if (!expect(json, path, ZR_JSON_NUMBER, "an index") || !zr_json_take_number(json, &value) ||
        !zr_json_check_index(json, path, value, count, of))
        return false;
    *out = (uint32_t)value;
    return true;
}

/* ---- words ---- */

bool zr_json_bool(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return expect(json, path, ZR_JSON_BOOL, "true or false") && zr_json_take_bool(json, out);
}

bool zr_json_flag(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    bool value;
    if (!zr_json_bool(json, path, &value)) return false;
    *(int *)out = value;
    return true;
}

bool zr_json_string(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_json_text text;
    if (!expect(json, path, ZR_JSON_STRING, "a string") || !zr_json_take_string(json, &text)) return false;
    const char *decoded = zr_json_decode(json, &text);
    if (decoded) *(const char **)out = decoded;
    return decoded;
}

bool zr_json_choice_of(struct zr_json *json, const struct zr_json_path *path, const struct zr_names *words, int *out)
{
    struct zr_json_text text;
    if (!expect(json, path, ZR_JSON_STRING, "a string") || !zr_json_take_string(json, &text)) return false;
    for (int i = 0; i < words->count; i++)
        if (zr_json_is(&text, words->words[i])) {
            *out = i;
            return true;
        }
    const char *word = zr_json_decode(json, &text);
    return word && zr_json_fault(json, path, "%s", zr_names_refuse(words, word).text);
}

bool zr_json_choice(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_choice_of(json, path, path->field->words, out);
}

/* ---- vectors ---- */

bool zr_json_list(struct zr_json *json, const struct zr_json_path *path)
{
    return expect(json, path, ZR_JSON_LIST, "a list");
}

bool zr_json_count(struct zr_json *json, const struct zr_json_path *path, size_t *count)
{
    if (!zr_json_list(json, path)) return false;
    struct zr_json there = *json;
    *count = 0;
    zr_json_enter(&there, '[');
    while (zr_json_any_item(&there) && zr_json_skip(&there))
        ++*count;
    if (there.ended) *json = there;
    return !there.ended;
}

void *zr_json_enter_list(struct zr_json *json, const struct zr_json_path *path, const char *things, size_t most,
                         size_t size, size_t *count)
{
    if (!zr_json_count(json, path, count)) return NULL;
    if (*count > most) {
        zr_json_skip(json);
        zr_json_fault(json, path, "%zu %s; up to %zu are allowed", *count, things, most);
        return NULL;
    }
    void *items = zr_arena_zero(json->arena, *count, size);
    if (items) zr_json_enter(json, '[');
    return items;
}

bool zr_json_numbers(struct zr_json *json, const struct zr_json_path *path, struct zr_json_row row, double *out,
                     size_t *count)
{
    bool good = expect(json, path, ZR_JSON_LIST, "a list of numbers") && zr_json_enter(json, '[');
    size_t found = 0;
    if (!good) return false;
    for (; zr_json_any_item(json); found++) {
        if (found < row.most)
            good = zr_json_number_in(json, ZR_JSON_ITEM(path, found), row.low, row.high, &out[found]) && good;
        else
            zr_json_skip(json);
    }
    if (count) *count = found;
    if (found >= row.least && found <= row.most) return good;
    if (row.least == row.most) return zr_json_fault(json, path, "expected %zu numbers, found %zu", row.least, found);
    return zr_json_fault(json, path, "expected %zu %s %zu numbers, found %zu", row.least,
                         row.most - row.least > 1 ? "to" : "or", row.most, found);
}

/* Reads three or four numbers; the default of the fourth is 1. */
static bool read_vec4(struct zr_json *json, const struct zr_json_path *path, struct zr_json_row row, zr_vec4 *out)
{
    double v[4] = {0};
    size_t count;
    if (!zr_json_numbers(json, path, row, v, &count)) return false;
    *out = (zr_vec4){(float)v[0], (float)v[1], (float)v[2], count == 4 ? (float)v[3] : 1.0f};
    return true;
}

bool zr_json_float2(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double v[2] = {0};
    const struct zr_json_row row = {2, 2, path->field->low, path->field->high};
    if (!zr_json_numbers(json, path, row, v, NULL)) return false;
    for (int k = 0; k < 2; k++)
        ((float *)out)[k] = (float)v[k];
    return true;
}

bool zr_json_vec3(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max;
    double v[3] = {0};
    const struct zr_json_row row = {3, 3, -limit, limit};
    if (!zr_json_numbers(json, path, row, v, NULL)) return false;
    *(zr_vec3 *)out = (zr_vec3){(float)v[0], (float)v[1], (float)v[2]};
    return true;
}

static bool read_doubles3(struct zr_json *json, const struct zr_json_path *path, double limit, void *out)
{
    double v[3] = {0};
    if (!zr_json_numbers(json, path, (struct zr_json_row){3, 3, -limit, limit}, v, NULL)) return false;
    memcpy(out, v, sizeof v);
    return true;
}

bool zr_json_doubles3(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_doubles3(json, path, (double)json->limits->coordinate_max, out);
}

bool zr_json_place3(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_doubles3(json, path, zr_recenter_limit(json->limits), out);
}

bool zr_json_place(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double v[3];
    if (!zr_json_place3(json, path, v)) return false;
    *(zr_vec3 *)out = zr_far_place(json->far, v);
    return true;
}

bool zr_json_vec4(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max;
    return read_vec4(json, path, (struct zr_json_row){4, 4, -limit, limit}, out);
}

bool zr_json_position(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max;
    const struct zr_json_row row = {3, 4, -limit, limit};
    double v[4] = {0};
    size_t count;
    if (!json->move) return read_vec4(json, path, row, out);
    if (!zr_json_numbers(json, path, row, v, &count)) return false;
    *(zr_vec4 *)out = zr_far_position(json->move, v, count == 4 ? v[3] : 1.0);
    return true;
}

bool zr_json_color(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const char *const forms = "[r,g,b] or [r,g,b,a] of 0..1, \"#rrggbb\", \"#rrggbbaa\", \"#rgb\", \"#rgba\", "
                                     "\"transparent\" or a name of CSS";
    const enum zr_json_type type = zr_json_type(json);
    struct zr_json_text text;
    if (type == ZR_JSON_LIST) return read_vec4(json, path, (struct zr_json_row){3, 4, 0.0, 1.0}, out);
    if (type == ZR_JSON_STRING) {
        if (!zr_json_take_string(json, &text)) return false;
        if (!text.has_escapes && zr_color_of_text(text.at, (size_t)(text.end - text.at), out)) return true;
        const char *word = zr_json_decode(json, &text);
        return word && (zr_color_of_text(word, strlen(word), out) ||
                        zr_json_fault(json, path, "%s is not a colour: %s", zr_quote(word, strlen(word)).text, forms));
    }
    return zr_json_skip(json) && zr_json_fault(json, path, "expected a colour, found %s: %s", kinds[type], forms);
}

bool zr_json_opaque(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    zr_vec4 color;
    if (!zr_json_color(json, path, &color)) return false;
    if (color.w < 1.0f) return zr_json_fault(json, path, "an alpha of %.9g: alpha must be 1", (double)color.w);
    *(zr_vec4 *)out = color;
    return true;
}
