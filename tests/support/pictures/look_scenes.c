#include "support/pictures/look_scenes.h"

#include <math.h>
#include <string.h>

#include "scene/output.h"

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

/* Storage of a scene beside its mesh. */
struct stage {
    struct zr_scene scene;
    struct zr_material material;
    struct zr_instance instance;
};

struct set {
    struct stage stage;
    struct zr_mesh mesh;
    zr_vec4 positions[POINTS];
    uint32_t face_offsets[FACES + 1], indices[CORNERS], lines[4];
};

/* The edge above on the right is cut off. */
static void make_box(struct set *s)
{
    static const zr_vec4 points[BOX_POINTS] = {{-1, 0, -1, 1},    {1, 0, -1, 1},     {1, 0, 1, 1},     {-1, 0, 1, 1},
                                               {-1, 1, -1, 1},    {0.75f, 1, -1, 1}, {0.75f, 1, 1, 1}, {-1, 1, 1, 1},
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

static const struct zr_scene *put_on_stage(struct stage *s, const struct zr_mesh *mesh, const struct zr_look *look,
                                           uint32_t width, uint32_t height)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    s->material = look->material;
    if (look->shades_by_mesh) s->material.shading = ZR_SHADING_FLAT;
    s->instance = (struct zr_instance){.object_to_world = zr_mat4_identity()};
    s->scene = (struct zr_scene){.material_count = 1,
                                 .mesh_count = 1,
                                 .instance_count = 1,
                                 .materials = &s->material,
                                 .meshes = mesh,
                                 .instances = &s->instance};
    s->scene.views[0] = (struct zr_view){.width = width,
                                         .height = height,
                                         .output_count = 1,
                                         .outputs = &color,
                                         .world_to_camera = zr_mat4_identity(),
                                         .projection_matrix = zr_mat4_identity()};
    zr_look_apply(look, &s->scene);
    zr_look_set_view(look, &s->scene.views[0]);
    return &s->scene;
}

static const struct zr_scene *make_solids(struct zr_arena *arena, const struct zr_look *look, uint32_t width,
                                          uint32_t height)
{
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
    return put_on_stage(&s->stage, &s->mesh, look, width, height);
}

/* ---- surfaces that are open, and sides that are round beside lids that are not ---- */

enum {
    STEPS = 4, /* of a quarter of the circle: none is wider than what looks make smooth */
    SIDES = 4 * STEPS,
    PATCH = 6, /* cells each way */
    PATCH_POINTS = (PATCH + 1) * (PATCH + 1),
    PLANE_AT = 0,
    PIPE_AT = 4,
    PATCH_AT = PIPE_AT + 2 * SIDES,
    WIRE_AT = PATCH_AT + PATCH_POINTS,
    OPEN_POINTS = WIRE_AT + 2,
    OPEN_FACES = 1 + SIDES + 2 + PATCH * PATCH,
    OPEN_CORNERS = 4 + 4 * SIDES + 2 * SIDES + 4 * PATCH * PATCH
};

struct open_set {
    struct stage stage;
    struct zr_mesh mesh;
    zr_vec4 positions[OPEN_POINTS];
    uint32_t face_offsets[OPEN_FACES + 1], indices[OPEN_CORNERS], lines[2];
    uint32_t faces, corners; /* so far */
};

static void add_corner(struct open_set *s, uint32_t position)
{
    s->indices[s->corners++] = position;
}

static void end_face(struct open_set *s)
{
    s->face_offsets[++s->faces] = s->corners;
}

static void add_quad(struct open_set *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_corner(s, a);
    add_corner(s, b);
    add_corner(s, c);
    add_corner(s, d);
    end_face(s);
}

static void make_plane(struct open_set *s)
{
    static const zr_vec4 points[4] = {
        {-1.6f, 0, -1.4f, 1}, {-1.6f, 0, 1.4f, 1}, {1.6f, 0, 1.4f, 1}, {1.6f, 0, -1.4f, 1}};
    memcpy(s->positions + PLANE_AT, points, sizeof points);
    add_quad(s, 0, 1, 2, 3);
}

/* A place of the circle without a sine: by the half angle's tangent, turned by quarters. */
static void circle_point(uint32_t i, float *x, float *z)
{
    const float t = (float)(i % STEPS) / STEPS, below = 1.0f + t * t, c = (1.0f - t * t) / below, d = 2.0f * t / below;
    const float at[4][2] = {{c, d}, {-d, c}, {-c, -d}, {d, -c}};
    *x = at[i / STEPS][0];
    *z = at[i / STEPS][1];
}

static void make_pipe(struct open_set *s)
{
    for (uint32_t i = 0; i < SIDES; i++) {
        float x, z;
        circle_point(i, &x, &z);
        s->positions[PIPE_AT + 2 * i] = (zr_vec4){0.5f * x - 0.7f, 0.25f, 0.5f * z - 0.4f, 1};
        s->positions[PIPE_AT + 2 * i + 1] = (zr_vec4){0.5f * x - 0.7f, 1.25f, 0.5f * z - 0.4f, 1};
        const uint32_t own = PIPE_AT + 2 * i, next = PIPE_AT + 2 * ((i + 1) % SIDES);
        add_quad(s, own, own + 1, next + 1, next);
    }
    for (uint32_t i = 0; i < SIDES; i++)
        add_corner(s, PIPE_AT + 2 * i);
    end_face(s);
    for (uint32_t i = SIDES; i-- > 0;)
        add_corner(s, PIPE_AT + 2 * i + 1);
    end_face(s);
}

/* Adds an open patch of a sphere, with its concave side towards the camera. */
static void make_patch(struct open_set *s)
{
    for (uint32_t i = 0; i < PATCH_POINTS; i++) {
        const uint32_t column = i % (PATCH + 1), row = i / (PATCH + 1), at = PATCH_AT + i;
        const float u = (float)column / PATCH - 0.5f, v = (float)row / PATCH - 0.5f;
        s->positions[at] = (zr_vec4){1.1f - sqrtf(0.64f - u * u - v * v), v + 0.7f, u + 0.5f, 1};
        if (column < PATCH && row < PATCH) add_quad(s, at, at + 1, at + PATCH + 2, at + PATCH + 1);
    }
}

static const struct zr_scene *make_open(struct zr_arena *arena, const struct zr_look *look, uint32_t width,
                                        uint32_t height)
{
    struct open_set *s = zr_arena_zero(arena, 1, sizeof *s);
    if (!s) return NULL;
    make_plane(s);
    make_pipe(s);
    make_patch(s);
    s->positions[WIRE_AT] = (zr_vec4){-1.5f, 0.1f, 1.3f, 1};
    s->positions[WIRE_AT + 1] = (zr_vec4){1.5f, 1.3f, -1.2f, 1};
    s->lines[0] = WIRE_AT, s->lines[1] = WIRE_AT + 1;
    s->mesh = (struct zr_mesh){.name = "",
                               .position_count = OPEN_POINTS,
                               .positions = s->positions,
                               .face_count = OPEN_FACES,
                               .face_offsets = s->face_offsets,
                               .indices = s->indices,
                               .line_count = 1,
                               .lines = s->lines};
    const struct zr_scene *scene = put_on_stage(&s->stage, &s->mesh, look, width, height);
    s->stage.material.double_sided = true;
    return scene;
}

const char *const look_scene_names[LOOK_SCENES] = {"solids", "open"};

const struct zr_scene *look_scene(struct zr_arena *arena, int number, const struct zr_look *look, uint32_t width,
                                  uint32_t height)
{
    return number == 0 ? make_solids(arena, look, width, height) : make_open(arena, look, width, height);
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
