/* Lists that several threads read in the smallest parts: of any text the same scene and the same complaints as of one
 * thread. */
#define ZR_JSON_PART_BYTES 48
#include "input/json/json_list.c"

#include "support/sanitized.h"
#include "support/tests.h"
#include "unit/common/by_teams.h"
#include "unit/common/json_texts.h"
#include "unit/common/mutate.h"

/* TEXTS=40000 in the environment takes a minute; sanitizers take ten and a hundred times as long. */
enum { TEXTS = IS_THREAD_SANITIZED ? 400 : IS_SANITIZED ? 2000 : 8000 };

TEST(any_text_is_read_alike_by_one_thread_and_by_several)
{
    const char *wanted = getenv("TEXTS");
    const int texts = wanted ? atoi(wanted) : TEXTS;
    int good = 0, faulty = 0;
    for (int i = 0; i < texts; i++) {
        struct text text = make_scene(1 + below(6));
        if (i % 2) {
            struct text other = respell(text.bytes, (enum spelling)(i / 2 % SPELLINGS));
            drop(&text);
            text = other;
        }
        if (i % 5) mutate(&text);
        struct reading *alone = read_by(NULL, ZR_FORMAT_JSON, &text),
                       *shared = read_by(teams[1], ZR_FORMAT_JSON, &text);
        assert_same_reading(alone, shared);
        good += alone->status == ZR_OK;
        faulty += alone->status != ZR_OK;
        reading_free(alone);
        reading_free(shared);
        drop(&text);
    }
    print_message("%d good, %d faulty\n", good, faulty);
    assert_true(good > texts / 8 && faulty > texts / 8);
}

RUN_TESTS(start_teams, end_teams)
