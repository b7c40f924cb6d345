#include "reference/page/report.h"

#include <inttypes.h>
#include <stdio.h>

#include "reference/page/page.h"

/* The bar decides what there is to say beside the counts. */
static void print_explanations(const struct comparison *c, enum compare_bar bar)
{
    if (bar == COMPARE_SECOND_OPINION)
        printf("  at an edge %" PRIu64 " (max %.5f px)  at equal depths %" PRIu64 "  unexplained %" PRIu64, c->at_edge,
               c->edge_max_px, c->at_tie, c->coverage - c->at_edge - c->at_tie);
    if (bar == COMPARE_TRANSFORM)
        printf("  at an edge %" PRIu64 " (max %.5f px)  depth off by at most %.4f px of slope, %" PRIu64
               " beyond the bound",
               c->at_edge, c->edge_max_px, c->depth_max_px, c->depth_astray);
    if (bar == COMPARE_EXACT && c->coverage) printf("  farthest from an edge %.5f px", c->edge_max_px);
    if (bar == COMPARE_EXACT && c->depth) printf("  depth off by at most %.4f px of slope", c->depth_max_px);
}

static void print_tally(const char *name, const struct tally *tally, enum compare_bar bar)
{
    const struct comparison *c = &tally->comparison;
    printf("%-22s triangles %8" PRIu64 "  visible %10" PRIu64 "  clipped %7" PRIu64 "  coverage %" PRIu64
           "  depth %" PRIu64 " (max %" PRIu32 " ulp)  colour %" PRIu64 " (max %" PRIu32 " LSB)",
           name, tally->triangles, c->visible, tally->clipped, c->coverage, c->depth, c->depth_max_ulp, c->color,
           c->color_max_lsb);
    print_explanations(c, bar);
    if (tally->parity_faces) printf("  by parity %" PRIu64 "  gaps %" PRIu64, tally->parity_faces, c->gaps);
    if (c->color_near) printf("  within 1 LSB %" PRIu64, c->color_near);
    if (tally->undecided) printf("  surfaces undecided in %" PRIu64, tally->undecided);
    if (tally->colors_left_out) printf("  COLOURS LEFT OUT of %" PRIu64 " pictures", tally->colors_left_out);
    if (tally->twins_pixels) printf("  channels %" PRIu64, tally->twins_beyond);
    putchar('\n');
}

void report_line(struct report *report, const char *name, enum verdict verdict, const struct tally *tally)
{
    static const char *const promise[] = {[COMPARE_EXACT] = "equals the reference",
                                          [COMPARE_SECOND_OPINION] = "differs where rounding explains it",
                                          [COMPARE_TRANSFORM] = "keeps the bounds of another transform"};
    report->count++;
    if (report->page) page_row(report->page, name, verdict, tally);
    if (report->style == REPORT_QUIET) return;
    if (report->style == REPORT_TAP)
        printf("%s %d - %s: ", verdict == VERDICT_EQUAL ? "ok" : "not ok", report->count, promise[report->bar]);
    print_tally(name, tally, report->bar);
    if (verdict == VERDICT_UNPROVED) printf("# %s: nothing was proved\n", name);
    fflush(stdout);
}

void report_total(struct report *report, enum verdict verdict, const struct tally *tally)
{
    static const char *const words[] = {[VERDICT_EQUAL] = "total, equal",
                                        [VERDICT_DIFFERENT] = "total, DIFFERENT",
                                        [VERDICT_UNPROVED] = "total, UNPROVED"};
    const char *word = verdict == VERDICT_EQUAL && report->bar != COMPARE_EXACT ? "total, explained" : words[verdict];
    if (report->style == REPORT_TAP) printf("1..%d\n# ", report->count);
    print_tally(word, tally, report->bar);
    fflush(stdout);
}

void report_channel(struct report *report, const char *name, enum verdict verdict, const char *figures)
{
    report->count++;
    if (report->style == REPORT_QUIET) return;
    if (report->style == REPORT_TAP)
        printf("%s %d - agrees with its twin: ", verdict == VERDICT_EQUAL ? "ok" : "not ok", report->count);
    printf("%-22s %s\n", name, figures);
    if (verdict == VERDICT_UNPROVED) printf("# %s: nothing was proved\n", name);
    fflush(stdout);
}

void report_refused(struct report *report, const char *name, const char *reason)
{
    report->refused++;
    if (report->page) page_refused(report->page, name, reason);
    printf("# refused by our reader: %s: %s\n", name, reason);
    fflush(stdout);
}

void report_no_colors(struct report *report, const char *name, const char *what)
{
    char reason[120];
    snprintf(reason, sizeof reason, "colours, since %s is drawn by no twin; all else is compared", what);
    if (report->page) page_refused(report->page, name, reason);
    printf("# left out: %s: %s\n", name, reason);
    fflush(stdout);
}

void report_left_out(struct report *report, const char *name, uint64_t pictures)
{
    char reason[200];
    snprintf(reason, sizeof reason,
             "%" PRIu64
             " pictures: outlines, lines and points are for the exact comparison, and float may move corners by "
             "1/256 px or leave fewer than 16 bits of depth",
             pictures);
    report->refused++;
    if (report->page) page_refused(report->page, name, reason);
    printf("# left out: %s: %s\n", name, reason);
    fflush(stdout);
}
