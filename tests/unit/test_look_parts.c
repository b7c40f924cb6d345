/* What the light of looks is made of is what its definitions say: sRGB, tone mapping, occlusion, environments. */

#include "lit_samples.h"
#include "support/isas.h"
#include "support/look_kernel.h"

enum { COUNT = 1 << 16, DIRECTIONS = 4096 };

static float in[3][COUNT], out[3][COUNT], scalar[3][COUNT];
static const float *const ins[3] = {in[0], in[1], in[2]};
static float *const outs[3] = {out[0], out[1], out[2]}, *const scalars[3] = {scalar[0], scalar[1], scalar[2]};

static void assert_below(double value, double bound, const char *what)
{
    print_message("%s: %.3g\n", what, value);
    if (!(value < bound)) fail_msg("%s: %g, not below %g", what, value, bound);
}

static void assert_same_first(int count)
{
    for (int k = 0; k < 3; k++)
        assert_memory_equal(out[k], scalar[k], (size_t)count * sizeof out[k][0]);
}

/* ---- sRGB ---- */

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

static void srgb_is_decoded_as_defined(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    fill_0_to_1();
    parts->decode(in[0], COUNT, out[0]);
    assert_below(worst_of_curve(reference_decode, false), 6e-7, "decoded, worst difference");
    assert_below(worst_of_curve(reference_decode, true), 1e-6, "decoded, worst relative difference");
    look_parts_scalar.decode(in[0], COUNT, scalar[0]);
    assert_memory_equal(out[0], scalar[0], sizeof out[0]);
}

static void srgb_is_encoded_as_defined(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    fill_0_to_1();
    parts->encode(in[0], COUNT, out[0]);
    assert_below(worst_of_curve(reference_encode, false), 3e-7, "encoded, worst difference");
    look_parts_scalar.encode(in[0], COUNT, scalar[0]);
    assert_memory_equal(out[0], scalar[0], sizeof out[0]);
}

static void what_is_beyond_srgb_is_kept_within(void **state)
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
static void every_byte_comes_back(void **state)
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

/* Half of them dark, where the toe is; others up to a thousand times as bright as white. */
static void fill_light(struct random *r)
{
    for (int i = 0; i < COUNT; i++) {
        const double most = i % 2 ? 0.3 : i % 4 ? 2.0 : pow(10.0, random_range(r, 0, 3));
        put3((float *const[3]){in[0], in[1], in[2]}, (size_t)i, any3(r, 0, most));
    }
    put3((float *const[3]){in[0], in[1], in[2]}, 0, (zr_vec3){0, 0, 0});
}

static void tones_are_as_defined(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    struct random r = random_seeded(11);
    static const char *const names[] = {"none, worst difference", "khronos, worst difference",
                                        "neutral, worst difference"};
    fill_light(&r);
    for (int tone = 0; tone < ZR_TONE_COUNT; tone++) {
        double worst = 0.0;
        parts->tone((enum zr_tone)tone, ins, COUNT, outs);
        look_parts_scalar.tone((enum zr_tone)tone, ins, COUNT, scalars);
        assert_same_first(COUNT);
        for (int i = 0; i < COUNT; i++) {
            const d3 light = {{(double)in[0][i], (double)in[1][i], (double)in[2][i]}};
            const d3 want = reference_tone((enum zr_tone)tone, light);
            for (int k = 0; k < 3; k++)
                worst = fmax(worst, fabs((double)out[k][i] - want.v[k]));
        }
        assert_below(worst, tone == ZR_TONE_NONE ? 1e-12 : 2e-7, names[tone]);
    }
}

static void no_tone_clamps(void **state)
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
static void tones_rise(void **state)
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

/* ---- occlusion ---- */

static void bounced_light_is_as_defined(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    double worst = 0.0;
    for (int i = 0; i < COUNT; i++) {
        in[0][i] = (float)(i % 256) / 255.0f;
        in[1][i] = (float)(i / 256) / 255.0f;
    }
    parts->bounced(in[0], in[1], COUNT, out[0]);
    look_parts_scalar.bounced(in[0], in[1], COUNT, scalar[0]);
    assert_memory_equal(out[0], scalar[0], sizeof out[0]);
    for (int i = 0; i < COUNT; i++) {
        worst = fmax(worst, fabs((double)out[0][i] - reference_bounced((double)in[0][i], (double)in[1][i])));
        assert_true(out[0][i] >= in[0][i]);
        if (in[0][i] == 0.0f) assert_true(out[0][i] == 0.0f);
        if (in[0][i] == 1.0f) assert_true(out[0][i] == 1.0f);
        if (i >= 256) assert_true(out[0][i] >= out[0][i - 256] - 1e-6f); /* the lighter, the more */
    }
    assert_below(worst, 1e-6, "bounced, worst difference");
}

/* ---- environments ---- */

static void fill_directions(void)
{
    for (int i = 0; i < DIRECTIONS; i++)
        for (int k = 0; k < 3; k++)
            in[k][i] = (float)fibonacci_direction(i, DIRECTIONS).v[k];
}

static struct zr_environment_light environment_of(int name)
{
    struct zr_environment_light light;
    assert_true(zr_environment_make((enum zr_environment_name)name, &light));
    return light;
}

static double worst_of(const double want[3], int i)
{
    double worst = 0.0;
    for (int k = 0; k < 3; k++)
        worst = fmax(worst, fabs((double)out[k][i] - want[k]));
    return worst;
}

