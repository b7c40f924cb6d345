#include "reference/gl/look_twin.h"

#include <math.h>
#include <string.h>

#include "reference/average.h"
#include "reference/gl/look_surfaces.h"
#include "reference/gl/look_texture.h"
#include "reference/gl/reference_texture.h"
#include "scene/environment_map.h"
#include "scene/picture.h"
#include "shade/lights/dfg.h"
#include "shade/lights/sheen.h"

typedef double vec3[3];

/* ---- what has no twin ---- */

/* Faces of one colour, and nothing else: their order makes no difference. */
static bool is_of_one_ink(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const struct zr_material *material = &scene->materials[i];
        if (material->shading != ZR_SHADING_XRAY || material->outline != ZR_OUTLINE_NONE ||
            !zr_vec4_equal(material->base_color, scene->materials[0].base_color))
            return false;
    }
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[i];
        if (mesh->line_count > 0 || mesh->point_count > 0 || mesh->colors || mesh->face_colors) return false;
    }
    return true;
}

const char *look_twin_lacks(const struct zr_scene *scene)
{
    const struct zr_picture *picture = scene->picture;
    if (picture->occlusion.is_on) return "occlusion";
    if (picture->has_ground) return "the ground's shadow";
    if (picture->edges.is_on) return "edges";
    if (zr_any_is_see_through(scene->materials, scene->material_count)) return "what is see-through";
    if (zr_any_is_glass(scene->materials, scene->material_count)) return "glass";
    if (zr_any_is_xray(scene->materials, scene->material_count) && !is_of_one_ink(scene))
        return "x-rays beside other colours";
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].has_shadows) return "shadows of lamps";
    return NULL;
}

/* ---- directions, in eye space ---- */

