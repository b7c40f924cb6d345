#include "input/json/json_number_rows.h"

#include "scene/texture.h"

const char *zr_numbers_any_next(const char *at, const char *end, double low, double high, float *out)
{
    double value;
    at = zr_numbers_skip_space(at + 1, end);
    const char *behind = zr_number_quick(at, end, &value);
    if (!behind) behind = zr_number_read_json(at, end, &value);
    if (!behind || !(value >= low && value <= high)) return NULL;
    *out = (float)value;
    behind = zr_numbers_skip_space(behind, end);
    return behind < end && (*behind == ',' || *behind == ']') ? behind : NULL;
}

const char *zr_numbers_any_three(const char *at, const char *end, double low, double high, zr_vec3 *out)
{
    float x, y, z;
    at = zr_numbers_any_next(at, end, low, high, &x);
    if (!at || *at != ',') return NULL;
    at = zr_numbers_any_next(at, end, low, high, &y);
    if (!at || *at != ',') return NULL;
    at = zr_numbers_any_next(at, end, low, high, &z);
    if (at) *out = (zr_vec3){x, y, z};
    return at;
}

/* Reads an integer below `count`; the forms 1.0 and 1e3 count as integers. */
static const char *read_index(const char *at, const char *end, uint32_t count, uint32_t *out)
{
    uint64_t word = zr_eight_bytes(at, end);
    unsigned digits = zr_count_digits(word);
    char behind = digits < 8 ? zr_byte_behind(word, digits) : '.';
    if (digits == 0 || (digits > 1 && (char)word == '0') || behind == '.' || behind == 'e' || behind == 'E') {
        double value;
        at = zr_number_read_json(at, end, &value);
        if (!at || !(value >= 0.0 && value < (double)count) || (double)(uint32_t)value != value) return NULL;
        *out = (uint32_t)value;
        return at;
    }
    *out = zr_digits_value(word, digits);
    return *out < count ? at + digits : NULL;
}

const char *zr_numbers_any_indices(const char *at, const char *end, uint32_t count, size_t most, uint32_t *out,
                                   size_t *used)
{
    for (size_t i = 0; i < most; i++) {
        at = read_index(zr_numbers_skip_space(at + 1, end), end, count, &out[i]);
        if (!at) return NULL;
        at = zr_numbers_skip_space(at, end);
        if (at == end) return NULL;
        if (*at == ']') {
            *used = i + 1;
            return at + 1;
        }
        if (*at != ',') return NULL;
    }
    return NULL;
}

void zr_rows_read_positions(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_growing *array = state;
    const double limit = (double)json->limits->coordinate_max;
    zr_vec4 *row;
    while (json->at < until && zr_json_item(json) && (row = zr_growing_next(array, json))) {
        const char *behind = json->move ? NULL : zr_numbers_position(json->at, json->end, limit, row);
        if (behind)
            json->at = behind;
        else
            zr_json_position(json, ZR_JSON_ITEM(path, array->count - array->first), row);
        array->count++;
    }
}

void zr_rows_read_colors(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_growing *array = state;
    zr_vec4 *row;
    while (json->at < until && zr_json_item(json) && (row = zr_growing_next(array, json))) {
        const char *behind = zr_numbers_color(json->at, json->end, row);
        if (behind)
            json->at = behind;
        else
            zr_json_color(json, ZR_JSON_ITEM(path, array->count - array->first), row);
        array->count++;
    }
}

void zr_rows_read_vec3s(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_growing *array = state;
    const double limit = (double)json->limits->coordinate_max;
    zr_vec3 *row;
    while (json->at < until && zr_json_item(json) && (row = zr_growing_next(array, json))) {
        const char *behind = zr_numbers_vec3(json->at, json->end, limit, row);
        if (behind)
            json->at = behind;
        else
            zr_json_vec3(json, ZR_JSON_ITEM(path, array->count - array->first), row);
        array->count++;
    }
}

static const char *row_texcoord(const char *at, const char *end, float out[2])
{
    const double limit = (double)ZR_TEXCOORD_MAX;
    if (at == end || *at != '[') return NULL;
    at = zr_numbers_next(at, end, -limit, limit, &out[0]);
    if (!at || *at != ',') return NULL;
    at = zr_numbers_next(at, end, -limit, limit, &out[1]);
    return at && *at == ']' ? at + 1 : NULL;
}

void zr_rows_read_texcoords(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_growing *array = state;
    const struct zr_json_row bounds = {2, 2, -(double)ZR_TEXCOORD_MAX, (double)ZR_TEXCOORD_MAX};
    float *row;
    while (json->at < until && zr_json_item(json) && (row = zr_growing_next(array, json))) {
        const char *behind = row_texcoord(json->at, json->end, row);
        double v[2] = {0};
        if (behind)
            json->at = behind;
        else if (zr_json_numbers(json, ZR_JSON_ITEM(path, array->count - array->first), bounds, v, NULL))
            for (int k = 0; k < 2; k++)
                row[k] = (float)v[k];
        array->count++;
    }
}

/* True if `w` is a sign of the bitangent. */
static bool is_sign(float w)
{
    return w == 1.0f || w == -1.0f;
}

static const char *row_tangent(const char *at, const char *end, double limit, zr_vec4 *out)
{
    zr_vec3 v;
    float w;
    at = zr_numbers_three(at, end, -limit, limit, &v);
    if (!at || *at != ',') return NULL;
    at = zr_numbers_next(at, end, -limit, limit, &w);
    *out = (zr_vec4){v.x, v.y, v.z, w};
    return at && *at == ']' && is_sign(w) ? at + 1 : NULL;
}

bool zr_tangent_check(struct zr_json *json, const struct zr_json_path *path, const zr_vec4 *tangent)
{
    return is_sign(tangent->w) ||
           zr_json_fault(json, ZR_JSON_ITEM(path, 3), "%.9g; 1 and -1 are allowed: the sign of the bitangent",
                         (double)tangent->w);
}

static void read_tangent(struct zr_json *json, const struct zr_json_path *path, zr_vec4 *tangent)
{
    if (zr_json_vec4(json, path, tangent)) zr_tangent_check(json, path, tangent);
}

void zr_rows_read_tangents(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_growing *array = state;
    const double limit = (double)json->limits->coordinate_max;
    zr_vec4 *row;
    while (json->at < until && zr_json_item(json) && (row = zr_growing_next(array, json))) {
        const char *behind = row_tangent(json->at, json->end, limit, row);
        if (behind)
            json->at = behind;
        else
            read_tangent(json, ZR_JSON_ITEM(path, array->count - array->first), row);
        array->count++;
    }
}
