#include "drake_form.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "input/text/number.h"

/* ---- the fields ---- */

enum kind { FILE_PART, TEXT, IMAGE_TYPE, SIDE, FOCAL, POSITIVE, NOT_NEGATIVE, NUMBER };
enum need { ALWAYS, NEVER, OF_DEPTH };

static const char *const expected[] = {[FILE_PART] = "a glTF file",
                                       [TEXT] = "a text",
                                       [IMAGE_TYPE] = "color, depth or label",
                                       [FOCAL] = "a number from 1e-6 to 1e9",
                                       [POSITIVE] = "a number greater than 0, at most 1e9,",
                                       [NOT_NEGATIVE] = "a number from 0 to 1e9",
                                       [NUMBER] = "a number from -1e9 to 1e9"};

/* Larger numbers are mistakes, and float32 holds their squares. Shorter focal lengths are refused by all scenes. */
#define NUMBER_MAX 1e9
#define FOCAL_MIN  1e-6

#define AT(member) (int)offsetof(struct drake_form, member)
static const struct field {
    const char *name;
    enum kind kind;
    enum need need;
    int offset;          /* of a double; -1: read elsewhere, or only checked */
    const char *pointer; /* of its key in the scene, or "" */
} fields[] = {{"scene", FILE_PART, ALWAYS, -1, DRAKE_AT_SCENE},
              {"scene_sha256", TEXT, NEVER, -1, ""},
              {"image_type", IMAGE_TYPE, ALWAYS, -1, ""},
              {"min_depth", NOT_NEGATIVE, OF_DEPTH, AT(min_depth), ""},
              {"max_depth", POSITIVE, OF_DEPTH, AT(max_depth), DRAKE_AT_RANGE},
              {"width", SIDE, ALWAYS, AT(width), DRAKE_AT_WIDTH},
              {"height", SIDE, ALWAYS, AT(height), DRAKE_AT_HEIGHT},
              {"near", POSITIVE, ALWAYS, AT(near), DRAKE_AT_NEAR},
              {"far", POSITIVE, ALWAYS, AT(far), DRAKE_AT_FAR},
              {"focal_x", FOCAL, ALWAYS, AT(focal_x), DRAKE_AT_FOCAL_X},
              {"focal_y", FOCAL, ALWAYS, AT(focal_y), DRAKE_AT_FOCAL_Y},
              {"center_x", NUMBER, ALWAYS, AT(center_x), DRAKE_AT_CENTER_X},
              {"center_y", NUMBER, ALWAYS, AT(center_y), DRAKE_AT_CENTER_Y},
              {"fov_x", POSITIVE, NEVER, -1, ""},
              {"fov_y", POSITIVE, NEVER, -1, ""},
              {"submit", TEXT, NEVER, -1, ""}}; /* the button of the form, which Drake's client sends, too */
#undef AT
enum { FIELDS = sizeof fields / sizeof fields[0] };

static const char *const images[DRAKE_IMAGES] = {"color", "depth", "label"};

/* ---- faults ---- */

/* The beginning of a field's value, on one line. */
struct value {
    char text[84];
};

static struct value value_of(const struct multipart_part *part)
{
    enum { SHOWN = 64 };
    struct value value;
    snprintf(value.text, sizeof value.text, "'%.*s'%s", part->size < SHOWN ? (int)part->size : SHOWN, part->bytes,
             part->size < SHOWN ? "" : "...");
    return value;
}

static void refuse(const struct multipart_part *part, const char *wanted, struct zr_error *error)
{
    zr_error_add(error, ZR_BAD_REQUEST, NULL, "field '%s' has the value %s; %s is expected", part->name,
                 value_of(part).text, wanted);
}

/* Values that are allowed, in words. */
struct wanted {
    char text[64];
};

static struct wanted wanted_of(enum kind kind, uint32_t side_max)
{
    struct wanted wanted;
    if (kind == SIDE)
        snprintf(wanted.text, sizeof wanted.text, "a whole number from 1 to %" PRIu32, side_max);
    else
        snprintf(wanted.text, sizeof wanted.text, "%s", expected[kind]);
    return wanted;
}

