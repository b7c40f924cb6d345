/* upload.h - a request body as it comes in, bounded on its own and together
 * with all others.
 */
#ifndef ZRASTERD_UPLOAD_H
#define ZRASTERD_UPLOAD_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

/* What all uploads hold together. */
struct upload_budget {
    size_t body_max, memory_max; /* bytes */
    atomic_size_t held;
};

struct upload {
    char *bytes; /* `size` bytes and a final zero; NULL before the first */
    size_t size, capacity;
    size_t populated; /* bytes whose pages were asked for */
};

enum upload_status { UPLOAD_OK, UPLOAD_TOO_LARGE, UPLOAD_NO_MEMORY };

/* `expected` is Content-Length, 0 where unknown: room for all of it at once. */
enum upload_status upload_add(struct upload *upload, struct upload_budget *budget, const char *bytes, size_t size,
                              uint64_t expected);

void upload_free(struct upload *upload, struct upload_budget *budget);

#endif
