#include "base/arena.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/forbid.h"
#include "support/tests.h"

TEST(arena_over_its_ceiling_fails_and_stays_failed)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 10000);
    assert_non_null(zr_arena_alloc(&arena, 5000, 1));
    assert_null(zr_arena_alloc(&arena, 5001, 1));
    assert_null(zr_arena_alloc(&arena, 1, 1));
    assert_false(zr_arena_ok(&arena));
    assert_true(arena.wanted >= 10001 && arena.wanted < 10001 + 2 * ZR_ARENA_ALIGN); /* of the first that failed */
    zr_arena_reset(&arena, 0);
    assert_true(zr_arena_ok(&arena) && arena.wanted == 0);
    assert_non_null(zr_arena_alloc(&arena, 9000, 1));
    zr_arena_free(&arena);
}

TEST(scratch_arena_shares_the_ceiling_and_gives_its_memory_back)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 10240);
    assert_non_null(zr_arena_alloc(&arena, 1024, 1));
    struct zr_arena scratch = zr_arena_open_scratch(&arena);
    assert_non_null(zr_arena_alloc(&scratch, 4096, 1));
    assert_non_null(zr_arena_alloc_beside(&arena, &scratch, 1024, 1));
    assert_non_null(zr_arena_alloc(&scratch, 4096, 1)); /* all that is left */
    assert_true(zr_arena_ok(&scratch));
    zr_arena_close_scratch(&scratch, &arena);
    assert_true(zr_arena_ok(&arena));
    assert_int_equal(arena.used, 2048);
    assert_int_equal(arena.peak, 10240);
    scratch = zr_arena_open_scratch(&arena);
    assert_null(zr_arena_alloc(&scratch, 8193, 1));
    zr_arena_close_scratch(&scratch, &arena);
    assert_false(zr_arena_ok(&arena));
    assert_int_equal(arena.wanted, 2048 + 8192 + ZR_ARENA_ALIGN);
    scratch = zr_arena_open_scratch(&arena);
    assert_null(zr_arena_alloc(&scratch, 1, 1)); /* what has failed stays failed */
    zr_arena_close_scratch(&scratch, &arena);
    zr_arena_free(&arena);
}

TEST(memory_beside_a_scratch_arena_leaves_it_what_it_has)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 10240);
    struct zr_arena scratch = zr_arena_open_scratch(&arena);
    assert_non_null(zr_arena_alloc(&scratch, 4096, 1));
    assert_null(zr_arena_alloc_beside(&arena, &scratch, 6145, 1));
    assert_false(zr_arena_ok(&arena));
    assert_int_equal(arena.wanted, 4096 + 6144 + ZR_ARENA_ALIGN);
    zr_arena_close_scratch(&scratch, &arena);
    assert_true(arena.peak <= arena.ceiling);
    zr_arena_free(&arena);
}

TEST(arena_product_that_overflows_fails)
{
    struct zr_arena arena;
    zr_arena_init(&arena, SIZE_MAX);
    assert_null(zr_arena_alloc(&arena, SIZE_MAX / 2, 3));
    assert_false(zr_arena_ok(&arena));
    assert_true(arena.wanted == SIZE_MAX);
    zr_arena_free(&arena);
}

TEST(arena_allocations_are_aligned_and_apart)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    unsigned char *blocks[100];
    for (size_t i = 0; i < 100; i++) {
        blocks[i] = zr_arena_alloc(&arena, i * 997, 1);
        assert_non_null(blocks[i]);
        assert_int_equal((uintptr_t)blocks[i] % ZR_ARENA_ALIGN, 0);
        memset(blocks[i], (int)i, i * 997);
    }
    for (size_t i = 0; i < 100; i++)
        for (size_t k = 0; k < i * 997; k++)
            assert_int_equal(blocks[i][k], i);
    zr_arena_free(&arena);
}

/* What AddressSanitizer reports, so that tests under it are about arrays, not about blocks. */
TEST(arena_forbids_what_is_not_allocated_under_address_sanitizer)
{
#if ZR_ASAN
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    char *one = zr_arena_alloc(&arena, 13, 1), *two = zr_arena_alloc(&arena, 64, 1);
    assert_false(__asan_address_is_poisoned(one + 12));
    assert_true(__asan_address_is_poisoned(one + 13));
    assert_true(__asan_address_is_poisoned(two - 1));
    assert_true(__asan_address_is_poisoned(two + 64));
    assert_ptr_equal(zr_arena_grow(&arena, two, 64, 200, 1), two);
    assert_false(__asan_address_is_poisoned(two + 199));
    assert_true(__asan_address_is_poisoned(two + 200));
    zr_arena_reset(&arena, ZR_ARENA_BLOCK);
    assert_true(__asan_address_is_poisoned(one));
    zr_arena_free(&arena);
#endif
}