static double dot(const vec3 a, const vec3 b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(vec3 v)
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

static void to_eye(const struct zr_camera *camera, const vec3 world, vec3 out)
{
    const float *m = camera->world_to_eye.m;
    for (int k = 0; k < 3; k++)
        out[k] = (double)m[k] * world[0] + (double)m[4 + k] * world[1] + (double)m[8 + k] * world[2];
    make_unit(out);
}

/* Rows that lead from eye space to the environment's: its up is the scene's or the camera's, its front is on the
 * camera's side, or, seen from straight above, at the bottom of the picture; turned counter-clockwise, from above. */
static void environment_rows(const struct look_twin *twin, vec3 rows[3])
{
    const struct zr_environment *environment = &twin->scene->picture->environment;
    const double angle = environment->rotation_degrees * acos(-1.0) / 180.0, c = cos(angle), s = sin(angle);
    const vec3 world_up = {0, !twin->scene->picture->z_is_up, twin->scene->picture->z_is_up};
    vec3 up = {0, 1, 0}, front = {0, 0, 1}, right;
    if (!environment->camera_frame) {
        to_eye(twin->camera, world_up, up);
        const bool is_above = 1.0 - up[2] * up[2] <= 1e-6;
        vec3 wanted = {0, is_above ? -1 : 0, is_above ? 0 : 1};
        const vec3 world_front = {0, twin->scene->picture->z_is_up ? -1 : 0, !twin->scene->picture->z_is_up};
        if (environment->map) to_eye(twin->camera, world_front, wanted);
        for (int k = 0; k < 3; k++)
            front[k] = wanted[k] - up[k] * dot(wanted, up);
        make_unit(front);
    }
    for (int k = 0; k < 3; k++)
        right[k] = up[(k + 1) % 3] * front[(k + 2) % 3] - up[(k + 2) % 3] * front[(k + 1) % 3];
    for (int k = 0; k < 3; k++) {
        rows[0][k] = right[k] * c - front[k] * s;
        rows[1][k] = up[k];
        rows[2][k] = right[k] * s + front[k] * c;
    }
}

/* Towards a lamp, or to the sky of a hemisphere. */
static void direction_to(const struct look_twin *twin, const struct zr_light *light, vec3 rows[3], vec3 out)
{
    const vec3 d = {(double)light->direction.x, (double)light->direction.y, (double)light->direction.z};
    const double sign = light->type == ZR_LIGHT_HEMISPHERE ? 1.0 : -1.0;
    if (light->environment_frame)
        for (int k = 0; k < 3; k++)
            out[k] = rows[0][k] * d[0] + rows[1][k] * d[1] + rows[2][k] * d[2];
    else if (light->camera_frame)
        memcpy(out, d, sizeof(vec3));
    else
        to_eye(twin->camera, d, out);
    if (light->type == ZR_LIGHT_POINT) return; /* it has none */
    make_unit(out);
    for (int k = 0; k < 3; k++)
        out[k] *= sign;
}

/* ---- uniforms ---- */

struct uniforms {
    zr_vec4 viewer;
    zr_vec3 ambient;
    float exposure, toe, environment, intensity, lamp_count;
    float to_environment[3][3];
    zr_vec4 middle;
    zr_vec3 around[ZR_MAP_HARMONICS];
    float gooch[2];
    float lamp_to[LOOK_LAMPS_MAX][3];
    float lamp_place[LOOK_LAMPS_MAX][4], lamp_spot[LOOK_LAMPS_MAX][4], lamp_end[LOOK_LAMPS_MAX][2];
    zr_vec3 lamp_color[LOOK_LAMPS_MAX], lamp_ground[LOOK_LAMPS_MAX], lamp_kind[LOOK_LAMPS_MAX];
    float split[ZR_DFG_SIDE * ZR_DFG_SIDE][2];
    float fibres[ZR_SHEEN_SIDE * ZR_SHEEN_SIDE];
};

/* Counted from the eye, in the units of the eye's space. */
static void place_of(const struct look_twin *twin, const struct zr_light *light, float out[4])
{
    const float *m = twin->camera->world_to_eye.m;
    const zr_vec4 viewer = zr_camera_eye(twin->camera);
    const double from[3] = {(double)viewer.x, (double)viewer.y, (double)viewer.z};
    const vec3 at = {(double)light->position.x, (double)light->position.y, (double)light->position.z};
    for (int k = 0; k < 3; k++) {
        double p = at[k];
        if (!light->camera_frame)
            p = (double)m[k] * at[0] + (double)m[4 + k] * at[1] + (double)m[8 + k] * at[2] + (double)m[12 + k];
        out[k] = (float)(p - (viewer.w != 0.0f ? from[k] : 0.0));
    }
    out[3] = 1.0f;
}

/* Sets a lamp with a position. The length of the up vector in eye space is that of a unit of the scene. */
static void set_place(const struct look_twin *twin, struct uniforms *u, uint32_t i, vec3 rows[3])
{
    const struct zr_light *light = &twin->scene->lights[i];
    const float *m = twin->camera->world_to_eye.m;
    const vec3 up = {(double)m[4], (double)m[5], (double)m[6]};
    const double degree = acos(-1.0) / 180.0, unit = sqrt(dot(up, up));
    vec3 to;
    u->lamp_spot[i][3] = -2.0f;
    if (!zr_light_has_place(light)) return;
    place_of(twin, light, u->lamp_place[i]);
    u->lamp_place[i][0] += twin->options.more_to_x;
    u->lamp_color[i] = zr_vec3_scale(light->color, (float)(unit * unit));
    u->lamp_end[i][1] = (float)((double)light->range * unit);
    if (light->type != ZR_LIGHT_SPOT) return;
    direction_to(twin, light, rows, to);
    for (int k = 0; k < 3; k++)
        u->lamp_spot[i][k] = (float)-to[k];
    u->lamp_spot[i][3] = (float)cos(light->outer_degrees * degree);
    u->lamp_end[i][0] = (float)cos(light->inner_degrees * degree);
}

static void set_lamps(const struct look_twin *twin, struct uniforms *u)
{
    vec3 rows[3], to;
    environment_rows(twin, rows);
    for (int i = 0; i < 9; i++)
        u->to_environment[i / 3][i % 3] = (float)rows[i / 3][i % 3];
    u->lamp_count = (float)twin->scene->light_count;
    for (uint32_t i = 0; i < twin->scene->light_count; i++) {
        const struct zr_light *light = &twin->scene->lights[i];
        direction_to(twin, light, rows, to);
        for (int k = 0; k < 3; k++)
            u->lamp_to[i][k] = (float)to[k] + (k == 0 ? twin->options.more_to_x : 0.0f);
        u->lamp_color[i] = light->color;
        u->lamp_ground[i] = light->ground;
        u->lamp_kind[i] =
            (zr_vec3){light->type == ZR_LIGHT_HEMISPHERE, light->lit != ZR_LIT_CLASSIC, light->lit != ZR_LIT_PBR};
        set_place(twin, u, i, rows);
    }
}

/* The middle of the scene's bounds, from the eye, and half their diagonal there. */
static zr_vec4 middle_of(const struct look_twin *twin)
{
    const struct zr_bounds bounds = zr_bounds_of(twin->scene, NULL, NULL);
    const float *m = twin->camera->world_to_eye.m, *low = &bounds.min.x, *high = &bounds.max.x;
    const zr_vec4 viewer = zr_camera_eye(twin->camera);
    const double from[3] = {(double)viewer.x, (double)viewer.y, (double)viewer.z};
    const vec3 up = {(double)m[4], (double)m[5], (double)m[6]};
    double square = 0.0, at[3], out[3];
    for (int k = 0; k < 3; k++) {
        const double extent = (double)high[k] - (double)low[k];
        square += extent * extent;
        at[k] = ((double)low[k] + (double)high[k]) / 2.0;
    }
    for (int k = 0; k < 3; k++)
        out[k] = (double)m[k] * at[0] + (double)m[4 + k] * at[1] + (double)m[8 + k] * at[2] + (double)m[12 + k] -
                 (viewer.w != 0.0f ? from[k] : 0.0);
    return (zr_vec4){(float)out[0], (float)out[1], (float)out[2],
                     (float)(square > 0.0 ? sqrt(square * dot(up, up)) / 2.0 : 1.0)};
}

static void set_uniforms(const struct look_twin *twin, struct uniforms *u)
{
    static const float toes[] = {[ZR_TONE_NONE] = -1.0f, [ZR_TONE_KHRONOS] = 0.04f, [ZR_TONE_NEUTRAL] = 0.02f};
    const struct zr_scene *scene = twin->scene;
    const float more = twin->options.more_ambient;
    memset(u, 0, sizeof *u);
    u->viewer = zr_camera_eye(twin->camera);
    u->ambient = zr_vec3_add(scene->ambient, (zr_vec3){more, more, more});
    u->exposure = scene->picture->exposure;
    u->toe = toes[scene->picture->tone];
    u->environment = (float)scene->picture->environment.name;
    u->intensity = scene->picture->environment.intensity;
    const struct zr_environment_map *map = scene->picture->environment.map;
    if (map) memcpy(u->around, map->harmonics, sizeof u->around);
    for (int i = 0; i < ZR_DFG_SIDE * ZR_DFG_SIDE; i++)
        for (int k = 0; k < 2; k++)
            u->split[i][k] = zr_dfg_table[i / ZR_DFG_SIDE][k][i % ZR_DFG_SIDE];
    memcpy(u->fibres, zr_sheen_table, sizeof u->fibres);
    const struct zr_gooch *gooch = &scene->picture->gooch;
    u->middle = middle_of(twin);
    u->gooch[0] = gooch->least;
    u->gooch[1] = gooch->rise;
    set_lamps(twin, u);
}

const struct reference_uniform *look_twin_uniforms(const struct look_twin *twin)
{
    static struct uniforms u;
    static const struct reference_uniform uniforms[LOOK_UNIFORMS] = {
        {"viewer", 4, 1, &u.viewer.x},
        {"ambient", 3, 1, &u.ambient.x},
        {"exposure", 1, 1, &u.exposure},
        {"toe", 1, 1, &u.toe},
        {"environment", 1, 1, &u.environment},
        {"intensity", 1, 1, &u.intensity},
        {"to_environment", 3, 3, u.to_environment[0]},
        {"middle", 4, 1, &u.middle.x},
        {"around", 3, ZR_MAP_HARMONICS, &u.around[0].x},
        {"gooch", 2, 1, u.gooch},
        {"lamp_count", 1, 1, &u.lamp_count},
        {"lamp_to", 3, LOOK_LAMPS_MAX, u.lamp_to[0]},
        {"lamp_color", 3, LOOK_LAMPS_MAX, &u.lamp_color[0].x},
        {"lamp_ground", 3, LOOK_LAMPS_MAX, &u.lamp_ground[0].x},
        {"lamp_kind", 3, LOOK_LAMPS_MAX, &u.lamp_kind[0].x},
        {"lamp_place", 4, LOOK_LAMPS_MAX, u.lamp_place[0]},
        {"lamp_spot", 4, LOOK_LAMPS_MAX, u.lamp_spot[0]},
        {"lamp_end", 2, LOOK_LAMPS_MAX, u.lamp_end[0]},
        {"split", 2, ZR_DFG_SIDE * ZR_DFG_SIDE, u.split[0]},
        {"fibres", 1, ZR_SHEEN_SIDE * ZR_SHEEN_SIDE, u.fibres},
    };
    set_uniforms(twin, &u);
    return uniforms;
}

/* ---- drawing ---- */

/* Which side a program is to take, as look_program.c has it. */
static bool put_sides(struct zr_arena *arena, struct reference_arrays *arrays)
{
    uint32_t corners = 0;
    for (uint32_t i = 0; i < arrays->batch_count; i++)
        corners = arrays->batches[i].first + arrays->batches[i].count;
    zr_vec4 *front = zr_arena_alloc(arena, corners, sizeof *front);
    if (!front) return false;
    if (corners > 0) memcpy(front, arrays->front, corners * sizeof *front);
    for (uint32_t i = 0; i < arrays->batch_count; i++) {
        const struct reference_batch *batch = &arrays->batches[i];
        const bool is_line = batch->outline || batch->mode == REFERENCE_LINES || batch->mode == REFERENCE_POINTS;
        const float side = batch->light == REFERENCE_LIT_FRONT  ? 1.0f
                           : batch->light == REFERENCE_LIT_BACK ? 2.0f
                                                                : 0.0f;
        for (uint32_t k = batch->first; k < batch->first + batch->count; k++)
            front[k].w = is_line ? 3.0f : side;
    }
    arrays->front = front;
    return true;
}

/* X-rays are seen from both sides. */
static bool show_backs(struct zr_arena *arena, struct zr_scene *scene)
{
    struct zr_material *materials = zr_arena_alloc(arena, scene->material_count, sizeof *materials);
    if (!materials) return false;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        materials[i] = scene->materials[i];
        materials[i].double_sided = true;
    }
    scene->materials = materials;
    return true;
}

