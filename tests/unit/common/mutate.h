/* mutate.h - tests: texts changed at random. */
#ifndef ZR_TESTS_MUTATE_H
#define ZR_TESTS_MUTATE_H

#include "texts.h"

/* One to three changes: a byte, a piece taken away, a piece copied over another, a byte put in. */
static inline void mutate(struct text *text)
{
    static const char bytes[] = "0123456789-+.eE,,[]{}\":\\ \n\tnulltruefalse#\xFF\x01";
    for (size_t changes = 1 + below(3); changes > 0 && text->size > 2; changes--) {
        size_t at = below(text->size), length = 1 + below(12), from = below(text->size);
        switch (below(4)) {
        case 0:
            text->bytes[at] = bytes[below(sizeof bytes - 1)];
            break;
        case 1: /* take away */
            if (length > text->size - at) length = text->size - at;
            memmove(text->bytes + at, text->bytes + at + length, text->size - at - length);
            text->size -= length;
            break;
        case 2: /* copy over */
            if (length > text->size - at) length = text->size - at;
            if (length > text->size - from) length = text->size - from;
            memmove(text->bytes + at, text->bytes + from, length);
            break;
        default: /* put in */
            put(text, " ", 1);
            memmove(text->bytes + at + 1, text->bytes + at, text->size - 1 - at);
            text->bytes[at] = bytes[below(sizeof bytes - 1)];
        }
    }
}

#endif
