/* Colours by their names in CSS. */
#include "input/color_names.h"

#include <string.h>

#include "support/cmocka_all.h"

static uint32_t rgb_of(const char *name)
{
    uint32_t rgb = UINT32_MAX;
    if (!zr_color_of_name(name, strlen(name), &rgb)) fail_msg("%s is not found", name);
    return rgb;
}

static void every_name_of_css_is_found_in_any_case(void **state)
{
    (void)state;
    static const char *const names[] = {"aliceblue",
                                        "antiquewhite",
                                        "aqua",
                                        "aquamarine",
                                        "azure",
                                        "beige",
                                        "bisque",
                                        "black",
                                        "blanchedalmond",
                                        "blue",
                                        "blueviolet",
                                        "brown",
                                        "burlywood",
                                        "cadetblue",
                                        "chartreuse",
                                        "chocolate",
                                        "coral",
                                        "cornflowerblue",
                                        "cornsilk",
                                        "crimson",
                                        "cyan",
                                        "darkblue",
                                        "darkcyan",
                                        "darkgoldenrod",
                                        "darkgray",
                                        "darkgreen",
                                        "darkgrey",
                                        "darkkhaki",
                                        "darkmagenta",
                                        "darkolivegreen",
                                        "darkorange",
                                        "darkorchid",
                                        "darkred",
                                        "darksalmon",
                                        "darkseagreen",
                                        "darkslateblue",
                                        "darkslategray",
                                        "darkslategrey",
                                        "darkturquoise",
                                        "darkviolet",
                                        "deeppink",
                                        "deepskyblue",
                                        "dimgray",
                                        "dimgrey",
                                        "dodgerblue",
                                        "firebrick",
                                        "floralwhite",
                                        "forestgreen",
                                        "fuchsia",
                                        "gainsboro",
                                        "ghostwhite",
                                        "gold",
                                        "goldenrod",
                                        "gray",
                                        "green",
                                        "greenyellow",
                                        "grey",
                                        "honeydew",
                                        "hotpink",
                                        "indianred",
                                        "indigo",
                                        "ivory",
                                        "khaki",
                                        "lavender",
                                        "lavenderblush",
                                        "lawngreen",
                                        "lemonchiffon",
                                        "lightblue",
                                        "lightcoral",
                                        "lightcyan",
                                        "lightgoldenrodyellow",
                                        "lightgray",
                                        "lightgreen",
                                        "lightgrey",
                                        "lightpink",
                                        "lightsalmon",
                                        "lightseagreen",
                                        "lightskyblue",
                                        "lightslategray",
                                        "lightslategrey",
                                        "lightsteelblue",
                                        "lightyellow",
                                        "lime",
                                        "limegreen",
                                        "linen",
                                        "magenta",
                                        "maroon",
                                        "mediumaquamarine",
                                        "mediumblue",
                                        "mediumorchid",
                                        "mediumpurple",
                                        "mediumseagreen",
                                        "mediumslateblue",
                                        "mediumspringgreen",
                                        "mediumturquoise",
                                        "mediumvioletred",
                                        "midnightblue",
                                        "mintcream",
                                        "mistyrose",
                                        "moccasin",
                                        "navajowhite",
                                        "navy",
                                        "oldlace",
                                        "olive",
                                        "olivedrab",
                                        "orange",
                                        "orangered",
                                        "orchid",
                                        "palegoldenrod",
                                        "palegreen",
                                        "paleturquoise",
                                        "palevioletred",
                                        "papayawhip",
                                        "peachpuff",
                                        "peru",
                                        "pink",
                                        "plum",
                                        "powderblue",
                                        "purple",
                                        "rebeccapurple",
                                        "red",
                                        "rosybrown",
                                        "royalblue",
                                        "saddlebrown",
                                        "salmon",
                                        "sandybrown",
                                        "seagreen",
                                        "seashell",
                                        "sienna",
                                        "silver",
                                        "skyblue",
                                        "slateblue",
                                        "slategray",
                                        "slategrey",
                                        "snow",
                                        "springgreen",
                                        "steelblue",
                                        "tan",
                                        "teal",
                                        "thistle",
                                        "tomato",
                                        "turquoise",
                                        "violet",
                                        "wheat",
                                        "white",
                                        "whitesmoke",
                                        "yellow",
                                        "yellowgreen"};
    assert_int_equal(sizeof names / sizeof names[0], 148);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char capital[ZR_COLOR_NAME_MAX + 1] = "";
        for (size_t k = 0; names[i][k]; k++)
            capital[k] = (char)(names[i][k] + ('A' - 'a'));
        assert_true(rgb_of(names[i]) <= 0xFFFFFF);
        assert_int_equal(rgb_of(capital), rgb_of(names[i]));
    }
}

/* Where CSS and X11 differ, it is CSS. */
static void names_have_the_values_of_css(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        uint32_t rgb;
    } cases[] = {{"gray", 0x808080},   {"grey", 0x808080},          {"green", 0x008000},  {"maroon", 0x800000},
                 {"purple", 0x800080}, {"rebeccapurple", 0x663399}, {"tomato", 0xFF6347}, {"black", 0},
                 {"white", 0xFFFFFF},  {"cyan", 0x00FFFF},          {"aqua", 0x00FFFF},   {"darkslategrey", 0x2F4F4F}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        assert_int_equal(rgb_of(cases[i].name), cases[i].rgb);
}

static void other_words_are_none(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_name_of_css_is_found_in_any_case),
        cmocka_unit_test(names_have_the_values_of_css),
        cmocka_unit_test(other_words_are_none),
    };
    return cmocka_run_group_tests_name("color names", tests, NULL, NULL);
}
