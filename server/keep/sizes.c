#include "sizes.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { SIZES = 4096 };

struct noted {
    struct zr_file_hash key;
    size_t size;
    bool is_noted, is_pinned;
};

struct sizes {
    pthread_mutex_t lock;
    struct noted noted[SIZES]; /* each at its only place */
};

struct sizes *sizes_open(void)
{
    struct sizes *sizes = calloc(1, sizeof *sizes);
    if (sizes) pthread_mutex_init(&sizes->lock, NULL);
    return sizes;
}

void sizes_close(struct sizes *sizes)
{
    if (!sizes) return;
    pthread_mutex_destroy(&sizes->lock);
    free(sizes);
}

static struct noted *place_of(struct sizes *sizes, const struct zr_file_hash *key)
{
    return &sizes->noted[(key->bytes[0] | (size_t)key->bytes[1] << 8) % SIZES];
}

void sizes_note(struct sizes *sizes, const struct zr_file_hash *key, size_t size, bool is_pinned)
{
    if (!sizes) return;
    pthread_mutex_lock(&sizes->lock);
    *place_of(sizes, key) = (struct noted){*key, size, true, is_pinned};
    pthread_mutex_unlock(&sizes->lock);
}

bool sizes_find(struct sizes *sizes, const struct zr_file_hash *key, size_t *size, bool *is_pinned)
{
    if (!sizes) return false;
    pthread_mutex_lock(&sizes->lock);
    const struct noted noted = *place_of(sizes, key);
    pthread_mutex_unlock(&sizes->lock);
    if (!noted.is_noted || memcmp(&noted.key, key, sizeof *key) != 0) return false;
    *size = noted.size;
    *is_pinned = noted.is_pinned;
    return true;
}
