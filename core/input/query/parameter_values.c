#include "input/query/parameter_values.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "input/text/color_text.h"
#include "input/text/names.h"
#include "input/text/number.h"
#include "input/text/text.h"
#include "parameter_rows.h"
#include "render_request.h"
#include "scene/section.h"

/* ---- the list ---- */

const struct zr_parameter_row zr_parameter_list[] = {
#define PARAMETER(name, pointer, scope, kind, help)                                                                    \
    {#name, pointer, ZR_PARAMETER_OF_##scope, ZR_PARAMETER_##kind, offsetof(struct zr_request, name)},
    ZR_PARAMETER_ROWS(PARAMETER)
#undef PARAMETER
};
const int zr_parameter_count = sizeof zr_parameter_list / sizeof zr_parameter_list[0];

const char *zr_parameter_text(const struct zr_request *request, const struct zr_parameter_row *row)
{
    return *(const char *const *)(const void *)((const char *)request + row->offset);
}

/* ---- values ---- */

static bool refuse(const struct zr_parameter *p, const char *text, const char *wanted)
{
    zr_error_add(p->error, ZR_BAD_REQUEST, NULL, "parameter %s: %s is not %s", p->name,
                 zr_quote(text, strlen(text)).text, wanted);
    return false;
}

/* True if the text is exactly one number. */
static bool is_number(const char *text, size_t length, double *value)
{
    return zr_number_read(text, text + length, value) == text + length;
}

static bool put_in_range(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    const struct zr_json_field *field = p->field;
    double value;
    if (is_number(text, strlen(text), &value) && value >= field->low && value <= field->high) {
        zr_json_put_number(json, value);
        return true;
    }
    char wanted[120];
    snprintf(wanted, sizeof wanted, "a number%s%s from %g to %g", field->unit ? " of " : "",
             field->unit ? field->unit : "", field->low, field->high);
    return refuse(p, text, wanted);
}

static bool put_positive(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    double value;
    if (!is_number(text, strlen(text), &value) || !(value <= (double)FLT_MAX) || !((float)value > 0.0f))
        return refuse(p, text, "a number greater than 0");
    zr_json_put_number(json, value);
    return true;
}

/* True for digits alone, at least one. *value is exact up to UINT32_MAX; larger numbers give some value above it. */
static bool is_whole(const char *text, uint64_t *value)
{
    const char *at = text;
    for (*value = 0; *at >= '0' && *at <= '9'; at++)
        if (*value <= UINT32_MAX) *value = *value * 10 + (uint64_t)(*at - '0');
    return *at == '\0' && at != text;
}

static bool put_whole(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    uint64_t value;
    char wanted[80];
    snprintf(wanted, sizeof wanted, "a whole number from %.0f to %.0f", p->field->low, p->field->high);
    if (!is_whole(text, &value) || (double)value < p->field->low || (double)value > p->field->high)
        return refuse(p, text, wanted);
    zr_json_put_number(json, (double)value);
    return true;
}

static bool put_side(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    const uint32_t most = p->limits->window_side_max;
    uint64_t value;
    char wanted[80];
    snprintf(wanted, sizeof wanted, "a whole number of pixels from 1 to %u", most);
    if (!is_whole(text, &value) || value < 1) return refuse(p, text, wanted);
    if (value > most) { /* well-formed, but too large: the same status as in a scene */
        zr_error_add(p->error, ZR_BAD_SCENE, NULL, "parameter %s: %s pixels; 1 to %u are allowed", p->name,
                     zr_quote(text, strlen(text)).text, most);
        return false;
    }
    zr_json_put_number(json, (double)value);
    return true;
}

static bool put_pixel(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    uint64_t value;
    if (!is_whole(text, &value) || value > UINT32_MAX) return refuse(p, text, "the number of a pixel, counted from 0");
    zr_json_put_number(json, (double)value);
    return true;
}

static bool put_vector(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    const char *at = text;
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, ",");
        double value;
        if (!is_number(at, length, &value) || !(value >= -(double)FLT_MAX && value <= (double)FLT_MAX) ||
            at[length] != (i < 2 ? ',' : '\0'))
            return refuse(p, text, "three numbers with commas between them");
        zr_json_put(json, i == 0 ? "[" : ",");
        zr_json_put_number(json, value);
        at += length + 1;
    }
    zr_json_put(json, "]");
    return true;
}

