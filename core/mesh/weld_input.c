#include "mesh/weld_input.h"

#include "scene/camera/camera_parts.h"

/* Each range of positions has a result of its own, which bounds their number. */
enum { RANGES_MOST = 64, RANGE_LEAST = 1 << 13 };

struct measured {
    double most[ZR_MEASURES];
    bool is_plain; /* every w is 1 */
};

struct measuring {
    const struct zr_mesh *mesh;
    enum zr_isa isa;
    size_t range;
    struct measured results[RANGES_MOST];
};

static void raise_one(zr_vec3 place, double most[ZR_MEASURES])
{
    const float at[3] = {place.x, place.y, place.z};
    if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) return;
    for (int k = 0; k < 3; k++) {
        zr_raise(&most[k], (double)at[k]);
        zr_raise(&most[3 + k], -(double)at[k]);
    }
}

static void measure_range(void *context, size_t begin, size_t end)
{
    struct measuring *m = context;
    struct measured *result = &m->results[begin / m->range];
    *result = (struct measured){.is_plain = true};
    for (int k = 0; k < ZR_MEASURES; k++)
        result->most[k] = -HUGE_VAL;
    if (zr_fit_extent_of(m->isa)(m->mesh->positions + begin, (uint32_t)(end - begin), result->most)) return;
    for (size_t i = begin; i < end; i++) {
        const zr_vec4 *p = &m->mesh->positions[i];
        result->is_plain = result->is_plain && p->w == 1.0f;
        raise_one(zr_vec4_over_w(*p), result->most);
    }
}

/* Returns the power of two that scales lengths to about 1; 1 if the fourth powers of the diagonal, and of a thousandth
 * of it, are floats anyway. */
static float scale_of(double diagonal)
{
    if (diagonal == 0.0 || (diagonal >= 0x1p-10 && diagonal <= 0x1p24)) return 1.0f;
    int exponent;
    (void)frexp(diagonal, &exponent);
    return ldexpf(1.0f, exponent < -126 ? 126 : exponent > 126 ? -126 : -exponent);
}

struct zr_mesh_extent zr_mesh_extent_of(struct zr_team *team, const struct zr_mesh *mesh)
{
    const size_t count = mesh->position_count, share = (count + RANGES_MOST - 1) / RANGES_MOST;
    struct measuring m = {.mesh = mesh, .isa = zr_team_isa(team), .range = share < RANGE_LEAST ? RANGE_LEAST : share};
    struct zr_mesh_extent extent = {.scale = 1.0f};
    double most[ZR_MEASURES], square = 0.0;
    zr_team_ranges(team, count, m.range, measure_range, &m);
    for (int k = 0; k < ZR_MEASURES; k++)
        most[k] = -HUGE_VAL;
    for (size_t r = 0; r * m.range < count; r++) {
        for (int k = 0; k < ZR_MEASURES; k++)
            zr_raise(&most[k], m.results[r].most[k]);
        extent.needs_copy = extent.needs_copy || !m.results[r].is_plain;
    }
    if (most[0] == -HUGE_VAL) return extent;
    for (int k = 0; k < 3; k++) {
        extent.low[k] = -most[3 + k];
        square += (most[k] + most[3 + k]) * (most[k] + most[3 + k]);
    }
    extent.diagonal = sqrt(square);
    extent.scale = scale_of(extent.diagonal);
    extent.needs_copy = extent.needs_copy || extent.scale != 1.0f;
    return extent;
}

struct copying {
    const struct zr_mesh *mesh;
    float scale;
    zr_vec4 *to;
};

static void copy_range(void *context, size_t begin, size_t end)
{
    const struct copying *c = context;
    for (size_t i = begin; i < end; i++) {
        const zr_vec3 place = zr_vec3_scale(zr_vec4_over_w(c->mesh->positions[i]), c->scale);
        c->to[i] = (zr_vec4){place.x, place.y, place.z, 1.0f};
    }
}

struct zr_weld_input zr_weld_input_make(struct zr_team *team, const struct zr_mesh *mesh,
                                        const struct zr_mesh_extent *extent, zr_vec4 *room)
{
    struct copying copying = {mesh, extent->scale, room};
    const double scale = (double)extent->scale;
    if (extent->needs_copy) zr_team_ranges(team, mesh->position_count, RANGE_LEAST, copy_range, &copying);
    return (struct zr_weld_input){
        .at = extent->needs_copy ? room : mesh->positions,
        .count = mesh->position_count,
        .low = {(float)(extent->low[0] * scale), (float)(extent->low[1] * scale), (float)(extent->low[2] * scale)},
        .diagonal = (float)(extent->diagonal * scale)};
}
