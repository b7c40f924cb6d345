#include "answers.h"

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
