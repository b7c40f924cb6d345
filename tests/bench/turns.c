#include "bench/turns.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static int in = -1, out = -1;

static void wait_for_turn(void)
{
    char byte;
    if (read(in, &byte, 1) != 1) _exit(1); /* who gives turns is gone */
}

void turns_begin(void)
{
    if (!getenv(TURNS_VARIABLE)) return;
    in = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
    out = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (in < 0 || out < 0 || !freopen("/dev/null", "r", stdin) || !freopen("/dev/null", "w", stdout)) exit(2);
    wait_for_turn();
}

void turns_pass(void)
{
    if (in < 0) return;
    if (write(out, "", 1) != 1) _exit(1);
    wait_for_turn();
}
