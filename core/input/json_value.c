#include "input/json_value.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "input/color_text.h"
#include "input/json_text.h"
#include "input/text.h"
#include "scene/scene.h"

/* From one corner of the largest scene to the other there are 3.5 times as many units as coordinates may have, and who
 * wants to see it all stands farther off. Squared, such lengths are far below ZR_MATRIX_MAX times a coordinate. */
enum { LENGTHS_A_COORDINATE = 1000 };

enum { PATH_LINKS_MAX = 16, POINTER_ROOM = ZR_POINTER_SIZE + 8 };

/* RFC 6901, section 3: ~ is ~0 and / is ~1. Ends one byte early where it must, so
 * that the text stays too long for zr_error_add, which then cuts it well. */
static size_t write_key(char *text, size_t used, const char *key)
{
    for (; *key && used + 2 < POINTER_ROOM; key++) {
        if (*key == '~' || *key == '/') {
            text[used++] = '~';
            text[used++] = *key == '~' ? '0' : '1';
        } else {
            text[used++] = *key;
        }
    }
    return used;
}

static void write_pointer(const struct zr_json_path *path, char text[POINTER_ROOM])
{
    const struct zr_json_path *links[PATH_LINKS_MAX];
    size_t count = 0, used = 0;
    for (; path && count < PATH_LINKS_MAX; path = path->parent)
        links[count++] = path;
    while (count > 0 && used + 24 < POINTER_ROOM) {
        const struct zr_json_path *link = links[--count];
        if (link->key) {
            text[used++] = '/';
            used = write_key(text, used, link->key);
        } else {
            used += (size_t)snprintf(text + used, POINTER_ROOM - used, "/%zu", link->index);
        }
    }
    text[used] = '\0';
}

bool zr_json_fault(struct zr_json *json, const struct zr_json_path *path, const char *format, ...)
{
    char pointer[POINTER_ROOM], detail[ZR_DETAIL_SIZE + 8];
    if (!zr_arena_ok(json->arena)) return false;
    write_pointer(path, pointer);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    zr_error_add(json->error, ZR_BAD_SCENE, pointer, "%s", detail);
    return false;
}

bool zr_json_full(const struct zr_json *json)
{
    return json->error->count >= ZR_ERROR_ITEMS || json->text->malformed;
}

bool zr_json_stopped(struct zr_json *json)
{
    if (!zr_is_cancelled(json->cancel)) return false;
    zr_arena_charge(json->arena, SIZE_MAX);
    return true;
}

static const char *kind_of(const cJSON *node)
{
    if (cJSON_IsBool(node)) return "a boolean";
    if (cJSON_IsNumber(node)) return "a number";
    if (cJSON_IsString(node)) return "a string";
    if (cJSON_IsArray(node)) return "a list";
    if (cJSON_IsObject(node)) return "an object";
    return "null";
}

bool zr_json_expect(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, const char *what)
{
    return zr_json_fault(json, path, "expected %s, found %s", what, kind_of(node));
}

static bool expect(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, bool is, const char *what)
{
    return is || zr_json_expect(json, path, node, what);
}

bool zr_json_object(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                    const struct zr_names *keys, const cJSON **found)
{
    for (int i = 0; i < keys->count; i++)
        found[i] = NULL;
    if (!expect(json, path, node, cJSON_IsObject(node), "an object")) return false;
    for (const cJSON *child = node->child; child && !zr_json_full(json); child = child->next) {
        const struct zr_json_path *at = ZR_JSON_KEY(path, child->string);
        int key = zr_names_find(keys, child->string);
        if (key < 0)
            zr_json_fault(json, at, "unknown key; known here: %s", zr_names_join(keys).text);
        else if (key >= keys->count)
            zr_json_fault(json, at, "not supported in this version");
        else if (found[key])
            zr_json_fault(json, at, "given twice");
        else
            found[key] = child;
    }
    return true;
}

bool zr_json_array(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, size_t *count)
{
    if (!expect(json, path, node, cJSON_IsArray(node), "a list")) return false;
    *count = 0;
    for (const cJSON *item = node->child; item; item = item->next)
        ++*count;
    return true;
}

