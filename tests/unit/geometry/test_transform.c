/* Positions many at once, as each instruction set does them, are those of one after the other, to the last bit, where
 * depth or w is infinite. */
#include "geometry/transform.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "geometry/clip.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/tests.h"

enum { COUNT = 3000 };

static zr_vec4 positions[COUNT];

static bool same_bits(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

/* What one position becomes: its outcode, and where that is 0 its vertex. */
static unsigned want_of(const zr_mat4 *m, const struct zr_viewport *viewport, zr_vec4 position,
                        struct zr_window_vertex *vertex)
{
    const zr_vec4 clip = zr_mat4_apply(m, position);
    const unsigned outcode = zr_clip_outcode(clip);
    if (outcode != 0) return outcode;
    return zr_viewport_apply(viewport, clip, vertex) ? 0 : ZR_OUTCODE_UNPLACED;
}

static void check(enum zr_isa isa, const zr_mat4 *m, const struct zr_viewport *viewport, size_t first, size_t count,
                  bool streamed)
{
    _Alignas(64) static struct zr_window_vertex out[COUNT + 16];
    static uint8_t outcodes[COUNT + 16];
    unsigned any = 0;
    memset(out, 0x55, sizeof out);
    memset(outcodes, 0x55, sizeof outcodes);
    const unsigned said = zr_transform_of(isa)(m, viewport, positions + first, count, out, outcodes, streamed);
    for (size_t i = 0; i < count; i++) {
        struct zr_window_vertex want;
        const unsigned outcode = want_of(m, viewport, positions[first + i], &want);
        any |= outcode;
        if (outcodes[i] != outcode)
            fail_msg("%s, %zu of %zu: outcode %u, not %u", zr_isa_name(isa), i, count, outcodes[i], outcode);
        if (outcode == 0 && !same_bits(&out[i], &want, sizeof want))
            fail_msg("%s, %zu of %zu: %a %a %a %a, not %a %a %a %a", zr_isa_name(isa), i, count, (double)out[i].x,
                     (double)out[i].y, (double)out[i].z, (double)out[i].oow, (double)want.x, (double)want.y,
                     (double)want.z, (double)want.oow);
    }
    assert_int_equal(said, any);
    for (size_t i = count; i < count + 16; i++) /* nothing is written behind them */
        assert_true(outcodes[i] == 0x55 && same_bits(&out[i].x, &(uint32_t){0x55555555}, 4));
}

static void check_all(enum zr_isa isa, const zr_mat4 *m, uint32_t width, uint32_t height)
{
    const struct zr_viewport viewport = zr_viewport_make(width, height);
    for (int streamed = 0; streamed < 2; streamed++) {
        check(isa, m, &viewport, 0, COUNT, streamed);
        for (size_t count = 0; count < 40; count++)
            check(isa, m, &viewport, 64 + 7 * count, count, streamed);
    }
}

/* Depth and w overflow, to either side: their sum is no number, and that is outside. */
TEST_EACH_ISA(depth_and_w_may_be_infinite)
{
    zr_mat4 m = zr_mat4_identity();
    m.m[10] = m.m[14] = -FLT_MAX;
    m.m[11] = m.m[15] = FLT_MAX;
    for (size_t i = 0; i < COUNT; i++)
        positions[i] = (zr_vec4){0.5f, 0.25f, 1.0f, 1.0f};
    check_all(isa_under_test(state), &m, 320, 200);
}

RUN_TESTS(NULL, NULL)