/* About the sizes of the system's pages. */
TEST(arena_large_blocks_are_whole_and_too_large_ones_fail)
{
    static const size_t pages[] = {1 << 20, 2 << 20, 6 << 20};
    struct zr_arena arena;
    zr_arena_init(&arena, SIZE_MAX);
    for (size_t i = 0; i < sizeof pages / sizeof *pages; i++)
        for (size_t bytes = pages[i] - 129; bytes <= pages[i] + 129; bytes += 43) {
            unsigned char *block = zr_arena_alloc(&arena, bytes, 1);
            assert_non_null(block);
            assert_int_equal((uintptr_t)block % ZR_ARENA_ALIGN, 0);
            block[0] = block[bytes - 1] = 1;
            zr_arena_reset(&arena, bytes % 2 ? 0 : SIZE_MAX);
        }
    for (size_t less = 0; less < 2 << 20; less += 12345) {
        assert_null(zr_arena_alloc(&arena, SIZE_MAX - less, 1));
        zr_arena_reset(&arena, 0);
        void *newest = zr_arena_alloc(&arena, 100, 1);
        assert_null(zr_arena_grow(&arena, newest, 100, SIZE_MAX - less, 1));
        zr_arena_reset(&arena, 0);
    }
    zr_arena_free(&arena);
}

TEST(arena_newest_allocation_grows_in_place_and_others_are_copied)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    char *first = zr_arena_alloc(&arena, 100, 1);
    memset(first, 7, 100);
    assert_ptr_equal(zr_arena_grow(&arena, first, 100, 5000, 1), first);
    char *second = zr_arena_alloc(&arena, 10, 1);
    assert_true(second >= first + 5000);
    char *moved = zr_arena_grow(&arena, first, 5000, 6000, 1);
    assert_ptr_not_equal(moved, first);
    assert_int_equal(moved[99], 7);
    zr_arena_free(&arena);
}

TEST(arena_newest_allocations_of_all_blocks_can_be_trimmed)
{
    enum { LARGE = 3 * ZR_ARENA_BLOCK / 2, GAP = ZR_ASAN ? ZR_ARENA_ALIGN : 0 };
    struct zr_arena arena;
    zr_arena_init(&arena, 8 * ZR_ARENA_BLOCK);
    char *first = zr_arena_alloc(&arena, LARGE, 1), *second = zr_arena_alloc(&arena, LARGE, 1);
    assert_non_null(second);
    const size_t held = arena.held;
    zr_arena_trim(&arena, first, LARGE, 1000, 1);
    assert_int_equal(arena.used, LARGE + 1024);
    assert_int_equal(arena.held, held); /* the freed end still counts, until another allocation takes it */
    zr_arena_trim(&arena, second, LARGE, 0, 1);
    assert_int_equal(arena.used, 1024);
    assert_int_equal(arena.held, held - LARGE);
    zr_arena_trim(&arena, NULL, 1000, 0, 1);
    assert_int_equal(arena.used, 1024);
    assert_ptr_equal(zr_arena_alloc(&arena, LARGE, 1), second + GAP);
    assert_ptr_equal(zr_arena_alloc(&arena, ZR_ARENA_BLOCK, 1), first + 1024 + GAP);
    assert_true(arena.held <= held + 1024);
    zr_arena_free(&arena);
}

TEST(arena_charge_counts_until_it_is_refunded)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 10000);
    assert_true(zr_arena_charge(&arena, 6000));
    zr_arena_refund(&arena, 6000);
    assert_true(zr_arena_charge(&arena, 9000));
    assert_null(zr_arena_alloc(&arena, 2000, 1));
    assert_false(zr_arena_ok(&arena));
    zr_arena_free(&arena);
}

TEST(arena_reset_keeps_blocks_for_the_next_request)
{
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 26);
    void *block = zr_arena_alloc(&arena, 1 << 22, 1);
    zr_arena_reset(&arena, 1 << 24);
    assert_ptr_equal(zr_arena_alloc(&arena, 1 << 22, 1), block);
    zr_arena_free(&arena);
}

