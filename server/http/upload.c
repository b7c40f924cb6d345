#include "upload.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { FIRST_CAPACITY = 16 << 10, PAGE = 4 << 10, HUGE_PAGE = 2 << 20, LARGE = 256 << 10, AHEAD = 256 << 10 };

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Advises the system about the whole pages between two bytes. The system may refuse. */
static void advise(const struct upload *upload, size_t from, size_t to, int advice)
{
    const uintptr_t bytes = (uintptr_t)upload->bytes;
    const uintptr_t first = (bytes + from + PAGE - 1) & ~(uintptr_t)(PAGE - 1);
    const uintptr_t last = (bytes + to) & ~(uintptr_t)(PAGE - 1);
    if (first < last) madvise((void *)first, last - first, advice);
}

/* Populates the pages of a large body in batches, at most as much ahead as has arrived. Single page faults add 1.5 ms
 * to a body of 3 MB, and huge pages take a third off the time of one of 39 MB. */
static void populate(struct upload *upload, size_t needed)
{
    const size_t capacity = upload->capacity;
    if (needed <= upload->populated || capacity < LARGE) return;
    const size_t huge_begin = HUGE_PAGE + (size_t)(-(uintptr_t)upload->bytes % HUGE_PAGE);
    const size_t huge_pages = capacity > huge_begin ? (capacity - huge_begin) / HUGE_PAGE : 0;
    const size_t huge_end = huge_begin + huge_pages * HUGE_PAGE;
    size_t end = smaller(capacity, needed + smaller(needed, AHEAD)), small_end = end;
    if (huge_pages > 0 && end > huge_begin && upload->populated < huge_end) {
        advise(upload, huge_begin, huge_end, MADV_HUGEPAGE);
        small_end = huge_begin;
        end = huge_end;
    }
    advise(upload, upload->populated, small_end, MADV_POPULATE_WRITE);
    upload->populated = end;
}

enum upload_status upload_add(struct upload *upload, struct upload_budget *budget, const char *bytes, size_t size,
                              uint64_t expected)
{
    if (size > budget->body_max - upload->size) return UPLOAD_TOO_LARGE;
    /* Only received bytes count: reserved room costs next to nothing before it is written, except pages populated
     * ahead. */
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
