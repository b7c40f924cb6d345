#include "bench/compare.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/http/process.h"
#include "bench/turns.h"
#include "support/files.h"

enum { THIS, OTHER, BUILDS, PATH_SIZE = 600 };

struct build {
    char program[PATH_SIZE], daemon[PATH_SIZE], results[PATH_SIZE];
    struct process process;
    bool runs;
    cJSON *rows;
};

/* ---- the two runs ---- */

static bool start(struct build *build, const char **arguments, int output_place)
{
    arguments[0] = build->program;
    arguments[output_place] = build->results;
    setenv("ZRASTERD", build->daemon, 1);
    setenv(TURNS_VARIABLE, "1", 1);
    if (access(build->program, X_OK) != 0) return bench_complain("there is no program %s", build->program);
    if (access(build->daemon, X_OK) != 0) return bench_complain("there is no program %s", build->daemon);
    unlink(build->results);
    build->runs = process_start(&build->process, arguments, false);
    return build->runs || bench_complain("%s does not start", build->program);
}

/* Who has the turn gives it back, or ends. */
static void alternate(struct build builds[BUILDS])
{
    for (int i = 0; builds[THIS].runs || builds[OTHER].runs; i = 1 - i) {
        struct build *build = &builds[i];
        if (!build->runs) continue;
        build->runs = write(build->process.in, "", 1) == 1 && process_wait(&build->process, NULL, 0);
    }
}

static cJSON *read_rows(const char *path)
{
    size_t size;
    char *text = file_read(path, &size);
    if (!text) return NULL;
    cJSON *root = cJSON_ParseWithLength(text, size);
    cJSON *rows = cJSON_DetachItemFromObject(root, "rows");
    cJSON_Delete(root);
    free(text);
    return rows;
}

/* ---- the table ---- */

static const char *name_of(const cJSON *row)
{
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItem(row, "work"));
    return name ? name : "";
}

static double ms_of(const cJSON *row)
{
    const cJSON *ms = cJSON_GetObjectItem(row, "ours_ms");
    return cJSON_IsNumber(ms) ? ms->valuedouble : 0.0;
}

static const cJSON *row_named(const cJSON *rows, const char *name)
{
    for (const cJSON *row = rows ? rows->child : NULL; row; row = row->next)
        if (strcmp(name_of(row), name) == 0) return row;
    return NULL;
}

static void print_table(const struct build builds[BUILDS])
{
    double logarithms = 0.0;
    int count = 0;
    printf("%-72s %9s %9s %8s\n", "this build against the other", "this ms", "other ms", "ratio");
    for (const cJSON *row = builds[THIS].rows ? builds[THIS].rows->child : NULL; row; row = row->next) {
        const cJSON *other = row_named(builds[OTHER].rows, name_of(row));
        const double ours = ms_of(row), theirs = other ? ms_of(other) : 0.0;
        if (!(ours > 0.0) || !(theirs > 0.0)) continue;
        printf("%-72s %9.4g %9.4g %7.3fx\n", name_of(row), ours, theirs, theirs / ours);
        logarithms += log(theirs / ours);
        count++;
    }
    for (int i = 0; i < BUILDS; i++)
        for (const cJSON *row = builds[i].rows ? builds[i].rows->child : NULL; row; row = row->next)
            if (!row_named(builds[1 - i].rows, name_of(row)))
                printf("%-72s %s\n", name_of(row), i == THIS ? "in this build only" : "in the other build only");
    if (count > 0)
        printf("\n%d rows: this build is %.3f times as fast (geometric mean)\n", count, exp(logarithms / count));
}

static void folder_of(const char *path, char *folder, size_t size)
{
    const char *slash = strrchr(path, '/');
    snprintf(folder, size, "%.*s", slash ? (int)(slash - path) : 1, slash ? path : ".");
}

int compare_builds(const struct bench *bench, const char *other, const char **arguments, const char *output)
{
    static struct build builds[BUILDS];
    char folder[PATH_SIZE / 2], here[PATH_SIZE / 2];
    int count = 0;
    folder_of(bench->program, here, sizeof here);
    folder_of(output, folder, sizeof folder);
    const char *const folders[BUILDS] = {here, other};
    for (int i = 0; i < BUILDS; i++) {
        snprintf(builds[i].program, PATH_SIZE, "%s/zraster-bench", folders[i]);
        snprintf(builds[i].daemon, PATH_SIZE, "%s/zrasterd", folders[i]);
        snprintf(builds[i].results, PATH_SIZE, "%s/%s.json", folder, i == THIS ? "this" : "other");
    }
    while (arguments[count])
        count++;
    arguments[count++] = "--output";
    arguments[count + 1] = NULL;
    bool ok = start(&builds[THIS], arguments, count) && start(&builds[OTHER], arguments, count);
    signal(SIGPIPE, SIG_IGN); /* one that ended early is no reason to end */
    if (ok) alternate(builds);
    for (int i = 0; i < BUILDS; i++) {
        if (builds[i].process.pid <= 0) continue;
        if (!process_end(&builds[i].process, 0)) ok = bench_complain("%s failed", builds[i].program);
        builds[i].rows = read_rows(builds[i].results);
    }
    print_table(builds);
    for (int i = 0; i < BUILDS; i++)
        cJSON_Delete(builds[i].rows);
    return ok ? 0 : 1;
}
