#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <zlib.h>

#include "output/images/idat.h"
#include "support/random.h"
#include "support/tests.h"

/* ---- addresses ---- */

/* ISA-L's table of matches has up to so many slots at level 1; a smaller one's number of a slot is the lower bits. */
enum { SLOTS = 8192 };

/* Addresses that differ by this are other ones to the fault that idat.h tells of: it hashed address >> 16. */
#define STEP ((size_t)1 << 16)

/* CRC-32C without its complements, as the instruction `crc32` computes it: ISA-L's hash of 4 bytes. */
static uint32_t hash(uint32_t value)
{
    for (int bit = 0; bit < 32; bit++)
        value = value & 1 ? value >> 1 ^ 0x82f63b78u : value >> 1;
    return value;
}

/* Room for a stream at addresses of every slot. */
enum { STEPS = 1 << 17 };
static uint8_t *room;
static struct isal_zstream *by_slot[SLOTS];

static int make_room(void **state)
{
    (void)state;
    room = mmap(NULL, STEPS * STEP, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return 1;
    madvise(room, STEPS * STEP,
            MADV_NOHUGEPAGE); /* few bytes of each step are touched; where it fails it takes longer */
    uint8_t *first = room + (STEP - (uintptr_t)room % STEP) % STEP;
    for (size_t i = 0; i < STEPS - 2; i++) {
        uint8_t *at = first + i * STEP;
        by_slot[hash((uint32_t)((uintptr_t)at >> 16)) % SLOTS] = (struct isal_zstream *)(void *)at;
    }
    for (size_t i = 0; i < SLOTS; i++)
        if (!by_slot[i]) return 1;
    return 0;
}

static int free_room(void **state)
{
    (void)state;
    return munmap(room, STEPS * STEP);
}

/* ---- strips ---- */

enum { LARGEST = 1 << 20, OUT_SIZE = LARGEST + LARGEST / 1000 + 64 };

struct strip {
    size_t size;
    uint8_t bytes[LARGEST + ZR_DEFLATE_TAIL];
};

static struct strip *strip;
static uint8_t table[ZR_DEFLATE_TABLE], out[2][OUT_SIZE], inflated[LARGEST + 1];

static int make_strip(void **state)
{
    (void)state;
    strip = calloc(1, sizeof *strip);
    return strip ? 0 : 1;
}

static int free_strip(void **state)
{
    (void)state;
    free(strip);
    return 0;
}

/* As filtered rows look: mostly zeros and runs, a few edges, and 2 (the filter UP) in front of each row. */
static void fill(struct random *random, size_t size)
{
    size_t row = 1 + random_next(random) % 200;
    uint8_t value = 0;
    strip->size = size;
    memset(strip->bytes, 0, size + ZR_DEFLATE_TAIL);
    for (size_t i = 0; i < size; i++) {
        if (random_next(random) % 9 == 0) value = random_next(random) % 3 ? 0 : (uint8_t)random_next(random);
        strip->bytes[i] = i % row == 0 ? 2 : value;
    }
}

static size_t deflate_at(struct isal_zstream *stream, bool last, uint8_t *to)
{
    size_t size = zr_deflate(stream, table, strip->bytes, strip->size, last, to, OUT_SIZE);
    assert_true(size > 0);
    return size;
}

static void assert_inflates(const uint8_t *bytes, size_t size, bool last)
{
    z_stream z = {.next_in = (unsigned char *)(uintptr_t)bytes,
                  .avail_in = (uInt)size,
                  .next_out = inflated,
                  .avail_out = sizeof inflated};
    assert_int_equal(inflateInit2(&z, -15), Z_OK);
    assert_int_equal(inflate(&z, Z_SYNC_FLUSH), last ? Z_STREAM_END : Z_OK);
    assert_int_equal(z.avail_in, 0);
    assert_int_equal(z.total_out, strip->size);
    assert_memory_equal(inflated, strip->bytes, strip->size);
    inflateEnd(&z);
}

/* The strip with its stream at an ordinary address, and at those whose hash is that of its bytes 0 to 2 with what
 * follows them: where an address has any say, it has it there. */
static void assert_same_wherever(bool last)
{
    static struct isal_zstream ordinary;
    size_t size = deflate_at(&ordinary, last, out[0]);
    assert_inflates(out[0], size, last);
    for (int i = 0; i < 3; i++) {
        uint32_t four;
        memcpy(&four, strip->bytes + i, sizeof four);
        struct isal_zstream *stream = by_slot[hash(four) % SLOTS];
        assert_int_equal(deflate_at(stream, last, out[1]), size);
        if (memcmp(out[0], out[1], size) != 0) fail_msg("%zu bytes: others at %p", strip->size, (void *)stream);
        madvise(stream, 2 * STEP, MADV_DONTNEED);
    }
}

TEST_AROUND(small_strips_are_the_same_wherever_the_stream_lies, make_room, free_room)
{
    struct random random = random_seeded(11);
    for (int i = 0; i < 1200; i++) {
        fill(&random, 1 + random_next(&random) % (i % 4 == 0 ? 60 : 2000));
        assert_same_wherever(i % 2 == 0);
    }
}

TEST_AROUND(large_strips_are_the_same_wherever_the_stream_lies, make_room, free_room)
{
    struct random random = random_seeded(12);
    for (int i = 0; i < 40; i++) {
        fill(&random, 2000 + random_next(&random) % (LARGEST - 2000));
        assert_same_wherever(i % 2 == 0);
    }
}

/* Whatever is left in memory by the strip before. */
TEST(a_table_that_is_full_of_others_changes_nothing)
{
    static struct isal_zstream stream;
    struct random random = random_seeded(13);
    fill(&random, 1000);
    memset(table, 0, sizeof table);
    size_t size = deflate_at(&stream, true, out[0]);
    for (size_t i = 0; i < sizeof table; i++)
        table[i] = (uint8_t)random_next(&random);
    memset(&stream, 0x5a, sizeof stream);
    assert_int_equal(deflate_at(&stream, true, out[1]), size);
    assert_memory_equal(out[0], out[1], size);
}

TEST(what_does_not_fit_gives_zero)
{
    static struct isal_zstream stream;
    struct random random = random_seeded(14);
    strip->size = 3000;
    for (size_t i = 0; i < strip->size; i++)
        strip->bytes[i] = (uint8_t)random_next(&random);
    for (size_t to = 1; to < strip->size; to += 13)
        assert_int_equal(zr_deflate(&stream, table, strip->bytes, strip->size, to % 2 == 0, out[0], to), 0);
}

RUN_TESTS(make_strip, free_strip)
