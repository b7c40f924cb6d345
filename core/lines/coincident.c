#include "lines/coincident.h"

#include "base/cancel.h"
#include "base/sort.h"

/* Bins of the hash table: of directions, over half a turn; and their neighbours. */
enum { ANGLE_BINS = 256, COMPARED_MOST = 64, ITEMS_PER_CANCEL_CHECK = 1 << 10 };

static const double reach = 1.0 / 32.0, overlap_least = 1.0 / 8.0;

/* A straight line: a point and a unit vector. */
struct carrier {
    double x, y, dx, dy;
    uint32_t next; /* number + 1 of the next one in its slot */
};

/* A piece on a carrier, over an interval of pixels from its point. */
struct member {
    uint32_t piece, carrier;
    double begin, end;
    bool is_turned; /* ends[0] is at `end` */
};

struct joining {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct zr_line_pieces *pieces;
    uint32_t hidden_count, carrier_count, member_count, slot_count;
    struct carrier *carriers;
    uint32_t *slots; /* number + 1 of the first carrier; slot_count is a power of two */
    struct member *members;
    struct zr_line_piece *made;
    uint32_t made_count;
};

static bool is_due(const struct joining *j, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(j->cancel);
}

/* ---- the table of carriers ---- */

/* Returns the line of a piece, in the upper half of directions. */
static struct carrier carrier_of(const struct zr_line_piece *piece)
{
    const struct zr_window_point *p = &piece->ends[0], *q = &piece->ends[1];
    const double x = q->x - p->x, y = q->y - p->y, length = sqrt(x * x + y * y);
    const double sign = y < 0.0 || (y == 0.0 && x < 0.0) ? -1.0 : 1.0;
    return (struct carrier){.x = p->x, .y = p->y, .dx = sign * x / length, .dy = sign * y / length};
}

/* A bin of lines: of their angle, and of their distance from the origin. */
struct bin {
    int32_t angle;
    int64_t place;
};

/* Angles are those of a diamond: 0..1 in the first quadrant, 1..2 in the second. */
static struct bin bin_of(const struct carrier *c)
{
    const double angle = c->dx >= 0.0 ? c->dy / (c->dx + c->dy) : 1.0 + c->dx / (c->dx - c->dy);
    return (struct bin){(int32_t)(angle * (ANGLE_BINS / 2)), (int64_t)floor(c->dx * c->y - c->dy * c->x)};
}

/* Returns the slot of a bin that is next to another one. Half a turn later, lines have the opposite sign. */
static uint32_t slot_of(const struct joining *j, struct bin bin, int angle, int place)
{
    const bool is_beyond = bin.angle + angle < 0 || bin.angle + angle >= ANGLE_BINS;
    const uint64_t turned = (uint64_t)((bin.angle + angle + ANGLE_BINS) % ANGLE_BINS);
    const int64_t own = bin.place + place;
    uint64_t h = turned * 0x9e3779b97f4a7c15u ^ (uint64_t)(is_beyond ? -own - 1 : own) * 0xc2b2ae3d27d4eb4fu;
    h = (h ^ h >> 32) * 0xd6e8feb86659fd93u;
    return (uint32_t)(h >> 32) & (j->slot_count - 1);
}

static bool is_near(const struct carrier *c, const struct zr_window_point *p)
{
    return fabs(c->dx * (p->y - c->y) - c->dy * (p->x - c->x)) <= reach;
}

/* Returns the first carrier of a slot on which the piece lies, or `least` if that is lower. */
static uint32_t find_in_slot(const struct joining *j, const struct zr_line_piece *piece, uint32_t slot, uint32_t least)
{
    uint32_t compared = 0;
    for (uint32_t n = j->slots[slot]; n != 0 && compared < COMPARED_MOST; n = j->carriers[n - 1].next, compared++)
        if (n - 1 < least && is_near(&j->carriers[n - 1], &piece->ends[0]) &&
            is_near(&j->carriers[n - 1], &piece->ends[1]))
            least = n - 1;
    return least;
}

/* Returns the first carrier on which the piece lies; `carrier_count` if there is none. */
static uint32_t find_carrier(const struct joining *j, const struct zr_line_piece *piece, struct bin bin)
{
    uint32_t found = j->carrier_count;
    for (int angle = -1; angle <= 1; angle++)
        for (int place = -1; place <= 1; place++)
            found = find_in_slot(j, piece, slot_of(j, bin, angle, place), found);
    return found;
}

static void add_carrier(struct joining *j, const struct carrier *own, struct bin bin)
{
    uint32_t *slot = &j->slots[slot_of(j, bin, 0, 0)];
    j->carriers[j->carrier_count] = *own;
    j->carriers[j->carrier_count++].next = *slot;
    *slot = j->carrier_count;
}