bool zr_json_number(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, double low, double high,
                    double *out)
{
    *out = node->valuedouble; /* 0 in what is no number */
    if (!cJSON_IsNumber(node)) return expect(json, path, node, false, "a number");
    if (*out >= low && *out <= high) return true;
    if (!isfinite(*out)) return zr_json_fault(json, path, "a number too large; %.9g to %.9g is allowed", low, high);
    return zr_json_fault(json, path, "%.10g is outside of %.10g to %.10g", *out, low, high);
}

bool zr_json_coordinate(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float *out)
{
    double value, limit = (double)json->limits->coordinate_max;
    if (!zr_json_number(json, path, node, -limit, limit, &value)) return false;
    *out = (float)value;
    return true;
}

bool zr_json_length(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float *out)
{
    double value, limit = (double)json->limits->coordinate_max * LENGTHS_A_COORDINATE;
    if (!zr_json_number(json, path, node, -limit, limit, &value)) return false;
    *out = (float)value;
    return true;
}

bool zr_json_positive(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float *out)
{
    if (!zr_json_length(json, path, node, out)) return false;
    return *out > 0.0f || zr_json_fault(json, path, "%.9g is not greater than 0", node->valuedouble);
}

bool zr_json_whole(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t *out)
{
    double value;
    if (!zr_json_number(json, path, node, 0, UINT32_MAX, &value)) return false;
    *out = (uint32_t)value;
    return (double)*out == value || zr_json_fault(json, path, "%.9g is not a whole number", value);
}

bool zr_json_index(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t count,
                   const char *of, uint32_t *out)
{
    if (!cJSON_IsNumber(node)) return expect(json, path, node, false, "an index");
    double value = node->valuedouble;
    if (value >= 0 && value < (double)count) {
        *out = (uint32_t)value;
        return (double)*out == value || zr_json_fault(json, path, "index %.9g is not a whole number", value);
    }
    return zr_json_fault(json, path, "index %.15g of %u %s%s", value, count, of,
                         count > 0 && value == (double)count ? "; they count from 0" : "");
}

bool zr_json_bool(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, bool *out)
{
    *out = cJSON_IsTrue(node);
    return expect(json, path, node, cJSON_IsBool(node), "true or false");
}

bool zr_json_string(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, const char **out)
{
    *out = node->valuestring;
    return expect(json, path, node, cJSON_IsString(node), "a string");
}

const char *zr_json_keep(struct zr_json *json, const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = zr_arena_alloc(json->arena, size, 1);
    return copy ? memcpy(copy, text, size) : "";
}

bool zr_json_choice(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                    const struct zr_names *names, int *out)
{
    const char *word;
    if (!zr_json_string(json, path, node, &word)) return false;
    int found = zr_names_find(names, word);
    if (found >= 0 && found < names->count) {
        *out = found;
        return true;
    }
    return zr_json_fault(json, path, "%s is %s; allowed: %s", zr_quote(word, strlen(word)).text,
                         found < 0 ? "unknown" : "not supported in this version", zr_names_join(names).text);
}

/* `least` to `most` numbers, each within low..high. */
static bool read_numbers(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, size_t least,
                         size_t most, double low, double high, float *out, size_t *count)
{
    *count = 0;
    if (!cJSON_IsArray(node)) return expect(json, path, node, false, "a list of numbers");
    bool good = true;
    for (const cJSON *item = node->child; item; item = item->next) {
        double value;
        if (*count < most) {
            good = zr_json_number(json, ZR_JSON_ITEM(path, *count), item, low, high, &value) && good;
            if (good) out[*count] = (float)value;
        }
        ++*count;
    }
    if (*count >= least && *count <= most) return good;
    if (least == most) return zr_json_fault(json, path, "expected %zu numbers, found %zu", least, *count);
    return zr_json_fault(json, path, "expected %zu or %zu numbers, found %zu", least, most, *count);
}

