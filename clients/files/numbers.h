/* numbers.h - client: numbers per pixel, as NPY and PFM files have them. */
#ifndef NUMBERS_H
#define NUMBERS_H

#include "bytes.h"

struct numbers {
    size_t width, height, channels;
    double *values; /* channels per pixel, from the top left; floats and integers are exact */
};

/* Returns true if a file that begins with these bytes is an NPY or PFM. */
bool numbers_are_in(const void *head, size_t size);

/* Reads an array of two or three dimensions: rows, columns, channels. Returns false with a line in *faults on
 * failure. */
bool numbers_read(struct numbers *numbers, const void *data, size_t size, struct bytes *faults);

void numbers_free(struct numbers *numbers);

#endif
