/* crease_check.h - tests: normals of corners, made and looked at. */
#ifndef ZR_TESTS_CREASE_CHECK_H
#define ZR_TESTS_CREASE_CHECK_H

#include <math.h>
#include <string.h>

#include "base/run.h"
#include "mesh/crease_normals.h"
#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/test_arena.h"

enum { ARENA_BYTES = 1 << 28 };

TEST_ARENA(ARENA_BYTES)

/* Before each test: all of a file have one arena. */
static inline int empty_arena(void **state)
{
    (void)state;
    zr_arena_reset(&arena, ARENA_BYTES);
    return 0;
}

static struct random numbers = {{RANDOM_STATE_1}};

static inline float any(void)
{
    return (float)random_range(&numbers, -1.0, 1.0);
}

/* Returns the normal of each corner. */
static inline const zr_vec4 *make(struct zr_team *team, const struct zr_mesh *mesh, float degrees)
{
    const struct zr_crease_normals *made =
        zr_crease_normals_make(&(struct zr_run){.arena = &arena, .team = team}, mesh, degrees);
    assert_non_null(made);
    const uint32_t corners = mesh->face_offsets[mesh->face_count];
    zr_vec4 *normals = zr_arena_alloc(&arena, corners, sizeof *normals);
    assert_non_null(normals);
    for (uint32_t i = 0; i < corners; i++) {
        const zr_vec3 n = zr_crease_normal_of(made, i);
        assert_true(zr_crease_number_of(made, i) < made->count);
        normals[i] = (zr_vec4){n.x, n.y, n.z, 0.0f};
    }
    return normals;
}

static inline void assert_unit_or_zero(zr_vec4 n)
{
    const double square = (double)n.x * (double)n.x + (double)n.y * (double)n.y + (double)n.z * (double)n.z;
    assert_true(n.w == 0.0f && (square == 0.0 || fabs(square - 1.0) < 1e-5));
}

static inline void assert_near(zr_vec4 n, double x, double y, double z, double error)
{
    if (fabs((double)n.x - x) > error || fabs((double)n.y - y) > error || fabs((double)n.z - z) > error || n.w != 0.0f)
        fail_msg("%g %g %g %g, not %g %g %g", (double)n.x, (double)n.y, (double)n.z, (double)n.w, x, y, z);
}

#endif
