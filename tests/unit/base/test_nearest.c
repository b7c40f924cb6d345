/* Which word was probably meant. */
#include "input/text/nearest.h"
#include "support/tests.h"

static const char *const words[] = {"near",  "far",  "color", "baseColorFactor",
                                    "znear", "zfar", "x",     "elevationDegrees"};

static const char *meant_by(const char *word)
{
    struct zr_nearest nearest = {.word = word};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        zr_nearest_offer(&nearest, words[i]);
    return nearest.known ? nearest.known : "";
}

TEST(slips_of_the_finger_and_other_spellings_are_known)
{
    static const char *const cases[][2] = {{"colour", "color"},
                                           {"colro", "color"},
                                           {"base_color_factor", "baseColorFactor"},
                                           {"BaseColourFactor", "baseColorFactor"},
                                           {"elevation-degrees", "elevationDegrees"},
                                           {"zNear", "znear"},
                                           {"nera", "near"},
                                           {"elevatonDegres", "elevationDegrees"},
                                           {"elevation", "elevationDegrees"},
                                           {"base", "baseColorFactor"},
                                           {"col", "color"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(meant_by(cases[i][0]), cases[i][1]);
}

TEST(words_that_are_far_from_all_mean_none)
{
    static const char *const others[] = {
        "", "_", "y", "el", "light", "ear drum", "zz", "doubleSided", "aWordThatIsLongerThanAllWordsThatAnyTableHas"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_string_equal(meant_by(others[i]), "");
    struct zr_nearest nearest = {.word = "light"};
    assert_string_equal(zr_nearest_text(&nearest).text, "");
    zr_nearest_offer(&nearest, "lights");
    assert_string_equal(zr_nearest_text(&nearest).text, " (did you mean lights?)");
}

RUN_TESTS(NULL, NULL)
