/* sort.h - base: sorts numbers in place, without recursion or memory. */
#ifndef ZR_SORT_H
#define ZR_SORT_H

#include <stdint.h>

/* Sorts ascending: by insertion if there are few, else by heap sort, which is never quadratic. */
void zr_sort_u64(uint64_t *values, uint32_t count);

#endif
