/* Lines, outlines and the depth offset against the reference: the same pixels, the same
 * float depths, the same bytes of colour. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/lines/batch.h"

static const char usage_text[] =
    "usage: zraster-verify-lines [option VALUE ...]\n"
    "  --primitives N   of each mode (100000)\n"
    "  --seed N         (1)\n"
    "  --mode NAME      lines, outlines or filled only\n"
    "  --placing NAME   corners placed in this way only\n"
    "  --fault NAME     draws our side wrong on purpose; all: in each way there is\n"
    "Mesa up to 22.3 draws lines by an older rule, which only the program of build/mutant has; that one alone can\n"
    "draw by the rule that Mesa does not follow (--fault other-rule).\n"
    "Exit status: 0 all equal, 1 differences, 2 bad usage, no reference, or nothing to compare;\n"
    "with --fault all: 0 where each fault shows differences, else 1.\n";

struct options {
    uint64_t primitives, seed;
    const char *mode, *placing;
    enum fault fault;
    bool all_faults, explain;
    enum line_rule rule; /* the reference's */
};

struct counts {
    struct batch_stats drawn;
    uint64_t visible, coverage, depth, color;
};

static bool parse_number(const char *text, uint64_t *out)
{
    char *end;
    *out = strtoull(text, &end, 10);
    return end != text && !*end;
}

static bool parse_fault(const char *text, enum fault *out)
{
    for (int i = 0; i < FAULT_COUNT; i++)
        if (strcmp(text, fault_names[i]) == 0) {
            *out = (enum fault)i;
            return true;
        }
    return false;
}

static bool parse_options(int argc, char **argv, struct options *options)
{
    for (int i = 1; i < argc; i += 2) {
        const char *name = argv[i], *value = argv[i + 1];
        bool ok = false;
        if (i + 1 == argc) return false;
        if (strcmp(name, "--primitives") == 0) ok = parse_number(value, &options->primitives);
        if (strcmp(name, "--seed") == 0) ok = parse_number(value, &options->seed);
        if (strcmp(name, "--fault") == 0) {
            options->all_faults = strcmp(value, "all") == 0;
            ok = options->all_faults || parse_fault(value, &options->fault);
        }
        if (strcmp(name, "--mode") == 0) ok = (options->mode = value) != NULL;
        if (strcmp(name, "--placing") == 0) ok = (options->placing = value) != NULL;
        if (!ok) return false;
    }
    return true;
}

static bool has_color(const uint8_t rgba[4], zr_vec4 color)
{
    return rgba[3] && rgba[0] == (uint8_t)(color.x * 255.0f + 0.5f) && rgba[1] == (uint8_t)(color.y * 255.0f + 0.5f) &&
           rgba[2] == (uint8_t)(color.z * 255.0f + 0.5f);
}

static void print_difference(const struct batch *batch, size_t pixel, const struct batch_picture *want,
                             const struct batch_picture *got)
{
    enum { SHOWN = 5 };
    static int shown;
    if (shown++ >= SHOWN) return;
    const uint8_t *a = &want->rgba[pixel * 4], *b = &got->rgba[pixel * 4];
    printf("# %s %s, window %u x %u, pixel %zu %zu (y up): want %d %d %d %d depth %a, got %d %d %d %d depth %a\n",
           batch->smooth ? "smooth" : "flat", batch->sided ? "sided" : "", batch->width, batch->height,
           pixel % batch->width, batch->height - 1 - pixel / batch->width, a[0], a[1], a[2], a[3],
           (double)want->depth[pixel], b[0], b[1], b[2], b[3], (double)got->depth[pixel]);
    for (uint32_t i = 0; i < batch->count && !batch->smooth && !batch->sided; i++)
        for (uint32_t k = batch->offsets[i]; k < batch->offsets[i + 1]; k++) {
            bool wanted = has_color(a, batch->colors[k]), gotten = has_color(b, batch->colors[k]);
            if (wanted || gotten)
                printf("#   %s %u corner %u: %a %a %a %a\n", wanted ? "want" : "got", i, k - batch->offsets[i],
                       (double)batch->positions[k].x, (double)batch->positions[k].y, (double)batch->positions[k].z,
                       (double)batch->positions[k].w);
        }
}

/* One question a pixel, so that one fault is counted once. In a flat picture the colour says who
 * owns the pixel; in a smooth one only whether anybody does. */
static void compare(const struct batch *batch, const struct batch_picture *want, const struct batch_picture *got,
                    bool explain, struct counts *counts)
{
    for (size_t i = 0; i < (size_t)batch->width * batch->height; i++) {
        const uint8_t *a = &want->rgba[i * 4], *b = &got->rgba[i * 4];
        bool equal_color = memcmp(a, b, 4) == 0;
        counts->visible += a[3] || b[3];
        if (!a[3] != !b[3] || (!batch->smooth && !equal_color))
            counts->coverage++;
        else if (want->depth[i] != got->depth[i])
            counts->depth++;
        else if (!equal_color)
            counts->color++;
        else
            continue;
        if (explain) print_difference(batch, i, want, got);
    }
}

