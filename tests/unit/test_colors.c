/* Colours of whole meshes: whatever is lit together, each has the colour that it has alone. */
#include <string.h>

#include "base/rgba.h"
#include "guarded.h"
#include "light_one.h"
#include "mesh/face_normals.h"
#include "shade/colors.h"
#include "support/isas.h"
#include "support/random.h"

/* More than is lit at once, some times over. */
enum { POSITIONS = 129, FACES = 193, CORNERS_MOST = 5, MATERIALS = 4, NORMALS = 9 };

static struct random numbers = {{RANDOM_STATE_1}};

static bool coin(void)
{
    return random_below(&numbers, 2) == 1;
}

static float any(void)
{
    return (float)random_below(&numbers, 1001) / 1000.0f;
}

/* A mesh and what it needs, which stays where it is. */
struct subject {
    struct zr_scene scene;
    struct zr_mesh mesh;
    struct zr_material materials[MATERIALS];
    struct zr_light lights[ZR_LIGHTS_MAX];
    zr_mat4 object_to_eye;
    zr_vec4 positions[POSITIONS], colors[POSITIONS], face_colors[FACES];
    uint32_t offsets[FACES + 1], indices[FACES * CORNERS_MOST], face_materials[FACES];
    zr_vec3 normals[POSITIONS];
    uint32_t normal_indices[FACES * CORNERS_MOST];
};

static void make_look(struct subject *s)
{
    static const uint32_t light_counts[] = {0, 1, 3, ZR_LIGHTS_MAX};
    static const zr_vec4 white = {1, 1, 1, 1};
    s->scene = (struct zr_scene){.materials = s->materials,
                                 .material_count = MATERIALS,
                                 .lights = s->lights,
                                 .light_count = light_counts[random_below(&numbers, 4)],
                                 .ambient = {0.1f, 0.2f, 0.0f}};
    for (uint32_t i = 0; i < s->scene.light_count; i++)
        s->lights[i] = (struct zr_light){.direction = {any() - 0.5f, any() - 0.5f, any() - 0.4f},
                                         .color = {any(), any(), any()},
                                         .camera_frame = coin()};
    for (int i = 0; i < MATERIALS; i++) {
        static const enum zr_shading shadings[] = {ZR_SHADING_UNLIT, ZR_SHADING_FLAT, ZR_SHADING_GOURAUD};
        s->materials[i] = (struct zr_material){.base_color = i == 0 ? white : (zr_vec4){any(), any(), any(), any()},
                                               .shading = shadings[random_below(&numbers, 3)]};
    }
}

static void make_mesh(struct subject *s)
{
    const bool only_triangles = coin();
    for (int i = 0; i < 16; i++)
        s->object_to_eye.m[i] = any() - 0.5f;
    for (int i = 0; i < POSITIONS; i++) {
        s->positions[i] = (zr_vec4){any(), any(), any(), 1};
        s->colors[i] = (zr_vec4){any(), any(), any(), 1};
        s->normals[i] = random_below(&numbers, 8) ? (zr_vec3){any() - 0.5f, any(), any()} : (zr_vec3){0, 0, 0};
    }
    s->offsets[0] = 0;
    for (int i = 0; i < FACES; i++) {
        s->offsets[i + 1] = s->offsets[i] + (only_triangles ? 3 : 3 + random_below(&numbers, 3));
        s->face_colors[i] = (zr_vec4){any(), any(), any(), 1};
        s->face_materials[i] =
            i > 0 && random_below(&numbers, 5) ? s->face_materials[i - 1] : random_below(&numbers, 4);
    }
    for (int i = 0; i < FACES * CORNERS_MOST; i++) {
        s->indices[i] = random_below(&numbers, POSITIONS);
        s->normal_indices[i] = random_below(&numbers, NORMALS);
    }
    s->mesh = (struct zr_mesh){.position_count = POSITIONS,
                               .positions = s->positions,
                               .face_count = FACES,
                               .face_offsets = s->offsets,
                               .indices = s->indices,
                               .colors = coin() ? s->colors : NULL,
                               .face_colors = coin() ? s->face_colors : NULL,
                               .face_materials = coin() ? s->face_materials : NULL,
                               .material = random_below(&numbers, MATERIALS)};
    if (coin()) return;
    s->mesh.normals = s->normals;
    s->mesh.normal_indices = coin() ? s->normal_indices : NULL;
    s->mesh.normal_count = s->mesh.normal_indices ? NORMALS : POSITIONS;
}

/* The sum of the normals of the faces around it, of unit length. */
static zr_vec3 computed_normal(const struct zr_mesh *mesh, uint32_t vertex)
{
    zr_vec3 sum = {0, 0, 0};
    for (uint32_t f = 0; f < mesh->face_count; f++)
        for (uint32_t slot = mesh->face_offsets[f]; slot < mesh->face_offsets[f + 1]; slot++)
            if (mesh->indices[slot] == vertex) sum = zr_vec3_add(sum, zr_normal_of_face(mesh, f));
    return zr_vec3_normalize(sum);
}

static zr_vec3 normal_at(const struct zr_mesh *mesh, uint32_t vertex, uint32_t slot)
{
    if (mesh->normal_count > 0) {
        const zr_vec3 n = mesh->normals[mesh->normal_indices ? mesh->normal_indices[slot] : vertex];
        if (n.x != 0.0f || n.y != 0.0f || n.z != 0.0f) return n;
    }
    return computed_normal(mesh, vertex);
}

