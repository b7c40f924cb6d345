#include "support/look_scenes.h"

#include <math.h>
#include <string.h>

enum {
    CELLS = 6, /* of a side of the ball, each way */
    ROW = CELLS + 1,
    BALL_POINTS = 6 * ROW * ROW,
    BALL_FACES = 6 * CELLS * CELLS,
    BOX_POINTS = 10,
    BOX_FACES = 7,
    LINE_POINTS = 3,
    POINTS = BOX_POINTS + BALL_POINTS + LINE_POINTS,
    FACES = BOX_FACES + BALL_FACES,
    CORNERS = 30 + 4 * BALL_FACES
};

struct set {
    struct zr_scene scene;
    struct zr_mesh mesh;
    struct zr_material material;
    struct zr_instance instance;
    zr_vec4 positions[POINTS];
    uint32_t face_offsets[FACES + 1], indices[CORNERS], lines[4];
};

/* The edge above on the right is cut off. */
static void make_box(struct set *s)
{
    static const zr_vec4 points[BOX_POINTS] = {{-1, 0, -1, 1}, {1, 0, -1, 1},     {1, 0, 1, 1},    {-1, 0, 1, 1},
                                               {-1, 1, -1, 1}, {0.75f, 1, -1, 1}, {0.75f, 1, 1, 1}, {-1, 1, 1, 1},
                                               {1, 0.75f, -1, 1}, {1, 0.75f, 1, 1}};
    static const uint32_t corners[30] = {0, 1, 2, 3, 4, 7, 6, 5, 3, 2, 9, 6, 7, 1, 0,
                                         4, 5, 8, 0, 3, 7, 4, 2, 1, 8, 9, 5, 6, 9, 8};
    static const uint32_t offsets[BOX_FACES + 1] = {0, 4, 8, 13, 18, 22, 26, 30};
    memcpy(s->positions, points, sizeof points);
    memcpy(s->indices, corners, sizeof corners);
    memcpy(s->face_offsets, offsets, sizeof offsets);
}

/* A point of side `side` of a cube, brought to the ball. */
static zr_vec4 ball_point(int side, uint32_t u, uint32_t v)
{
    const float radius = 0.6f, a = 2.0f * (float)u / CELLS - 1.0f, b = 2.0f * (float)v / CELLS - 1.0f;
    const float out = side < 3 ? 1.0f : -1.0f, first = side < 3 ? a : b, second = side < 3 ? b : a;
    const float at[3][3] = {{out, first, second}, {second, out, first}, {first, second, out}};
    const float *p = at[side % 3];
    const float scale = radius / sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return (zr_vec4){p[0] * scale - 0.2f, p[1] * scale + 1.6f, p[2] * scale, 1};
}

static void make_ball(struct set *s)
{
    uint32_t corner = 30, face = BOX_FACES;
    for (uint32_t side = 0; side < 6; side++)
        for (uint32_t i = 0; i < ROW * ROW; i++) {
            const uint32_t u = i % ROW, v = i / ROW, at = BOX_POINTS + side * ROW * ROW + i;
            s->positions[at] = ball_point((int)side, u, v);
            if (u == CELLS || v == CELLS) continue;
            const uint32_t corners[4] = {at, at + 1, at + ROW + 1, at + ROW};
            memcpy(s->indices + corner, corners, sizeof corners);
            corner += 4;
            s->face_offsets[++face] = corner;
        }
}

static void make_lines(struct set *s)
{
    static const zr_vec4 points[LINE_POINTS] = {{-1.5f, 0.2f, 1.2f, 1}, {0, 1.4f, 1.2f, 1}, {1.3f, 0.1f, 1.2f, 1}};
    static const uint32_t lines[4] = {0, 1, 1, 2};
    memcpy(s->positions + BOX_POINTS + BALL_POINTS, points, sizeof points);
    for (int i = 0; i < 4; i++)
        s->lines[i] = BOX_POINTS + BALL_POINTS + lines[i];
}

static void aim(const struct zr_look_view *from, struct zr_view *view)
{
    view->pose = from->pose;
    view->preset = from->preset;
    view->azimuth_degrees = from->azimuth_degrees;
    view->elevation_degrees = from->elevation_degrees;
    view->up = (zr_vec3){0, 1, 0};
    view->projection = from->projection;
    view->yfov_radians = from->fov_radians;
    view->fit_padding = from->padding;
    view->world_to_camera = view->projection_matrix = zr_mat4_identity();
}

const struct zr_scene *look_scene(struct zr_arena *arena, const struct zr_look *look, uint32_t width, uint32_t height)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    struct set *s = zr_arena_zero(arena, 1, sizeof *s);
    if (!s) return NULL;
    make_box(s);
    make_ball(s);
    make_lines(s);
    s->mesh = (struct zr_mesh){.name = "",
                               .position_count = POINTS,
                               .positions = s->positions,
                               .face_count = FACES,
                               .face_offsets = s->face_offsets,
                               .indices = s->indices,
                               .line_count = 2,
                               .lines = s->lines};
    s->material = look->material;
    if (look->shades_by_mesh) s->material.shading = ZR_SHADING_FLAT;
    s->instance = (struct zr_instance){.object_to_world = zr_mat4_identity()};
    s->scene = (struct zr_scene){.look = look,
                                 .picture = look->picture,
                                 .background = look->background,
                                 .ambient = look->ambient,
                                 .light_count = look->light_count,
                                 .lights = look->lights,
                                 .material_count = 1,
                                 .mesh_count = 1,
                                 .instance_count = 1,
                                 .materials = &s->material,
                                 .meshes = &s->mesh,
                                 .instances = &s->instance};
    s->scene.views[0] = (struct zr_view){.width = width, .height = height, .output_count = 1, .outputs = &color};
    aim(&look->view, &s->scene.views[0]);
    return &s->scene;
}

uint64_t look_digest(const struct zr_frame *frame)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        const uint8_t *p = frame->color + 4 * i;
        hash = (hash ^ ((uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24)) *
               0x100000001b3u;
    }
    return hash;
}
