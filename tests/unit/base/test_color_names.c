/* Colours by their names in CSS, which tests/unit/base/color_names.txt lists. */
#include "input/text/color_text.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "support/tests.h"

TEST(every_name_of_css_is_found_in_any_case)
{
    FILE *file = fopen("tests/unit/base/color_names.txt", "r");
    char name[64];
    unsigned want, count = 0;
    assert_non_null(file);
    for (; fscanf(file, "%63s %x", name, &want) == 2; count++)
        for (int capital = 0; capital < 2; capital++) {
            uint32_t rgb = UINT32_MAX;
            for (size_t i = 0; name[i]; i++)
                name[i] = (char)(capital ? toupper(name[i]) : name[i]);
            if (!zr_color_of_name(name, strlen(name), &rgb) || rgb != want) fail_msg("%s: %06x", name, rgb);
        }
    fclose(file);
    assert_int_equal(count, 148);
}

TEST(other_words_are_none)
{
    static const char *const words[] = {"",
                                        "re",
                                        "redd",
                                        " red",
                                        "red ",
                                        "transparent",
                                        "currentcolor",
                                        "zzz",
                                        "lightgoldenrodyellows",
                                        "a name of more than twenty letters"};
    uint32_t rgb;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        assert_false(zr_color_of_name(words[i], strlen(words[i]), &rgb));
}

TEST(transparent_is_a_colour_with_alpha_0)
{
    zr_vec4 color = {1, 1, 1, 1};
    assert_true(zr_color_of_text("Transparent", strlen("Transparent"), &color));
    assert_true(color.x == 0.0f && color.w == 0.0f);
    assert_false(zr_color_of_text("transparen", strlen("transparen"), &color));
}

RUN_TESTS(NULL, NULL)