/* ---- members ---- */

static double place_on(const struct carrier *c, const struct zr_window_point *p)
{
    return c->dx * (p->x - c->x) + c->dy * (p->y - c->y);
}

static void add_member(struct joining *j, uint32_t piece, uint32_t carrier)
{
    const struct zr_window_point *ends = j->pieces->at[piece].ends;
    const double a = place_on(&j->carriers[carrier], &ends[0]), b = place_on(&j->carriers[carrier], &ends[1]);
    j->members[j->member_count++] =
        (struct member){.piece = piece, .carrier = carrier, .begin = fmin(a, b), .end = fmax(a, b), .is_turned = b < a};
}

/* Returns a number that ascends with a float. */
static uint32_t ordered(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 31 ? ~bits : bits | UINT32_C(1) << 31;
}

/* Writes the numbers of the hidden pieces, the longest first. */
static void list_hidden(const struct joining *j, uint64_t *keys)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < j->pieces->count; i++)
        if (j->pieces->at[i].is_hidden)
            keys[count++] = (uint64_t)~ordered((float)zr_line_piece_length(&j->pieces->at[i])) << 32 | i;
    zr_sort_u64(keys, count);
}

/* Deals all pieces to carriers. False if cancelled. */
static bool deal(struct joining *j, const uint64_t *hidden)
{
    for (uint32_t i = 0; i < j->hidden_count; i++) {
        const struct zr_line_piece *piece = &j->pieces->at[(uint32_t)hidden[i]];
        if (is_due(j, i)) return false;
        if (!(zr_line_piece_length(piece) > 0.0)) continue;
        const struct carrier own = carrier_of(piece);
        const struct bin bin = bin_of(&own);
        const uint32_t found = find_carrier(j, piece, bin);
        if (found == j->carrier_count) add_carrier(j, &own, bin);
        add_member(j, (uint32_t)hidden[i], found);
    }
    for (uint32_t i = 0; i < j->pieces->count; i++) {
        const struct zr_line_piece *piece = &j->pieces->at[i];
        if (is_due(j, i)) return false;
        if (piece->is_hidden || piece->is_dropped || !(zr_line_piece_length(piece) > 0.0)) continue;
        const struct carrier own = carrier_of(piece);
        const uint32_t found = find_carrier(j, piece, bin_of(&own));
        if (found < j->carrier_count) add_member(j, i, found);
    }
    return true;
}

/* ---- members in order ---- */

/* Returns the group of a member: the hidden ones of a carrier, then its visible ones. */
static uint32_t group_of(const struct joining *j, const struct member *m)
{
    return 2 * m->carrier + !j->pieces->at[m->piece].is_hidden;
}

/* Sorts a group by the begins of its members. */
static void sort_group(const struct member *members, uint32_t *numbers, uint64_t *keys, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        keys[i] = (uint64_t)ordered((float)members[numbers[i]].begin) << 32 | numbers[i];
    zr_sort_u64(keys, count);
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = (uint32_t)keys[i];
}

/* Writes the members of each group by their begins, and the first of each group to `firsts`. False if cancelled. */
static bool sort_members(const struct joining *j, uint32_t *firsts, uint32_t *numbers, uint64_t *keys)
{
    const uint32_t groups = 2 * j->carrier_count;
    for (uint32_t i = 0; i < j->member_count; i++)
        firsts[group_of(j, &j->members[i])]++;
    for (uint32_t g = 0, sum = 0; g <= groups; g++)
        firsts[g] = sum += firsts[g];
    for (uint32_t i = j->member_count; i-- > 0;)
        numbers[--firsts[group_of(j, &j->members[i])]] = i;
    for (uint32_t g = 0; g < groups; g++) {
        if (is_due(j, g)) return false;
        sort_group(j->members, numbers + firsts[g], keys, firsts[g + 1] - firsts[g]);
    }
    return true;
}

/* ---- one carrier ---- */

/* An interval of a carrier, and its ends in the window. */
struct part {
    double begin, end;
    struct zr_window_point from, to;
    uint32_t piece; /* at its begin */
};

static struct part part_of(const struct joining *j, const struct member *m)
{
    const struct zr_window_point *ends = j->pieces->at[m->piece].ends;
    return (struct part){m->begin, m->end, ends[m->is_turned], ends[!m->is_turned], m->piece};
}

static void add_made(struct joining *j, const struct part *part)
{
    if (!(part->end - part->begin >= ZR_HIDDEN_GAP_PIXELS)) return;
    struct zr_line_piece *made = &j->made[j->made_count++];
    *made = j->pieces->at[part->piece];
    made->ends[0] = part->from;
    made->ends[1] = part->to;
    made->is_dropped = false;
}