bool look_twin_light_samples(const struct look_twin *twin, const struct zr_scene *large,
                             const struct reference_arrays *arrays, float *samples, uint8_t *gaps,
                             struct reference_error *error)
{
    struct look_corners corners;
    if (!look_corners_make(twin->arena, large, arrays, &corners)) return false;
    const struct reference_attribute attributes[] = {{"tangent", 4, &corners.tangents->x},
                                                     {"along_x", 4, &corners.along_x->x},
                                                     {"along_y", 4, &corners.along_y->x},
                                                     {"w_along", 4, &corners.w_along->x}};
    const struct reference_shader shader = {.program = look_program(twin->programs, LOOK_PROGRAM_SAMPLES, error),
                                            .attribute_count = sizeof attributes / sizeof *attributes,
                                            .attributes = attributes,
                                            .uniform_count = LOOK_UNIFORMS,
                                            .uniforms = look_twin_uniforms(twin)};
    return shader.program && reference_draw_floats(twin->reference, arrays, &shader, samples, error) &&
           reference_read_gaps(twin->reference, gaps, error);
}

/* Four floats a sample: linear light, times its opacity, and that: 1 where something is that is no x-ray. */
static bool draw_samples(const struct look_twin *twin, const struct zr_scene *large, float *samples, uint8_t *gaps,
                         struct reference_error *error)
{
    struct batches batches;
    const uint32_t width = large->views[0].width, height = large->views[0].height;
    if (!batches_make(twin->arena, large, twin->camera, &twin->options, &batches) ||
        !put_sides(twin->arena, &batches.arrays))
        return false;
    batches.arrays.blended = zr_any_is_xray(large->materials, large->material_count);
    if (!reference_resize(twin->reference, width, height, batches.parity_faces > 0, error) ||
        !(look_surfaces_are_lit(twin->scene) ? look_surfaces_draw : look_twin_light_samples)(
            twin, large, &batches.arrays, samples, gaps, error))
        return false;
    batches_mark_thin(&batches, width, height, gaps);
    return true;
}

