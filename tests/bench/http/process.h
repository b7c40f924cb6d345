/* process.h - bench: a program that is started, says something, and is ended. */
#ifndef ZR_BENCH_PROCESS_H
#define ZR_BENCH_PROCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

struct process {
    pid_t pid;
    int in, out; /* its standard input and output, seen from here */
};

/* `arguments` ends with NULL, and begins with the file to run. Its standard error is kept where `quiet` is false. */
bool process_start(struct process *process, const char *const *arguments, bool quiet);

/* What it writes up to the end of a line, or its first byte where `line` is NULL; waits without a clock, so that
 * nothing is added to what is timed. */
bool process_wait(struct process *process, char *line, size_t size);

/* Closes both ends and, where `signal` is not 0, sends it; waits. True where it ended well. */
bool process_end(struct process *process, int signal);

#endif
