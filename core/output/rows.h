/* rows.h - output: rows of pixels that are made when they are wanted, and are never all in memory. */
#ifndef ZR_ROWS_H
#define ZR_ROWS_H

#include <stdbool.h>
#include <stdint.h>

struct zr_rows {
    /* Writes row `y`; from any thread. `again`: it is wanted beside the row that is written, to be looked at;
     * what is counted as rows are made is not to be counted. NULL: no such rows. */
    void (*make)(void *source, uint32_t y, void *row, bool again);
    void *source;
};

#endif
