/* guarded.h - tests: input that ends at a page nobody may read, so that one byte
 * too far is a crash and not luck. */
#ifndef ZR_TESTS_GUARDED_H
#define ZR_TESTS_GUARDED_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

struct guarded {
    const char *bytes;
    size_t size;
    void *map;
    size_t map_size;
};

static inline struct guarded guarded_copy(const void *bytes, size_t size)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE), room = (size + page - 1) / page * page;
    char *map = mmap(NULL, room + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (map == MAP_FAILED || mprotect(map + room, page, PROT_NONE) != 0) {
        perror("guarded_copy");
        abort();
    }
    char *copy = map + room - size;
    if (size > 0) memcpy(copy, bytes, size);
    return (struct guarded){copy, size, map, room + page};
}

static inline void guarded_free(struct guarded *guarded)
{
    munmap(guarded->map, guarded->map_size);
}

#endif
