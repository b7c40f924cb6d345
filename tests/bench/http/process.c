#include "bench/http/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

bool process_start(struct process *process, const char *const *arguments, bool quiet)
{
    int in[2], out[2];
    posix_spawn_file_actions_t actions;
    if (pipe2(in, O_CLOEXEC) != 0) return false;
    if (pipe2(out, O_CLOEXEC) != 0) return false;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    if (quiet) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    int failure =
        posix_spawn(&process->pid, arguments[0], &actions, NULL, (char *const *)(uintptr_t)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]);
    close(out[1]);
    process->in = in[1];
    process->out = out[0];
    if (failure == 0) return true;
    close(process->in);
    close(process->out);
    return false;
}

bool process_wait(struct process *process, char *line, size_t size)
{
    char byte;
    size_t used = 0;
    if (!line) return read(process->out, &byte, 1) == 1;
    do {
        ssize_t count = read(process->out, line + used, size - 1 - used);
        if (count <= 0) return false;
        used += (size_t)count;
        line[used] = '\0';
    } while (used + 1 < size && !strchr(line, '\n'));
    return true;
}

bool process_end(struct process *process, int signal)
{
    int status = -1;
    close(process->in);
    close(process->out);
    if (signal) kill(process->pid, signal);
    return waitpid(process->pid, &status, 0) == process->pid && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
