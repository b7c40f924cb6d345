#include "overlay/glyphs.h"

enum { COLUMNS = 5, PITCH = COLUMNS + 1, A_LINE = 16, FIRST = 32, ASCII = 95, NONE = ASCII, SPACE_WIDTH = 3 };

/* Sixteen glyphs per group, each five columns wide and nine rows high, from the top of capitals to the bottom of g. */
/* clang-format off */
static const char *const sheet[] = {
    /* ! " # $ % & ' ( ) * + , - . / */
    "        #    # #   # #    #   ##     ##     #      #   #                                      #",
    "        #    # #   # #   #### ##  # #  #    #     #     #     #     #                         #",
    "        #    # #  ##### # #      #  # #     #    #       #  # # #   #                        # ",
    "        #          # #   ###    #    #           #       #   ###  #####       #####         #  ",
    "        #         #####   # #  #    # # #        #       #  # # #   #                      #   ",
    "                   # #  ####  #  ## #  #          #     #     #     #                     #    ",
    "        #          # #    #      ##  ## #          #   #                  #           #   #    ",
    "                                                                          #                    ",
    "                                                                         #                     ",
    /* 0 1 2 3 4 5 6 7 8 9 : ; < = > ? */
    " ###    #    ###   ###     #  #####   ##  #####  ###   ###                 #         #     ### ",
    "#   #  ##   #   # #   #   ##  #      #        # #   # #   #               #           #   #   #",
    "#   # # #       #     #  # #  ####  #        #  #   # #   #   #     #    #    #####    #      #",
    "#   #   #      #    ##  #  #      # ####     #   ###   ####             #               #    # ",
    "#   #   #     #       # #####     # #   #   #   #   #     #              #    #####    #    #  ",
    "#   #   #    #    #   #    #  #   # #   #   #   #   #    #                #           #        ",
    " ###  ##### #####  ###     #   ###   ###    #    ###   ##     #     #      #         #      #  ",
    "                                                                    #                          ",
    "                                                                   #                           ",
    /* @ A B C D E F G H I J K L M N O */
    " ###   ###  ####   ###  ####  ##### #####  ###  #   #  ###     ## #   # #     #   # #   #  ### ",
    "#   # #   # #   # #   # #   # #     #     #   # #   #   #       # #  #  #     ## ## ##  # #   #",
    "# ### #   # #   # #     #   # #     #     #     #   #   #       # # #   #     # # # ##  # #   #",
    "# # # ##### ####  #     #   # ####  ####  # ### #####   #       # ##    #     # # # # # # #   #",
    "# ### #   # #   # #     #   # #     #     #   # #   #   #       # # #   #     #   # #  ## #   #",
    "#     #   # #   # #   # #   # #     #     #   # #   #   #   #   # #  #  #     #   # #  ## #   #",
    " #### #   # ####   ###  ####  ##### #      ###  #   #  ###   ###  #   # ##### #   # #   #  ### ",
    "                                                                                               ",
    "                                                                                               ",
    /* P Q R S T U V W X Y Z [ \ ] ^ _ */
    "####   ###  ####   ###  ##### #   # #   # #   # #   # #   # #####  ###  #      ###    #        ",
    "#   # #   # #   # #   #   #   #   # #   # #   # #   # #   #     #  #    #        #   # #       ",
    "#   # #   # #   # #       #   #   # #   # #   #  # #   # #     #   #     #       #  #   #      ",
    "####  #   # ####   ###    #   #   #  # #  # # #   #     #     #    #      #      #             ",
    "#     # # # # #       #   #   #   #  # #  # # #  # #    #    #     #       #     #             ",
    "#     #  #  #  #  #   #   #   #   #  # #  # # # #   #   #   #      #        #    #             ",
    "#      ## # #   #  ###    #    ###    #    # #  #   #   #   #####  ###      #  ###             ",
    "                                                                                               ",
    "                                                                                          #####",
    /* ` a b c d e f g h i j k l m n o */
    " #          #               #         ##        #       #      #   #     ##                    ",
    "  #         #               #        #  #       #                  #      #                    ",
    "       ###  # ##   ###   ## #  ###   #     #### # ##   ##     ##   #  #   #   ## #  # ##   ### ",
    "          # ##  # #     #  ## #   # ###   #   # ##  #   #      #   # #    #   # # # ##  # #   #",
    "       #### #   # #     #   # #####  #    #   # #   #   #      #   ##     #   # # # #   # #   #",
    "      #   # ##  # #   # #  ## #      #    #   # #   #   #      #   # #    #   # # # #   # #   #",
    "       #### # ##   ###   ## #  ###   #     #### #   #  ###     #   #  #  ###  #   # #   #  ### ",
    "                                              #                #                               ",
    "                                           ###              ###                                ",
    /* p q r s t u v w x y z { | } ~ (none) */
    "                         #                                           ##   #   ##          #####",
    "                         #                                          #     #     #         #   #",
    "# ##   ## # # ##   #### ###   #   # #   # #   # #   # #   # #####   #     #     #    #    #   #",
    "##  # #  ## ##  # #      #    #   # #   # #   #  # #  #   #    #   #      #      #  # # # #   #",
    "#   # #   # #      ###   #    #   # #   # # # #   #   #   #   #     #     #     #      #  #   #",
    "##  # #  ## #         #  #  # #  ##  # #  # # #  # #  #   #  #      #     #     #         #   #",
    "# ##   ## # #     ####    ##   ## #   #    # #  #   #  #### #####    ##   #   ##          #####",
    "#         #                                               #               #                    ",
    "#         #                                            ###                #                    ",
    /* U+00B0 U+00B1 U+00B9 U+00B2 U+00B3 U+207B U+00B5 U+00B7
     * U+00D7 U+2212 U+0394 U+03A9 U+00C5 U+03BB U+03C1 U+03C3 */
    " ##     #    #    ##    ###                                        ###    #   #                ",
    "#  #    #   ##      #    ##                                   #   #   #  # #   #               ",
    "#  #  #####  #     #      #   ###   #   #       #   #         #   #   #   #    #     ###   ####",
    " ##     #   ###   ###   ##          #   #   #    # #  #####  # #  #   #  ###    #   #   # #  # ",
    "        #                           #   #         #          # #   # #  #   #  # #  #   # #   #",
    "                                    ##  #        # #        #   #  # #  ##### #   # ##  # #   #",
    "      #####                         # ##        #   #       ##### ## ## #   # #   # # ##   ### ",
    "                                    #                                               #          ",
    "                                    #                                               #          "};
