/* first_frame.h - bench: what the program first_frame reads from its standard input, as bytes: this, then
 * position_count positions, as many colours, and index_count indices. It draws that through Mesa, reads back colour
 * and depth, and writes one byte.
 */
#ifndef ZR_BENCH_FIRST_FRAME_H
#define ZR_BENCH_FIRST_FRAME_H

#include "base/vec.h"

struct first_frame {
    unsigned width, height, position_count, index_count;
    zr_mat4 modelview, projection;
};

#endif
