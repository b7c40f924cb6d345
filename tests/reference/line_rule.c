#include "reference/line_rule.h"

#include <stdio.h>
#include <string.h>

#include "base/mutant.h"

enum { SIDE = 16 };

const char *const line_rule_names[] = {[LINE_RULE_OLDER] = "older", [LINE_RULE_CURRENT] = "current"};

/* Clip space of a place in the window, y up. Exact for these. */
static zr_vec4 at(float x, float y)
{
    return (zr_vec4){x * 2 / SIDE - 1, y * 2 / SIDE - 1, 0, 1};
}

/* Whether a line from a to b covers pixel x, y (y up). */
static bool covers(struct reference *reference, zr_vec4 a, zr_vec4 b, int x, int y, bool *out,
                   struct reference_error *error)
{
    static const zr_vec4 white[2] = {{1, 1, 1, 1}, {1, 1, 1, 1}};
    const zr_vec4 positions[2] = {a, b};
    const zr_mat4 identity = zr_mat4_identity();
    const struct reference_batch batch = {.mode = REFERENCE_LINES, .count = 2, .modelview = &identity};
    const struct reference_arrays arrays = {
        .positions = positions, .front = white, .batch_count = 1, .batches = &batch, .projection = identity};
    uint8_t rgba[SIDE * SIDE * 4];
    if (!reference_resize(reference, SIDE, SIDE, false, error) || !reference_draw(reference, &arrays, error) ||
        !reference_read(reference, rgba, NULL, error))
        return false;
    *out = rgba[((SIDE - 1 - y) * SIDE + x) * 4] != 0;
    return true;
}

/* Nobody looked at the versions between these two: there the lines alone decide. */
static bool version_contradicts(const struct reference *reference, enum line_rule rule)
{
    int version = reference_mesa_version(reference);
    return (version >= REFERENCE_CURRENT_MESA && rule == LINE_RULE_OLDER) ||
           (version <= 2203 && rule == LINE_RULE_CURRENT);
}

bool line_rule_find(struct reference *reference, enum line_rule *rule, struct reference_error *error)
{
    bool first_is_drawn, goes_even;
    /* Down from the centre of a pixel, whose own it is by the current rule; and 128.5 subpixels above the centres of
     * row 0, which is row 0 where it is rounded to even, and row 1 where it is rounded up. */
    const float tie = 0.5f + 128.5f / 256;
    if (!covers(reference, at(2.5f, 4.5f), at(2.5f, 1.5f), 2, 4, &first_is_drawn, error) ||
        !covers(reference, at(1.25f, tie), at(9.25f, tie), 5, 0, &goes_even, error))
        return false;
    *rule = first_is_drawn ? LINE_RULE_CURRENT : LINE_RULE_OLDER;
    if (first_is_drawn == goes_even && !version_contradicts(reference, *rule)) return true;
    snprintf(error->text, sizeof error->text,
             "lines follow no known rule (a pixel under a first end is%s drawn, ties go %s): %s",
             first_is_drawn ? "" : " not", goes_even ? "to even" : "away from zero", reference_name(reference));
    return false;
}

bool line_rule_choose(enum line_rule rule)
{
    return zr_mutant_set("older_mesa", rule == LINE_RULE_OLDER);
}
