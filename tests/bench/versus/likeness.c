#include "bench/versus/likeness.h"

#include <stdio.h>
#include <stdlib.h>

static int most_apart(const uint8_t *a, const uint8_t *b)
{
    int most = 0;
    for (int k = 0; k < 3; k++) {
        const int difference = abs(a[k] - b[k]);
        most = difference > most ? difference : most;
    }
    return most;
}

bool likeness_find(const struct zr_frame *frame, struct reference *reference, int steps, struct likeness *likeness)
{
    const size_t pixels = (size_t)frame->width * frame->height;
    struct reference_error error = {"out of memory"};
    uint8_t *rgba = malloc(pixels * 4);
    float *depth = malloc(pixels * sizeof *depth);
    const bool ok = rgba && depth && reference_read(reference, rgba, depth, &error);
    *likeness = (struct likeness){.seen = 0};
    for (size_t i = 0; ok && i < pixels; i++) {
        likeness->seen += frame->window_depth[i] < 1.0f;
        likeness->off += most_apart(rgba + 4 * i, frame->color + 4 * i) > steps;
        likeness->deep += depth[i] != frame->window_depth[i];
    }
    free(rgba);
    free(depth);
    if (!ok) fprintf(stderr, "reference: %s\n", error.text);
    return ok;
}
