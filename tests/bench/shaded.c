#include "bench/shaded.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/run.h"
#include "reference/generate/batches.h"
#include "reference/gl/look_twin.h"
#include "reference/gl/reference_gl.h"
#include "reference/gl/reference_texture.h"
#include "scene/camera/resolved_view.h"
#include "scene/picture.h"
#include "shade/lights/light.h"

enum { POSITIONS, COLORS, NORMALS, TEXCOORDS, INDICES };
_Static_assert(INDICES + 1 == SHADED_BUFFERS, "a buffer each");

static const size_t ARENA_BYTES = (size_t)1 << 30;

static bool complain(const struct reference_error *error)
{
    fprintf(stderr, "reference: %s\n", error->text);
    return false;
}

bool shaded_open(struct shaded *shaded, bool exact, int threads)
{
    struct reference_error error = {""};
    const struct reference_options options = {.driver = "llvmpipe", .native = !exact, .threads = threads};
    *shaded = (struct shaded){.reference = reference_open(&options, &error)};
    zr_arena_init(&shaded->arena, ARENA_BYTES);
    return shaded->reference || complain(&error);
}

/* ---- what is drawn ---- */

static void upload(GLuint buffer, const void *bytes, size_t size)
{
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, bytes, GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

/* Arrays of all meshes, one behind the other. first[i]: where the corners of mesh i begin. */
struct joined {
    uint32_t vertex_count, corner_count, *first;
    zr_vec4 *positions, *colors, *texcoords;
    zr_vec3 *normals;
    uint32_t *indices;
};

static bool make_room(struct zr_arena *arena, const struct zr_scene *scene, struct joined *joined)
{
    uint32_t vertices = 0, corners = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        vertices += scene->meshes[i].position_count;
        corners += 3 * scene->meshes[i].face_count;
    }
    *joined = (struct joined){.first = zr_arena_alloc(arena, scene->mesh_count, sizeof *joined->first),
                              .positions = zr_arena_alloc(arena, vertices, sizeof(zr_vec4)),
                              .colors = zr_arena_alloc(arena, vertices, sizeof(zr_vec4)),
                              .texcoords = zr_arena_zero(arena, vertices, sizeof(zr_vec4)),
                              .normals = zr_arena_alloc(arena, vertices, sizeof(zr_vec3)),
                              .indices = zr_arena_alloc(arena, corners, sizeof(uint32_t))};
    return zr_arena_ok(arena);
}

static void append_mesh(const struct zr_scene *scene, uint32_t number, struct joined *joined)
{
    const struct zr_mesh *mesh = &scene->meshes[number];
    const uint32_t first = joined->vertex_count;
    joined->first[number] = joined->corner_count;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        zr_vec4 color = scene->materials[mesh->material].base_color;
        if (mesh->colors) color = zr_vec4_mul(color, mesh->colors[i]);
        joined->positions[first + i] = mesh->positions[i];
        joined->colors[first + i] = color;
        joined->normals[first + i] = mesh->normals[i];
        if (mesh->texcoords) joined->texcoords[first + i] = mesh->texcoords[i];
    }
    for (uint32_t i = 0; i < 3 * mesh->face_count; i++)
        joined->indices[joined->corner_count + i] = first + mesh->indices[i];
    joined->vertex_count += mesh->position_count;
    joined->corner_count += 3 * mesh->face_count;
}

/* Into buffer objects; *joined tells where everything is. */
static bool keep_meshes(struct shaded *shaded, struct joined *joined)
{
    if (!make_room(&shaded->arena, shaded->scene, joined)) return false;
    for (uint32_t i = 0; i < shaded->scene->mesh_count; i++)
        append_mesh(shaded->scene, i, joined);
    glGenBuffers(SHADED_BUFFERS, shaded->buffers);
    upload(shaded->buffers[POSITIONS], joined->positions, joined->vertex_count * sizeof(zr_vec4));
    upload(shaded->buffers[COLORS], joined->colors, joined->vertex_count * sizeof(zr_vec4));
    upload(shaded->buffers[NORMALS], joined->normals, joined->vertex_count * sizeof(zr_vec3));
    upload(shaded->buffers[TEXCOORDS], joined->texcoords, joined->vertex_count * sizeof(zr_vec4));
    upload(shaded->buffers[INDICES], joined->indices, joined->corner_count * sizeof(uint32_t));
    return true;
}

