#include "refusal.h"

static const struct {
    const char *word, *text;
} ROWS[REFUSALS] = {
    [REFUSAL_NONE] = {"", ""},
    [REFUSAL_DRAINING] = {"draining", "the daemon is shutting down"},
    [REFUSAL_QUEUE] = {"queue", "the queue is full"},
    [REFUSAL_ANSWERS] = {"answers", "the answers that wait for their readers fill answerMemoryBytes"},
    [REFUSAL_UPLOADS] = {"uploads", "the bodies of requests fill uploadMemoryBytes"},
    [REFUSAL_STREAMS] = {"streams", "no more answers can be streamed at once (maxStreams)"},
    [REFUSAL_CONTAINER] = {"container", "the memory of the container is nearly used up"},
    [REFUSAL_MEMORY] = {"memory", "the system has no memory for the request now"},
    [REFUSAL_CONNECTIONS] = {"connections", ""},
    [REFUSAL_CLIENT] = {"client", ""},
};

const char *refusal_text(enum refusal refusal)
{
    return ROWS[refusal].text;
}

const char *refusal_word(enum refusal refusal)
{
    return ROWS[refusal].word;
}
