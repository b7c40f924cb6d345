#include "reference/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double edge_bar_px = 1.0 / 256.0, slope_bar_px = 0.1;

/* In exact comparisons places are looked up for people only, so not for ever. */
enum { MEASURED_MAX = 4096 };

/* Floats of one sign are ordered as their bits are; this puts both signs on one
 * line of integers, with -0 and 0 on the same spot. */
static int64_t place(float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    int64_t magnitude = bits & 0x7fffffffu;
    return bits >> 31 ? -magnitude : magnitude;
}

uint32_t compare_ulp(float a, float b)
{
    if (isnan(a) || isnan(b)) return isnan(a) && isnan(b) ? 0 : UINT32_MAX;
    int64_t distance = llabs(place(a) - place(b));
    return distance < UINT32_MAX ? (uint32_t)distance : UINT32_MAX;
}

static uint32_t max(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

static uint32_t color_lsb(const uint8_t *a, const uint8_t *b)
{
    uint32_t most = 0;
    for (int i = 0; i < 4; i++)
        most = max(most, (uint32_t)abs(a[i] - b[i]));
    return most;
}

/* 0 where there is nothing to compare. */
static uint32_t color_off(const struct picture *want, const struct picture *got, size_t pixel)
{
    return want->color_slack == COMPARE_NO_COLORS ? 0 : color_lsb(want->rgba + pixel * 4, got->rgba + pixel * 4);
}

static bool is_gap(const struct picture *want, size_t pixel)
{
    return want->gaps && want->gaps[pixel];
}

bool compare_pixel_equal(const struct picture *want, const struct picture *got, size_t pixel)
{
    if (is_gap(want, pixel)) return true;
    return want->owner[pixel] == got->owner[pixel] && compare_ulp(want->depth[pixel], got->depth[pixel]) == 0 &&
           color_off(want, got, pixel) <= want->color_slack;
}

/* One pixel that differs, and what is known of it. */
struct difference {
    const struct picture *want, *got;
    size_t pixel;
    uint32_t x, row;
    struct nearness *nearness; /* NULL: not measured */
};

static struct near nothing_near(void)
{
    return (struct near){.edge_px = HUGE_VAL};
}

/* True where rounding explains that the owners differ. */
static bool compare_owners(const struct difference *d, enum compare_bar bar, struct comparison *sum)
{
    uint32_t want_owner = d->want->owner[d->pixel], got_owner = d->got->owner[d->pixel];
    sum->coverage++;
    if (!d->nearness) return false;
    struct near a = want_owner ? nearness_at(d->nearness, want_owner, d->x, d->row) : nothing_near();
    struct near b = got_owner ? nearness_at(d->nearness, got_owner, d->x, d->row) : nothing_near();
    double edge = fmin(a.edge_px, b.edge_px);
    if (edge <= edge_bar_px) {
        sum->edge_max_px = fmax(sum->edge_max_px, edge);
        sum->at_edge++;
        return true;
    }
    double one_ulp = d->nearness->depth_rounding;
    double tie = bar == COMPARE_TRANSFORM ? 2.0 * one_ulp + slope_bar_px * (a.slope + b.slope) : a.noise + b.noise;
    if (a.covered && b.covered && fabs(a.depth - b.depth) <= tie) {
        sum->at_tie++;
        return true;
    }
    sum->edge_max_px = fmax(sum->edge_max_px, edge);
    return false;
}

/* True where the depths are as near as the independent transform asks. */
static bool compare_depths(const struct difference *d, uint32_t ulp, struct comparison *sum)
{
    sum->depth++;
    sum->depth_max_ulp = max(sum->depth_max_ulp, ulp);
    if (!d->nearness) return false;
    struct near near = nearness_at(d->nearness, d->want->owner[d->pixel], d->x, d->row);
    double want = (double)d->want->depth[d->pixel], off = fabs((double)d->got->depth[d->pixel] - want);
    double one_ulp = d->nearness->depth_rounding;
    if (near.slope > 0.0 && off > one_ulp) sum->depth_max_px = fmax(sum->depth_max_px, (off - one_ulp) / near.slope);
    if (off <= one_ulp + slope_bar_px * near.slope) return true;
    sum->depth_astray++;
    return false;
}

/* True where the pixel meets the bar. */
static bool compare_pixel(const struct difference *d, enum compare_bar bar, struct comparison *sum)
{
    if (d->want->owner[d->pixel] != d->got->owner[d->pixel]) return compare_owners(d, bar, sum) && bar != COMPARE_EXACT;
    uint32_t ulp = compare_ulp(d->want->depth[d->pixel], d->got->depth[d->pixel]);
    uint32_t lsb = color_off(d->want, d->got, d->pixel);
    const bool beyond = lsb > d->want->color_slack;
    bool near = ulp == 0 || bar == COMPARE_SECOND_OPINION || compare_depths(d, ulp, sum);
    if (bar == COMPARE_SECOND_OPINION && ulp != 0) {
        sum->depth++;
        sum->depth_max_ulp = max(sum->depth_max_ulp, ulp);
    }
    sum->color += beyond;
    sum->color_near += lsb > 0 && !beyond;
    sum->color_max_lsb = max(sum->color_max_lsb, lsb);
    return bar == COMPARE_EXACT ? ulp == 0 && !beyond : near;
}

struct compare_missed compare_pictures(const struct picture *want, const struct picture *got, uint32_t width,
                                       uint32_t height, enum compare_bar bar, struct nearness *nearness,
                                       struct comparison *sum)
{
    struct compare_missed missed = {.count = 0};
    uint64_t measured = 0;
    size_t pixels = (size_t)width * height;
    for (size_t i = 0; i < pixels; i++) {
        if (is_gap(want, i)) {
            sum->gaps++;
            continue;
        }
        sum->pixels++;
        sum->visible += (want->owner[i] | got->owner[i]) != 0;
        if (compare_pixel_equal(want, got, i) && color_off(want, got, i) == 0) continue;
        bool measure = bar != COMPARE_EXACT || measured++ < MEASURED_MAX;
        struct difference difference = {.want = want,
                                        .got = got,
                                        .pixel = i,
                                        .x = (uint32_t)(i % width),
                                        .row = (uint32_t)(i / width),
                                        .nearness = measure ? nearness : NULL};
        if (compare_pixel(&difference, bar, sum)) continue;
        if (missed.count < COMPARE_MISSED_MAX) missed.pixels[missed.count] = i;
        missed.count++;
    }
    return missed;
}

void compare_add(struct comparison *sum, const struct comparison *more)
{
    sum->pixels += more->pixels;
    sum->visible += more->visible;
    sum->gaps += more->gaps;
    sum->coverage += more->coverage;
    sum->at_edge += more->at_edge;
    sum->at_tie += more->at_tie;
    sum->edge_max_px = fmax(sum->edge_max_px, more->edge_max_px);
    sum->depth += more->depth;
    sum->depth_max_ulp = max(sum->depth_max_ulp, more->depth_max_ulp);
    sum->depth_max_px = fmax(sum->depth_max_px, more->depth_max_px);
    sum->depth_astray += more->depth_astray;
    sum->color += more->color;
    sum->color_near += more->color_near;
    sum->color_max_lsb = max(sum->color_max_lsb, more->color_max_lsb);
}
