/* upload.h - a request body during its arrival, bounded alone and together with all others. */
#ifndef ZRASTERD_UPLOAD_H
#define ZRASTERD_UPLOAD_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

/* Budget of all uploads together. */
struct upload_budget {
    size_t body_max, memory_max; /* bytes */
    atomic_size_t held;
};

struct upload {
    char *bytes; /* `size` bytes and a final zero; NULL while empty */
    size_t size, capacity;
    size_t populated; /* bytes whose pages are populated */
};

enum upload_status { UPLOAD_OK, UPLOAD_TOO_LARGE, UPLOAD_NO_MEMORY };

/* Appends bytes. `expected`: Content-Length, reserved at once; 0: unknown. */
enum upload_status upload_add(struct upload *upload, struct upload_budget *budget, const char *bytes, size_t size,
                              uint64_t expected);

void upload_free(struct upload *upload, struct upload_budget *budget);

#endif
