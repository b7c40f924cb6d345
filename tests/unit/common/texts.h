/* texts.h - tests: texts made piece by piece, and at random. */
#ifndef ZR_TESTS_TEXTS_H
#define ZR_TESTS_TEXTS_H

#include "input_check.h"
#include "support/random.h"

struct text {
    char *bytes;
    size_t size, room;
};

static inline void put(struct text *text, const char *bytes, size_t size)
{
    if (text->size + size + 1 > text->room) {
        text->room = 2 * (text->size + size) + 4096;
        text->bytes = realloc(text->bytes, text->room);
        assert_non_null(text->bytes);
    }
    memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
    text->bytes[text->size] = '\0';
}

static inline void add(struct text *text, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    int size = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    assert_in_range(size, 0, sizeof line - 1);
    put(text, line, (size_t)size);
}

static inline void drop(struct text *text)
{
    free(text->bytes);
    *text = (struct text){0};
}

static struct random numbers = {{RANDOM_STATE_1}};

static inline size_t below(size_t count)
{
    return random_below(&numbers, (uint32_t)count);
}

static inline double any_place(void)
{
    return ((double)below(2000001) - 1e6) / (double)(below(3) ? 1000000 : 10);
}

#endif
