/* ticker.h - client: a line on stderr that shows how long a file has been read and drawn. */
#ifndef TICKER_H
#define TICKER_H

#include <pthread.h>
#include <stdbool.h>

struct ticker {
    bool is_running, ends, is_printed;
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t change;
};

/* Starts the line "3.2 s" if `is_shown`; it appears after half a second. */
void ticker_start(struct ticker *ticker, bool is_shown);

/* Clears the line. Others may print afterwards. Does nothing the second time. */
void ticker_end(struct ticker *ticker);

#endif
