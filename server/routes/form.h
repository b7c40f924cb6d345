/* form.h - answers that have several files as parts (parts.h), for routes that do not encode them. */
#ifndef ZRASTERD_FORM_H
#define ZRASTERD_FORM_H

#include "answer.h"
#include "http/accept.h"

struct form_file {
    const char *name, *type;
    const void *bytes;
    size_t size;
};

/* Sets status 200 and a body with a part for each of up to FORM_FILES_MAX files. */
enum { FORM_FILES_MAX = 4 };
void form_answer(struct answer *answer, enum accept_parts parts, const struct form_file *files, size_t count);

#endif
