/* zraster-bench: ours against theirs, in one run.
 *
 * Both sides of a row are timed in turns, after their results were compared. Times drift
 * from run to run and from machine to machine: the ratio is what counts.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "bench/machine.h"
#include "bench/versus_libpng.h"
#include "bench/versus_llvmpipe.h"

static int usage(void)
{
    fputs("usage: zraster-bench [--models DIR] [--only PART] [--rounds N] [--output FILE] [--check-only] [--list]\n"
          "DIR may hold stanford-bunny.obj; ZRASTERD names the daemon (build/zrasterd).\n"
          "  --only PART    rows whose names have this part\n"
          "  --rounds N     instead of as many as fit\n"
          "  --output FILE  where the rows go as JSON (build/bench/results.json)\n"
          "  --check-only   compares pictures and measures nothing\n"
          "  --list         names the rows and measures nothing\n",
          stderr);
    return 2;
}

static bool read_options(int count, char **arguments, struct bench *bench, const char **output)
{
    for (int i = 1; i < count; i++) {
        const char *flag = arguments[i], *value = i + 1 < count ? arguments[i + 1] : NULL;
        if (strcmp(flag, "--check-only") == 0)
            bench->check_only = true;
        else if (strcmp(flag, "--list") == 0)
            bench->list = true;
        else if (!value)
            return false;
        else if (strcmp(flag, "--models") == 0)
            bench->models = arguments[++i];
        else if (strcmp(flag, "--only") == 0)
            bench->only = arguments[++i];
        else if (strcmp(flag, "--output") == 0)
            *output = arguments[++i];
        else if (strcmp(flag, "--rounds") == 0)
            bench->rounds = atoi(arguments[++i]);
        else
            return false;
    }
    return true;
}

int main(int count, char **arguments)
{
    struct bench bench = {.program = arguments[0], .models = ""};
    const char *output = "build/bench/results.json";
    if (!read_options(count, arguments, &bench, &output)) return usage();
    if (!bench.check_only && !bench.list)
        printf("%s, %d cores, %s\n", machine_processor(), machine_cores(), machine_isa());
    versus_llvmpipe(&bench);
    versus_libpng(&bench);
    if (!bench.check_only && !bench.list) {
        results_print_summary(&bench.results);
        if (!results_write(&bench.results, output)) bench.results.failed = true;
    }
    int status = results_status(&bench.results);
    results_free(&bench.results);
    return status;
}
