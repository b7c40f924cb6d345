/* likeness.h - bench: how alike two pictures are that need not be equal to the last bit. */
#ifndef ZR_BENCH_LIKENESS_H
#define ZR_BENCH_LIKENESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "reference/gl/reference.h"
#include "shade/frame.h"

/* Pixels. */
struct likeness {
    size_t seen; /* where the frame has something */
    size_t off;  /* a colour of theirs is more than `steps` of 255 away from ours */
    size_t deep; /* window depths differ */
};

/* Of the frame, which has color and windowDepth, and the reference's last draw. False where that cannot be read,
 * explained on stderr. */
bool likeness_find(const struct zr_frame *frame, struct reference *reference, int steps, struct likeness *likeness);

#endif
