#include "output/deflate.h"

#include <string.h>

/* A first call with up to 16 bytes does not enter ISA-L's main loop, and by the next call the stream has begun. This
 * avoids the fault described in deflate.h through ISA-L's documented interface, and costs 7 bytes per part. */
enum { FIRST = 8 };

/* Returns true if all bytes fit. */
static bool add(struct isal_zstream *stream, const uint8_t *bytes, size_t size, bool last)
{
    stream->end_of_stream = last;
    stream->flush = last ? NO_FLUSH : SYNC_FLUSH; /* ends on a whole byte */
    stream->next_in = (uint8_t *)(uintptr_t)bytes;
    stream->avail_in = (uint32_t)size;
    return isal_deflate(stream) == COMP_OK && stream->avail_in == 0 && stream->avail_out > 0;
}

size_t zr_deflate(struct isal_zstream *stream, uint8_t table[ZR_DEFLATE_TABLE], const uint8_t *bytes, size_t size,
                  bool last, uint8_t *out, size_t room)
{
    memset(stream, 0, sizeof *stream);
    isal_deflate_init(stream);
    stream->level = 1;
    stream->level_buf = table;
    stream->level_buf_size = ZR_DEFLATE_TABLE;
    stream->next_out = out;
    stream->avail_out = (uint32_t)room;
    size_t first = size > FIRST ? FIRST : 0;
    if (first > 0 && !add(stream, bytes, first, false)) return 0;
    return add(stream, bytes + first, size - first, last) ? stream->total_out : 0;
}