/* clang-format on */

/* Characters of the last group, in its order. */
static const uint32_t others[A_LINE] = {0x00B0, 0x00B1, 0x00B9, 0x00B2, 0x00B3, 0x207B, 0x00B5, 0x00B7,
                                        0x00D7, 0x2212, 0x0394, 0x03A9, 0x00C5, 0x03BB, 0x03C1, 0x03C3};

/* These look the same; keyboards have one or the other. */
enum { MICRO = 0x00B5, GREEK_MU = 0x03BC };

static int glyph_of(uint32_t character)
{
    if (character >= FIRST && character < FIRST + ASCII) return (int)(character - FIRST);
    if (character == GREEK_MU) character = MICRO;
    for (int i = 0; i < A_LINE; i++)
        if (others[i] == character) return NONE + 1 + i;
    return NONE;
}

static bool has_dot(int glyph, int column, int row)
{
    return sheet[glyph / A_LINE * ZR_GLYPH_ROWS + row][glyph % A_LINE * PITCH + column] == '#';
}

static bool is_empty(int glyph, int column)
{
    for (int row = 0; row < ZR_GLYPH_ROWS; row++)
        if (has_dot(glyph, column, row)) return false;
    return true;
}

/* Columns begin .. end - 1. */
struct span {
    int begin, end;
};

/* Returns the columns that a character uses. All digits are as wide as 0, so that numbers align. */
static struct span span_of(uint32_t character)
{
    const int glyph = glyph_of(character);
    struct span span = {0, COLUMNS};
    if (character >= '0' && character <= '9') return span;
    while (span.begin < span.end && is_empty(glyph, span.begin))
        span.begin++;
    while (span.end > span.begin && is_empty(glyph, span.end - 1))
        span.end--;
    return span.begin < span.end ? span : (struct span){0, SPACE_WIDTH};
}

