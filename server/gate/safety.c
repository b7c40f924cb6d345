#include "safety.h"

/* An SVG that is opened as a document runs nothing and loads nothing; its paper is a style. */
#define POLICY "default-src 'none'; style-src 'unsafe-inline'; sandbox"

static void add(struct answer *answer, const char *name, const char *value)
{
    if (!answer_find(answer, name)) answer_header(answer, name, "%s", value);
}

void safety_finish(struct answer *answer)
{
    add(answer, "X-Content-Type-Options", "nosniff");
    add(answer, "Content-Security-Policy", POLICY);
    add(answer, "Cross-Origin-Resource-Policy", "same-origin");
    add(answer, "Referrer-Policy", "no-referrer");
    if (answer->status >= 400) add(answer, "Cache-Control", "no-store");
}
