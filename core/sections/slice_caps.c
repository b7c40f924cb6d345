#include "sections/slices.h"

/* Segments in the order of their begins. */
struct joining {
    struct zr_slices *slices;
    const struct zr_slice_segment *segments;
    uint32_t count;
    uint32_t *next; /* at the first segment that begins at a vertex: the first one there that is not used */
    bool *is_used;
    struct zr_slice_faces *faces;
};

enum { SEGMENTS_PER_CANCEL_CHECK = 1 << 13 };

static bool is_before(const struct zr_slice_segment *a, const struct zr_slice_segment *b)
{
    if (a->part != b->part) return a->part < b->part;
    if (a->from != b->from) return a->from < b->from;
    if (a->to != b->to) return a->to < b->to;
    return a->face < b->face;
}

/* Merges from[begin .. middle - 1] and from[middle .. end - 1] to to[begin .. end - 1]. Returns false if cancelled. */
static bool merge(const struct zr_cancel *cancel, const struct zr_slice_segment *from, uint32_t begin, uint32_t middle,
                  uint32_t end, struct zr_slice_segment *to)
{
    for (uint32_t i = begin, left = begin, right = middle; i < end; i++) {
        if (i % SEGMENTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        const bool takes_right = left == middle || (right < end && is_before(&from[right], &from[left]));
        to[i] = from[takes_right ? right++ : left++];
    }
    return true;
}

/* Sorts by runs of growing length, for a library's sort cannot be cancelled. Returns the sorted ones, in `segments` or
 * in `room`; NULL if cancelled. */
static struct zr_slice_segment *sort(const struct zr_cancel *cancel, struct zr_slice_segment *segments,
                                     struct zr_slice_segment *room, uint32_t count)
{
    for (uint64_t run = 1; run < count; run *= 2) {
        for (uint64_t begin = 0; begin < count; begin += 2 * run) {
            const uint64_t middle = begin + run < count ? begin + run : count,
                           end = begin + 2 * run < count ? begin + 2 * run : count;
            if (!merge(cancel, segments, (uint32_t)begin, (uint32_t)middle, (uint32_t)end, room)) return NULL;
        }
        struct zr_slice_segment *sorted = room;
        room = segments;
        segments = sorted;
    }
    return segments;
}

/* Returns the first segment of the part that begins at the vertex, or `count`. */
static uint32_t first_from(const struct joining *j, uint32_t part, uint32_t vertex)
{
    uint32_t low = 0, high = j->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const struct zr_slice_segment *at = &j->segments[middle];
        if (at->part < part || (at->part == part && at->from < vertex))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Returns an unused segment that begins where `segment` ends, or `count`. */
static uint32_t after(struct joining *j, const struct zr_slice_segment *segment)
{
    const uint32_t first = first_from(j, segment->part, segment->to);
    if (first == j->count) return first;
    uint32_t at = j->next[first];
    while (at < j->count && j->segments[at].part == segment->part && j->segments[at].from == segment->to) {
        j->next[first] = at + 1;
        if (!j->is_used[at]) return at;
        at++;
    }
    return j->count;
}

static uint32_t make_corner(struct zr_slices *slices, uint32_t vertex)
{
    slices->made[slices->corner_count - slices->slot_count] =
        (struct zr_slice_corner){ZR_SLICE_NONE, ZR_SLICE_NONE, 0.0, vertex};
    return slices->corner_count++;
}

/* Follows a loop from segment `first`, and adds it as a ring if it has three corners. */
static void add_loop(struct joining *j, uint32_t first)
{
    struct zr_slice_faces *faces = j->faces;
    const uint32_t begin = faces->corner_count;
    for (uint32_t at = first; at < j->count; at = after(j, &j->segments[at])) {
        if (faces->corner_count % SEGMENTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(j->slices->cancel)) break;
        j->is_used[at] = true;
        faces->corners[faces->corner_count++] = make_corner(j->slices, j->segments[at].from);
    }
    if (faces->corner_count - begin >= 3)
        faces->ring_ends[faces->ring_count++] = faces->corner_count;
    else
        faces->corner_count = begin;
}

/* Adds the cap of the part of segment `first`. Returns the end of the part's segments. */
static uint32_t add_cap(struct joining *j, uint32_t first)
{
    struct zr_slices *slices = j->slices;
    struct zr_slice_faces *faces = j->faces;
    const uint32_t part = j->segments[first].part, rings = faces->ring_count;
    uint32_t end = first;
    for (; end < j->count && j->segments[end].part == part; end++)
        if (!j->is_used[end]) {
            if (zr_is_cancelled(slices->cancel)) return j->count;
            add_loop(j, end);
        }
    if (faces->ring_count == rings) return end;
    slices->caps[slices->cap_count] = (struct zr_slice_cap){part, slices->plane_count, j->segments[first].face};
    faces->numbers[faces->face_count] = slices->mesh->face_count + slices->cap_count++;
    faces->is_saved[faces->face_count] = false;
    faces->face_ends[faces->face_count++] = faces->ring_count;
    return end;
}

static uint32_t count_parts(const struct zr_slice_segment *segments, uint32_t count)
{
    uint32_t parts = 0;
    for (uint32_t i = 0; i < count; i++)
        parts += i == 0 || segments[i].part != segments[i - 1].part;
    return parts;
}

enum zr_status zr_slice_caps_add(struct zr_arena *arena, struct zr_slices *slices, struct zr_slice_segment *segments,
                                 uint32_t count, struct zr_slice_faces *faces)
{
    struct joining j = {.slices = slices, .count = count, .faces = faces};
    struct zr_slice_segment *other = zr_arena_alloc(arena, count, sizeof *other);
    if (!other) return ZR_NO_MEMORY;
    j.segments = segments = sort(slices->cancel, segments, other, count);
    if (!segments) return ZR_CANCELLED;
    const uint32_t caps = slices->cap_count, parts = count_parts(segments, count);
    struct zr_slice_cap *room = zr_arena_grow(arena, slices->caps, caps, (size_t)caps + parts, sizeof *room);
    j.next = zr_arena_alloc(arena, count, sizeof *j.next);
    j.is_used = zr_arena_zero(arena, count, sizeof *j.is_used);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    slices->caps = room;
    for (uint32_t i = 0; i < count; i++)
        j.next[i] = i;
    for (uint32_t at = 0; at < count;) {
        if (zr_is_cancelled(slices->cancel)) return ZR_CANCELLED;
        at = add_cap(&j, at);
    }
    return zr_is_cancelled(slices->cancel) ? ZR_CANCELLED : ZR_OK;
}