TEST(arena_ends_of_blocks_are_held_once_they_are_left)
{
    enum { MIB = 1 << 20, BYTES = MIB + MIB / 8 };
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)32 * MIB);
    size_t count = 0;
    while (zr_arena_alloc(&arena, BYTES, 1))
        count++;
    assert_in_range(count, 15, 16); /* blocks of two */
    assert_true(arena.held <= arena.ceiling && arena.wanted > arena.ceiling);
    zr_arena_reset(&arena, 0);
    for (int i = 0; i < 10; i++)
        assert_non_null(zr_arena_alloc(&arena, BYTES, 1));
    const size_t held = arena.held;
    for (int i = 0; i < 100; i++)
        assert_non_null(zr_arena_alloc(&arena, MIB / 16, 1));
    assert_true(arena.held < held + MIB); /* they are at the ends */
    zr_arena_free(&arena);
}

TEST(arena_large_allocations_waste_little)
{
    struct zr_arena arena;
    zr_arena_init(&arena, SIZE_MAX);
    for (size_t bytes = 2 << 20; bytes < (size_t)40 << 20; bytes += bytes / 7) {
        const size_t before = arena.held;
        for (int i = 0; i < 3; i++)
            assert_non_null(zr_arena_alloc(&arena, bytes, 1));
        assert_in_range(arena.held - before, 3 * bytes, 3 * (zr_arena_block_bytes(bytes)) + (2 << 20));
        assert_true(zr_arena_block_bytes(bytes) <= bytes + (2 << 20));
        zr_arena_reset(&arena, bytes & 1 ? SIZE_MAX : 0);
    }
    zr_arena_free(&arena);
}

static size_t hold_some(struct zr_arena *arena, size_t unit)
{
    for (size_t i = 1; i <= 12; i++) {
        char *bytes = zr_arena_alloc(arena, i * unit, 1);
        assert_non_null(bytes);
        memset(bytes, 1, i * unit);
        assert_non_null(zr_arena_alloc(arena, 5000, 1));
    }
    return arena->held;
}

TEST(arena_holds_the_same_whatever_was_before)
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 30);
    const size_t held = hold_some(&arena, 700000);
    for (size_t unit = 300000; unit < 1200000; unit += 150000) {
        zr_arena_reset(&arena, SIZE_MAX);
        hold_some(&arena, unit);
        zr_arena_reset(&arena, SIZE_MAX);
        assert_int_equal(hold_some(&arena, 700000), held);
    }
    zr_arena_free(&arena);
}

#if !ZR_ASAN /* whose shadow is resident, too */
static size_t resident_bytes(void)
{
    size_t pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%*s %zu", &pages) != 1) pages = 0;
    fclose(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void use_array(struct zr_arena *arena, size_t bytes)
{
    char *array = zr_arena_alloc(arena, bytes, 1);
    if (array) memset(array, 1, bytes);
}
#endif

TEST(arena_holds_no_more_of_the_system_than_it_counts)
{
#if !ZR_ASAN
    enum { MIB = 1 << 20, SLACK = 4 * MIB };
    struct zr_arena arena;
    const size_t before = resident_bytes();
    zr_arena_init(&arena, (size_t)128 * MIB);
    for (int i = 0; i < 20; i++)
        use_array(&arena, 4 * MIB + 16384);
    assert_true(resident_bytes() <= before + arena.held + SLACK);
    zr_arena_reset(&arena, SIZE_MAX);
    for (int i = 0; i < 20; i++) /* in what was kept, of which the rest goes back */
        use_array(&arena, 3 * MIB);
    assert_true(resident_bytes() <= before + arena.ceiling + SLACK);
    zr_arena_reset(&arena, SIZE_MAX);
    use_array(&arena, (size_t)100 * MIB); /* what was kept makes room */
    assert_true(zr_arena_ok(&arena));
    assert_true(resident_bytes() <= before + arena.ceiling + SLACK);
    zr_arena_free(&arena);
#endif
}

TEST(arena_scratch_makes_room_in_what_a_reset_has_kept)
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)64 << 20);
    assert_non_null(zr_arena_alloc(&arena, 40 << 20, 1));
    zr_arena_reset(&arena, SIZE_MAX);
    struct zr_arena scratch = zr_arena_open_scratch(&arena);
    assert_non_null(zr_arena_alloc(&scratch, 10 << 20, 1));
    assert_true(arena.spare_bytes > 0);
    assert_non_null(zr_arena_alloc(&scratch, 40 << 20, 1));
    assert_int_equal(arena.spare_bytes, 0);
    zr_arena_close_scratch(&scratch, &arena);
    assert_int_equal(arena.held, 0);
    zr_arena_free(&arena);
}

