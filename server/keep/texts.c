#include "texts.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

#include "base/cancel.h"

enum { SAMPLES = 64, SAMPLE_BYTES = 64, COMPARED_AT_ONCE = 1 << 20, HASHES_TRIED = 16 };

struct text {
    struct kept_value value;
    size_t size, byte_count;
    const char *text;
    const unsigned char *bytes;
    pthread_mutex_t lock;
    bool is_hashed;
    struct zr_file_hash hash; /* of the bytes */
    char room[];              /* text and bytes */
};

static void free_text(struct kept_value *value)
{
    pthread_mutex_destroy(&((struct text *)value)->lock);
    free(value);
}

struct kept *texts_open(uint64_t max_bytes)
{
    static const struct kept_kind kind = {.free = free_text};
    return kept_open(&kind, max_bytes);
}

/* ---- hashes ---- */

static void add(struct zr_file_hash *hash, const void *bytes, size_t size)
{
    struct sha256_ctx sha256;
    sha256_init(&sha256);
    sha256_update(&sha256, sizeof hash->bytes, hash->bytes);
    sha256_update(&sha256, size, bytes);
    sha256_digest(&sha256, sizeof hash->bytes, hash->bytes);
}

/* Hashes the size and some samples, from the beginning to the end. */
static void hash_samples(const char *text, size_t size, struct zr_file_hash *hash)
{
    char samples[SAMPLES * SAMPLE_BYTES];
    const size_t step = size < sizeof samples ? 0 : (size - SAMPLE_BYTES) / (SAMPLES - 1);
    *hash = (struct zr_file_hash){{0}};
    add(hash, &size, sizeof size);
    for (size_t i = 0; step > 0 && i < SAMPLES; i++)
        memcpy(samples + i * SAMPLE_BYTES, text + i * step, SAMPLE_BYTES);
    if (step > 0)
        add(hash, samples, sizeof samples);
    else
        add(hash, text, size);
}

/* Compares a text with a kept one. Sets *at to the first difference. */
static bool is_equal(const struct text *kept, const char *text, size_t size, const struct zr_cancel *cancel, size_t *at)
{
    *at = 0;
    if (kept->size != size) return false;
    while (*at < size && !zr_is_cancelled(cancel)) {
        const size_t count = size - *at < COMPARED_AT_ONCE ? size - *at : COMPARED_AT_ONCE;
        if (memcmp(kept->text + *at, text + *at, count) != 0) break;
        *at += count;
    }
    if (*at == size) return true;
    while (kept->text[*at] == text[*at] && *at + 1 < size)
        ++*at;
    return false;
}

/* ---- texts of one request ---- */

/* A kept text that a request uses. */
struct text_found {
    struct text *text;
    struct text_found *next;
};

/* Without memory, the hash of its bytes is computed again. */
static void note_found(struct texts_use *use, struct kept_value *value)
{
    struct text_found *found = malloc(sizeof *found);
    if (!found) return;
    *found = (struct text_found){(struct text *)value, use->found};
    use->found = found;
}

static bool find(void *context, const char *text, size_t size, const struct zr_cancel *cancel,
                 struct zr_file_hash *hash, const void **bytes, size_t *byte_count)
{
    struct texts_use *use = context;
    hash_samples(text, size, hash);
    for (int i = 0; i < HASHES_TRIED && !zr_is_cancelled(cancel); i++) {
        struct kept_value *value = kept_find(use->texts, hash, &use->held, NULL);
        const struct text *kept = (const struct text *)value;
        size_t at;
        if (!value) break;
        if (is_equal(kept, text, size, cancel, &at)) {
            note_found(use, value);
            *bytes = kept->bytes;
            *byte_count = kept->byte_count;
            return true;
        }
        add(hash, &at, sizeof at);
        add(hash, text + at, size - at < SAMPLE_BYTES ? size - at : SAMPLE_BYTES);
    }
    kept_miss(use->texts);
    return false;
}

static void keep(void *context, const struct zr_file_hash *hash, const char *text, size_t size, const void *bytes,
                 size_t byte_count)
{
    struct kept *texts = ((struct texts_use *)context)->texts;
    const uint64_t room = sizeof(struct text) + size + byte_count;
    struct text *made = kept_note(texts, hash) && room <= kept_max_bytes(texts) ? malloc(room) : NULL;
    if (!made) return;
    *made = (struct text){.value = {.hash = *hash, .bytes = room}, .size = size, .byte_count = byte_count};
    pthread_mutex_init(&made->lock, NULL);
    made->text = memcpy(made->room, text, size);
    made->bytes = memcpy(made->room + size, bytes, byte_count);
    kept_add(texts, &made->value, NULL);
}

struct zr_kept_texts texts_lend(struct texts_use *use)
{
    if (!use->texts || kept_max_bytes(use->texts) == 0) return (struct zr_kept_texts){.find = NULL};
    return (struct zr_kept_texts){find, keep, use};
}

static void hash_bytes(const void *bytes, size_t size, struct zr_file_hash *hash)
{
    struct sha256_ctx sha256;
    sha256_init(&sha256);
    sha256_update(&sha256, size, bytes);
    sha256_digest(&sha256, sizeof hash->bytes, hash->bytes);
}

void texts_hash(const struct texts_use *use, const void *bytes, size_t size, struct zr_file_hash *hash)
{
    const struct text_found *found = use ? use->found : NULL;
    while (found && (found->text->bytes != bytes || found->text->byte_count != size))
        found = found->next;
    if (!found) {
        hash_bytes(bytes, size, hash);
        return;
    }
    pthread_mutex_lock(&found->text->lock);
    if (!found->text->is_hashed) hash_bytes(bytes, size, &found->text->hash);
    found->text->is_hashed = true;
    *hash = found->text->hash;
    pthread_mutex_unlock(&found->text->lock);
}

void texts_release(struct texts_use *use)
{
    for (struct text_found *next; use->found; use->found = next) {
        next = use->found->next;
        free(use->found);
    }
    if (use->texts) kept_release(use->texts, &use->held);
}
