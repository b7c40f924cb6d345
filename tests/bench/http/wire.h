/* wire.h - bench: HTTP over one connection that stays open, with as little of its own as can be. */
#ifndef ZR_BENCH_WIRE_H
#define ZR_BENCH_WIRE_H

#include <stdbool.h>
#include <stddef.h>

struct wire {
    int fd;
    char *bytes; /* of the last answer; kept, warm */
    size_t room;
};

/* Of the last answer; valid until the next. */
struct wire_answer {
    int status;
    const char *headers; /* zero-terminated */
    const char *body;
    size_t size;
};

/* To 127.0.0.1. False where nobody listens. wire_close in any case. */
bool wire_open(struct wire *wire, unsigned port);
void wire_close(struct wire *wire);

/* One request; `body` NULL: none, else it is JSON. False where no whole answer came. */
bool wire_ask(struct wire *wire, const char *method, const char *target, const void *body, size_t size,
              struct wire_answer *answer);

/* Of a step that Server-Timing tells of: "parse", "render", "encode". 0 where it does not. */
double wire_step_ms(const struct wire_answer *answer, const char *step);

#endif
