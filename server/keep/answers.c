#include "answers.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct kept_answer {
    struct kept_value value;
    bool is_pinned;
    int status;
    size_t warnings;
    size_t size, header_count;
    struct answer_header headers[ANSWER_HEADERS_MAX]; /* values are after the bytes */
    char bytes[];
};

struct kept *answers_open(uint64_t max_bytes)
{
    static const struct kept_kind kind = {NULL, NULL, NULL};
    return kept_open(&kind, max_bytes);
}

static void release(struct answer *answer)
{
    kept_release(answer->lender, &answer->lent);
}

bool answers_find(struct kept *answers, const struct zr_file_hash *key, struct answer *answer, bool *is_pinned)
{
    if (!answers || kept_max_bytes(answers) == 0) return false;
    struct kept_value *value = kept_find(answers, key, &answer->lent, NULL);
    if (!value) {
        kept_miss(answers);
        return false;
    }
    struct kept_answer *there = (struct kept_answer *)value;
    answer->lender = answers;
    answer->release = release;
    answer->status = there->status;
    answer->bytes = there->bytes;
    answer->size = there->size;
    answer->warnings = there->warnings;
    for (size_t i = 0; i < there->header_count; i++)
        answer_header(answer, there->headers[i].name, "%s", there->headers[i].value);
    *is_pinned = there->is_pinned;
    return true;
}

void answers_keep(struct kept *answers, const struct zr_file_hash *key, const struct answer *answer, bool is_pinned)
{
    if (!answers || !answer->bytes || answer->is_broken) return;
    size_t room = sizeof(struct kept_answer) + answer->size;
    for (size_t i = 0; i < answer->header_count; i++)
        room += strlen(answer->headers[i].value) + 1;
    struct kept_answer *made = room <= kept_max_bytes(answers) ? malloc(room) : NULL;
    if (!made) return;
    *made = (struct kept_answer){.value = {.hash = *key, .bytes = room},
                                 .is_pinned = is_pinned,
                                 .status = answer->status,
                                 .warnings = answer->warnings,
                                 .size = answer->size,
                                 .header_count = answer->header_count};
    memcpy(made->bytes, answer->bytes, answer->size);
    char *text = made->bytes + answer->size;
    for (size_t i = 0; i < answer->header_count; i++) {
        made->headers[i] = (struct answer_header){answer->headers[i].name, text};
        text = stpcpy(text, answer->headers[i].value) + 1;
    }
    kept_add(answers, &made->value, NULL);
}

/* ---- sizes ---- */

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