/* The matrices of an instance: batches point to them. */
struct placement {
    zr_mat4 object_to_eye;
    struct zr_normal_matrix normals;
};

static struct reference_batch batch_of(const struct shaded *shaded, const struct joined *joined, uint32_t number,
                                       struct placement *placement)
{
    const struct zr_instance *instance = &shaded->scene->instances[number];
    const struct zr_mesh *mesh = &shaded->scene->meshes[instance->mesh];
    const struct zr_material *material = &shaded->scene->materials[mesh->material];
    placement->object_to_eye = zr_mat4_mul(&shaded->camera.world_to_eye, &instance->object_to_world);
    placement->normals = zr_normal_matrix_make(&placement->object_to_eye);
    return (struct reference_batch){.mode = REFERENCE_TRIANGLES,
                                    .first = joined->first[instance->mesh],
                                    .count = 3 * mesh->face_count,
                                    .modelview = &placement->object_to_eye,
                                    .to_eye = &placement->object_to_eye,
                                    .light = material->double_sided ? REFERENCE_LIT : REFERENCE_LIT_FRONT,
                                    .normal_rows = placement->normals.rows,
                                    .late = material,
                                    .material = material,
                                    .textured = zr_material_has_textures(material) ? material : NULL,
                                    .eye = zr_camera_eye(&shaded->camera),
                                    .smooth = true,
                                    .cull = !material->double_sided};
}

static bool make_batches(struct shaded *shaded, const struct joined *joined)
{
    const struct zr_scene *scene = shaded->scene;
    const struct batches_options options = {.purpose = BATCHES_COLORS};
    struct reference_batch *batches = zr_arena_alloc(&shaded->arena, scene->instance_count, sizeof *batches);
    struct placement *placements = zr_arena_alloc(&shaded->arena, scene->instance_count, sizeof *placements);
    if (!batches || !placements) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        batches[i] = batch_of(shaded, joined, i, &placements[i]);
    shaded->arrays =
        (struct reference_arrays){.lighting = batches_light(&shaded->arena, scene, &shaded->camera, &options),
                                  .textures_of = scene,
                                  .batch_count = scene->instance_count,
                                  .batches = batches,
                                  .projection = shaded->camera.projection,
                                  .background = scene->background};
    return shaded->arrays.lighting != NULL;
}

/* ---- programs ---- */

static const char *constants_of_phong(const struct shaded *shaded)
{
    static char text[256];
    const struct reference_batch *batch = &shaded->arrays.batches[0];
    snprintf(text, sizeof text,
             "#define FIXED\n"
             "const int light_count = %u, side = %d, model = 0, in_fog = 0;\n"
             "const bool textured = %s;\n",
             shaded->arrays.lighting->count, batch->light == REFERENCE_LIT ? 0 : 1, batch->textured ? "true" : "false");
    return text;
}

/* Uniforms that constants stand for are not there. */
static bool make_linear_program(struct shaded *shaded, struct reference_error *error)
{
    static const float toes[] = {[ZR_TONE_NONE] = -1.0f, [ZR_TONE_KHRONOS] = 0.04f, [ZR_TONE_NEUTRAL] = 0.02f};
    char text[512];
    const struct reference_batch *batch = &shaded->arrays.batches[0];
    const struct zr_picture *picture = shaded->scene->picture;
    const struct look_twin twin = {.scene = shaded->scene, .camera = &shaded->camera};
    snprintf(
        text, sizeof text,
        "#define FIXED\n"
        "const float side = %d.0, toe = %f, environment = %d.0, lamp_count = %u.0;\n"
        "const float has[14] = float[14](%d.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);\n"
        "const float second[14] = float[14](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);\n"
        "const int shading = %d;\n",
        batch->light == REFERENCE_LIT ? 0 : 1, (double)toes[picture->tone], (int)picture->environment.name,
        shaded->scene->light_count, batch->textured ? 1 : 0, (int)ZR_SHADING_PBR);
    shaded->program = look_program_fixed(text, error);
    if (!shaded->program) return false;
    const struct reference_uniform *uniforms = look_twin_uniforms(&twin);
    glUseProgram(shaded->program);
    for (int i = 0; i < LOOK_UNIFORMS; i++)
        if (glGetUniformLocation(shaded->program, uniforms[i].name) >= 0 &&
            !reference_uniform_set(shaded->program, &uniforms[i], error))
            return false;
    return true;
}

