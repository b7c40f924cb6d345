#include "effects/ground.h"

#include <stdint.h>

#include "base/run.h"
#include "scene/picture.h"
#include "shade/lights/lamps.h"

enum { SIDE = ZR_GROUND_SIDE, TEXELS = SIDE * SIDE, PASSES = 3 };

/* Columns per task, processed side by side by vectors. */
enum { STRIP = 32 };
_Static_assert(SIDE % STRIP == 0, "strips are whole");

/* Parts of the shadow: height above which nothing darkens, blur radius (both relative to the diagonal), and
 * strength. */
static const struct part {
    float height, blur, strength;
} parts[] = {{0.06f, 0.02f, 0.55f}, {0.35f, 0.07f, 0.45f}};
enum { PARTS = sizeof parts / sizeof parts[0] };

/* A box in texels: 2 whole + 1 full ones, and a fraction `end` of one more at either end. */
struct box {
    int whole;
    double end, share; /* share: 1 / width of the box */
};

struct blur {
    const float *heights;
    float top[PARTS]; /* height above which nothing darkens, scene units */
    float strength[PARTS];
    struct box boxes[PARTS];
    float *columns[PARTS]; /* blurred along columns; transposed, [x * SIDE + y], so that the next step works along
                            * columns too */
    float *light;
};

/* Makes a box of at least one texel. The map is 0 outside, so a box is limited to its width. */
static struct box make_box(float half_width, float texel)
{
    const double radius = (double)half_width / (double)texel;
    double beyond = radius < (double)SIDE ? radius - 0.5 : (double)SIDE;
    if (!(beyond > 0.0)) beyond = 0.0;
    const int whole = (int)beyond;
    const double end = beyond - (double)whole;
    return (struct box){whole, end, 1.0 / ((double)(2 * whole + 1) + 2.0 * end)};
}

/* Blurs a strip once along its columns. Sums are in double, so that adding and removing a texel leaves no error
 * in a float: T is exactly 1 far from the scene. */
static void blur_pass(const struct box *box, float in[SIDE][STRIP], float out[SIDE][STRIP])
{
    static const float nothing[STRIP];
    double sum[STRIP] = {0.0};
    for (int y = 0; y < box->whole && y < SIDE; y++)
        for (int x = 0; x < STRIP; x++)
            sum[x] += (double)in[y][x];
    for (int y = 0; y < SIDE; y++) {
        const int top = y + box->whole, bottom = y - box->whole;
        const float *const enters = top < SIDE ? in[top] : nothing, *const above =
                                                                        top + 1 < SIDE ? in[top + 1] : nothing;
        const float *const leaves = bottom >= 0 ? in[bottom] : nothing, *const below =
                                                                            bottom > 0 ? in[bottom - 1] : nothing;
        for (int x = 0; x < STRIP; x++) {
            const double inside = sum[x] + (double)enters[x];
            out[y][x] = (float)((inside + box->end * ((double)above[x] + (double)below[x])) * box->share);
            sum[x] = inside - (double)leaves[x];
        }
    }
}

static void blur_strip(const struct box *box, float strip[SIDE][STRIP])
{
    float other[SIDE][STRIP];
    blur_pass(box, strip, other);
    blur_pass(box, other, strip);
    blur_pass(box, strip, other);
    memcpy(strip, other, sizeof other);
}
_Static_assert(PASSES == 3, "blur_strip makes three passes");

static float near_plane(float height, float top)
{
    const float v = 1.0f - height / top;
    return v > 1.0f ? 1.0f : v > 0.0f ? v : 0.0f; /* NaN: 0 */
}

/* First step: computes the nearness of the scene to the plane, blurred along columns. */
static void blur_columns(void *context, size_t begin, size_t end)
{
    const struct blur *blur = context;
    for (size_t first = begin * STRIP; first < end * STRIP; first += STRIP)
        for (int part = 0; part < PARTS; part++) {
            float strip[SIDE][STRIP];
            for (size_t y = 0; y < SIDE; y++)
                for (size_t x = 0; x < STRIP; x++)
                    strip[y][x] = near_plane(blur->heights[y * SIDE + first + x], blur->top[part]);
            blur_strip(&blur->boxes[part], strip);
            for (size_t x = 0; x < STRIP; x++)
                for (size_t y = 0; y < SIDE; y++)
                    blur->columns[part][(first + x) * SIDE + y] = strip[y][x];
        }
}

/* Second step: blurs along rows, and multiplies `light` by 1 - strength * nearness. */
static void blur_rows(void *context, size_t begin, size_t end)
{
    const struct blur *blur = context;
    for (size_t first = begin * STRIP; first < end * STRIP; first += STRIP) {
        float *const light = blur->light + first * SIDE;
        for (size_t i = 0; i < STRIP * SIDE; i++)
            light[i] = 1.0f;
        for (int part = 0; part < PARTS; part++) {
            float strip[SIDE][STRIP];
            for (size_t x = 0; x < SIDE; x++)
                memcpy(strip[x], &blur->columns[part][x * SIDE + first], sizeof strip[x]);
            blur_strip(&blur->boxes[part], strip);
            for (size_t y = 0; y < STRIP; y++)
                for (size_t x = 0; x < SIDE; x++)
                    light[y * SIDE + x] *= 1.0f - blur->strength[part] * strip[x][y];
        }
    }
}

/* Returns f of ground.h: 1 for high scenes. */
static float share_of_height(const struct part *part, float diagonal, float height)
{
    const float share = height / (1.2f * (part->height * diagonal));
    return share < 1.0f ? share > 0.12f ? share : 0.12f : 1.0f; /* NaN: 1 */
}

