#include "input/stl/stl_file.h"

#include <string.h>

enum { HEADER_BYTES = 80, MARKED = 1 << 15, BITS = 5, MOST = (1 << BITS) - 1 };

/* Finds the colour of the part. Ignores its alpha, since the values that exporters write are arbitrary. */
static bool find_part_color(const char *header, zr_vec4 *color)
{
    static const char word[] = "COLOR=";
    enum { LENGTH = sizeof word - 1, RGBA_BYTES = 4 };
    for (int i = 0; i + LENGTH + RGBA_BYTES <= HEADER_BYTES; i++) {
        const unsigned char *rgb = (const unsigned char *)header + i + LENGTH;
        if (memcmp(header + i, word, LENGTH) != 0) continue;
        *color = (zr_vec4){(float)rgb[0] / 255.0f, (float)rgb[1] / 255.0f, (float)rgb[2] / 255.0f, 1};
        return true;
    }
    return false;
}

/* Attributes of VisCAM have bit 15 or are 0. If all are white, they are more likely a filler than colours. */
struct zr_stl_colors zr_stl_colors_of(const char *header, const struct zr_stl_attributes *bits)
{
    struct zr_stl_colors colors = {ZR_STL_PLAIN, {1, 1, 1, 1}};
    if (!find_part_color(header, &colors.part)) {
        if (bits->unmarked == 0 && bits->colored != 0) colors.dialect = ZR_STL_VISCAM;
        return colors;
    }
    if (bits->any == 0 || (bits->all & MARKED && bits->any == bits->all))
        colors.dialect = ZR_STL_PART;
    else
        colors.dialect = bits->all & MARKED ? ZR_STL_MESHLAB : ZR_STL_MAGICS;
    return colors;
}

zr_vec4 zr_stl_facet_color(const struct zr_stl_colors *colors, uint16_t attribute)
{
    const bool is_marked = attribute & MARKED, is_viscam = colors->dialect == ZR_STL_VISCAM;
    if (colors->dialect == ZR_STL_PART || (colors->dialect != ZR_STL_MESHLAB && is_marked != is_viscam))
        return colors->part;
    const float low = (float)(attribute & MOST) / MOST, middle = (float)(attribute >> BITS & MOST) / MOST,
                high = (float)(attribute >> 2 * BITS & MOST) / MOST;
    return is_viscam ? (zr_vec4){high, middle, low, 1} : (zr_vec4){low, middle, high, 1};
}
