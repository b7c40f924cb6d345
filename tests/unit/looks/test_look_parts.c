/* sRGB is that of its definition; limits of tone mapping. */
#include "support/isas.h"
#include "support/pictures/look_kernel.h"
#include "unit/common/lit_samples.h"

enum { COUNT = 1 << 16 };

static float in[3][COUNT], out[3][COUNT], scalar[3][COUNT];
static const float *const ins[3] = {in[0], in[1], in[2]};
static float *const outs[3] = {out[0], out[1], out[2]};

static void assert_below(double value, double bound, const char *what)
{
    print_message("%s: %.3g\n", what, value);
    if (!(value < bound)) fail_msg("%s: %g, not below %g", what, value, bound);
}

/* ---- sRGB, IEC 61966-2-1 ---- */

static double reference_decode(double encoded)
{
    const double e = fmin(fmax(encoded, 0.0), 1.0);
    return e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4);
}

static double reference_encode(double linear)
{
    const double l = fmin(fmax(linear, 0.0), 1.0);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1.0 / 2.4) - 0.055;
}

static void fill_0_to_1(void)
{
    for (int i = 0; i < COUNT; i++)
        in[0][i] = (float)i / (COUNT - 1);
}

typedef double curve_fn(double);

static double worst_of_curve(curve_fn *curve, bool relative)
{
    double worst = 0.0;
    for (int i = 0; i < COUNT; i++) {
        const double want = curve((double)in[0][i]), off = fabs((double)out[0][i] - want);
        worst = fmax(worst, relative ? off / fmax(want, 1e-9) : off);
    }
    return worst;
}

TEST_EACH_ISA(srgb_is_decoded_as_defined)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    fill_0_to_1();
    parts->decode(in[0], COUNT, out[0]);
    assert_below(worst_of_curve(reference_decode, false), 6e-7, "decoded, worst difference");
    assert_below(worst_of_curve(reference_decode, true), 1e-6, "decoded, worst relative difference");
    look_parts_scalar.decode(in[0], COUNT, scalar[0]);
    assert_memory_equal(out[0], scalar[0], sizeof out[0]);
}

TEST_EACH_ISA(srgb_is_encoded_as_defined)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    fill_0_to_1();
    parts->encode(in[0], COUNT, out[0]);
    assert_below(worst_of_curve(reference_encode, false), 3e-7, "encoded, worst difference");
    look_parts_scalar.encode(in[0], COUNT, scalar[0]);
    assert_memory_equal(out[0], scalar[0], sizeof out[0]);
}

TEST_EACH_ISA(what_is_beyond_srgb_is_kept_within)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    static const float beyond[16] = {-1.0f,    -1e30f,    -0.0f,  0.0f, 1e-45f, 1e-38f, 1.0f, 1.0000001f,
                                     INFINITY, -INFINITY, 255.0f, 2.0f, 1e30f,  NAN,    3.0f, -1e-45f};
    static const float want[16] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 0};
    float decoded[16], encoded[16];
    parts->decode(beyond, 16, decoded);
    parts->encode(beyond, 16, encoded);
    for (int i = 0; i < 16; i++) {
        assert_true(fabsf(decoded[i] - want[i]) < 1e-6f);
        assert_true(fabsf(encoded[i] - want[i]) < 1e-6f);
    }
}

/* Else unlit surfaces would not come out as given. */
TEST_EACH_ISA(every_byte_comes_back)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    for (int i = 0; i < 256; i++)
        in[0][i] = (float)i / 255.0f;
    parts->decode(in[0], 256, in[1]);
    parts->encode(in[1], 256, out[0]);
    for (int i = 0; i < 256; i++) {
        assert_int_equal((int)(out[0][i] * 255.0f + 0.5f), i);
        assert_true(fabsf(out[0][i] * 255.0f - (float)i) < 0.01f);
    }
}

/* ---- tone ---- */

TEST_EACH_ISA(no_tone_clamps)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    static const float bright[16] = {-1, 0, 0.25f, 1, 1.5f, 1e30f, INFINITY, -INFINITY, -0.0f, 0.999f};
    const float *const three[3] = {bright, bright, bright};
    parts->tone(ZR_TONE_NONE, three, 16, outs);
    for (int i = 0; i < 16; i++)
        for (int k = 0; k < 3; k++)
            assert_true(out[k][i] == fminf(fmaxf(bright[i], 0.0f), 1.0f));
}

/* Grey stays grey, and more light never becomes less of a pixel; as bright as a scene can say. */
TEST_EACH_ISA(tones_rise)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    for (int i = 0; i < COUNT; i++)
        in[0][i] = in[1][i] = in[2][i] = i == 0 ? 0.0f : (float)pow(10.0, -8.0 + 24.0 * i / COUNT);
    for (int tone = 0; tone < ZR_TONE_COUNT; tone++) {
        parts->tone((enum zr_tone)tone, ins, COUNT, outs);
        assert_true(out[0][0] == 0.0f);
        assert_true(out[0][COUNT - 1] > 0.9999f && out[0][COUNT - 1] <= 1.0f);
        for (int i = 1; i < COUNT; i++) {
            assert_true(out[0][i] >= out[0][i - 1] - 2e-7f);
            assert_true(fabsf(out[1][i] - out[0][i]) < 2e-7f && fabsf(out[2][i] - out[0][i]) < 2e-7f);
        }
    }
}

TEST(no_environment_is_none)
{
    struct zr_environment_light light;
    assert_false(zr_environment_make(ZR_ENVIRONMENT_NONE, &light));
}

RUN_TESTS(NULL, NULL)
