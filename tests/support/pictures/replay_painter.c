#include <stdio.h>
#include <string.h>

#include "support/pictures/replay_parts.h"

enum { PIECES = 40000 };

struct piece {
    const cJSON *item; /* NULL: cut or drawn */
    int box[4], size;
};
static struct piece pieces[PIECES];
static int piece_end; /* 1 + the greatest number so far */
static struct {
    int p, q;
    bool is_nearer;
} compared; /* the last two */

static struct piece *piece_of(int number)
{
    CHECK(number > 0 && number < PIECES && pieces[number].item, "piece %d is not there", number);
    return &pieces[number];
}

static struct piece *add_piece(const cJSON *item)
{
    const int number = whole(item, "piece"), id = whole(item, "primitive");
    const cJSON *span;
    CHECK(number > 0 && number < PIECES && !pieces[number].item, "piece %d", number);
    struct piece *piece = &pieces[number];
    if (number >= piece_end) piece_end = number + 1;
    *piece = (struct piece){item, {SIDE, SIDE, -1, -1}, 0};
    cJSON_ArrayForEach(span, member(item, "spans"))
    {
        const int y = whole_of(at(span, 0)), x0 = whole_of(at(span, 1)), x1 = whole_of(at(span, 2));
        for (int x = x0; x < x1; x++, piece->size++)
            CHECK(replay_covers(primitive_of(id), x, y), "piece %d at %d, %d", number, x, y);
        if (x0 < piece->box[0]) piece->box[0] = x0;
        if (y < piece->box[1]) piece->box[1] = y;
        if (x1 - 1 > piece->box[2]) piece->box[2] = x1 - 1;
        if (y > piece->box[3]) piece->box[3] = y;
    }
    return piece;
}

static void mark(const struct piece *piece, int marks[SIDE][SIDE], int by)
{
    const cJSON *span;
    cJSON_ArrayForEach(span, member(piece->item, "spans")) for (int x = whole_of(at(span, 1));
                                                                x < whole_of(at(span, 2)); x++)
        marks[whole_of(at(span, 0))][x] += by;
}

static void play_compare(const cJSON *step)
{
    const int first = whole_of(at(member(step, "compare"), 0)), second = whole_of(at(member(step, "compare"), 1));
    const struct piece *p = piece_of(first), *q = piece_of(second);
    const char *test = member(step, "test")->valuestring;
    const bool nearer = cJSON_IsTrue(member(step, "nearer")), farther = cJSON_IsTrue(member(step, "farther"));
    const bool is_apart = number_of(member(q->item, "far")) < number_of(member(p->item, "near"));
    const bool boxes =
        p->box[0] <= q->box[2] && q->box[0] <= p->box[2] && p->box[1] <= q->box[3] && q->box[1] <= p->box[3];
    CHECK(strcmp(test, is_apart ? "depth" : boxes ? "pixels" : "box") == 0, "the test %s", test);
    CHECK(strcmp(test, "pixels") == 0 || (!nearer && !farther), "the test %s finds something", test);
    compared.p = first;
    compared.q = second;
    compared.is_nearer = nearer;
}

/* A piece that is hidden in part goes first, or closes a cycle. */
static void check_hidden(int by, int hidden)
{
    CHECK(compared.p == by && compared.q == hidden && compared.is_nearer, "%d does not hide %d", by, hidden);
}

static void play_swap(const cJSON *pair)
{
    check_hidden(whole_of(at(pair, 0)), whole_of(at(pair, 1)));
}

static void play_cycle(const cJSON *cycle)
{
    const cJSON *item;
    check_hidden(whole_of(at(cycle, length(cycle) - 1)), whole_of(at(cycle, 0)));
    cJSON_ArrayForEach(item, cycle) piece_of(whole_of(item));
    replay_play.out->cycles++;
}

static void play_split(const cJSON *step)
{
    static int marks[SIDE][SIDE];
    struct piece *whole_one = piece_of(whole(step, "split"));
    const struct piece *by = piece_of(whole(step, "by"));
    memset(marks, 0, sizeof marks);
    mark(whole_one, marks, 1);
    const struct piece *rest = add_piece(at(member(step, "into"), 0)), *inside = add_piece(at(member(step, "into"), 1));
    CHECK(rest->size > 0 && inside->size > 0, "a part is empty");
    mark(rest, marks, -1);
    mark(inside, marks, -1);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            CHECK(marks[y][x] == 0, "parts do not make the piece at %d, %d", x, y);
    mark(by, marks, 1);
    const cJSON *span;
    cJSON_ArrayForEach(span, member(inside->item, "spans")) for (int x = whole_of(at(span, 1));
                                                                 x < whole_of(at(span, 2)); x++)
        CHECK(marks[whole_of(at(span, 0))][x] == 1, "the inner part is beside the other piece");
    whole_one->item = NULL;
    replay_play.out->cuts++;
}

static void play_draw(int number)
{
    struct piece *piece = piece_of(number);
    const int id = whole(piece->item, "primitive");
    const cJSON *span;
    cJSON_ArrayForEach(span, member(piece->item, "spans")) for (int x = whole_of(at(span, 1));
                                                                x < whole_of(at(span, 2)); x++)
        replay_play.shown[whole_of(at(span, 0))][x] = (uint32_t)id;
    piece->item = NULL;
}

void replay_painter(const cJSON *step)
{
    const cJSON *item;
    double far = 2.0;
    if (has(step, "compare")) play_compare(step);
    if (has(step, "swap")) play_swap(member(step, "swap"));
    if (has(step, "cycle")) play_cycle(member(step, "cycle"));
    if (has(step, "split")) play_split(step);
    if (has(step, "draw")) play_draw(whole(step, "draw"));
    if (!has(step, "order")) return;
    cJSON_ArrayForEach(item, member(step, "order"))
    {
        CHECK(number_of(member(item, "far")) <= far, "the farthest is not first");
        far = number_of(member(item, "far"));
        add_piece(item);
        CHECK(whole(item, "piece") == whole(item, "primitive"), "the number of a piece");
    }
}

void replay_painter_begin(void)
{
    memset(pieces, 0, (size_t)piece_end * sizeof *pieces);
    piece_end = 0;
}

void replay_painter_end(void)
{
    for (int i = 0; i < piece_end; i++)
        CHECK(!pieces[i].item, "piece %d is left", i);
}
