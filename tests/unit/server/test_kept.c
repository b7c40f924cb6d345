/* server/keep/kept.c: the table of values that are kept between requests. */
#include "keep/kept.h"
#include "support/tests.h"

#include <stdlib.h>

static struct kept *looked_at;

static void look_and_free(struct kept_value *value)
{
    assert_int_equal(kept_look(looked_at).count, 0);
    free(value);
}

static void add_value(struct kept *kept, unsigned char number)
{
    struct kept_value *value = calloc(1, sizeof *value);
    assert_non_null(value);
    value->bytes = 4096;
    value->hash.bytes[0] = number;
    assert_true(kept_add(kept, value, NULL));
}

/* Large values take a while to be freed, for which no other request waits. With the lock held, this test never ends. */
TEST(values_are_freed_without_the_lock)
{
    static const struct kept_kind kind = {.free = look_and_free};
    struct kept *kept = looked_at = kept_open(&kind, 4096);
    assert_non_null(kept);
    add_value(kept, 1);
    assert_true(kept_drop(kept));
    kept_close(kept);
}

RUN_TESTS(NULL, NULL)