/* What is written in linear light is encoded as it is stored. */
static void store_encoded(const struct reference *reference)
{
    glBindRenderbuffer(GL_RENDERBUFFER, reference->color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, (GLsizei)reference->width, (GLsizei)reference->height);
    glEnable(GL_FRAMEBUFFER_SRGB);
}

static bool make_program(struct shaded *shaded, struct reference_error *error)
{
    shaded->reference->fixed = constants_of_phong(shaded);
    if (!shaded->scene->picture->is_linear) return true;
    store_encoded(shaded->reference);
    return make_linear_program(shaded, error);
}

bool shaded_take(struct shaded *shaded, const struct zr_scene *scene)
{
    struct reference_error error = {"out of memory"};
    const struct zr_resolved_view *resolved = NULL;
    struct zr_error unresolved = {.status = ZR_OK};
    struct joined joined;
    shaded->scene = scene;
    if (zr_resolved_view_find(&(struct zr_run){.arena = &shaded->arena, .error = &unresolved}, scene, &resolved) !=
        ZR_OK)
        return false;
    shaded->camera = resolved->camera;
    if (!reference_resize(shaded->reference, scene->views[0].width, scene->views[0].height, false, &error) ||
        !keep_meshes(shaded, &joined) || !make_batches(shaded, &joined))
        return complain(&error);
    if (scene->texture_count > 0) {
        shaded->textures = reference_textures_make(scene, scene->picture->is_linear, &error);
        if (!shaded->textures) return complain(&error);
    }
    return make_program(shaded, &error) || complain(&error);
}

/* ---- drawing ---- */

static void point_at_buffers(const struct shaded *shaded)
{
    glBindBuffer(GL_ARRAY_BUFFER, shaded->buffers[POSITIONS]);
    glVertexPointer(4, GL_FLOAT, 0, NULL);
    glBindBuffer(GL_ARRAY_BUFFER, shaded->buffers[COLORS]);
    glColorPointer(4, GL_FLOAT, 0, NULL);
    glBindBuffer(GL_ARRAY_BUFFER, shaded->buffers[NORMALS]);
    glNormalPointer(GL_FLOAT, 0, NULL);
    glBindBuffer(GL_ARRAY_BUFFER, shaded->buffers[TEXCOORDS]);
    glTexCoordPointer(4, GL_FLOAT, 0, NULL);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, shaded->buffers[INDICES]);
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
}

static void draw_batch(const struct reference_batch *batch)
{
    glLoadMatrixf(batch->modelview->m);
    if (batch->cull)
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, (GLsizei)batch->count, GL_UNSIGNED_INT,
                   (const void *)(batch->first * sizeof(uint32_t)));
}

static bool finish(const char *what)
{
    struct reference_error error = {""};
    glUseProgram(0);
    glFinish();
    return reference_gl_ok(&error, what) || complain(&error);
}

bool shaded_draw(struct shaded *shaded)
{
    struct reference_error error = {""};
    const struct reference_arrays *arrays = &shaded->arrays;
    if (!shaded->program && !reference_light_begin(shaded->reference, arrays, &error)) return complain(&error);
    glClearColor(arrays->background.x, arrays->background.y, arrays->background.z, arrays->background.w);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(arrays->projection.m);
    glMatrixMode(GL_MODELVIEW);
    point_at_buffers(shaded);
    for (uint32_t i = 0; i < arrays->batch_count; i++) {
        const struct reference_batch *batch = &arrays->batches[i];
        if (batch->textured) reference_textures_bind(shaded->textures, batch->textured);
        if (shaded->program)
            reference_program_batch(shaded->program, batch, shaded->scene);
        else
            reference_light_batch(shaded->reference, arrays, batch);
        draw_batch(batch);
    }
    return finish("draw");
}

bool shaded_draw_ids(struct shaded *shaded)
{
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glDepthFunc(GL_EQUAL);
    glDisableClientState(GL_COLOR_ARRAY);
    for (uint32_t i = 0; i < shaded->arrays.batch_count; i++) {
        const uint32_t id = i + 1;
        glColor4ub((GLubyte)id, (GLubyte)(id >> 8), (GLubyte)(id >> 16), (GLubyte)(id >> 24));
        draw_batch(&shaded->arrays.batches[i]);
    }
    glEnableClientState(GL_COLOR_ARRAY);
    glDepthFunc(GL_LESS);
    return finish("draw ids");
}