static void refuse_unknown(const struct multipart_part *part, struct zr_error *error)
{
    char names[240] = "";
    size_t used = 0;
    for (int i = 0; i < FIELDS && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", fields[i].name);
    zr_error_add(error, ZR_BAD_REQUEST, NULL, "field '%s' is unknown; the fields are %s", part->name, names);
}

/* ---- values ---- */

static bool is_text(const struct multipart_part *part, const char *text)
{
    return part->size == strlen(text) && memcmp(part->bytes, text, part->size) == 0;
}

static bool read_number(const struct multipart_part *part, enum kind kind, uint32_t side_max, double *value)
{
    const char *end = part->bytes + part->size;
    if (part->size == 0 || zr_number_read(part->bytes, end, value) != end || !(fabs(*value) <= NUMBER_MAX))
        return false;
    switch (kind) {
    case SIDE:
        return *value >= 1.0 && *value <= (double)side_max && *value == floor(*value);
    case FOCAL:
        return *value >= FOCAL_MIN;
    case POSITIVE:
        return *value > 0.0;
    case NOT_NEGATIVE:
        return *value >= 0.0;
    default:
        return true;
    }
}

static void read_image(const struct multipart_part *part, struct drake_form *form, struct zr_error *error)
{
    for (int i = 0; i < DRAKE_IMAGES; i++) {
        if (!is_text(part, images[i])) continue;
        form->image = (enum drake_image)i;
        return;
    }
    refuse(part, expected[IMAGE_TYPE], error);
}

static void read_field(const struct field *field, const struct multipart_part *part, uint32_t side_max,
                       struct drake_form *form, struct zr_error *error)
{
    double value;
    if (field->kind == FILE_PART) form->scene = part;
    if (field->kind == IMAGE_TYPE) read_image(part, form, error);
    if (field->kind < SIDE) return;
    if (!read_number(part, field->kind, side_max, &value))
        refuse(part, wanted_of(field->kind, side_max).text, error);
    else if (field->offset >= 0)
        memcpy((char *)form + field->offset, &value, sizeof value);
}

/* Fields of depth images belong to no other image. */
static void check_need(const struct field *field, const struct multipart_part *part, uint32_t side_max,
                       const struct drake_form *form, struct zr_error *error)
{
    const bool is_wanted = field->need == ALWAYS || (field->need == OF_DEPTH && form->image == DRAKE_DEPTH);
    if (!part && is_wanted)
        zr_error_add(error, ZR_BAD_REQUEST, NULL, "field '%s' is missing; %s is expected", field->name,
                     wanted_of(field->kind, side_max).text);
    else if (part && field->need == OF_DEPTH && !is_wanted)
        zr_error_add(error, ZR_BAD_REQUEST, NULL,
                     "field '%s' has the value %s; it is expected with the image_type depth only", field->name,
                     value_of(part).text);
}

static void check_order(const struct multipart *parts, const char *low_name, double low, const char *high_name,
                        double high, struct zr_error *error)
{
    char wanted[80];
    if (low < high) return;
    snprintf(wanted, sizeof wanted, "a number greater than %s, %g, at most 1e9,", low_name, low);
    refuse(multipart_find(parts, high_name), wanted, error);
}

bool drake_form_read(const struct multipart *parts, uint32_t side_max, struct drake_form *form, struct zr_error *error)
{
    *form = (struct drake_form){.scene = NULL};
    for (size_t i = 0; i < parts->count; i++) {
        int which = 0;
        while (which < FIELDS && strcmp(fields[which].name, parts->parts[i].name) != 0)
            which++;
        if (which == FIELDS) refuse_unknown(&parts->parts[i], error);
    }
    for (int i = 0; i < FIELDS; i++) {
        const struct multipart_part *part = multipart_find(parts, fields[i].name);
        if (part) read_field(&fields[i], part, side_max, form, error);
    }
    for (int i = 0; i < FIELDS; i++)
        check_need(&fields[i], multipart_find(parts, fields[i].name), side_max, form, error);
    form->hash = multipart_find(parts, "scene_sha256");
    if (error->count > 0) return false;
    check_order(parts, "near", form->near, "far", form->far, error);
    if (form->image == DRAKE_DEPTH)
        check_order(parts, "min_depth", form->min_depth, "max_depth", form->max_depth, error);
    return error->count == 0;
}

/* ---- faults of the scene ---- */

static const char *field_at(const char *pointer)
{
    for (int i = 0; i < FIELDS; i++) {
        const char *at = fields[i].pointer;
        if (*at && strncmp(at, pointer, strlen(at)) == 0) return fields[i].name;
    }
    return strncmp(pointer, DRAKE_AT_CAMERA, strlen(DRAKE_AT_CAMERA)) == 0 ? "scene" : NULL;
}

void drake_form_report(const struct zr_error *faults, enum zr_status status, struct zr_error *error)
{
    for (size_t i = 0; i < zr_error_held(faults); i++) {
        const struct zr_error_item *item = &faults->items[i];
        const char *name = field_at(item->pointer);
        if (name)
            zr_error_add(error, status, NULL, "field '%s': %s", name, item->detail);
        else
            zr_error_add(error, status, item->pointer, "%s", item->detail);
    }
}
