#include "overlay/annotate/place_marks.h"

#include <math.h>
#include <stdio.h>

/* Sizes in heights of capitals: distances of rings from places, the dot, half of the square
 * around it that is kept free, and the least radius of a ring. */
static const double distances[] = {2.5, 3.6, 5.2, 7.5, 10.5}, dot = 0.3, around = 0.6, least_radius = 1.12,
                    side_room = 0.12;

enum { DISTANCES = sizeof distances / sizeof *distances, WAYS = 16 };

/* Sixteenths of a turn. */
static const double ways[WAYS][2] = {{1, 0},
                                     {0.92387953251128674, 0.38268343236508978},
                                     {0.70710678118654757, 0.70710678118654757},
                                     {0.38268343236508978, 0.92387953251128674},
                                     {0, 1},
                                     {-0.38268343236508978, 0.92387953251128674},
                                     {-0.70710678118654757, 0.70710678118654757},
                                     {-0.92387953251128674, 0.38268343236508978},
                                     {-1, 0},
                                     {-0.92387953251128674, -0.38268343236508978},
                                     {-0.70710678118654757, -0.70710678118654757},
                                     {-0.38268343236508978, -0.92387953251128674},
                                     {0, -1},
                                     {0.38268343236508978, -0.92387953251128674},
                                     {0.70710678118654757, -0.70710678118654757},
                                     {0.92387953251128674, -0.38268343236508978}};

static struct zr_rect rect_around(struct zr_point at, double radius)
{
    return (struct zr_rect){at.x - radius, at.y - radius, at.x + radius, at.y + radius};
}

/* Returns the way that leads most away from the middle of the window. */
static int outward(const struct zr_layout *l, struct zr_point at)
{
    const double x = at.x - 0.5 * l->width, y = at.y - 0.5 * l->height;
    int best = 0;
    for (int i = 1; i < WAYS; i++)
        if (x * ways[i][0] + y * ways[i][1] > x * ways[best][0] + y * ways[best][1]) best = i;
    return best;
}

static void draw(struct zr_layout *l, struct zr_point at, struct zr_point center, const double way[2], double radius,
                 const char *text)
{
    const double r = dot * l->letters, width = zr_type_width(text, l->letters);
    const struct zr_ink paper = zr_layout_ink(l, l->paper, 0.0, false);
    const struct zr_segment line = {{at.x + way[0] * r, at.y + way[1] * r},
                                    {center.x - way[0] * radius, center.y - way[1] * radius}};
    zr_layout_draw(l, line, l->ink, 0.7, true);
    zr_marks_add_disc(l->marks, at, r, zr_layout_ink(l, l->ink, 0.0, true));
    zr_marks_add_disc(l->marks, center, radius, paper);
    zr_marks_add_ring(l->marks, center, radius, zr_layout_ink(l, l->ink, 0.8, false));
    zr_layout_write(l, text, center.x - 0.5 * width, center.y + 0.5 * l->letters, l->letters, l->ink, false);
    zr_layout_take_line(l, line);
    zr_layout_take_rect(l, rect_around(center, radius));
}

/* Draws a mark in the first free ring. */
static bool place(struct zr_layout *l, struct zr_point at, const char *text)
{
    const double h = l->letters, begin = 1.42 * around * h;
    const double half = 0.5 * zr_type_width(text, h) + side_room * h + 0.6, below = 0.9 * h + 0.6; /* on whole pixels */
    const double radius = fmax(least_radius * h, sqrt(half * half + below * below));
    const int first = outward(l, at);
    for (int i = 0; i < DISTANCES; i++)
        for (int k = 0; k < WAYS; k++) {
            const int turn = k % 2 ? (k + 1) / 2 : WAYS - k / 2; /* 0, 1, -1, 2, -2 and so on */
            const double *way = ways[(first + turn) % WAYS], reach = distances[i] * h + radius - least_radius * h;
            const struct zr_point center = {at.x + way[0] * reach, at.y + way[1] * reach};
            const struct zr_rect rect = rect_around(center, radius + 0.2 * h);
            const struct zr_segment line = {{at.x + way[0] * begin, at.y + way[1] * begin},
                                            {center.x - way[0] * radius, center.y - way[1] * radius}};
            if (!zr_layout_is_inside(l, rect) || !zr_layout_is_apart(l, rect) || !zr_layout_is_line_free(l, line))
                continue;
            draw(l, at, center, way, radius, text);
            return true;
        }
    return false;
}

void zr_place_marks_place(struct zr_layout *l)
{
    const struct zr_annotate *annotate = &l->frame->view->annotate;
    struct zr_point *at = zr_arena_alloc(l->arena, annotate->mark_count ? annotate->mark_count : 1, sizeof *at);
    bool is_seen[ZR_PLACE_MARKS_MAX];
    if (!at) return;
    for (uint32_t i = 0; i < annotate->mark_count; i++) {
        is_seen[i] = zr_layout_project(l, zr_layout_world(l, annotate->marks[i].at), &at[i]);
        if (is_seen[i]) zr_layout_take_rect(l, rect_around(at[i], around * l->letters));
    }
    for (uint32_t i = 0; i < annotate->mark_count; i++) {
        char what[32];
        if (is_seen[i] && place(l, at[i], annotate->marks[i].text)) continue;
        snprintf(what, sizeof what, "marks/%u", i);
        zr_layout_leave_out(l, what, is_seen[i] ? "no room" : "behind the eye",
                            is_seen[i] ? ZR_LEFT_OUT_NO_ROOM : ZR_LEFT_OUT_BY_VIEW);
    }
}