/* ---- averages, backgrounds, encoding ---- */

static double decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double encode(double v)
{
    return v <= 0.0031308 ? v * 12.92 : 1.055 * pow(v, 1.0 / 2.4) - 0.055;
}

static uint8_t byte_of(double v)
{
    return (uint8_t)nearbyint(fmin(fmax(v, 0.0), 1.0) * 255.0);
}

/* Linear, and its opacity; a gradient goes from the middle of the first row to that of the last one. */
static void background_of(const struct zr_scene *scene, uint32_t row, double out[4])
{
    const struct zr_picture *picture = scene->picture;
    const uint32_t height = scene->views[0].height;
    const double down = height > 1 ? (double)row / (height - 1) : 0.0;
    const float *top = picture->has_gradient ? &picture->top.x : &scene->background.x;
    const float *bottom = picture->has_gradient ? &picture->bottom.x : &scene->background.x;
    for (int k = 0; k < 3; k++)
        out[k] = decode((double)top[k]) * (1.0 - down) + decode((double)bottom[k]) * down;
    out[3] = picture->has_gradient ? 1.0 : (double)scene->background.w;
}

/* What dithering adds to encoded values of a pixel that shows a gradient alone; rows count from the top. */
static double dither_of(const struct zr_scene *scene, uint32_t x, uint32_t row)
{
    static const int pattern[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    const uint32_t y = scene->views[0].height - 1 - row;
    if (!scene->picture->has_gradient) return 0.0;
    return ((pattern[y & 3][x & 3] + 0.5) / 16.0 - 0.5) / 255.0;
}

/* `corner`: of a pixel's samples. `dither`: added where they cover nothing. */
static void finish_pixel(const float *corner, uint32_t side, size_t row_floats, const double background[4],
                         double dither, uint8_t out[4])
{
    double sum[4] = {0};
    for (uint32_t i = 0; i < side * side; i++)
        for (int k = 0; k < 4; k++)
            sum[k] += (double)corner[i / side * row_floats + i % side * 4 + (uint32_t)k] / (side * side);
    const double rest = 1.0 - sum[3], opacity = sum[3] + rest * background[3];
    const double moved = sum[3] == 0.0 ? dither : 0.0;
    for (int k = 0; k < 3; k++)
        out[k] = opacity > 0.0 ? byte_of(encode((sum[k] + rest * background[3] * background[k]) / opacity) + moved) : 0;
    out[3] = byte_of(opacity);
}

bool look_twin_draw(const struct look_twin *twin, uint8_t *rgba, uint8_t *gaps, struct reference_error *error)
{
    struct zr_picture picture;
    struct zr_scene large = average_scene(twin->arena, twin->scene, &picture);
    const uint32_t side = twin->scene->picture->side;
    const uint32_t width = twin->scene->views[0].width, height = twin->scene->views[0].height;
    const size_t count = (size_t)large.views[0].width * large.views[0].height;
    const size_t row_floats = (size_t)large.views[0].width * 4;
    float *samples = zr_arena_alloc(twin->arena, count, 4 * sizeof *samples);
    uint8_t *sample_gaps = zr_arena_alloc(twin->arena, count, 1);
    const bool has_xrays = zr_any_is_xray(large.materials, large.material_count);
    if (twin->scene->light_count > LOOK_LAMPS_MAX || !samples || !sample_gaps) return false;
    if (has_xrays && !show_backs(twin->arena, &large)) return false;
    const struct zr_environment_map *map = twin->scene->picture->environment.map;
    const unsigned table = map ? reference_table_make(map->texels, ZR_MAP_TEXELS, error) : 0;
    const bool is_drawn = (!map || table) && draw_samples(twin, &large, samples, sample_gaps, error);
    if (table) reference_table_delete(table);
    if (!is_drawn) return false;
    average_gaps(sample_gaps, side, width, height, gaps);
    for (uint32_t y = 0; y < height; y++) {
        double background[4];
        background_of(twin->scene, y, background);
        for (uint32_t x = 0; x < width; x++)
            finish_pixel(samples + (size_t)y * side * row_floats + (size_t)x * side * 4, side, row_floats, background,
                         dither_of(twin->scene, x, y), rgba + 4 * ((size_t)y * width + x));
    }
    return true;
}
