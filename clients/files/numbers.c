#include "numbers.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char npy[] = "\x93NUMPY";

enum { NPY_SIZE = sizeof npy - 1, HEADER_SIZE = 1024, VALUES_MOST = 1 << 28 };

bool numbers_are_in(const void *head, size_t size)
{
    return (size >= NPY_SIZE && memcmp(head, npy, NPY_SIZE) == 0) ||
           (size >= 3 && (memcmp(head, "PF\n", 3) == 0 || memcmp(head, "Pf\n", 3) == 0));
}

/* How the values lie in the file. */
struct form {
    char type; /* f, i or u; booleans are u */
    size_t bytes;
    bool is_big, is_upward; /* most significant byte first; the lowest row first */
};

/* ---- values ---- */

static double value_of(const unsigned char *at, const struct form *form)
{
    uint64_t bits = 0;
    double value;
    float single;
    for (size_t i = 0; i < form->bytes; i++)
        bits |= (uint64_t)at[form->is_big ? form->bytes - 1 - i : i] << 8 * i;
    if (form->type == 'f' && form->bytes == 8) {
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    if (form->type == 'f') {
        const uint32_t low = (uint32_t)bits;
        memcpy(&single, &low, sizeof single);
        return (double)single;
    }
    if (form->type == 'i' && form->bytes < 8 && bits >> (8 * form->bytes - 1))
        return (double)bits - (double)(UINT64_C(1) << 8 * form->bytes);
    return form->type == 'i' ? (double)(int64_t)bits : (double)bits;
}

/* Takes the values of a picture whose size is set. */
static bool take_values(struct numbers *out, const struct form *form, const unsigned char *data, size_t size,
                        struct bytes *faults)
{
    if (out->width == 0 || out->height == 0 || out->channels == 0 || out->width > VALUES_MOST / out->height ||
        out->channels > VALUES_MOST / (out->width * out->height))
        return bytes_print(faults, "the array is empty, or has more than %d values", VALUES_MOST), false;
    const size_t row = out->width * out->channels, count = row * out->height;
    if (size < count * form->bytes)
        return bytes_print(faults, "the file is cut off: %zu values of %zu bytes", count, form->bytes), false;
    out->values = malloc(count * sizeof *out->values);
    if (!out->values) return bytes_print(faults, "out of memory"), false;
    for (size_t y = 0; y < out->height; y++)
        for (size_t i = 0; i < row; i++)
            out->values[(form->is_upward ? out->height - 1 - y : y) * row + i] =
                value_of(data + (y * row + i) * form->bytes, form);
    return true;
}

/* ---- headers ---- */

/* Reads the text of an NPY's header, "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }". */
static bool read_header(struct numbers *out, struct form *form, const char *text, struct bytes *faults)
{
    const char *type = strstr(text, "'descr': '"), *shape = strstr(text, "'shape': (");
    char order = 0;
    size_t sides[3] = {0, 1, 1};
    if (!type || sscanf(type, "'descr': '%c%c%zu'", &order, &form->type, &form->bytes) != 3 || !shape ||
        !strchr("<>|=", order))
        return bytes_print(faults, "the header of the NPY has no type and shape"), false;
    if (form->type == 'b') form->type = 'u';
    const bool is_float = form->type == 'f' && (form->bytes == 4 || form->bytes == 8);
    const bool is_integer = (form->type == 'u' || form->type == 'i') &&
                            (form->bytes == 1 || form->bytes == 2 || form->bytes == 4 || form->bytes == 8);
    if ((!is_float && !is_integer) || strstr(text, "'fortran_order': True"))
        return bytes_print(faults, "floats of 4 or 8 bytes or integers, row by row, are compared"), false;
    const int found = sscanf(shape, "'shape': (%zu, %zu, %zu", &sides[0], &sides[1], &sides[2]);
    const char *end = strchr(shape, ')');
    size_t commas = 0;
    for (const char *at = shape + strlen("'shape': ("); end && at < end; at++)
        commas += *at == ',' && at[1] != ')';
    if (found < 1 || commas > 2) return bytes_print(faults, "arrays of one to three dimensions are compared"), false;
    form->is_big = order == '>';
    out->height = sides[0];
    out->width = sides[1];
    out->channels = sides[2];
    return true;
}

static bool read_npy(struct numbers *out, const unsigned char *data, size_t size, struct bytes *faults)
{
    struct form form = {.type = 0};
    char text[HEADER_SIZE];
    const size_t fixed = size > NPY_SIZE && data[NPY_SIZE] >= 2 ? 12 : 10;
    if (size < fixed) return bytes_print(faults, "the file is cut off"), false;
    size_t length = (size_t)data[8] | (size_t)data[9] << 8;
    if (fixed == 12) length |= (size_t)data[10] << 16 | (size_t)data[11] << 24;
    if (length >= sizeof text || size - fixed < length)
        return bytes_print(faults, "the header of the NPY is cut off or too long"), false;
    memcpy(text, data + fixed, length);
    text[length] = '\0';
    return read_header(out, &form, text, faults) &&
           take_values(out, &form, data + fixed + length, size - fixed - length, faults);
}

static bool read_pfm(struct numbers *out, const unsigned char *data, size_t size, struct bytes *faults)
{
    struct form form = {.type = 'f', .bytes = 4, .is_upward = true};
    char text[HEADER_SIZE];
    const size_t held = size < sizeof text - 1 ? size : sizeof text - 1;
    double scale = 0;
    int length = 0;
    memcpy(text, data, held);
    text[held] = '\0';
    if (sscanf(text + 2, "%zu %zu %lf%n", &out->width, &out->height, &scale, &length) != 3 || (size_t)length + 3 > size)
        return bytes_print(faults, "the header of the PFM is wrong"), false;
    form.is_big = scale > 0;
    out->channels = text[1] == 'F' ? 3 : 1;
    return take_values(out, &form, data + length + 3, size - (size_t)length - 3, faults);
}

bool numbers_read(struct numbers *numbers, const void *data, size_t size, struct bytes *faults)
{
    *numbers = (struct numbers){.values = NULL};
    if (!numbers_are_in(data, size)) return bytes_print(faults, "not an NPY or PFM"), false;
    return *(const char *)data == 'P' ? read_pfm(numbers, data, size, faults) : read_npy(numbers, data, size, faults);
}

void numbers_free(struct numbers *numbers)
{
    free(numbers->values);
}
