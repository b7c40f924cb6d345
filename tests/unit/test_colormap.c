/* Maps of colours against what their authors define. */
#include "scene/colormap.h"
#include "support/cmocka_all.h"

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
static void maps_of_lists_have_what_is_published(void **state)
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
    (void)state;
    for (int i = 0; i < PUBLISHED; i++) {
        const double at = (double)(i * PUBLISHED_STEP) / PUBLISHED_LAST;
        assert_color(ZR_COLORMAP_VIRIDIS, at, viridis[i]);
        assert_color(ZR_COLORMAP_TURBO, at, turbo[i]);
    }
}

/* ---- coolwarm, by the formulas of the paper ---- */

struct msh {
    double m, s, h; /* CIELAB in polar coordinates: length, angle from the axis of lightness, hue */
};

static double decode(double c)
{
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double encode(double c)
{
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

static const double WHITE[3] = {0.95047, 1.0, 1.08883}; /* D65 */

static struct msh msh_of(const double rgb[3])
{
    const double r = decode(rgb[0]), g = decode(rgb[1]), b = decode(rgb[2]);
    const double xyz[3] = {0.4124564 * r + 0.3575761 * g + 0.1804375 * b, 0.2126729 * r + 0.7151522 * g + 0.0721750 * b,
                           0.0193339 * r + 0.1191920 * g + 0.9503041 * b};
    double f[3];
    for (int i = 0; i < 3; i++)
        f[i] = xyz[i] / WHITE[i] > 0.008856 ? cbrt(xyz[i] / WHITE[i]) : 7.787 * xyz[i] / WHITE[i] + 16.0 / 116;
    const double l = 116 * f[1] - 16, a = 500 * (f[0] - f[1]), bb = 200 * (f[1] - f[2]),
                 m = sqrt(l * l + a * a + bb * bb);
    return (struct msh){m, acos(l / m), atan2(bb, a)};
}

static void rgb_of(struct msh msh, double rgb[3])
{
    const double l = msh.m * cos(msh.s), a = msh.m * sin(msh.s) * cos(msh.h), b = msh.m * sin(msh.s) * sin(msh.h);
    const double fy = (l + 16) / 116, f[3] = {fy + a / 500, fy, fy - b / 200};
    double xyz[3];
    for (int i = 0; i < 3; i++)
        xyz[i] = WHITE[i] * (f[i] > 0.206893 ? f[i] * f[i] * f[i] : (f[i] - 16.0 / 116) / 7.787);
    rgb[0] = encode(3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2]);
    rgb[1] = encode(-0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2]);
    rgb[2] = encode(0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2]);
}

/* The hue that white is left with, so that what lies between changes evenly. */
static double spun(struct msh color, double white)
{
    const double spin = color.s * sqrt(white * white - color.m * color.m) / (color.m * sin(color.s));
    return color.h > -acos(-1.0) / 3 ? color.h + spin : color.h - spin;
}

static void maps_between_two_hues_are_those_of_their_formulas(void **state)
{
    static const double ends[2][3] = {{59 / 255.0, 76 / 255.0, 192 / 255.0}, {180 / 255.0, 4 / 255.0, 38 / 255.0}};
    enum { STEPS = 1000 };
    (void)state;
    for (int i = 0; i <= STEPS; i++) {
        const double at = (double)i / STEPS, share = at < 0.5 ? 1 - 2 * at : 2 * at - 1; /* of the end's colour */
        const struct msh end = msh_of(ends[at >= 0.5]), white = {fmax(88, end.m), 0, spun(end, 88)};
        double want[3];
        rgb_of((struct msh){white.m + share * (end.m - white.m), share * end.s, white.h + share * (end.h - white.h)},
               want);
        assert_color(ZR_COLORMAP_COOLWARM, at, want);
    }
}

static void gray_is_linear(void **state)
{
    (void)state;
    for (int i = 0; i <= 1000; i++) {
        const zr_vec4 color = zr_colormap_color(ZR_COLORMAP_GRAY, (float)i / 1000.0f);
        assert_true(color.x == color.y && color.y == color.z);
        assert_true(fabsf(color.x - (float)i / 1000.0f) < 1e-7f);
    }
}

/* Nothing beyond the table is read, and no colour is out of 0..1. */
static void all_of_0_to_1_has_a_color(void **state)
{
    (void)state;
    for (int map = 0; map < ZR_COLORMAP_COUNT; map++)
        for (int i = 0; i <= 1 << 16; i++) {
            const float at = i == 1 << 16 ? 1.0f : i == (1 << 16) - 1 ? nextafterf(1.0f, 0.0f) : (float)i / (1 << 16);
            const zr_vec4 color = zr_colormap_color((enum zr_colormap)map, at);
            assert_true(color.x >= 0 && color.x <= 1 && color.y >= 0 && color.y <= 1 && color.z >= 0 && color.z <= 1);
        }
}

/* As a map of one quantity must: equal steps get lighter. */
static void viridis_gets_lighter(void **state)
{
    double before = -1;
    (void)state;
    for (int i = 0; i <= 128; i++) {
        const zr_vec4 c = zr_colormap_color(ZR_COLORMAP_VIRIDIS, (float)i / 128);
        const double y = 0.2126 * decode((double)c.x) + 0.7152 * decode((double)c.y) + 0.0722 * decode((double)c.z);
        assert_true(y > before);
        before = y;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_of_lists_have_what_is_published),
        cmocka_unit_test(maps_between_two_hues_are_those_of_their_formulas),
        cmocka_unit_test(gray_is_linear),
        cmocka_unit_test(all_of_0_to_1_has_a_color),
        cmocka_unit_test(viridis_gets_lighter),
    };
    return cmocka_run_group_tests_name("colormap", tests, NULL, NULL);
}
