/* daemon.h - a real zrasterd for a test: started on a free port, stopped by its
 * own process id. A failure here fails the running test.
 */
#ifndef TEST_DAEMON_H
#define TEST_DAEMON_H

#include <stddef.h>
#include <sys/types.h>

struct daemon {
    pid_t pid;
    unsigned port;
    int log_fd;      /* its standard error: a file in memory */
    unsigned client; /* N: clients of this copy have the address 127.0.0.N; 0: the usual one */
};

/* Flags of a daemon, as an array that ends with NULL. */
#define LIST(...)                                                                                                      \
    (const char *const[])                                                                                              \
    {                                                                                                                  \
        __VA_ARGS__, NULL                                                                                              \
    }

/* With this flag the daemon refuses no scene for its predicted cost. Without it, a slow machine or build refuses a slow
 * scene at once. */
#define ANY_COST "--cost-max-ms=86400000"

/* The binary: named by ZRASTERD, else build/zrasterd. */
const char *daemon_binary(void);

/* It, with --port 0 and `flags` (ends with NULL; may be NULL). Returns when it listens. */
struct daemon daemon_start(const char *const *flags);

/* Asks it to end. */
void daemon_signal(const struct daemon *daemon);

/* Asks it to end and waits; its exit status must be 0, so a leak found by a sanitizer fails. */
void daemon_stop(struct daemon *daemon);

/* A line of /proc/PID/status, such as "VmHWM:", in KiB. */
long daemon_memory_kib(const struct daemon *daemon, const char *key);

/* All that it wrote to standard error so far; free it. */
char *daemon_log(const struct daemon *daemon);

/* Waits until the log has a line with `text`; returns that line (free it). The running test fails where none comes in
 * some seconds. */
char *daemon_wait_for_log(const struct daemon *daemon, const char *text);

/* Runs the binary with `arguments` to its end: exit status, and what it wrote to both outputs (free it). */
int daemon_run(const char *const *arguments, char **output);

#endif