static bool is_equal(const struct counts *counts)
{
    return counts->coverage == 0 && counts->depth == 0 && counts->color == 0;
}

static void print_counts(const char *mode, const char *name, const struct counts *c)
{
    printf(
        "%s - %-8s %-16s %8llu primitives %7llu clipped %8llu lines %7llu dropped %9llu px  coverage %llu  depth %llu  "
        "colour %llu\n",
        is_equal(c) ? "ok" : "not ok", mode, name, (unsigned long long)c->drawn.primitives,
        (unsigned long long)c->drawn.clipped, (unsigned long long)c->drawn.lines, (unsigned long long)c->drawn.dropped,
        (unsigned long long)c->visible, (unsigned long long)c->coverage, (unsigned long long)c->depth,
        (unsigned long long)c->color);
}

/* False where the reference fails. */
static bool check_placing(const struct options *options, enum batch_mode mode, const struct placing *placing,
                          uint64_t primitives, struct counts *counts)
{
    static struct batch batch;
    static struct batch_picture want, got;
    struct random r = random_seeded(options->seed * 1000003u + (uint64_t)(placing - placings) * 7u + mode);
    while (counts->drawn.primitives < primitives) {
        batch_generate(&batch, mode, placing, &r);
        draw_own(&batch, options->fault, &got, &counts->drawn);
        if (!draw_reference(&batch, &want)) return false;
        compare(&batch, &want, &got, options->explain, counts);
    }
    return true;
}

static void counts_add(struct counts *sum, const struct counts *more)
{
    sum->drawn.primitives += more->drawn.primitives;
    sum->drawn.clipped += more->drawn.clipped;
    sum->drawn.lines += more->drawn.lines;
    sum->drawn.dropped += more->drawn.dropped;
    sum->visible += more->visible;
    sum->coverage += more->coverage;
    sum->depth += more->depth;
    sum->color += more->color;
}

/* False where the reference fails. */
static bool check_modes(const struct options *options, bool quiet, struct counts *total)
{
    static const char *const modes[] = {"lines", "outlines", "filled"};
    for (enum batch_mode mode = BATCH_LINES; mode <= BATCH_FILLED; mode++) {
        if (options->mode && strcmp(options->mode, modes[mode]) != 0) continue;
        struct counts sum = {0};
        for (uint32_t i = 0; i < placing_count; i++) {
            struct counts counts = {0};
            uint64_t primitives = options->primitives / (options->placing ? 1 : placing_count) + 1;
            if (options->placing && strcmp(options->placing, placings[i].name) != 0) continue;
            if (!check_placing(options, mode, &placings[i], primitives, &counts)) return false;
            if (!quiet) print_counts(modes[mode], placings[i].name, &counts);
            counts_add(&sum, &counts);
        }
        if (!quiet) print_counts(modes[mode], "total", &sum);
        counts_add(total, &sum);
    }
    return true;
}

/* Our side draws lines by the reference's rule, or by the other one where that is the fault. */
static bool choose_rule(const struct options *options)
{
    enum line_rule other = options->rule == LINE_RULE_CURRENT ? LINE_RULE_OLDER : LINE_RULE_CURRENT;
    return line_rule_choose(options->fault == FAULT_OTHER_RULE ? other : options->rule);
}

/* A comparison that a fault slips through proves nothing about the rule it breaks. */
static int check_faults(struct options *options)
{
    int unseen = 0;
    options->explain = false;
    for (int i = 1; i < FAULT_COUNT; i++) {
        struct counts total = {0};
        options->fault = (enum fault)i;
        if (!choose_rule(options)) fprintf(stderr, "other-rule: this build has one rule only\n");
        if (!check_modes(options, true, &total)) return 2;
        unseen += is_equal(&total);
        printf("%s - fault %s (coverage %llu depth %llu colour %llu)\n", is_equal(&total) ? "not ok" : "ok",
               fault_names[i], (unsigned long long)total.coverage, (unsigned long long)total.depth,
               (unsigned long long)total.color);
    }
    return unseen ? 1 : 0;
}

int main(int argc, char **argv)
{
    struct options options = {.primitives = 100000, .seed = 1, .explain = true};
    if (!parse_options(argc, argv, &options)) {
        fputs(usage_text, stderr);
        return 2;
    }
    if (!draw_reference_open(&options.rule)) return 2;
    if (!options.all_faults && !choose_rule(&options)) {
        fprintf(stderr, "this build has not the rule by which to draw lines; the one in build/mutant has\n");
        return 2;
    }
    if (options.all_faults) return check_faults(&options);
    struct counts total = {0};
    if (!check_modes(&options, false, &total) || total.visible == 0) return 2;
    return is_equal(&total) ? 0 : 1;
}
