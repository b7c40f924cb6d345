/* zraster-verify: is every pixel of ours the reference's pixel, to the last bit? */
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/generate.h"
#include "reference/harness.h"
#include "reference/models.h"
#include "reference/report.h"

struct options {
    uint64_t triangles, seed;
    const char *kind, *models, *failures; /* NULL: all kinds; no models */
    int threads;
    enum report_style style;
};

static const char usage_text[] =
    "usage: zraster-verify [options]\n"
    "Renders random polygons with zraster and with Mesa's llvmpipe and compares all pixels.\n"
    "  --triangles N   over all kinds, polygons counted as fans (200000)\n"
    "  --seed S        other polygons (1)\n"
    "  --kind NAME     one kind only; 'none' for models alone, 'list' to list them\n"
    "  --threads N     that render, on both sides (1)\n"
    "  --models DIR    also stanford-bunny.obj and teapot.obj from DIR\n"
    "  --failures DIR  where pictures of differences go (build/reference-failures)\n"
    "  --tap           one TAP line a kind\n"
    "  --quiet         the total only\n"
    "Exit status: 0 all equal, 1 differences, 2 bad usage, no reference, or nothing to compare.\n";

static bool parse_number(const char *text, uint64_t low, uint64_t high, uint64_t *out)
{
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (errno || end == text || *end || text[0] == '-' || value < low || value > high) return false;
    *out = value;
    return true;
}

static bool parse_options(int argc, char **argv, struct options *options)
{
    static const struct option known[] = {{"triangles", required_argument, NULL, 't'},
                                          {"seed", required_argument, NULL, 's'},
                                          {"kind", required_argument, NULL, 'k'},
                                          {"threads", required_argument, NULL, 'j'},
                                          {"models", required_argument, NULL, 'm'},
                                          {"failures", required_argument, NULL, 'f'},
                                          {"tap", no_argument, NULL, 'p'},
                                          {"quiet", no_argument, NULL, 'q'},
                                          {NULL, 0, NULL, 0}};
    int option;
    uint64_t threads = 1;
    while ((option = getopt_long(argc, argv, "", known, NULL)) != -1) {
        bool ok = true;
        switch (option) {
        case 't':
            ok = parse_number(optarg, 1, 1000000000, &options->triangles);
            break;
        case 's':
            ok = parse_number(optarg, 0, UINT64_MAX, &options->seed);
            break;
        case 'j':
            ok = parse_number(optarg, 1, ZR_TEAM_MAX, &threads);
            break;
        case 'k':
            options->kind = optarg;
            break;
        case 'm':
            options->models = optarg;
            break;
        case 'f':
            options->failures = optarg;
            break;
        case 'p':
            options->style = REPORT_TAP;
            break;
        case 'q':
            options->style = REPORT_QUIET;
            break;
        default:
            ok = false;
        }
        if (!ok) return false;
    }
    options->threads = (int)threads;
    return optind == argc;
}

static bool is_wanted(const struct options *options, size_t kind)
{
    return !options->kind || strcmp(options->kind, generators[kind].name) == 0;
}

static enum verdict check_kind(struct harness *harness, const struct generator *generator, uint64_t seed,
                               uint64_t triangles, struct tally *tally)
{
    enum { PICTURES_MIN = 6 }; /* so that each kind has smooth colours in some */
    struct drawing drawing = {0};
    enum verdict worst = VERDICT_EQUAL;
    for (uint64_t frame = 0; frame < PICTURES_MIN || tally->triangles < triangles; frame++) {
        generate(generator, seed, frame, &drawing);
        uint64_t pictures = tally->pictures;
        enum verdict verdict = harness_check(harness, &drawing, generator->name, frame, tally);
        if (verdict > worst) worst = verdict;
        if (tally->pictures == pictures) break; /* one side gave no picture: the next ones would not either */
    }
    drawing_free(&drawing);
    bool proved = tally->comparison.visible > 0 && (!generator->clips || tally->clipped > 0);
    return worst == VERDICT_EQUAL && !proved ? VERDICT_UNPROVED : worst;
}

static enum verdict check_all(struct harness *harness, const struct options *options)
{
    struct report report = {.style = options->style};
    struct tally total = {0};
    enum verdict worst = VERDICT_EQUAL;
    uint64_t kinds = 0;
    for (size_t i = 0; i < generator_count; i++)
        kinds += is_wanted(options, i);
    for (size_t i = 0; i < generator_count; i++) {
        if (!is_wanted(options, i)) continue;
        struct tally tally = {0};
        enum verdict verdict = check_kind(harness, &generators[i], options->seed, options->triangles / kinds, &tally);
        report_line(&report, generators[i].name, verdict, &tally);
        tally_add(&total, &tally);
        if (verdict > worst) worst = verdict;
    }
    if (options->models) {
        enum verdict verdict = models_check(harness, &report, options->models, &total);
        if (verdict > worst) worst = verdict;
    }
    if (report.count == 0) worst = VERDICT_UNPROVED;
    report_total(&report, worst, &total);
    return worst;
}

static bool kind_exists(const struct options *options)
{
    if (options->models && options->kind && strcmp(options->kind, "none") == 0) return true;
    for (size_t i = 0; i < generator_count; i++)
        if (is_wanted(options, i)) return true;
    return false;
}

int main(int argc, char **argv)
{
    struct options options = {.triangles = 200000, .seed = 1, .failures = "build/reference-failures"};
    bool understood = parse_options(argc, argv, &options);
    if (understood && options.kind && strcmp(options.kind, "list") == 0) {
        for (size_t i = 0; i < generator_count; i++)
            puts(generators[i].name);
        return 0;
    }
    if (!understood || !kind_exists(&options)) {
        fputs(usage_text, stderr);
        return VERDICT_UNPROVED;
    }
    struct harness harness;
    enum verdict verdict = VERDICT_UNPROVED;
    if (harness_open(&harness, &reference_osmesa, options.threads, options.failures)) {
        if (options.style != REPORT_QUIET) printf("# reference: %s\n", harness.backend->renderer(harness.reference));
        verdict = check_all(&harness, &options);
    }
    harness_close(&harness);
    return (int)verdict;
}
