/* zraster-verify: is every pixel of ours the reference's pixel, to the last bit? */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fast.h"
#include "base/mutant.h"
#include "reference/floats.h"
#include "reference/generate/generate.h"
#include "reference/models.h"
#include "reference/options.h"
#include "reference/page/page.h"
#include "reference/scene_files.h"
#include "reference/subject.h"

/* An independent transform may change the owner of one pixel in so many. */
enum { PIXELS_PER_CHANGE = 1000000 };

static enum verdict worse(enum verdict a, enum verdict b)
{
    return a > b ? a : b;
}

static bool is_wanted(const struct options *options, size_t i)
{
    if (generators[i].wires && options->harness.bar != COMPARE_EXACT) return false;
    return options->random && (!options->kind || strcmp(options->kind, generators[i].name) == 0);
}

/* A picture that shows something: one of each kind goes on the page. */
static bool is_rich(const struct harness_pictures *pictures)
{
    const struct zr_frame *frame = pictures->frame;
    if (!frame || frame->width < 90) return false;
    return frame->covered_pixels * 20 > (uint64_t)frame->width * frame->height;
}

static enum verdict check_kind(struct harness *harness, struct report *report, const struct generator *generator,
                               uint64_t seed, uint64_t triangles, struct tally *tally)
{
    enum { PICTURES_MIN = 6 }; /* so that each kind has smooth colours in some */
    struct drawing drawing = {0};
    enum verdict worst = VERDICT_EQUAL;
    bool shown = false;
    for (uint64_t frame = 0; frame < PICTURES_MIN || tally->triangles < triangles; frame++) {
        struct subject subject;
        struct harness_pictures pictures;
        generate(generator, seed, frame, &drawing);
        if (drawing.failed) {
            fprintf(stderr, "out of memory\n");
            worst = VERDICT_UNPROVED;
            break;
        }
        subject_make(&subject, &drawing);
        enum verdict verdict = harness_check(harness, &subject.scene, generator->name, frame, tally, &pictures);
        worst = worse(worst, verdict);
        bool worth_showing = drawing.smooth && !shown && is_rich(&pictures);
        if (report->page && worth_showing) page_picture(report->page, generator->name, verdict, &pictures);
        shown = shown || worth_showing;
        if (!pictures.frame) break; /* one side gave no picture: the next ones would not either */
    }
    drawing_free(&drawing);
    bool proved = tally->comparison.visible > 0 && (!generator->clips || tally->clipped > 0);
    return worst == VERDICT_EQUAL && !proved ? VERDICT_UNPROVED : worst;
}

static enum verdict check_random(struct harness *harness, struct report *report, const struct options *options,
                                 struct tally *total)
{
    enum verdict worst = VERDICT_EQUAL;
    uint64_t kinds = 0;
    for (size_t i = 0; i < generator_count; i++)
        kinds += is_wanted(options, i);
    for (size_t i = 0; i < generator_count; i++) {
        if (!is_wanted(options, i)) continue;
        struct tally tally = {0};
        enum verdict verdict =
            check_kind(harness, report, &generators[i], options->seed, options->triangles / kinds, &tally);
        report_line(report, generators[i].name, verdict, &tally);
        tally_add(total, &tally);
        worst = worse(worst, verdict);
    }
    return worst;
}

static enum verdict check_all(struct harness *harness, const struct options *options)
{
    struct report report = {.style = options->style, .bar = options->harness.bar};
    struct twins twins = {.programs = {0}};
    const struct scene_files_options files = {options->preset, options->pictures, &twins};
    struct tally total = {0};
    if (options->page)
        report.page = page_open(&(struct page_options){.path = options->page,
                                                       .title = options->title,
                                                       .renderer = reference_name(harness->reference),
                                                       .bar = report.bar,
                                                       .plain = options->plain});
    enum verdict worst = check_random(harness, &report, options, &total);
    if (options->floats) worst = worse(worst, floats_check(harness, &report, options->seed, options->floats, &total));
    if (options->models) worst = worse(worst, models_check(harness, &report, options->models, &total));
    for (int i = 0; i < options->path_count; i++)
        worst = worse(worst, scene_files_check(harness, &report, options->paths[i], &files, &total));
    if (total.twins_pixels) worst = worse(worst, twins_report(&twins, &report));
    if (report.count == 0) worst = VERDICT_UNPROVED;
    if (report.bar == COMPARE_TRANSFORM &&
        total.comparison.coverage > (total.comparison.visible + PIXELS_PER_CHANGE - 1) / PIXELS_PER_CHANGE)
        worst = worse(worst, VERDICT_DIFFERENT);
    report_total(&report, worst, &total);
    return page_close(report.page, worst, &total) ? worst : VERDICT_UNPROVED;
}

static bool kind_exists(const struct options *options)
{
    if (!options->random) return true;
    for (size_t i = 0; i < generator_count; i++)
        if (is_wanted(options, i)) return true;
    return false;
}

int main(int argc, char **argv)
{
    struct options options;
    bool understood = options_parse(argc, argv, &options);
    if (understood && options.kind && strcmp(options.kind, "list") == 0) {
        for (size_t i = 0; i < generator_count; i++)
            puts(generators[i].name);
        return 0;
    }
    if (!understood || !kind_exists(&options)) {
        fputs(options_usage, stderr);
        return VERDICT_UNPROVED;
    }
    if (options.mutant && strcmp(options.mutant, "list") == 0) {
        for (int i = 0; zr_mutant_name(i); i++)
            puts(zr_mutant_name(i));
        return 0;
    }
    if (options.mutant && !zr_mutant_set(options.mutant, true)) {
        fprintf(stderr, "zraster-verify: --mutant: this build has no mutant '%s'\n", options.mutant);
        return VERDICT_UNPROVED;
    }
    const bool counts = options.without && strcmp(options.without, "list") == 0;
    if (options.without && !counts && !zr_fast_forbid(options.without)) {
        fprintf(stderr, "zraster-verify: --without: this build has no switch for '%s'\n", options.without);
        return VERDICT_UNPROVED;
    }
    struct harness harness;
    enum verdict verdict = VERDICT_UNPROVED;
    bool open = harness_open(&harness, &options.harness);
    if (open && options.line_rule) {
        puts(line_rule_names[harness.line_rule]);
        verdict = VERDICT_EQUAL;
    } else if (open) {
        if (options.style != REPORT_QUIET) printf("# reference: %s\n", reference_name(harness.reference));
        verdict = check_all(&harness, &options);
    }
    harness_close(&harness);
    uint64_t taken;
    for (int i = 0; counts && zr_fast_name(i, &taken); i++)
        printf("%s %" PRIu64 "\n", zr_fast_name(i, &taken), taken);
    return (int)verdict;
}