struct zr_ground zr_ground_make(const struct zr_run *run, const float *heights, float half_size, float diagonal,
                                float height)
{
    struct blur blur = {.heights = heights, .light = zr_arena_alloc(run->arena, TEXELS, sizeof *blur.light)};
    for (int part = 0; part < PARTS; part++) {
        blur.columns[part] = zr_arena_alloc(run->arena, TEXELS, sizeof *blur.columns[part]);
        const float share = share_of_height(&parts[part], diagonal, height);
        blur.top[part] = parts[part].height * diagonal * share;
        blur.strength[part] = parts[part].strength * (0.5f + 0.5f * share);
        blur.boxes[part] = make_box(parts[part].blur * diagonal * share, 2.0f * half_size / (float)SIDE);
    }
    if (!zr_arena_ok(run->arena)) return (struct zr_ground){half_size, NULL};
    zr_team_ranges(run->team, SIDE / STRIP, 1, blur_columns, &blur);
    zr_team_ranges(run->team, SIDE / STRIP, 1, blur_rows, &blur);
    return (struct zr_ground){half_size, blur.light};
}

static float texel(const struct zr_ground *ground, int32_t x, int32_t y)
{
    return x >= 0 && x < SIDE && y >= 0 && y < SIDE ? ground->light[y * SIDE + x] : 1.0f;
}

/* Converts to texels from the centre of the first. Clamps positions off the map, and NaN, to a texel with T = 1. */
static float texel_place(float at, float half_size)
{
    const float place = (at / half_size + 1.0f) * (0.5f * (float)SIDE) - 0.5f;
    const float most = place < (float)SIDE ? place : (float)SIDE;
    return most > -1.0f ? most : -1.0f;
}

/* The same operations as in ground_kernel.c. */
float zr_ground_at(const struct zr_ground *ground, float x, float y)
{
    const float u = texel_place(x, ground->half_size), v = texel_place(y, ground->half_size);
    const int32_t i = (int32_t)floorf(u), j = (int32_t)floorf(v);
    const float a = u - (float)i, b = v - (float)j;
    const float t00 = texel(ground, i, j), t10 = texel(ground, i + 1, j);
    const float t01 = texel(ground, i, j + 1), t11 = texel(ground, i + 1, j + 1);
    const float low = t00 + (t10 - t00) * a, high = t01 + (t11 - t01) * a;
    return low + (high - low) * b;
}

/* Plane through the lowest point of the bounds: its middle and its axes, in world space. */
struct plane {
    zr_vec3 middle, x, y, up;
    float half_size, height; /* half the side of the map; height of the scene over the plane */
};

static struct plane plane_under(const struct zr_scene *scene, const struct zr_bounds *bounds)
{
    const zr_vec3 min = bounds->min, max = bounds->max, size = zr_vec3_sub(max, min);
    const bool z_is_up = scene->picture->z_is_up;
    struct plane plane = {.middle = zr_vec3_scale(zr_vec3_add(min, max), 0.5f),
                          .x = {1, 0, 0},
                          .y = z_is_up ? (zr_vec3){0, 1, 0} : (zr_vec3){0, 0, -1},
                          .up = zr_scene_up(scene),
                          .height = z_is_up ? size.z : size.y};
    const float depth = z_is_up ? size.y : size.z, widest = size.x > depth ? size.x : depth;
    if (z_is_up)
        plane.middle.z = min.z;
    else
        plane.middle.y = min.y;
    plane.half_size = 0.5f * widest + 0.3f * zr_diagonal_of(bounds);
    return plane;
}

/* Returns a world-space unit vector in eye space, scaled so that its dot product measures scene units. */
static zr_vec3 axis_in(const zr_mat4 *m, zr_vec3 axis, float scale)
{
    const zr_vec3 v = zr_mat4_direction(m, axis);
    return scale == 1.0f ? v : zr_vec3_scale(v, 1.0f / (scale * scale));
}

static struct zr_ground_frame frame_of(const struct plane *plane, const struct zr_camera *camera)
{
    const zr_mat4 *m = &camera->world_to_eye;
    const float scale = zr_eye_scale_of(camera);
    const zr_vec4 middle = zr_mat4_apply(m, (zr_vec4){plane->middle.x, plane->middle.y, plane->middle.z, 1.0f});
    return (struct zr_ground_frame){.origin = {middle.x, middle.y, middle.z},
                                    .x_axis = axis_in(m, plane->x, scale),
                                    .y_axis = axis_in(m, plane->y, scale),
                                    .z_axis = zr_mat4_direction(m, plane->up)};
}

/* True if the eye, or the direction towards it, is above the plane. */
static bool is_above(const struct zr_camera *camera, const struct zr_ground_frame *frame)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    zr_vec3 place = {eye.x, eye.y, eye.z};
    if (eye.w != 0.0f) place = zr_vec3_sub(place, frame->origin);
    return zr_vec3_dot(place, frame->z_axis) > 0.0f;
}

/* The camera below has the up direction -y, so that rows of the map, from the top, run along the plane's y. */
bool zr_ground_view_find(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_bounds *bounds,
                         struct zr_ground_view *view)
{
    const float diagonal = zr_diagonal_of(bounds), margin = 0.01f * diagonal;
    if (!(diagonal > 0.0f)) return false;
    const struct plane plane = plane_under(scene, bounds);
    view->frame = frame_of(&plane, camera);
    view->half_size = plane.half_size;
    view->height = plane.height;
    view->below = zr_camera_orthographic(plane.x, zr_vec3_scale(plane.y, -1.0f), zr_vec3_scale(plane.up, -1.0f),
                                         plane.middle, plane.half_size, -margin, plane.height + margin);
    return is_above(camera, &view->frame);
}
