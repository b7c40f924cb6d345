/* Texts of strangers, without what would command a terminal. */
#include <string.h>

#include "base/visible.h"
#include "support/tests.h"

TEST(bytes_that_show_nothing_become_question_marks_and_all_others_stay)
{
    static const struct {
        const char *from, *to;
    } CASES[] = {
        {"part one.stl", "part one.stl"},
        {"\x1b[2J\a\r\x7f", "?[2J???"},
        {"a\tb", "a?b"},
        {"\xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80", "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80"},
        {"\xc2\x9b"
         "31m",
         "??31m"}, /* a C1 control: CSI */
        {"\xe2\x80\xae"
         "fdp",
         "???fdp"},                               /* turns the direction of text */
        {"\xef\xbb\xbf\xe2\x80\xa8.", "??????."}, /* a mark, and a line's end */
        {"\x80\xc3", "??"},
        {"", ""},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        char text[64];
        strcpy(text, CASES[i].from);
        zr_make_visible(text, false);
        assert_string_equal(text, CASES[i].to);
    }
}

TEST(line_ends_stay_where_there_are_lines)
{
    char lines[] = "a\n\x1b"
                   "b\n";
    zr_make_visible(lines, true);
    assert_string_equal(lines, "a\n?b\n");
}

RUN_TESTS(NULL, NULL)
