#include "refusal.h"

static const struct {
    const char *word, *text;
} ROWS[REFUSALS] = {
    [REFUSAL_NONE] = {"", ""},
    [REFUSAL_DRAINING] = {"draining", "the daemon is shutting down"},
    [REFUSAL_QUEUE] = {"queue", "the queue has as many requests as the setting queue allows"},
    [REFUSAL_WAIT] = {"wait", "the requests in the queue need more than a second before this one would begin"},
    [REFUSAL_ANSWERS] = {"answers", "the answers that wait for their readers fill answerMemoryBytes"},
    [REFUSAL_SHARE] = {"share", "the answers that wait for this client fill its half of answerMemoryBytes"},
    [REFUSAL_UPLOADS] = {"uploads", "the bodies of requests fill uploadMemoryBytes"},
    [REFUSAL_STREAMS] = {"streams", "no more answers can be streamed at once (maxStreams)"},
    [REFUSAL_STREAM_SHARE] = {"stream_share", "this client has half of the answers that can be streamed (maxStreams)"},
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
