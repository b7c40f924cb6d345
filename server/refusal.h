/* refusal.h - reasons of a 503 or a 429, from one table: the text for the client, and the word for the log and for
 * metrics. */
#ifndef ZRASTERD_REFUSAL_H
#define ZRASTERD_REFUSAL_H

enum refusal {
    REFUSAL_NONE,
    REFUSAL_DRAINING,     /* the daemon goes down */
    REFUSAL_QUEUE,        /* the queue holds as many requests as it may */
    REFUSAL_WAIT,         /* the requests in the queue take too long */
    REFUSAL_ANSWERS,      /* answers that wait fill answerMemoryBytes */
    REFUSAL_SHARE,        /* those of the client fill its share of answerMemoryBytes */
    REFUSAL_UPLOADS,      /* bodies fill uploadMemoryBytes */
    REFUSAL_STREAMS,      /* maxStreams answers are streamed */
    REFUSAL_STREAM_SHARE, /* the client has its share of maxStreams */
    REFUSAL_CONTAINER,    /* the memory of the control group is nearly used up */
    REFUSAL_MEMORY,       /* the system has no memory */
    REFUSAL_CONNECTIONS,  /* the connection's place was needed, or there was none */
    REFUSAL_CLIENT,       /* maxPerClient: 429 */
    REFUSALS
};

/* Returns the sentence for the client, "" for those that have their own, and the word. */
const char *refusal_text(enum refusal refusal);
const char *refusal_word(enum refusal refusal);

#endif
