/* deflate.h - output: compresses bytes to one part of a deflate stream, by ISA-L at level 1.
 *
 * Exact:  the same bytes give the same part, at any address of `stream` and the buffers. ISA-L 2.30 and 2.31 alone do
 *         not ensure this. If a stream begins within their main loop (more than 16 bytes), byte 2 enters the match
 *         table under a hash of the stream's own address. Some matches are then found at one address and not at another
 *         (igzip_icf_body_h1_gr_bt.asm, write_first_byte). */
#ifndef ZR_DEFLATE_H
#define ZR_DEFLATE_H

#include <isa-l/igzip_lib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ZR_DEFLATE_TAIL readable bytes must follow the input; ISA-L looks ahead by 288. `table` needs no initial value. */
enum { ZR_DEFLATE_TAIL = 512, ZR_DEFLATE_TABLE = ISAL_DEF_LVL1_DEFAULT };

/* Writes a part that refers to no data before it. The last part ends the stream; the others end on a whole byte.
 * Returns its size, or 0 if it does not fit into `room`, the size for incompressible bytes. */
size_t zr_deflate(struct isal_zstream *stream, uint8_t table[ZR_DEFLATE_TABLE], const uint8_t *bytes, size_t size,
                  bool last, uint8_t *out, size_t room);

#endif
