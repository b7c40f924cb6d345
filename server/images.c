#include "images.h"

#include <malloc.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

#include "scene/image.h"

enum { CHAINS = 4096, BLOCK = 4096 };

_Static_assert(sizeof(struct zr_image_hash) == SHA256_DIGEST_SIZE, "the hash of images is SHA-256");

struct entry {
    struct zr_image_hash hash;
    struct zr_kept_image kept;
    uint64_t bytes;     /* size in whole blocks */
    size_t users;       /* number of requests that use it */
    struct entry *next; /* next entry of the chain */
    struct entry *newer, *older;
    unsigned char texels[];
};

struct images {
    pthread_mutex_t lock;
    uint64_t max_bytes;
    struct images_state state;
    struct entry *newest, *oldest; /* in the order of last use */
    struct entry *chains[CHAINS];
};

/* An image that a request uses. */
struct images_held {
    struct entry *entry;
    struct images_held *next;
};

struct images *images_open(uint64_t max_bytes)
{
    struct images *images = calloc(1, sizeof *images);
    if (!images) return NULL;
    images->max_bytes = max_bytes;
    pthread_mutex_init(&images->lock, NULL);
    return images;
}

/* ---- with the lock held ---- */

static struct entry **chain_of(struct images *images, const struct zr_image_hash *hash)
{
    return &images->chains[(hash->bytes[0] | (size_t)hash->bytes[1] << 8) % CHAINS];
}

static struct entry *find_entry(struct images *images, const struct zr_image_hash *hash)
{
    struct entry *entry = *chain_of(images, hash);
    while (entry && memcmp(&entry->hash, hash, sizeof *hash) != 0)
        entry = entry->next;
    return entry;
}

static void unlink_use(struct images *images, struct entry *entry)
{
    *(entry->newer ? &entry->newer->older : &images->newest) = entry->older;
    *(entry->older ? &entry->older->newer : &images->oldest) = entry->newer;
}

static void link_newest(struct images *images, struct entry *entry)
{
    entry->newer = NULL;
    entry->older = images->newest;
    *(images->newest ? &images->newest->newer : &images->oldest) = entry;
    images->newest = entry;
}

static void remove_entry(struct images *images, struct entry *entry)
{
    struct entry **link = chain_of(images, &entry->hash);
    while (*link != entry)
        link = &(*link)->next;
    *link = entry->next;
    unlink_use(images, entry);
    images->state.count--;
    images->state.bytes -= entry->bytes;
    free(entry);
}

/* Removes the least recently used images without users, until no more than `bytes` are kept. */
static void remove_down_to(struct images *images, uint64_t bytes)
{
    for (struct entry *entry = images->oldest, *newer; entry && images->state.bytes > bytes; entry = newer) {
        newer = entry->newer;
        if (entry->users > 0) continue;
        remove_entry(images, entry);
        images->state.dropped++;
    }
}

/* Applies the stricter limits of two decodings of one image, which another request kept meanwhile or before. */
static void widen(struct entry *entry, const struct zr_kept_image *kept)
{
    if (kept->texels_max < entry->kept.texels_max) entry->kept.texels_max = kept->texels_max;
    if (kept->scratch_bytes > entry->kept.scratch_bytes) entry->kept.scratch_bytes = kept->scratch_bytes;
}

/* ---- all images ---- */

bool images_drop(struct images *images)
{
    pthread_mutex_lock(&images->lock);
    const uint64_t dropped = images->state.dropped;
    remove_down_to(images, 0);
    const bool any = images->state.dropped > dropped;
    pthread_mutex_unlock(&images->lock);
    if (any) malloc_trim(0);
    return any;
}

void images_close(struct images *images)
{
    if (!images) return;
    images_drop(images);
    pthread_mutex_destroy(&images->lock);
    free(images);
}

struct images_state images_look(struct images *images)
{
    pthread_mutex_lock(&images->lock);
    const struct images_state state = images->state;
    pthread_mutex_unlock(&images->lock);
    return state;
}

/* ---- images of one request ---- */

static bool find(void *context, const void *bytes, size_t size, struct zr_image_hash *hash, struct zr_kept_image *kept)
{
    struct images_use *use = context;
    struct images *images = use->images;
    struct sha256_ctx sha256;
    struct images_held *held = malloc(sizeof *held);
    sha256_init(&sha256);
    sha256_update(&sha256, size, bytes);
    sha256_digest(&sha256, sizeof hash->bytes, hash->bytes);
    pthread_mutex_lock(&images->lock);
    struct entry *entry = held ? find_entry(images, hash) : NULL;
    if (entry) {
        entry->users++;
        unlink_use(images, entry);
        link_newest(images, entry);
        *kept = entry->kept;
        images->state.hits++;
    } else {
        images->state.misses++;
    }
    pthread_mutex_unlock(&images->lock);
    if (!entry) {
        free(held);
        return false;
    }
    *held = (struct images_held){entry, use->held};
    use->held = held;
    return true;
}

static struct entry *copy_image(const struct zr_image_hash *hash, const struct zr_kept_image *kept)
{
    const size_t texels = zr_image_bytes(&kept->image);
    struct entry *entry = malloc(sizeof *entry + texels);
    if (!entry) return NULL;
    *entry =
        (struct entry){.hash = *hash, .kept = *kept, .bytes = (sizeof *entry + texels + BLOCK - 1) / BLOCK * BLOCK};
    memcpy(entry->texels, kept->image.texels, texels);
    entry->kept.image.texels = entry->texels;
    return entry;
}

static void keep(void *context, const struct zr_image_hash *hash, const struct zr_kept_image *kept)
{
    struct images *images = ((struct images_use *)context)->images;
    if (zr_image_bytes(&kept->image) > images->max_bytes) return;
    struct entry *made = copy_image(hash, kept);
    if (!made) return;
    pthread_mutex_lock(&images->lock);
    struct entry *entry = find_entry(images, hash);
    if (!entry && made->bytes <= images->max_bytes) remove_down_to(images, images->max_bytes - made->bytes);
    if (entry) {
        widen(entry, kept);
    } else if (made->bytes <= images->max_bytes && images->state.bytes <= images->max_bytes - made->bytes) {
        struct entry **chain = chain_of(images, hash);
        made->next = *chain;
        *chain = made;
        link_newest(images, made);
        images->state.count++;
        images->state.bytes += made->bytes;
        made = NULL;
    }
    pthread_mutex_unlock(&images->lock);
    free(made);
}

struct zr_kept_images images_lend(struct images_use *use)
{
    if (!use->images || use->images->max_bytes == 0) return (struct zr_kept_images){NULL, NULL, NULL};
    return (struct zr_kept_images){find, keep, use};
}

void images_release(struct images_use *use)
{
    if (!use->held) return;
    pthread_mutex_lock(&use->images->lock);
    for (const struct images_held *held = use->held; held; held = held->next)
        held->entry->users--;
    pthread_mutex_unlock(&use->images->lock);
    while (use->held) {
        struct images_held *next = use->held->next;
        free(use->held);
        use->held = next;
    }
}
