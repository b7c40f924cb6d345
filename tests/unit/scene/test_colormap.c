/* Maps of colours against what their authors define. */
#include "scene/colormap.h"
#include "support/tests.h"

#include <math.h>

/* Of 255: rounding, and what is linear between knots and is a curve in the definition. */
#define NEAR 0.8

static void assert_color(enum zr_colormap map, double at, const double want[3])
{
    const zr_vec4 color = zr_colormap_color(map, (float)at);
    const double got[3] = {(double)color.x, (double)color.y, (double)color.z};
    for (int c = 0; c < 3; c++)
        if (!(fabs(255 * (got[c] - want[c])) <= NEAR))
            fail_msg("map %d at %.4f, channel %d: %.2f, not %.2f of 255", (int)map, at, c, 255 * got[c], 255 * want[c]);
    assert_true(color.w == 1.0f);
}

enum { PUBLISHED = 18, PUBLISHED_STEP = 15, PUBLISHED_LAST = 255 };

/* Each fifteenth of 256 colours. Source: matplotlib 3.6.3, _cm_listed.py, rounded to four digits. */
TEST(maps_of_lists_have_what_is_published)
{
    static const double viridis[PUBLISHED][3] = {
        {0.2670, 0.0049, 0.3294}, {0.2819, 0.0897, 0.4124}, {0.2803, 0.1657, 0.4765}, {0.2637, 0.2376, 0.5188},
        {0.2374, 0.3052, 0.5419}, {0.2086, 0.3678, 0.5527}, {0.1823, 0.4262, 0.5571}, {0.1592, 0.4822, 0.5581},
        {0.1378, 0.5375, 0.5549}, {0.1211, 0.5927, 0.5446}, {0.1281, 0.6477, 0.5235}, {0.1807, 0.7014, 0.4882},
        {0.2741, 0.7520, 0.4366}, {0.3952, 0.7975, 0.3678}, {0.5356, 0.8358, 0.2819}, {0.6889, 0.8654, 0.1827},
        {0.8456, 0.8873, 0.0997}, {0.9932, 0.9062, 0.1439}};
    static const double turbo[PUBLISHED][3] = {
        {0.1900, 0.0718, 0.2322}, {0.2483, 0.2414, 0.6129}, {0.2751, 0.4007, 0.8669}, {0.2688, 0.5500, 0.9930},
        {0.1862, 0.6977, 0.9550}, {0.1003, 0.8296, 0.8139}, {0.1353, 0.9220, 0.6656}, {0.3201, 0.9797, 0.4765},
        {0.5466, 0.9991, 0.2958}, {0.7158, 0.9688, 0.2082}, {0.8587, 0.8865, 0.2123}, {0.9605, 0.7718, 0.2281},
        {0.9965, 0.6319, 0.1874}, {0.9755, 0.4574, 0.1130}, {0.9102, 0.2960, 0.0481}, {0.8080, 0.1775, 0.0166},
        {0.6645, 0.0844, 0.0042}, {0.4796, 0.0158, 0.0106}};
    for (int i = 0; i < PUBLISHED; i++) {
        const double at = (double)(i * PUBLISHED_STEP) / PUBLISHED_LAST;
        assert_color(ZR_COLORMAP_VIRIDIS, at, viridis[i]);
        assert_color(ZR_COLORMAP_TURBO, at, turbo[i]);
    }
}

TEST(gray_is_linear)
{
    for (int i = 0; i <= 1000; i++) {
        const zr_vec4 color = zr_colormap_color(ZR_COLORMAP_GRAY, (float)i / 1000.0f);
        assert_true(color.x == color.y && color.y == color.z);
        assert_true(fabsf(color.x - (float)i / 1000.0f) < 1e-7f);
    }
}

RUN_TESTS(NULL, NULL)