static void radiance_is_as_defined(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    /* The mix with irradiance begins behind 0.2 and ends at 0.8. */
    static const float alphas[] = {0.0f, 1e-4f, 0.01f, 0.1f, 0.1999f, 0.2f, 0.2001f, 0.3f, 0.5f, 0.7999f, 0.8f, 1.0f};
    double worst = 0.0;
    fill_directions();
    for (int name = ZR_ENVIRONMENT_STUDIO; name < ZR_ENVIRONMENT_COUNT; name++)
        for (size_t a = 0; a < sizeof alphas / sizeof alphas[0]; a++) {
            const struct zr_environment_light light = environment_of(name);
            parts->radiance(&light, alphas[a], ins, DIRECTIONS, outs);
            look_parts_scalar.radiance(&light, alphas[a], ins, DIRECTIONS, scalars);
            assert_same_first(DIRECTIONS);
            for (int i = 0; i < DIRECTIONS; i++) {
                const d3 d = {{(double)in[0][i], (double)in[1][i], (double)in[2][i]}};
                worst = fmax(worst, worst_of(reference_radiance(&light, d, (double)alphas[a]).v, i));
            }
        }
    assert_below(worst, 5e-6, "radiance, worst difference");
}

static void irradiance_is_as_defined(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    double worst = 0.0;
    fill_directions();
    for (int name = ZR_ENVIRONMENT_STUDIO; name < ZR_ENVIRONMENT_COUNT; name++) {
        const struct zr_environment_light light = environment_of(name);
        parts->irradiance(&light, ins, DIRECTIONS, outs);
        look_parts_scalar.irradiance(&light, ins, DIRECTIONS, scalars);
        assert_same_first(DIRECTIONS);
        for (int i = 0; i < DIRECTIONS; i++) {
            const d3 n = {{(double)in[0][i], (double)in[1][i], (double)in[2][i]}};
            worst = fmax(worst, worst_of(reference_irradiance(&light, n).v, i));
        }
    }
    assert_below(worst, 1e-6, "irradiance, worst difference");
}

/* The roughest surface mirrors what it scatters, to the last bit. */
static void radiance_ends_as_irradiance(void **state)
{
    const struct look_parts *parts = look_parts_of(isa_under_test(state));
    const struct zr_environment_light light = environment_of(ZR_ENVIRONMENT_STUDIO);
    fill_directions();
    parts->radiance(&light, 0.8f, ins, DIRECTIONS, outs);
    parts->irradiance(&light, ins, DIRECTIONS, scalars);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < DIRECTIONS; i++)
            assert_true(fabsf(out[k][i] - scalar[k][i]) < 1e-6f);
}

/* ---- harmonics ---- */

static void check_coefficients(int name)
{
    const struct zr_environment_light light = environment_of(name);
    d3 want[ZR_HARMONICS];
    double worst = 0.0;
    project_harmonics(&light, 400000, want);
    for (int i = 0; i < ZR_HARMONICS; i++)
        for (int k = 0; k < 3; k++)
            worst = fmax(worst, fabs(d3_of(light.harmonics[i]).v[k] - want[i].v[k]));
    assert_below(worst, 5.5e-5, "coefficient, worst difference");
}

static void coefficients_are_integrals(void **state)
{
    (void)state;
    check_coefficients(ZR_ENVIRONMENT_STUDIO);
    check_coefficients(ZR_ENVIRONMENT_OUTDOOR);
}

/* Bands above the second are missing. */
static void check_irradiance(int name, double bound_rms, double bound_worst)
{
    enum { NORMALS = 400, STEPS = 20000 };
    const struct zr_environment_light light = environment_of(name);
    double sum = 0.0, worst = 0.0;
    for (int i = 0; i < NORMALS; i++) {
        const d3 n = fibonacci_direction(i, NORMALS);
        const d3 got = reference_irradiance(&light, n), want = integrate_irradiance(&light, n, STEPS);
        for (int k = 0; k < 3; k++) {
            const double off = got.v[k] - want.v[k];
            sum += off * off / (3 * NORMALS);
            worst = fmax(worst, fabs(off));
        }
    }
    assert_below(sqrt(sum), bound_rms, "irradiance, RMS of what harmonics lack");
    assert_below(worst, bound_worst, "irradiance, worst of what harmonics lack");
}

static void irradiance_is_near_the_integral(void **state)
{
    (void)state;
    check_irradiance(ZR_ENVIRONMENT_STUDIO, 0.0215, 0.0505);
    check_irradiance(ZR_ENVIRONMENT_OUTDOOR, 0.003, 0.01);
}

static void no_environment_is_none(void **state)
{
    struct zr_environment_light light;
    (void)state;
    assert_false(zr_environment_make(ZR_ENVIRONMENT_NONE, &light));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(srgb_is_decoded_as_defined),
        TEST_EACH_ISA(srgb_is_encoded_as_defined),
        TEST_EACH_ISA(what_is_beyond_srgb_is_kept_within),
        TEST_EACH_ISA(every_byte_comes_back),
        TEST_EACH_ISA(tones_are_as_defined),
        TEST_EACH_ISA(no_tone_clamps),
        TEST_EACH_ISA(tones_rise),
        TEST_EACH_ISA(bounced_light_is_as_defined),
        TEST_EACH_ISA(radiance_is_as_defined),
        TEST_EACH_ISA(irradiance_is_as_defined),
        TEST_EACH_ISA(radiance_ends_as_irradiance),
        cmocka_unit_test(coefficients_are_integrals),
        cmocka_unit_test(irradiance_is_near_the_integral),
        cmocka_unit_test(no_environment_is_none),
    };
    return cmocka_run_group_tests_name("look parts", tests, NULL, NULL);
}
