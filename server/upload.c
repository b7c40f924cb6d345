#include "upload.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { FIRST_CAPACITY = 16 << 10, PAGE = 4096, LARGE = 256 << 10, AHEAD = 256 << 10 };

/* The system is asked for pages of a large body many at a time, for as much again as has come, but for AHEAD at most:
 * one by one, as they are written to, a body of 3 MB waits 1.5 ms longer for them. It may refuse. */
static void populate(struct upload *upload, size_t needed)
{
    if (needed <= upload->populated || upload->capacity < LARGE) return;
    const size_t ahead = needed < AHEAD ? needed : AHEAD;
    const size_t end = upload->capacity - needed > ahead ? needed + ahead : upload->capacity;
    const uintptr_t from = (uintptr_t)(upload->bytes + upload->populated + PAGE - 1) & ~(uintptr_t)(PAGE - 1);
    const uintptr_t to = (uintptr_t)(upload->bytes + end) & ~(uintptr_t)(PAGE - 1);
    if (from < to) madvise((void *)from, to - from, MADV_POPULATE_WRITE);
    upload->populated = end;
}

enum upload_status upload_add(struct upload *upload, struct upload_budget *budget, const char *bytes, size_t size,
                              uint64_t expected)
{
    if (size > budget->body_max - upload->size) return UPLOAD_TOO_LARGE;
    /* Only bytes that have come are held: room that is asked for costs next to nothing before it is written to. */
    if (atomic_fetch_add(&budget->held, size) + size > budget->memory_max) {
        atomic_fetch_sub(&budget->held, size);
        return UPLOAD_NO_MEMORY;
    }
    size_t needed = upload->size + size;
    if (needed > upload->capacity) {
        size_t capacity = upload->capacity ? upload->capacity * 2 : FIRST_CAPACITY;
        if (!upload->bytes && expected > 0) capacity = (size_t)expected;
        if (capacity < needed) capacity = needed;
        if (capacity > budget->body_max) capacity = budget->body_max;
        char *grown = realloc(upload->bytes, capacity + 1);
        if (!grown) {
            atomic_fetch_sub(&budget->held, size);
            return UPLOAD_NO_MEMORY;
        }
        upload->bytes = grown;
        upload->capacity = capacity;
    }
    populate(upload, needed);
    memcpy(upload->bytes + upload->size, bytes, size);
    upload->size = needed;
    upload->bytes[needed] = '\0';
    return UPLOAD_OK;
}

void upload_free(struct upload *upload, struct upload_budget *budget)
{
    atomic_fetch_sub(&budget->held, upload->size);
    free(upload->bytes);
    *upload = (struct upload){0};
}
