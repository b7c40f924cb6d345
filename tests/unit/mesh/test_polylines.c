/* Polylines from pieces of lines, and coincident pieces. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lines/coincident.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/line_pieces.h"

TEST_ARENA(1u << 26)

TEST(straight_pieces_become_one_segment)
{
    struct zr_line_piece pieces[] = {piece(0, 0, 10, 0.01, ZR_LINE_CREASE), piece(10, 0.01, 20, 0, ZR_LINE_CREASE),
                                     piece(30, 10, 20, 0, ZR_LINE_CREASE)};
    const struct zr_polylines lines = join(&arena, pieces, 3);
    assert_int_equal(lines.count, 1);
    assert_int_equal(lines.at[0].count, 3);
    assert_int_equal(lines.at[0].class, ZR_STROKE_INNER);
    assert_true(lines.points[1][0] == 20.0 && lines.points[2][0] == 30.0);
}

TEST(classes_follow_kinds_and_the_background)
{
    struct zr_line_piece pieces[] = {piece(0, 0, 20, 0, ZR_LINE_CREASE), piece(20, 0, 40, 0, ZR_LINE_CREASE),
                                     piece(40, 0, 60, 0, ZR_LINE_BORDER), piece(60, 0, 80, 0, ZR_LINE_CREASE)};
    pieces[1].is_at_background = true;
    pieces[3].is_hidden = true;
    const struct zr_polylines lines = join(&arena, pieces, 4);
    assert_int_equal(lines.count, 3);
    assert_int_equal(lines.at[0].class, ZR_STROKE_INNER);
    assert_int_equal(lines.at[1].class, ZR_STROKE_OUTLINE);
    assert_int_equal(lines.at[2].class, ZR_STROKE_HIDDEN);
}

/* Joins coincident pieces, and writes the lines that are left along y = 10: "10-90 " and so on. */
static const char *coincident(struct zr_line_piece *at, uint32_t count, uint32_t hidden)
{
    static char text[256];
    struct zr_line_pieces pieces = {.count = count, .at = zr_arena_copy(&arena, at, count * sizeof *at)};
    for (uint32_t i = 0; i < hidden; i++)
        pieces.at[i].is_hidden = true;
    assert_int_equal(zr_coincident_join(&arena, NULL, &pieces), ZR_OK);
    const struct zr_polylines lines = join(&arena, pieces.at, pieces.count);
    text[0] = 0;
    for (uint32_t i = 0; i < lines.count; i++) {
        const double *from = lines.points[lines.at[i].first], *to = lines.points[lines.at[i].first + 1];
        if (lines.at[i].class != ZR_STROKE_HIDDEN) continue;
        snprintf(text + strlen(text), sizeof text - strlen(text), "%.0f-%.0f ", fmin(from[0], to[0]),
                 fmax(from[0], to[0]));
    }
    return text;
}

TEST(hidden_pieces_that_coincide_become_one)
{
    struct zr_line_piece inside[] = {piece(20, 10, 60, 10, ZR_LINE_CREASE), piece(90, 10, 10, 10, ZR_LINE_CREASE)},
                         beyond[] = {piece(50, 10, 10, 10, ZR_LINE_CREASE), piece(30, 10.02, 90, 10.02, ZR_LINE_BORDER),
                                     piece(85, 10, 95, 10, ZR_LINE_CREASE)},
                         beside[] = {piece(10, 10, 50, 10, ZR_LINE_CREASE), piece(30, 10.1, 90, 10.1, ZR_LINE_CREASE)},
                         turned[] = {piece(10, 10, 50, 10, ZR_LINE_CREASE), piece(11, 9, 49, 11, ZR_LINE_CREASE)};
    assert_string_equal(coincident(inside, 2, 2), "10-90 ");
    assert_string_equal(coincident(beyond, 3, 3), "10-95 ");
    assert_string_equal(coincident(beside, 2, 2), "10-50 30-90 ");
    assert_string_equal(coincident(turned, 2, 2), "10-50 11-49 ");
}

TEST(visible_pieces_win_over_hidden_ones)
{
    struct zr_line_piece cut[] = {piece(10, 10, 90, 10, ZR_LINE_CREASE), piece(40, 10, 60, 10, ZR_LINE_CREASE)},
                         covered[] = {piece(20, 10, 60, 10, ZR_LINE_CREASE), piece(10, 10, 90, 10, ZR_LINE_BORDER)},
                         behind[] = {piece(20, 10, 60, 10, ZR_LINE_CREASE), piece(60, 10, 90, 10, ZR_LINE_BORDER)};
    assert_string_equal(coincident(cut, 2, 1), "10-40 60-90 ");
    assert_string_equal(coincident(covered, 2, 1), "");
    assert_string_equal(coincident(behind, 2, 1), "20-60 ");
}

/* Pieces along lines at all angles, each of which is there three times, in different pieces. */
TEST(coincident_lines_at_any_angle_are_drawn_once)
{
    struct random numbers = random_seeded(4);
    for (int round = 0; round < 200; round++) {
        const double angle = random_range(&numbers, -3.2, 3.2), x = random_range(&numbers, 0, 2000),
                     y = random_range(&numbers, 0, 2000), dx = cos(angle), dy = sin(angle);
        const double ends[3][2] = {{0, 40}, {30, 100}, {20, 60}};
        struct zr_line_piece pieces[3];
        for (int i = 0; i < 3; i++) {
            const double *e = ends[i];
            pieces[i] =
                piece(x + dx * e[i & 1], y + dy * e[i & 1], x + dx * e[!(i & 1)], y + dy * e[!(i & 1)], ZR_LINE_CREASE);
            pieces[i].is_hidden = true;
        }
        struct zr_line_pieces all = {.count = 3, .at = zr_arena_copy(&arena, pieces, sizeof pieces)};
        assert_int_equal(zr_coincident_join(&arena, NULL, &all), ZR_OK);
        const struct zr_polylines lines = join(&arena, all.at, all.count);
        assert_int_equal(lines.count, 1);
        const double *from = lines.points[0], *to = lines.points[1];
        assert_true(fabs(hypot(to[0] - from[0], to[1] - from[1]) - 100.0) < 1e-9);
    }
}

TEST(free_specks_go)
{
    struct zr_line_piece alone[] = {piece(0, 0, 11, 0, ZR_LINE_CREASE)},
                         both[] = {piece(0, 0, 11, 0, ZR_LINE_CREASE), piece(11, 0, 11, 5, ZR_LINE_BORDER)};
    assert_int_equal(join(&arena, alone, 1).count, 0);
    assert_int_equal(join(&arena, both, 2).count, 2);
    alone[0].is_at_background = true;
    assert_int_equal(join(&arena, alone, 1).count, 1);
    alone[0].is_at_background = false;
    alone[0].is_hidden = true;
    assert_int_equal(join(&arena, alone, 1).count, 1);
}

/* A line where one polygon of a circle changes to another: its pieces end within a pixel of one another. */
TEST(pieces_that_nearly_meet_are_no_specks)
{
    struct zr_line_piece near[] = {piece(0, 0, 8, 0, ZR_LINE_CREASE), piece(8.9, 0.2, 17, 0, ZR_LINE_INTERSECTION)},
                         far[] = {piece(0, 0, 8, 0, ZR_LINE_CREASE), piece(9.1, 0.2, 17, 0, ZR_LINE_INTERSECTION)};
    assert_int_equal(join(&arena, near, 2).count, 2);
    assert_int_equal(join(&arena, far, 2).count, 0);
}

RUN_TESTS(open_arena, close_arena)
