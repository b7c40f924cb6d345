/* part_set.h - scene: parts that a key names (scene/parts/part_list.h), as read.
 *
 * Names:  a pattern is the name of a part, or has the signs * (any text) and ? (any one character). A text of digits
 *         that is no name is an id. Ids count parts from 1.
 */
#ifndef ZR_PART_SET_H
#define ZR_PART_SET_H

#include <stdbool.h>
#include <stdint.h>

struct zr_part_pattern {
    const char *text; /* UTF-8; NULL: an id */
    double id;
};

/* The parts that a key names. Without patterns, the key has no effect. */
struct zr_part_set {
    uint32_t count;
    const struct zr_part_pattern *patterns;
    const char *pointer; /* JSON Pointer of the value */
    bool is_list;        /* pattern i has the pointer `pointer`/i; false: `pointer` */
};

#endif
