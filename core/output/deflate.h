/* deflate.h - output: bytes -> one part of a deflate stream, through ISA-L at level 1.
 *
 * Exact:  the same bytes give the same part, wherever in memory `stream` and all else lie. ISA-L 2.30 and 2.31 do not
 *         give that of themselves: where a stream begins within their main loop (more than 16 bytes), byte 2 is entered
 *         in the table of matches under a hash of the stream's own address (igzip_icf_body_h1_gr_bt.asm,
 * write_first_byte), so that some matches are found at one address and not at another.
 */
#ifndef ZR_DEFLATE_H
#define ZR_DEFLATE_H

#include <isa-l/igzip_lib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `bytes` has as many behind `size` that can be read; ISA-L looks ahead by 288. `table` may hold anything before. */
enum { ZR_DEFLATE_TAIL = 512, ZR_DEFLATE_TABLE = ISAL_DEF_LVL1_DEFAULT };

/* Writes a part that refers to nothing in front of it. The last one ends the stream, the others end on a whole byte.
 * Returns its size, or 0 where `out` has no room for it: that of bytes which cannot be compressed. */
size_t zr_deflate(struct isal_zstream *stream, uint8_t table[ZR_DEFLATE_TABLE], const uint8_t *bytes, size_t size,
                  bool last, uint8_t *out, size_t room);

#endif
