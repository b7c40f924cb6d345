#include "support/pictures/gallery.h"
#include "scene/picture.h"

#include <math.h>
#include <string.h>

#include "scene/looks.h"
#include "scene/output.h"
#include "support/pictures/look.h"
#include "support/random.h"

const char *const gallery_names[GALLERY_SCENES] = {"soup",
                                                   "soup of the tiny",
                                                   "layers",
                                                   "ball, smooth",
                                                   "ball, flat, mirrored",
                                                   "outlines",
                                                   "wires and lines",
                                                   "polygons",
                                                   "inside a ball",
                                                   "layers into a base",
                                                   "balls, smooth and one-sided",
                                                   "lamps on vertices",
                                                   "lamps on pixels",
                                                   "nothing into a base"};
/* The last is large enough to be written past the caches. */
const uint32_t gallery_windows[GALLERY_WINDOWS][2] = {{1, 1}, {65, 1}, {333, 517}, {640, 480}, {1024, 512}};
const char *const gallery_channels[GALLERY_CHANNELS] = {"color", "depth", "window depth", "face id"};

static const struct zr_output outputs[GALLERY_CHANNELS] = {
    {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
    {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY},
    {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
    {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};

const void *gallery_channel(const struct zr_frame *frame, int channel)
{
    const void *const all[GALLERY_CHANNELS] = {frame->color, frame->depth, frame->window_depth, frame->face_id};
    return all[channel];
}

/* Parts of a scene. */
struct set {
    struct zr_arena *arena;
    struct random random;
    struct zr_scene scene;
    struct zr_mesh mesh;
    struct zr_material material;
    struct zr_instance instances[2];
    struct zr_light lights[3];
    struct zr_base base;
    /* To be filled. */
    zr_vec4 *positions, *colors;
    uint32_t *face_offsets, *indices, *lines;
};

static float between(struct random *random, double low, double high)
{
    return (float)random_range(random, low, high);
}

/* Its coordinates one after the other: initializers may be evaluated in any order. */
static zr_vec4 any_point(struct random *random, double half, double half_depth)
{
    zr_vec4 point = {.w = 1};
    point.x = between(random, -half, half);
    point.y = between(random, -half, half);
    point.z = between(random, -half_depth, half_depth);
    return point;
}

/* Beyond 0..1 too: bytes are clamped. */
static zr_vec4 any_color(struct random *random)
{
    zr_vec4 color = any_point(random, 0.6, 0.6);
    return (zr_vec4){color.x + 0.5f, color.y + 0.5f, color.z + 0.5f, 1};
}

/* In clip space, at distance w. */
static zr_vec4 project(zr_vec4 p, float w)
{
    return (zr_vec4){p.x * w, p.y * w, p.z * w, w};
}

/* Room for a mesh. */
static bool mesh_begin(struct set *s, uint32_t positions, uint32_t faces, uint32_t corners, uint32_t lines)
{
    s->positions = zr_arena_zero(s->arena, positions, sizeof *s->positions);
    s->colors = zr_arena_zero(s->arena, positions, sizeof *s->colors);
    s->face_offsets = zr_arena_zero(s->arena, faces + 1, sizeof *s->face_offsets);
    s->indices = zr_arena_zero(s->arena, corners + 1, sizeof *s->indices);
    s->lines = zr_arena_zero(s->arena, 2 * (size_t)lines + 1, sizeof *s->lines);
    if (!zr_arena_ok(s->arena)) return false;
    for (uint32_t i = 0; i < positions; i++)
        s->colors[i] = any_color(&s->random);
    s->mesh.position_count = positions;
    s->mesh.positions = s->positions;
    s->mesh.face_count = faces;
    s->mesh.face_offsets = s->face_offsets;
    s->mesh.indices = s->indices;
    s->mesh.line_count = lines;
    s->mesh.lines = s->lines;
    s->mesh.colors = s->colors;
    return true;
}

/* Each has corners of its own. */
static bool triangles_begin(struct set *s, uint32_t triangles)
{
    if (!mesh_begin(s, 3 * triangles, triangles, 3 * triangles, 0)) return false;
    for (uint32_t i = 0; i < 3 * triangles; i++)
        s->indices[i] = i;
    for (uint32_t t = 0; t <= triangles; t++)
        s->face_offsets[t] = 3 * t;
    return true;
}

/* ---- scenes ---- */

/* In clip space: in perspective, near and far, through all planes, of half sizes from small to large; every
 * twentieth reaches over the whole window. */
static bool make_soup(struct set *s, double small, double large)
{
    enum { TRIANGLES = 5000 }; /* enough for several threads to sort */
    if (!triangles_begin(s, TRIANGLES)) return false;
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        const zr_vec4 centre = any_point(&s->random, 1.2, 0);
        double size = t % 20 ? random_range(&s->random, small, large) : 2.0;
        for (uint32_t k = 0; k < 3; k++) {
            const zr_vec4 p = any_point(&s->random, size, 1.1);
            s->positions[3 * t + k] =
                project((zr_vec4){centre.x + p.x, centre.y + p.y, p.z, 1}, between(&s->random, 0.3, 3.0));
        }
    }
    return true;
}

static bool make_large_soup(struct set *s)
{
    return make_soup(s, 0.0, 0.3);
}

static bool make_tiny_soup(struct set *s)
{
    return make_soup(s, 0.0, 0.01);
}

static float steps(struct random *random, uint32_t count)
{
    return (float)random_below(random, count) / 16;
}

/* Triangles in three planes, on a coarse grid: at most samples several are equally near, edges meet samples, and
 * some triangles have no area, or come twice. */
static bool make_layers(struct set *s)
{
    enum { TRIANGLES = 1500 };
    if (!triangles_begin(s, TRIANGLES)) return false;
    s->mesh.colors = NULL;
    s->mesh.face_colors = s->colors;
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        float z = (float)random_below(&s->random, 3) * 0.25f, x = steps(&s->random, 33) - 1;
        float y = steps(&s->random, 33) - 1;
        for (uint32_t k = 0; k < 3; k++) {
            zr_vec4 *p = &s->positions[3 * t + k];
            p->x = x + steps(&s->random, 9) / 2;
            p->y = y + steps(&s->random, 9) / 2;
            p->z = z, p->w = 1;
        }
        if (t % 4 == 3) memcpy(s->positions + 3 * t, s->positions + 3 * t - 3, 3 * sizeof *s->positions);
    }
    return true;
}

/* A point of the unit ball's surface, from one of the cube's. */
static zr_vec4 ball_point(int side, uint32_t u, uint32_t v, uint32_t cells)
{
    float a = 2 * (float)u / (float)cells - 1, b = 2 * (float)v / (float)cells - 1, c = side & 1 ? 1.0f : -1.0f;
    if (c < 0) a = -a;
    float scale = 1.0f / sqrtf(a * a + b * b + c * c);
    a *= scale, b *= scale, c *= scale;
    if (side < 2) return (zr_vec4){a, b, c, 1};
    return side < 4 ? (zr_vec4){c, a, b, 1} : (zr_vec4){b, c, a, 1};
}

/* Adds a ball of quadrilaterals, made from `sides` sides of a cube. Missing sides show its inside. */
static bool make_ball(struct set *s, uint32_t cells, int sides)
{
    uint32_t row = cells + 1, each = row * row, faces = cells * cells;
    if (!mesh_begin(s, each * (uint32_t)sides, faces * (uint32_t)sides, 4 * faces * (uint32_t)sides, 0)) return false;
    uint32_t f = 0;
    for (int side = 0; side < sides; side++)
        for (uint32_t i = 0; i < each; i++) {
            uint32_t u = i % row, v = i / row, at = each * (uint32_t)side + i;
            s->positions[at] = ball_point(side, u, v, cells);
            if (u == cells || v == cells) continue;
            const uint32_t corners[4] = {at, at + 1, at + row + 1, at + row};
            memcpy(s->indices + 4 * f++, corners, sizeof corners);
            s->face_offsets[f] = 4 * f;
        }
    scene_look(&s->scene, (struct zr_view){.pose = ZR_POSE_ORBIT,
                                           .azimuth_degrees = 30,
                                           .elevation_degrees = 20,
                                           .up = {0, 1, 0},
                                           .projection = ZR_PROJECTION_PERSPECTIVE,
                                           .yfov_radians = 0.7f,
                                           .fit_padding = 0.02f});
    s->material.shading = ZR_SHADING_GOURAUD;
    s->lights[0] = (struct zr_light){.direction = {0.6f, -0.8f, 0}, .color = {0.7f, 0.6f, 0.5f}, .camera_frame = false};
    s->lights[1] =
        (struct zr_light){.direction = {-0.36f, 0.48f, 0.8f}, .color = {0.2f, 0.4f, 0.4f}, .camera_frame = false};
    s->lights[2] = (struct zr_light){.direction = {0, 0, -1}, .color = {0.3f, 0.3f, 0.3f}, .camera_frame = true};
    s->scene.light_count = 3;
    s->scene.ambient = (zr_vec3){0.1f, 0.1f, 0.15f};
    return true;
}

static bool make_smooth_ball(struct set *s)
{
    return make_ball(s, 40, 5);
}

static bool make_mirrored_ball(struct set *s)
{
    s->scene.instance_count = 2;
    s->instances[1].object_to_world.m[0] = -1;
    s->instances[1].object_to_world.m[12] = 1.2f;
    if (!make_ball(s, 24, 5)) return false;
    s->material.shading = ZR_SHADING_FLAT;
    s->material.double_sided = false;
    return true;
}

/* The triangles of the second are as small as pixels, and in some windows those of the first as small as stamps: they
 * are painted early (shade/paint.h). */
static bool make_smooth_balls(struct set *s)
{
    zr_mat4 *behind = &s->instances[1].object_to_world;
    s->scene.instance_count = 2;
    behind->m[5] = behind->m[10] = 0.3f;
    behind->m[0] = -0.3f; /* mirrored */
    behind->m[12] = 1.3f;
    if (!make_ball(s, 72, 5)) return false;
    s->material.double_sided = false;
    return true;
}

/* A point lamp, a spot with a range that goes with the camera, and a directional light. */
static void light_by_lamps(struct set *s)
{
    s->lights[1] =
        (struct zr_light){.type = ZR_LIGHT_POINT, .position = {1.2f, 0.9f, 0.7f}, .color = {0.9f, 0.6f, 0.4f}};
    s->lights[2] = (struct zr_light){.type = ZR_LIGHT_SPOT,
                                     .position = {-0.4f, 0.6f, 0.2f},
                                     .direction = {0.18f, -0.24f, -0.954f},
                                     .color = {3, 4, 5},
                                     .range = 9,
                                     .inner_degrees = 5,
                                     .outer_degrees = 25,
                                     .camera_frame = true};
}

static bool make_lamps_on_vertices(struct set *s)
{
    if (!make_ball(s, 24, 5)) return false;
    light_by_lamps(s);
    return true;
}

static bool make_lamps_on_pixels(struct set *s)
{
    if (!make_ball(s, 12, 5)) return false;
    light_by_lamps(s);
    s->material.shading = ZR_SHADING_PHONG;
    s->material.specular = (zr_vec3){0.5f, 0.5f, 0.5f};
    s->material.shininess = 20;
    return true;
}

static bool make_outlines(struct set *s)
{
    if (!make_ball(s, 12, 5)) return false;
    s->material.outline = ZR_OUTLINE_COLORED;
    s->material.outline_color = (zr_vec4){0.9f, 0.2f, 0.1f, 1};
    return true;
}

/* A unfilled soup in its own colours, and lines across the window. */
static bool make_wires(struct set *s)
{
    enum { POINTS = 300, LINES = 600, FACES = 200 };
    if (!mesh_begin(s, POINTS, FACES, 3 * FACES, LINES)) return false;
    for (uint32_t i = 0; i < POINTS; i++) {
        const zr_vec4 p = any_point(&s->random, 1.3, 1.1);
        s->positions[i] = project(p, between(&s->random, 0.3, 3.0));
    }
    for (uint32_t i = 0; i < 2 * LINES; i++)
        s->lines[i] = random_below(&s->random, POINTS);
    for (uint32_t i = 0; i < 3 * FACES; i++)
        s->indices[i] = random_below(&s->random, POINTS);
    for (uint32_t f = 0; f <= FACES; f++)
        s->face_offsets[f] = 3 * f;
    s->material.unfilled = true;
    s->material.outline = ZR_OUTLINE_OWN;
    return true;
}

/* Adds polygons of 3 to 12 corners in inclined planes, concave and self-intersecting, with smooth colours. */
static bool make_polygons(struct set *s)
{
    enum { FACES = 250, MOST = 12 };
    if (!mesh_begin(s, FACES * MOST, FACES, FACES * MOST, 0)) return false;
    uint32_t corner = 0;
    for (uint32_t f = 0; f < FACES; f++) {
        uint32_t corners = 3 + random_below(&s->random, MOST - 2);
        const zr_vec4 at = any_point(&s->random, 1, 0.8), slope = any_point(&s->random, 0.3, 0);
        for (uint32_t k = 0; k < corners; k++, corner++) {
            const zr_vec4 p = any_point(&s->random, f % 3 ? 0.2 : 0.02, 0);
            s->positions[corner] = (zr_vec4){at.x + p.x, at.y + p.y, at.z + slope.x * p.x + slope.y * p.y, 1};
            s->indices[corner] = corner;
        }
        s->face_offsets[f + 1] = corner;
    }
    s->mesh.position_count = corner;
    return true;
}

static bool make_inside(struct set *s)
{
    if (!make_ball(s, 10, 6)) return false;
    s->scene.views[0].pose = ZR_POSE_LOOK_AT;
    s->scene.views[0].eye = (zr_vec3){0.3f, 0.2f, 0.5f};
    s->scene.views[0].target = (zr_vec3){-0.4f, 0.1f, -0.7f};
    s->scene.views[0].yfov_radians = 1.6f;
    s->scene.views[0].has_znear = s->scene.views[0].has_zfar = true;
    s->scene.views[0].znear = 0.05f;
    s->scene.views[0].zfar = 10;
    return true;
}

/* A base with steps in its depth, that are also depths of the layers. */
static bool make_base(struct set *s)
{
    size_t pixels = (size_t)s->scene.views[0].width * s->scene.views[0].height;
    uint8_t *color = zr_arena_alloc(s->arena, pixels, 4);
    float *window_depth = zr_arena_alloc(s->arena, pixels, sizeof *window_depth);
    float *depth = zr_arena_alloc(s->arena, pixels, sizeof *depth);
    uint32_t *face_id = zr_arena_alloc(s->arena, pixels, sizeof *face_id);
    if (!zr_arena_ok(s->arena)) return false;
    for (size_t i = 0; i < pixels; i++) {
        size_t x = i % s->scene.views[0].width, y = i / s->scene.views[0].width, step = (x / 23 + y / 31) % 5;
        window_depth[i] = step == 4 ? 1.0f : 0.5f + 0.125f * (float)step;
        depth[i] = step == 4 ? INFINITY : 2 * window_depth[i] - 1;
        face_id[i] = step == 4 ? 0 : 1 + (uint32_t)step;
        const uint8_t bytes[4] = {(uint8_t)(40 * step), (uint8_t)x, (uint8_t)y, 255};
        memcpy(color + 4 * i, bytes, 4);
    }
    s->base = (struct zr_base){.color = color,
                               .window_depth = window_depth,
                               .depth = depth,
                               .face_id = face_id,
                               .scene_wins_ties = true,
                               .first_face_id = 10};
    s->scene.base = &s->base;
    return true;
}

static bool make_based(struct set *s)
{
    return make_base(s) && make_layers(s);
}

/* No record, and no batch of any. */
static bool make_bare_base(struct set *s)
{
    return make_base(s) && mesh_begin(s, 1, 0, 0, 0);
}

/* ---- */

static void set_init(struct set *s, struct zr_arena *arena, uint32_t width, uint32_t height)
{
    s->arena = arena;
    s->material = (struct zr_material){.base_color = {1, 1, 1, 1}, .shading = ZR_SHADING_UNLIT, .double_sided = true};
    s->mesh.name = "";
    s->instances[0].object_to_world = s->instances[1].object_to_world = zr_mat4_identity();
    static const struct zr_picture picture = {.side = 0};
    s->scene = (struct zr_scene){.look = zr_look_textbook(),
                                 .picture = &picture,
                                 .background = {0.1f, 0.2f, 0.3f, 1},
                                 .material_count = 1,
                                 .mesh_count = 1,
                                 .instance_count = 1,
                                 .materials = &s->material,
                                 .meshes = &s->mesh,
                                 .instances = s->instances,
                                 .lights = s->lights};
    s->scene.views[0] = (struct zr_view){.width = width,
                                         .height = height,
                                         .output_count = GALLERY_CHANNELS,
                                         .outputs = outputs,
                                         .pose = ZR_POSE_MATRIX,
                                         .world_to_camera = zr_mat4_identity(),
                                         .projection = ZR_PROJECTION_MATRIX,
                                         .projection_matrix = zr_mat4_identity()};
}

const struct zr_scene *gallery_scene(struct zr_arena *arena, int number, uint32_t width, uint32_t height)
{
    static bool (*const make[GALLERY_SCENES])(struct set *) = {
        make_large_soup,      make_tiny_soup, make_layers, make_smooth_ball, make_mirrored_ball, make_outlines,
        make_wires,           make_polygons,  make_inside, make_based,       make_smooth_balls,  make_lamps_on_vertices,
        make_lamps_on_pixels, make_bare_base};
    struct set *s = zr_arena_zero(arena, 1, sizeof *s);
    if (!s) return NULL;
    set_init(s, arena, width, height);
    s->random = random_seeded((uint64_t)number + 1);
    return make[number](s) ? &s->scene : NULL;
}