/* Small and large arrays, one of them in a scratch arena. Returns the part's share. */
static struct zr_arena_share work_apart(struct zr_arena *arena, const struct zr_arena_share *shared, bool works)
{
    const struct zr_arena_part part = zr_arena_open_part(arena, 1 << 16);
    for (size_t i = 0; works && i < 10; i++)
        zr_arena_alloc(arena, 1000 * i * i, 1);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    if (works) zr_arena_alloc(&scratch, 3 << 20, 1);
    zr_arena_close_scratch(&scratch, arena);
    return zr_arena_close_part(arena, &part, shared);
}

TEST(arena_part_has_the_same_share_whatever_was_before)
{
    struct zr_arena_share first = {0, 0, 0};
    for (size_t before = 0; before < 6; before++) {
        struct zr_arena worked, shares;
        zr_arena_init(&worked, (size_t)64 << 20);
        zr_arena_init(&shares, (size_t)64 << 20);
        for (size_t i = 0; i < before; i++) {
            zr_arena_alloc(&worked, 700000 * i, 1);
            zr_arena_alloc(&shares, 700000 * i, 1);
        }
        const struct zr_arena_share share = work_apart(&worked, NULL, true);
        if (before == 0) first = share;
        work_apart(&shares, &share, false);
        assert_memory_equal(&share, &first, sizeof share);
        assert_true(share.most > 3 << 20 && share.held < 1 << 20);
        for (int i = 0; i < 3; i++) {
            assert_int_equal(shares.used, worked.used);
            assert_int_equal(shares.held, worked.held);
            zr_arena_alloc(&worked, 900000, 1);
            zr_arena_alloc(&shares, 900000, 1);
        }
        zr_arena_free(&worked);
        zr_arena_free(&shares);
    }
}

/* Also if the arena fails within it. */
TEST(arena_step_gives_its_blocks_to_later_allocations)
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)64 << 20);
    unsigned char *kept = zr_arena_alloc(&arena, 1000, 1);
    memset(kept, 7, 1000);
    const size_t used = arena.used, held = arena.held;
    for (int i = 0; i < 5; i++) {
        const struct zr_arena_step step = zr_arena_open_step(&arena);
        for (int k = 0; k < 3; k++)
            memset(zr_arena_alloc(&arena, 11 << 20, 1), i, 11 << 20);
        const struct zr_arena_step inner = zr_arena_open_step(&arena);
        memset(zr_arena_alloc(&arena, 8 << 20, 1), 9, 8 << 20);
        zr_arena_close_step(&arena, &inner);
        zr_arena_close_step(&arena, &step);
        assert_int_equal(arena.used, used);
        assert_int_equal(arena.held, held);
        assert_true(zr_arena_bytes(&arena) < 48 << 20); /* the blocks of the first round */
        assert_true(arena.most >= 41 << 20 && arena.most < 48 << 20);
    }
    const struct zr_arena_step small = zr_arena_open_step(&arena); /* goes on in the block of `kept` */
    unsigned char *beside = zr_arena_alloc(&arena, 64, 1);
    assert_true(beside > kept && beside < kept + 2000);
    zr_arena_trim(&arena, beside, 64, 0, 1);
    assert_int_equal(arena.used, used);
    zr_arena_trim(&arena, NULL, 64, 0, 1);
    zr_arena_close_step(&arena, &small);
    memset(zr_arena_alloc(&arena, 50 << 20, 1), 1, 50 << 20); /* the spare blocks are not in its way */
    assert_true(kept[0] == 7 && kept[999] == 7);
    const struct zr_arena_step step = zr_arena_open_step(&arena);
    assert_null(zr_arena_alloc(&arena, 20 << 20, 1));
    zr_arena_close_step(&arena, &step);
    assert_false(zr_arena_ok(&arena));
    assert_true(arena.wanted > 70 << 20);
    zr_arena_free(&arena);
}

TEST(arena_part_needs_what_its_share_says)
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)64 << 20);
    const struct zr_arena_share share = work_apart(&arena, NULL, true);
    for (size_t less = 0; less < 2; less++) {
        zr_arena_free(&arena);
        zr_arena_init(&arena, share.most - less);
        work_apart(&arena, NULL, true);
        assert_int_equal(zr_arena_ok(&arena), less == 0);
    }
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