/* Writes one plane: an axis, and optionally a share of the bounds and a side. */
static bool put_plane(const char *text, size_t length, struct zr_json_writer *json)
{
    static const char *const sides[] = {"far", "positive", "negative"};
    const char *const fraction = memchr(text, ':', length), *const end = text + length;
    const char *const side = fraction ? memchr(fraction + 1, ':', (size_t)(end - fraction - 1)) : NULL;
    double share = 0.5;
    size_t number = 0;
    if ((fraction ? fraction : end) != text + 1 || *text < 'x' || *text > 'z') return false;
    if (fraction && !is_number(fraction + 1, (size_t)((side ? side : end) - fraction - 1), &share)) return false;
    while (side && number < 3 &&
           (strlen(sides[number]) != (size_t)(end - side - 1) ||
            memcmp(sides[number], side + 1, strlen(sides[number])) != 0))
        number++;
    if (number == 3 || !(share >= 0.0 && share <= 1.0)) return false;
    zr_json_put(json, *text == 'x' ? "{\"axis\":\"x\"" : *text == 'y' ? "{\"axis\":\"y\"" : "{\"axis\":\"z\"");
    zr_json_put(json, ",\"fraction\":");
    zr_json_put_number(json, share);
    zr_json_put(json, ",\"keep\":");
    zr_json_put_string(json, sides[number]);
    zr_json_put(json, "}");
    return true;
}

/* A plane takes up to 75 bytes of JSON. */
_Static_assert(75 * ZR_SECTION_PLANES_MAX + 2 <= ZR_PARAMETER_ROOM, "the writer has room for all planes");

static bool put_planes(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    size_t count = 1;
    for (const char *at = text; *at; at++)
        count += *at == ',';
    if (count > ZR_SECTION_PLANES_MAX) return refuse(p, text, "a list of up to 6 planes");
    for (const char *at = text;; at++) {
        const size_t length = strcspn(at, ",");
        zr_json_put(json, at == text ? "[" : ",");
        if (!put_plane(at, length, json))
            return refuse(p, text,
                          "a list of planes such as x, y:0.25 or z:0.5:positive, with commas between them: an "
                          "axis, a share of the bounds from 0 to 1, and far, positive or negative");
        at += length;
        if (*at == '\0') break;
    }
    zr_json_put(json, "]");
    return true;
}

static bool put_opaque(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    zr_vec4 color;
    if (!zr_color_of_text(text, strlen(text), &color))
        return refuse(p, text, "a colour: #rrggbb, #rgb, or a name of CSS");
    if (color.w < 1.0f) return refuse(p, text, "opaque, and only the background may be transparent");
    zr_json_put_string(json, text);
    return true;
}

static bool put_background(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    zr_vec4 color;
    if (!zr_color_of_text(text, strlen(text), &color))
        return refuse(p, text, "a colour: transparent, #rrggbb, #rrggbbaa, #rgb, #rgba, or a name of CSS");
    zr_json_put_string(json, text);
    return true;
}

static bool put_outline(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    if (strcmp(text, "true") != 0 && strcmp(text, "false") != 0) return put_opaque(p, text, json);
    zr_json_put(json, text);
    return true;
}

static bool put_flag(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    static const char *const words[] = {"false", "true", "0", "1"};
    static const struct zr_names names = ZR_NAMES(4, words);
    const int found = zr_names_of_query(p->name, &names, text, p->error);
    if (found < 0) return false;
    zr_json_put(json, words[found % 2]);
    return true;
}

static bool put_count(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    if (zr_names_of_query(p->name, p->field->words, text, p->error) < 0) return false;
    zr_json_put(json, text);
    return true;
}