/* What the colours of a mesh are held against. */
struct expected {
    const struct subject *subject;
    struct zr_lights lighting;
    struct zr_normal_matrix to_eye;
    struct zr_colors got;
};

static void check(const struct expected *e, uint32_t at, const struct zr_material *material, zr_vec3 normal,
                  zr_vec4 base)
{
    zr_vec4 front = base, back = base;
    if (material->shading != ZR_SHADING_UNLIT) light_one(&e->lighting, &e->to_eye, normal, base, &front, &back);
    if (memcmp(&e->got.front[at], &front, sizeof front) != 0) fail_msg("front %u, layout %d", at, e->got.rate);
    if (memcmp(&e->got.back[at], &back, sizeof back) != 0) fail_msg("back %u, layout %d", at, e->got.rate);
}

static void check_face(const struct expected *e, uint32_t face)
{
    const struct zr_mesh *mesh = &e->subject->mesh;
    const struct zr_material *material = zr_material_of_face(&e->subject->scene, mesh, face);
    const uint32_t begin = mesh->face_offsets[face];
    zr_vec4 base = material->base_color;
    if (mesh->face_colors) base = zr_vec4_mul(base, mesh->face_colors[face]);
    if (!zr_material_is_smooth(mesh, material)) {
        if (mesh->colors) base = zr_vec4_mul(base, mesh->colors[mesh->indices[begin]]);
        check(e, e->got.rate == ZR_RATE_FACE ? face : begin, material, zr_normal_of_face(mesh, face), base);
        return;
    }
    for (uint32_t slot = begin; slot < mesh->face_offsets[face + 1]; slot++) {
        const uint32_t vertex = mesh->indices[slot];
        check(e, e->got.rate == ZR_RATE_VERTEX ? vertex : slot, material, normal_at(mesh, vertex, slot),
              mesh->colors ? zr_vec4_mul(base, mesh->colors[vertex]) : base);
    }
}

/* As bytes, where that will do: those of the floats. Returns whether it does. */
static int check_packed(const struct expected *e, struct zr_team *team)
{
    const struct subject *s = e->subject;
    const bool flat = e->got.rate == ZR_RATE_FACE;
    assert_int_equal(zr_colors_can_be_packed(&s->scene, &s->mesh), flat);
    for (int sided = 0; sided <= 1 && flat; sided++) {
        const uint32_t blank[2 * FACES] = {0};
        struct guarded out = guarded_copy(blank, ((size_t)FACES << sided) * sizeof *blank);
        const struct zr_colors got = zr_colors_make_packed(team, NULL, &s->scene, &s->mesh, &e->lighting,
                                                           &s->object_to_eye, sided, (uint32_t *)(void *)out.bytes);
        assert_true(got.rate == ZR_RATE_FACE && got.count == FACES && got.sided == sided && got.packed);
        for (uint32_t face = 0; face < FACES; face++) {
            assert_int_equal(got.packed[face], zr_rgba_opaque(e->got.front[face]));
            if (sided) assert_int_equal(got.packed[FACES + face], zr_rgba_opaque(e->got.back[face]));
        }
        guarded_free(&out);
    }
    return flat;
}

static void colors_of_meshes_are_those_of_each_face_alone(void **state)
{
    static struct subject subject;
    static const zr_vec4 blank[FACES * CORNERS_MOST];
    const enum zr_isa isa = isa_under_test(state);
    struct zr_team *team = zr_team_create_for(3, isa);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 20);
    int layouts = 0, packed = 0;
    for (int round = 0; round < 500; round++) {
        const struct zr_camera camera = {.world_to_eye = zr_mat4_identity()};
        make_look(&subject);
        make_mesh(&subject);
        const size_t size = zr_colors_count(&subject.scene, &subject.mesh) * sizeof *blank;
        struct guarded front = guarded_copy(blank, size), back = guarded_copy(blank, size),
                       indices = guarded_copy(subject.indices, subject.offsets[FACES] * sizeof *subject.indices);
        subject.mesh.indices = (const uint32_t *)(const void *)indices.bytes;
        struct expected e = {.subject = &subject, .to_eye = zr_normal_matrix_make(&subject.object_to_eye)};
        zr_arena_reset(&arena, 1 << 20);
        e.lighting = zr_lights_make(&arena, &subject.scene, &camera);
        const zr_vec4 *normals = NULL;
        e.got = zr_colors_make(&arena, team, NULL, &subject.scene, &subject.mesh, &e.lighting, &subject.object_to_eye,
                               &normals, (zr_vec4 *)(void *)front.bytes, (zr_vec4 *)(void *)back.bytes);
        layouts |= 1 << e.got.rate;
        for (uint32_t face = 0; face < FACES; face++)
            check_face(&e, face);
        packed += check_packed(&e, team);
        guarded_free(&front);
        guarded_free(&back);
        guarded_free(&indices);
    }
    assert_int_equal(layouts, 1 << ZR_RATE_FACE | 1 << ZR_RATE_VERTEX | 1 << ZR_RATE_CORNER);
    assert_true(packed > 20);
    zr_arena_free(&arena);
    zr_team_destroy(team);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(colors_of_meshes_are_those_of_each_face_alone),
    };
    return cmocka_run_group_tests_name("colors", tests, NULL, NULL);
}
