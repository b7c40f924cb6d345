/* zraster-bench: ours against theirs, in one run.
 *
 * Both sides of a row are timed in turns, after their results were compared. Times drift
 * from run to run and from machine to machine: the ratio is what counts.
 */
#include <cjson/cJSON.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "bench/compare.h"
#include "bench/growth.h"
#include "bench/http/service.h"
#include "bench/input/arrays.h"
#include "bench/input/formats.h"
#include "bench/layers.h"
#include "bench/looks.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/turns.h"
#include "bench/versus/sides.h"
#include "bench/versus/versus_cjson.h"
#include "bench/versus/versus_glsl.h"
#include "bench/versus/versus_libpng.h"
#include "bench/versus/versus_llvmpipe.h"

static bool refuse(void)
{
    fputs("usage: zraster-bench [--models DIR] [--isa NAME] [--only PART] [--rounds N] [--output FILE] [--check-only]\n"
          "                     [--list] [--against DIR]\n"
          "DIR may hold stanford-bunny.obj; ZRASTERD names the daemon (build/zrasterd).\n"
          "  --isa NAME     to render with: scalar, sse2, avx2, avx512 or neon (the widest); also by ZRASTER_ISA\n"
          "  --only PART    rows whose names have this part\n"
          "  --rounds N     1 to 401, instead of as many as fit\n"
          "  --output FILE  where the rows go as JSON (build/bench/results.json)\n"
          "  --check-only   compares pictures and measures nothing\n"
          "  --list         names the rows and measures nothing\n"
          "  --against DIR  this build against another one, whose zraster-bench and zrasterd are in DIR, in turns;\n"
          "                 this.json and other.json then lie beside FILE\n",
          stderr);
    return false;
}

static bool take_isa(const char *from, const char *name)
{
    char known[128];
    if (machine_use_isa(name)) return true;
    zr_isa_list(known, sizeof known);
    fprintf(stderr, "zraster-bench: %s: '%s' is no instruction set that this machine has; it has %s\n", from, name,
            known);
    return false;
}

/* What main itself needs. */
struct options {
    const char *output, *against; /* against: NULL: nothing */
};

/* False, explained on stderr. */
static bool read_options(int count, char **arguments, struct bench *bench, struct options *options)
{
    const char *isa = getenv("ZRASTER_ISA"); /* empty: not given, as the daemon has it */
    for (int i = 1; i < count; i++) {
        const char *flag = arguments[i], *value = i + 1 < count ? arguments[i + 1] : NULL;
        if (strcmp(flag, "--check-only") == 0)
            bench->check_only = true;
        else if (strcmp(flag, "--list") == 0)
            bench->list = true;
        else if (!value)
            return refuse();
        else if (strcmp(flag, "--models") == 0)
            bench->models = arguments[++i];
        else if (strcmp(flag, "--isa") == 0) {
            isa = NULL;
            if (!take_isa(flag, arguments[++i])) return false;
        } else if (strcmp(flag, "--only") == 0)
            bench->only = arguments[++i];
        else if (strcmp(flag, "--output") == 0)
            options->output = arguments[++i];
        else if (strcmp(flag, "--against") == 0)
            options->against = arguments[++i];
        else if (strcmp(flag, "--rounds") == 0) {
            bench->rounds = atoi(arguments[++i]);
            if (bench->rounds < 1 || bench->rounds > SERIES_MAX) return refuse();
        } else
            return refuse();
    }
    return !isa || !*isa || take_isa("ZRASTER_ISA", isa);
}

/* A context names itself, and there is one a process. */
static bool name_renderer(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench, (void)context;
    struct theirs theirs;
    if (!theirs_open(&theirs, false, 1)) return false;
    struct row row = {.work = ""};
    snprintf(row.work, sizeof row.work, "%s", reference_name(theirs.reference));
    sink_row(sink, &row);
    return true;
}

static void introduce(struct bench *bench)
{
    struct results *results = &bench->results, names = {.rows = NULL};
    results->processor = machine_processor();
    results->cores = machine_cores();
    results->isa = machine_isa_name();
    if (bench_in_child(bench, name_renderer, NULL, &names) && names.count == 1)
        memcpy(results->renderer, names.rows[0].work, sizeof results->renderer);
    results_free(&names);
    printf("%s, %d cores\nours: %s\ntheirs: %s, libpng %s, cJSON %s\n", results->processor, results->cores,
           results->isa, results->renderer, png_get_libpng_ver(NULL), cJSON_Version());
    if (machine_load() > 0.7)
        printf("NOTE: others are at work here (load %.1f): rows of as many threads as cores suffer most\n",
               machine_load());
    results_print_legend();
}

/* Both builds get all that this one was given but where results go. */
static int compare(const struct bench *bench, const struct options *options, int count, char **arguments)
{
    const char **passed = calloc((size_t)count + COMPARE_ADDS + 1, sizeof *passed);
    if (!passed) return 2;
    int used = 1;
    for (int i = 1; i < count; i++) {
        if (strcmp(arguments[i], "--against") == 0 || strcmp(arguments[i], "--output") == 0)
            i++;
        else
            passed[used++] = arguments[i];
    }
    passed[0] = bench->program;
    const int status = compare_builds(bench, options->against, passed, options->output);
    free(passed);
    return status;
}

int main(int count, char **arguments)
{
    struct bench bench = {.program = arguments[0], .models = ""};
    struct options options = {.output = "build/bench/results.json"};
    if (!read_options(count, arguments, &bench, &options)) return 2;
    if (options.against) return compare(&bench, &options, count, arguments);
    turns_begin();
    if (!bench.check_only && !bench.list) introduce(&bench);
    growth_floors(&bench);
    growth_past_caches(&bench);
    versus_llvmpipe(&bench);
    versus_glsl(&bench);
    growth_of_threads(&bench);
    growth_of_channels(&bench);
    growth_of_light(&bench);
    looks_against_plain(&bench);
    looks_against_llvmpipe(&bench);
    layers_against_llvmpipe(&bench);
    versus_libpng(&bench);
    versus_cjson(&bench);
    arrays_against_json(&bench);
    formats_against_each_other(&bench);
    images_by_threads(&bench);
    service_against_stock(&bench);
    looks_over_http(&bench);
    service_for_simulator(&bench);
    service_against_bare_http(&bench);
    service_cold_start(&bench);
    service_beside_large(&bench);
    service_beside_io(&bench);
    service_for_many(&bench);
    service_while_scraped(&bench);
    service_memory(&bench);
    service_capacity(&bench);
    service_with_kept_meshes(&bench);
    service_with_views(&bench);
    service_for_drake(&bench);
    growth_of_work(&bench);
    if (!bench.check_only && !bench.list) {
        results_print_summary(&bench.results);
        if (!results_write(&bench.results, options.output)) bench.results.failed = true;
    }
    int status = results_status(&bench.results);
    results_free(&bench.results);
    return status;
}
