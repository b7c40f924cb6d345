/* rows.h - output: rows of pixels generated on demand, never all in memory. */
#ifndef ZR_ROWS_H
#define ZR_ROWS_H

#include <stdbool.h>
#include <stdint.h>

struct zr_rows {
    /* Writes row `y`; called from any thread. `again`: the caller only compares its neighbour with the row, which is
     * generated for output elsewhere; statistics must not count it twice. NULL: no rows. */
    void (*make)(void *source, uint32_t y, void *row, bool again);
    void *source;
};

#endif
