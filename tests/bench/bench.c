#include "bench/bench.h"

#include <stdarg.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

bool bench_wants(const struct bench *bench, const char *name)
{
    if (bench->only && !strstr(name, bench->only)) return false;
    if (!bench->list) return true;
    puts(name);
    return false;
}

void bench_path_of(const struct bench *bench, const char *program, char *path, size_t size)
{
    const char *slash = strrchr(bench->program, '/');
    snprintf(path, size, "%.*stests/bench/alone/%s", slash ? (int)(slash - bench->program + 1) : 0, bench->program,
             program);
}

bool bench_complain(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("zraster-bench: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs("\n", stderr);
    va_end(arguments);
    return false;
}

void sink_row(const struct sink *sink, const struct row *row)
{
    const char *bytes = (const char *)row;
    for (size_t sent = 0; sent < sizeof *row;) {
        ssize_t count = write(sink->fd, bytes + sent, sizeof *row - sent);
        if (count <= 0) _exit(1);
        sent += (size_t)count;
    }
}

static bool receive(int fd, struct row *row)
{
    char *bytes = (char *)row;
    for (size_t got = 0; got < sizeof *row;) {
        ssize_t count = read(fd, bytes + got, sizeof *row - got);
        if (count <= 0) return false;
        got += (size_t)count;
    }
    return true;
}

bool bench_in_child(struct bench *bench,
                    bool (*work)(const struct bench *bench, void *context, const struct sink *sink), void *context,
                    struct results *rows)
{
    int ends[2], status = -1;
    fflush(stdout);
    if (pipe(ends) != 0) return !(bench->results.failed = true);
    pid_t child = fork();
    if (child == 0) {
        struct sink sink = {ends[1]};
        close(ends[0]);
        bool ok = work(bench, context, &sink);
        fflush(stdout);
        _exit(ok ? 0 : 1);
    }
    close(ends[1]);
    struct row row;
    while (child > 0 && receive(ends[0], &row)) {
        results_add(rows ? rows : &bench->results, &row);
        if (!rows) results_print_row(&row);
    }
    close(ends[0]);
    bool ok = child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!ok) {
        bench_complain("a measurement ended with status 0x%x", (unsigned)status);
        bench->results.failed = true;
    }
    return ok;
}

bool bench_check_in_child(struct bench *bench,
                          bool (*work)(const struct bench *bench, void *context, const struct sink *sink),
                          void *context, bool wrong[BENCH_CHECKS_MAX])
{
    static int number = 0;
    struct results found = {.rows = NULL};
    bool ok = bench_in_child(bench, work, context, &found);
    for (int i = 0; i < found.count; i++) {
        const struct row *row = &found.rows[i];
        if (wrong && i < BENCH_CHECKS_MAX) wrong[i] = row->wrong;
        if (bench->check_only || row->wrong)
            printf("%s %d - %s: %s\n", row->wrong ? "not ok" : "ok", ++number, row->work, row->note);
        if (row->wrong && bench->check_only) bench->results.failed = true; /* else its row says so */
    }
    results_free(&found);
    return ok;
}