/* The members of a carrier, by their begins. */
struct row {
    const uint32_t *hidden, *visible; /* their numbers */
    uint32_t hidden_count, visible_count;
};

/* Adds a part without what visible members cover. Returns false, and adds nothing, if they cover nothing of it and it is
 * `alone`. The members before `*passed` end before the part begins. */
static bool add_uncovered(struct joining *j, const struct row *row, struct part part, bool alone, uint32_t *passed)
{
    bool is_cut = false;
    while (*passed < row->visible_count && j->members[row->visible[*passed]].end <= part.begin)
        (*passed)++;
    for (uint32_t i = *passed; i < row->visible_count && j->members[row->visible[i]].begin < part.end; i++) {
        const struct part cover = part_of(j, &j->members[row->visible[i]]);
        if (fmin(cover.end, part.end) - fmax(cover.begin, part.begin) < overlap_least) continue;
        const struct part before = {part.begin, cover.begin, part.from, cover.from, part.piece};
        is_cut = true;
        add_made(j, &before);
        part.begin = cover.end;
        part.from = cover.to;
    }
    if (is_cut || !alone) add_made(j, &part);
    return is_cut || !alone;
}

/* Joins the hidden members of a carrier. */
static void join_row(struct joining *j, const struct row *row)
{
    uint32_t passed = 0;
    for (uint32_t i = 0, next; i < row->hidden_count; i = next) {
        struct part part = part_of(j, &j->members[row->hidden[i]]);
        for (next = i + 1; next < row->hidden_count; next++) {
            const struct part more = part_of(j, &j->members[row->hidden[next]]);
            if (fmin(more.end, part.end) - more.begin < overlap_least) break;
            if (more.end <= part.end) continue;
            part.end = more.end;
            part.to = more.to;
        }
        if (!add_uncovered(j, row, part, next == i + 1, &passed)) continue;
        for (uint32_t k = i; k < next; k++)
            j->pieces->at[j->members[row->hidden[k]].piece].is_dropped = true;
    }
}

static bool join_rows(struct joining *j, const uint32_t *firsts, const uint32_t *numbers)
{
    for (uint32_t c = 0; c < j->carrier_count; c++) {
        const uint32_t *own = firsts + 2 * (size_t)c;
        const struct row row = {numbers + own[0], numbers + own[1], own[1] - own[0], own[2] - own[1]};
        if (is_due(j, c)) return false;
        join_row(j, &row);
    }
    return true;
}

/* ---- all steps ---- */

static bool make_table(struct joining *j)
{
    while (j->slot_count < 2 * j->hidden_count)
        j->slot_count *= 2;
    j->slots = zr_arena_zero(j->arena, j->slot_count, sizeof *j->slots);
    j->carriers = zr_arena_alloc(j->arena, j->hidden_count, sizeof *j->carriers);
    j->members = zr_arena_alloc(j->arena, j->pieces->count, sizeof *j->members);
    return zr_arena_ok(j->arena);
}

/* Appends what was made. */
static bool append(struct joining *j)
{
    struct zr_line_pieces *pieces = j->pieces;
    if (j->made_count == 0) return true;
    const uint32_t count = pieces->count + j->made_count;
    struct zr_line_piece *grown = zr_arena_grow(j->arena, pieces->at, pieces->count, count, sizeof *grown);
    if (!grown) return false;
    memcpy(grown + pieces->count, j->made, j->made_count * sizeof *grown);
    *pieces = (struct zr_line_pieces){.count = count, .at = grown};
    return true;
}

enum zr_status zr_coincident_join(struct zr_arena *arena, const struct zr_cancel *cancel, struct zr_line_pieces *pieces)
{
    struct joining j = {.arena = arena, .cancel = cancel, .pieces = pieces, .slot_count = 64};
    for (uint32_t i = 0; i < pieces->count; i++)
        j.hidden_count += pieces->at[i].is_hidden;
    if (j.hidden_count == 0) return ZR_OK;
    uint64_t *keys = zr_arena_alloc(arena, pieces->count, sizeof *keys);
    if (!keys || !make_table(&j)) return ZR_NO_MEMORY;
    list_hidden(&j, keys);
    if (!deal(&j, keys)) return ZR_CANCELLED;
    uint32_t *firsts = zr_arena_zero(arena, 2 * (size_t)j.carrier_count + 1, sizeof *firsts);
    uint32_t *numbers = zr_arena_alloc(arena, j.member_count, sizeof *numbers);
    j.made = zr_arena_alloc(arena, j.member_count, sizeof *j.made);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    if (!sort_members(&j, firsts, numbers, keys) || !join_rows(&j, firsts, numbers)) return ZR_CANCELLED;
    return append(&j) ? ZR_OK : ZR_NO_MEMORY;
}
