#include "input/parameter_names.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "parameter_rows.h"
#include "scene/shadings.h"

static const struct {
    const char *name, *pointer;
} rows[] = {
#define PARAMETER(name, pointer, ...) {#name, pointer},
    ZR_PARAMETER_ROWS(PARAMETER)
#undef PARAMETER
};

/* Finds the parameter that sets a key, of `length` bytes, of the object at `pointer`. NULL if there is none. */
static const char *parameter_of(const char *pointer, const char *key, size_t length)
{
    const size_t object = strlen(pointer);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *at = rows[i].pointer;
        if (strlen(at) == object + 1 + length && at[object] == '/' && memcmp(at, pointer, object) == 0 &&
            memcmp(at + object + 1, key, length) == 0)
            return rows[i].name;
    }
    return NULL;
}

struct zr_parameter_text zr_parameter_names(const char *pointer, const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    struct zr_parameter_text out = {""};
    for (size_t used = 0; *text && used < sizeof out.text;) {
        const size_t word = strspn(text, letters), length = word ? word : strcspn(text, letters);
        const char *name = word ? parameter_of(pointer, text, word) : NULL;
        used += (size_t)snprintf(out.text + used, sizeof out.text - used, "%.*s", name ? INT_MAX : (int)length,
                                 name ? name : text);
        text += length;
    }
    return out;
}