bool zr_json_vec3(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec3 *out)
{
    double limit = (double)json->limits->coordinate_max;
    size_t count;
    float v[3] = {0};
    if (!read_numbers(json, path, node, 3, 3, -limit, limit, v, &count)) return false;
    *out = (zr_vec3){v[0], v[1], v[2]};
    return true;
}

bool zr_json_vec4(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec4 *out)
{
    double limit = (double)json->limits->coordinate_max;
    size_t count;
    float v[4] = {0};
    if (!read_numbers(json, path, node, 4, 4, -limit, limit, v, &count)) return false;
    *out = (zr_vec4){v[0], v[1], v[2], v[3]};
    return true;
}

bool zr_json_position(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec4 *out)
{
    double limit = (double)json->limits->coordinate_max;
    size_t count;
    float v[4] = {0};
    if (!read_numbers(json, path, node, 3, 4, -limit, limit, v, &count)) return false;
    *out = (zr_vec4){v[0], v[1], v[2], count == 4 ? v[3] : 1.0f};
    return true;
}

bool zr_json_color(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec4 *out)
{
    static const char *const forms =
        "[r,g,b] or [r,g,b,a] of 0..1, \"#rrggbb\", \"#rrggbbaa\", \"#rgb\", \"#rgba\" or a name "
        "of CSS";
    if (cJSON_IsString(node)) {
        const char *text = node->valuestring;
        return zr_color_of_text(text, strlen(text), out) ||
               zr_json_fault(json, path, "%s is not a colour: %s", zr_quote(text, strlen(text)).text, forms);
    }
    if (!cJSON_IsArray(node)) return zr_json_fault(json, path, "expected a colour, found %s: %s", kind_of(node), forms);
    size_t count;
    float v[4] = {0};
    if (!read_numbers(json, path, node, 3, 4, 0.0, 1.0, v, &count)) return false;
    *out = (zr_vec4){v[0], v[1], v[2], count == 4 ? v[3] : 1.0f};
    return true;
}

bool zr_json_mat4(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_mat4 *out)
{
    double limit = (double)ZR_MATRIX_MAX;
    size_t count;
    if (!cJSON_IsArray(node)) return expect(json, path, node, false, "a matrix");
    if (!node->child || !cJSON_IsArray(node->child))
        return read_numbers(json, path, node, 16, 16, -limit, limit, out->m, &count);
    size_t row = 0;
    bool good = true;
    for (const cJSON *item = node->child; item; item = item->next, row++) {
        float v[4] = {0};
        if (row >= 4) continue;
        good = read_numbers(json, ZR_JSON_ITEM(path, row), item, 4, 4, -limit, limit, v, &count) && good;
        for (size_t column = 0; good && column < 4; column++)
            out->m[column * 4 + row] = v[column];
    }
    if (row != 4) return zr_json_fault(json, path, "expected 4 rows, found %zu", row);
    return good;
}

/* Whoever writes a flat one row by row has the translation in the bottom row, and is told so. */
bool zr_json_affine(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_mat4 *out)
{
    if (!zr_json_mat4(json, path, node, out)) return false;
    const float *m = out->m;
    if (m[3] == 0.0f && m[7] == 0.0f && m[11] == 0.0f && m[15] == 1.0f) return true;
    return zr_json_fault(json, path,
                         "the bottom row is %.9g %.9g %.9g %.9g, not 0 0 0 1 (a flat list goes column by column)",
                         (double)m[3], (double)m[7], (double)m[11], (double)m[15]);
}

bool zr_json_vec4_list(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                       zr_json_vec4_reader read, zr_vec4 *out)
{
    size_t i = 0;
    bool good = true;
    for (const cJSON *item = node->child; item && !zr_json_full(json); item = item->next, i++)
        good = read(json, ZR_JSON_ITEM(path, i), item, &out[i]) && good;
    return good;
}

bool zr_json_vec3_list(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec3 *out)
{
    size_t i = 0;
    bool good = true;
    for (const cJSON *item = node->child; item && !zr_json_full(json); item = item->next, i++)
        good = zr_json_vec3(json, ZR_JSON_ITEM(path, i), item, &out[i]) && good;
    return good;
}
