#include "overlay/type.h"

#include <math.h>
#include <string.h>

#include "base/utf8.h"
#include "overlay/pen.h"

/* Units of letters. */
#define GAP        2.4
#define WIDTH_MOST 2e5 /* wider texts fit no window */

double zr_type_height(int32_t width, int32_t height)
{
    const double root = sqrt(zr_lesser(width, height) / 480.0);
    const double pixels = floor(11 * root * sqrt(root) + 0.5);
    return pixels > ZR_TYPE_LEAST ? pixels : ZR_TYPE_LEAST;
}

double zr_type_pen(double height)
{
    return 0.12 * height > 1 ? 0.12 * height : 1;
}

uint32_t zr_type_character(const char **text)
{
    enum { INVALID = 0xFFFD, LONGEST = 4 };
    const uint8_t *at = (const uint8_t *)*text;
    const size_t length = zr_utf8_length(*text, *text + strnlen(*text, LONGEST));
    *text += length > 0 ? length : 1;
    if (length == 0) return INVALID;
    uint32_t character = length == 1 ? at[0] : at[0] & (0x7Fu >> length);
    for (size_t i = 1; i < length; i++)
        character = character << 6 | (at[i] & 0x3Fu);
    return character;
}

double zr_type_width(const char *text, double height)
{
    double units = 0;
    while (*text && units < WIDTH_MOST) {
        units += zr_letter_width(zr_letter_find(zr_type_character(&text)));
        if (*text) units += GAP;
    }
    return units / ZR_LETTER_CAPITAL * height;
}

bool zr_type_has_all(const char *text)
{
    while (*text)
        if (!zr_letter_is_known(zr_letter_find(zr_type_character(&text)))) return false;
    return true;
}

bool zr_type_next(struct zr_type_walk *walk, struct zr_letter_path *out)
{
    struct zr_type_place *place = &walk->place;
    if (!*walk->text) return false;
    const struct zr_letter letter = zr_letter_find(zr_type_character(&walk->text));
    const double unit = place->height / ZR_LETTER_CAPITAL, step = (zr_letter_width(letter) + GAP) * unit;
    zr_letter_trace(letter, out);
    for (uint32_t i = 0; out->count > 0 && i < out->ends[out->count - 1]; i++) {
        struct zr_point *p = &out->points[i];
        const double along = unit * p->x, up = unit * p->y;
        *p = (struct zr_point){place->x + along * place->dx + up * place->dy,
                               place->y + along * place->dy - up * place->dx};
    }
    place->x += step * place->dx;
    place->y += step * place->dy;
    return true;
}

void zr_type_draw(const struct zr_canvas *canvas, const char *text, struct zr_type_place place, double pen,
                  uint32_t color)
{
    struct zr_type_walk walk = {text, place};
    struct zr_letter_path letter;
    while (zr_type_next(&walk, &letter))
        zr_pen_draw(canvas, &(struct zr_path){letter.count, letter.ends, letter.points}, pen, color);
}
