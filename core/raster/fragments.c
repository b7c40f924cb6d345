#include "raster/fragments.h"

/* For the lists of a whole window: takes some milliseconds at the first access to their memory. */
enum { PLACES_PER_CANCEL_CHECK = 1 << 20 };

static void *take(struct zr_arena *arena, pthread_mutex_t *lock, uint64_t count, size_t size)
{
    if (lock) pthread_mutex_lock(lock);
    void *taken = zr_arena_alloc(arena, count, size);
    if (lock) pthread_mutex_unlock(lock);
    return taken;
}

bool zr_fragments_begin(struct zr_arena *arena, pthread_mutex_t *lock, uint32_t places, struct zr_fragments *fragments)
{
    if (!fragments->ends) fragments->ends = take(arena, lock, (size_t)places + 1, sizeof *fragments->ends);
    if (!fragments->ends) return false;
    if (!zr_arena_clear(arena, fragments->ends, ((size_t)places + 1) * sizeof *fragments->ends)) return false;
    fragments->places = places;
    fragments->is_filled_in = false;
    return true;
}

/* Ensures room for `total` keys, which tiles share one after the other. Grows by at least half, so that the abandoned
 * arrays are a constant share. */
static bool make_room(struct zr_arena *arena, pthread_mutex_t *lock, uint64_t total, struct zr_fragments *fragments)
{
    if (fragments->keys && total <= fragments->room) return true;
    const uint64_t grown = (uint64_t)fragments->room + fragments->room / 2, room = total > grown ? total : grown;
    fragments->keys = take(arena, lock, room, sizeof *fragments->keys);
    fragments->room = (uint32_t)room;
    return fragments->keys != NULL;
}

bool zr_fragments_prefix_sum(struct zr_arena *arena, pthread_mutex_t *lock, struct zr_fragments *fragments)
{
    uint64_t total = 0;
    for (uint32_t i = 0; i < fragments->places; i++) {
        if (i % PLACES_PER_CANCEL_CHECK == PLACES_PER_CANCEL_CHECK - 1 && zr_is_cancelled(arena->cancel)) return false;
        const uint32_t count = fragments->ends[i + 1];
        fragments->ends[i] = (uint32_t)total; /* next key of list i: at first its start */
        total += count;
    }
    fragments->is_filled_in = true;
    return total <= UINT32_MAX / 2 && make_room(arena, lock, total, fragments);
}

/* Shell sort: most lists are short, and none is longer than the number of primitives. Gaps: Ciura 2001. */
void zr_fragment_keys_sort(uint64_t *keys, uint32_t count)
{
    static const uint32_t gaps[] = {1398101, 345000, 86961, 21907, 5501, 1750, 701, 301, 132, 57, 23, 10, 4, 1};
    size_t g = 0;
    while (g < sizeof gaps / sizeof gaps[0] && gaps[g] >= count)
        g++;
    for (; g < sizeof gaps / sizeof gaps[0]; g++)
        for (uint32_t i = gaps[g]; i < count; i++) {
            const uint64_t key = keys[i];
            uint32_t to = i;
            for (; to >= gaps[g] && keys[to - gaps[g]] > key; to -= gaps[g])
                keys[to] = keys[to - gaps[g]];
            keys[to] = key;
        }
}

/* Checks for cancellation once per this many fragments; short lists take little time, and a long one is followed by a
 * check. */
enum { FRAGMENTS_PER_CANCEL_CHECK = 1 << 16 };

void zr_fragments_sort(const struct zr_cancel *cancel, struct zr_fragments *fragments)
{
    uint32_t next = 0;
    for (uint32_t end = fragments->places; end > 0;) {
        const uint32_t count = end % PLACES_PER_CANCEL_CHECK ? end % PLACES_PER_CANCEL_CHECK : PLACES_PER_CANCEL_CHECK;
        end -= count;
        memmove(fragments->ends + end + 1, fragments->ends + end, count * sizeof *fragments->ends);
        if (count == PLACES_PER_CANCEL_CHECK && zr_is_cancelled(cancel)) return;
    }
    fragments->ends[0] = 0;
    for (uint32_t i = 0; i < fragments->places; i++) {
        if (fragments->ends[i] >= next) {
            if (zr_is_cancelled(cancel)) return;
            next = fragments->ends[i] + FRAGMENTS_PER_CANCEL_CHECK;
        }
        zr_fragment_keys_sort(fragments->keys + fragments->ends[i], fragments->ends[i + 1] - fragments->ends[i]);
    }
}
