#include "input/text/parameter_names.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "parameter_rows.h"
#include "scene/encodings.h"
#include "scene/shadings.h"

static const struct {
    const char *name, *pointer, *help;
} rows[] = {
#define PARAMETER(name, pointer, scope, kind, help) {#name, pointer, help},
    ZR_PARAMETER_ROWS(PARAMETER)
#undef PARAMETER
};

static const char missing[] = " is missing: ";

/* Finds the parameter that sets a key, of `length` bytes, of the object at `pointer`. -1 if there is none. */
static int row_of(const char *pointer, const char *key, size_t length)
{
    const size_t object = strlen(pointer);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *at = rows[i].pointer;
        if (strlen(at) == object + 1 + length && at[object] == '/' && memcmp(at, pointer, object) == 0 &&
            memcmp(at + object + 1, key, length) == 0)
            return (int)i;
    }
    return -1;
}

/* Replaces the text of a missing key, which describes JSON, by the help of its parameter. False for other texts. */
static bool explain_missing(const char *pointer, const char *text, size_t key, struct zr_parameter_text *out)
{
    const int row = row_of(pointer, text, key);
    if (row < 0 || strncmp(text + key, missing, sizeof missing - 1) != 0) return false;
    snprintf(out->text, sizeof out->text, "%s is missing, which is needed here: %s", rows[row].name, rows[row].help);
    return true;
}

struct zr_parameter_text zr_parameter_names(const char *pointer, const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    struct zr_parameter_text out = {""};
    if (explain_missing(pointer, text, strspn(text, letters), &out)) return out;
    for (size_t used = 0; *text && used < sizeof out.text;) {
        const size_t word = strspn(text, letters), length = word ? word : strcspn(text, letters);
        const int row = word ? row_of(pointer, text, word) : -1;
        const char *name = row < 0 ? NULL : rows[row].name;
        used += (size_t)snprintf(out.text + used, sizeof out.text - used, "%.*s", name ? INT_MAX : (int)length,
                                 name ? name : text);
        text += length;
    }
    return out;
}
