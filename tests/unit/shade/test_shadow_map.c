/* The border of a shadow. */
#include <math.h>

#include "shade/lights/gbuffer.h"
#include "support/isas.h"
#include "support/shadow_map_kernel.h"

enum { SIDE = ZR_SHADOW_SIDE, BORDER = ZR_SHADOW_BORDER, ROWS = SIDE + 2 * BORDER, STRIDE = ROWS + 8 };

/* A wall over one half of the map: light goes up from 0 to 1 over 7 texels, and the bias frees the wall itself. */
TEST_EACH_ISA(the_border_of_a_shadow_is_soft)
{
    const enum zr_isa isa = isa_under_test(state);
    static float depths[ROWS * STRIDE], got[16];
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < STRIDE; x++)
            depths[y * STRIDE + x] = x < BORDER + 500 && x >= BORDER ? 10.0f : INFINITY;
    const struct zr_shadow_map map = {.depths = depths,
                                      .stride = STRIDE,
                                      .u_axis = {1, 0, 0},
                                      .v_axis = {0, 1, 0},
                                      .depth_axis = {0, 0, 1},
                                      .bias = 0.1f,
                                      .eye_scale = 1.0f};
    float x[16], y[16], z[16], none[16] = {0}, up[16];
    for (int i = 0; i < 16; i++) {
        x[i] = 494.5f + (float)i, y[i] = 512.0f, z[i] = 20.0f, up[i] = -1.0f;
    }
    const float *const point[3] = {x, y, z}, *const normal[3] = {none, none, up};
    shadow_shares_of(isa)(&map, point, normal, 16, got);
    static const int lit[] = {0, 0, 0, 3, 8, 15, 22, 29, 34, 37, 37, 37};
    for (int i = 0; i < 12; i++)
        assert_true(got[i] == (float)lit[i] / 37.0f);
    for (int i = 0; i < 16; i++)
        z[i] = 10.15f;
    shadow_shares_of(isa)(&map, point, normal, 16, got);
    for (int i = 0; i < 16; i++)
        assert_true(got[i] == 1.0f);
}

RUN_TESTS(NULL, NULL)
