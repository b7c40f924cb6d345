/* test_arena.h - support: an arena of at most `bytes` for each test of a file, with its setup and teardown.
 *
 *     TEST_ARENA(1 << 24)                                                      defines `arena`
 *     TEST_AROUND(f, open_arena, close_arena) { ... }
 */
#ifndef ZR_TEST_ARENA_H
#define ZR_TEST_ARENA_H

#include "base/arena.h"

#define TEST_ARENA(bytes)                                                                                              \
    static struct zr_arena arena;                                                                                      \
    static int open_arena(void **state)                                                                                \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        zr_arena_init(&arena, bytes);                                                                                  \
        return 0;                                                                                                      \
    }                                                                                                                  \
    static int close_arena(void **state)                                                                               \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        zr_arena_free(&arena);                                                                                         \
        return 0;                                                                                                      \
    }

#endif