static bool put_name(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    if (p->kind == ZR_PARAMETER_NAME_OR_FALSE && strcmp(text, "false") == 0)
        zr_json_put(json, text);
    else
        zr_json_put_string(json, text);
    return true;
}

/* Writes a list of the texts between the commas. */
static bool put_list(const struct zr_parameter *p, const char *text, const char *wanted, struct zr_json_writer *json)
{
    const char *at = text;
    for (size_t length; at; at = at[length] ? at + length + 1 : NULL) {
        length = strcspn(at, ",");
        if (length == 0) return refuse(p, text, wanted);
        zr_json_put(json, at == text ? "[" : ",");
        zr_json_put_part(json, at, length);
    }
    zr_json_put(json, "]");
    return true;
}

static bool put_parts(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    return put_list(p, text, "a list of names, patterns or ids of parts with commas between them", json);
}

static bool put_presets(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    return put_list(p, text, "a list of names of presets with commas between them", json);
}

/* Writes a list of pixels. Blanks, or semicolons, are between them. */
static bool put_pixel_list(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    static const char between[] = " \t;", wanted[] = "a list of pixels such as 320,240 with blanks between them";
    const char *at = text + strspn(text, between);
    zr_json_put(json, "[");
    if (!*at) return refuse(p, text, wanted);
    for (const char *first = at; *at; at += strspn(at, between)) {
        zr_json_put(json, at == first ? "[" : ",[");
        for (int i = 0; i < 2; i++) {
            const size_t length = strspn(at, "0123456789");
            double value;
            if (length == 0 || length > 10 || !is_number(at, length, &value) || value > UINT32_MAX ||
                (i == 0 && at[length] != ','))
                return refuse(p, text, wanted);
            zr_json_put_number(json, value);
            zr_json_put(json, i == 0 ? "," : "]");
            at += length + (i == 0);
        }
        if (*at && !strchr(between, *at)) return refuse(p, text, wanted);
    }
    zr_json_put(json, "]");
    return true;
}

static bool put_words(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    return put_list(p, text, "a list of words with commas between them", json);
}

typedef bool put_fn(const struct zr_parameter *p, const char *text, struct zr_json_writer *json);

bool zr_parameter_put(const struct zr_parameter *p, const char *text, struct zr_json_writer *json)
{
    static put_fn *const by_kind[] = {[ZR_PARAMETER_NAME] = put_name,
                                      [ZR_PARAMETER_NAME_OR_FALSE] = put_name,
                                      [ZR_PARAMETER_AXIS] = put_name,
                                      [ZR_PARAMETER_BOOL] = put_flag,
                                      [ZR_PARAMETER_COUNT] = put_count,
                                      [ZR_PARAMETER_NUMBER] = put_in_range,
                                      [ZR_PARAMETER_DEGREES] = put_in_range,
                                      [ZR_PARAMETER_PIXELS] = put_in_range,
                                      [ZR_PARAMETER_UNITS] = put_positive,
                                      [ZR_PARAMETER_SECONDS] = put_in_range,
                                      [ZR_PARAMETER_WHOLE] = put_whole,
                                      [ZR_PARAMETER_SIDE] = put_side,
                                      [ZR_PARAMETER_PIXEL] = put_pixel,
                                      [ZR_PARAMETER_VECTOR] = put_vector,
                                      [ZR_PARAMETER_PARTS] = put_parts,
                                      [ZR_PARAMETER_PLANES] = put_planes,
                                      [ZR_PARAMETER_PRESETS] = put_presets,
                                      [ZR_PARAMETER_WORDS] = put_words,
                                      [ZR_PARAMETER_PIXEL_LIST] = put_pixel_list,
                                      [ZR_PARAMETER_COLOR] = put_opaque,
                                      [ZR_PARAMETER_BACKGROUND] = put_background,
                                      [ZR_PARAMETER_OUTLINE] = put_outline};
    return by_kind[p->kind](p, text, json);
}