/* Returns the next UTF-8 character and advances *text. An invalid byte counts as a character without a glyph. */
static uint32_t next_character(const char **text)
{
    const uint8_t *at = (const uint8_t *)*text;
    const int more = at[0] >= 0xF0 ? 3 : at[0] >= 0xE0 ? 2 : at[0] >= 0xC0 ? 1 : 0;
    uint32_t character = more == 0 ? at[0] : at[0] & (0x3Fu >> more);
    int i = 1;
    for (; i <= more && (at[i] & 0xC0) == 0x80; i++)
        character = character << 6 | (at[i] & 0x3Fu);
    *text += i;
    return character;
}

int32_t zr_glyphs_width(const char *text)
{
    enum { LONGEST = 1 << 20 }; /* longer texts fit no window */
    int32_t width = 0;
    while (*text && width < LONGEST) {
        const struct span span = span_of(next_character(&text));
        width += span.end - span.begin + (*text != '\0');
    }
    return width;
}

bool zr_glyphs_has_all(const char *text)
{
    while (*text)
        if (glyph_of(next_character(&text)) == NONE) return false;
    return true;
}

/* A text's colour and size, and the upper left corner of the next glyph. */
struct drawing {
    const struct zr_canvas *canvas;
    int32_t x, y, scale, grow;
    uint32_t color;
};

static void fill(const struct drawing *d, int32_t x, int32_t y, int32_t width, int32_t height)
{
    zr_canvas_fill(d->canvas, zr_box_grow((struct zr_box){d->x + x, d->y + y, width, height}, d->grow), d->color);
}

/* Draws each run of adjacent dots as one box. */
static void draw_dots(const struct drawing *d, int glyph, int row, struct span span)
{
    for (int begin = span.begin, end; begin < span.end; begin = end + 1) {
        for (end = begin; end < span.end && has_dot(glyph, end, row); end++)
            ;
        if (end > begin) fill(d, (begin - span.begin) * d->scale, row * d->scale, (end - begin) * d->scale, d->scale);
    }
}

/* Draws a staircase triangle with legs of half a dot at the corner (x, y), to its right or left and below or above. */
static void draw_corner(const struct drawing *d, int32_t x, int32_t y, bool right, bool down)
{
    const int32_t legs = (d->scale + 1) / 2;
    for (int32_t i = 0; i < legs; i++)
        fill(d, right ? x : x - (legs - i), down ? y + i : y - 1 - i, legs - i, 1);
}

/* If two dots touch at a corner only, draws a triangle in both empty squares beside that corner, so that steps become
 * slopes. Source: the character rounding of the SAA5050, a circuit for teletext (Mullard, 1977). */
static void draw_slopes(const struct drawing *d, int glyph, int row, struct span span)
{
    for (int column = span.begin; column + 1 < span.end; column++) {
        const bool a = has_dot(glyph, column, row), b = has_dot(glyph, column + 1, row);
        const bool below_a = has_dot(glyph, column, row + 1), below_b = has_dot(glyph, column + 1, row + 1);
        const int32_t x = (column + 1 - span.begin) * d->scale, y = (row + 1) * d->scale;
        if (a == b || a != below_b || b != below_a) continue;
        draw_corner(d, x, y, a, false);
        draw_corner(d, x, y, b, true);
    }
}

void zr_glyphs_draw(const struct zr_canvas *canvas, const char *text, int32_t x, int32_t y, int32_t scale, int32_t grow,
                    uint32_t color)
{
    struct drawing d = {canvas, x, y, scale, grow, color};
    while (*text) {
        const uint32_t character = next_character(&text);
        const struct span span = span_of(character);
        const int glyph = glyph_of(character);
        for (int row = 0; row < ZR_GLYPH_ROWS; row++) {
            draw_dots(&d, glyph, row, span);
            if (scale > 1 && row + 1 < ZR_GLYPH_ROWS) draw_slopes(&d, glyph, row, span);
        }
        d.x += (span.end - span.begin + 1) * scale;
    }
}
