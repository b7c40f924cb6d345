/* Points and normals that are made when they are loaded have the bytes of those in arrays: each scene of tests/scenes
 * is drawn again with unused vertices, so many that nothing is kept in arrays. */
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "shade/draw_attributes.h"
#include "support/files.h"
#include "support/scenes.h"
#include "support/tests.h"

static const size_t ceiling = (size_t)1 << 31;
static struct zr_arena arena;
static struct zr_output outputs[] = {
    {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
    {.channel = ZR_CHANNEL_NORMALS, .encoding = ZR_ENCODING_NPY, .space = ZR_SPACE_OBJECT}};

/* The scene points into the bytes. */
static struct zr_scene read_scene(const char *name, const char *bytes, size_t size)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = bytes, .size = size};
    const struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    if (zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene) != ZR_OK)
        fail_msg("%s: %s %s", name, error.items[0].pointer, error.items[0].detail);
    struct zr_scene out = *scene;
    out.views[0].outputs = outputs;
    out.views[0].output_count = out.base ? 1 : 2;
    return out;
}

/* Returns `count` items of `size` bytes followed by copies of the first. NULL stays NULL. */
static const void *lengthened(const void *items, size_t count, size_t size)
{
    if (!items || count == 0) return items;
    char *out = zr_arena_alloc(&arena, count + ZR_LOADED_VERTICES, size);
    memcpy(out, items, count * size);
    for (size_t i = count; i < count + ZR_LOADED_VERTICES; i++)
        memcpy(out + i * size, items, size);
    return out;
}

static void add_vertices(struct zr_mesh *mesh)
{
    const size_t count = mesh->position_count;
    const bool has_normals = mesh->normal_count > 0 && !mesh->normal_indices;
    if (count == 0) return;
    mesh->positions = lengthened(mesh->positions, count, sizeof *mesh->positions);
    mesh->texcoords = lengthened(mesh->texcoords, count, sizeof *mesh->texcoords);
    mesh->tangents = lengthened(mesh->tangents, count, sizeof *mesh->tangents);
    mesh->colors = lengthened(mesh->colors, count, sizeof *mesh->colors);
    if (has_normals) {
        mesh->normals = lengthened(mesh->normals, mesh->normal_count, sizeof *mesh->normals);
        mesh->normal_count += ZR_LOADED_VERTICES;
    }
    mesh->position_count += ZR_LOADED_VERTICES;
}

static void compare(const char *name, const struct zr_scene *scene, struct zr_team *const teams[ZR_ISA_COUNT])
{
    const struct zr_frame *want = scene_render(&arena, NULL, scene);
    const size_t pixels = (size_t)want->width * want->height;
    struct zr_mesh *meshes = zr_arena_copy(&arena, scene->meshes, scene->mesh_count * sizeof *meshes);
    struct zr_scene larger = *scene;
    assert_non_null(meshes);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        add_vertices(&meshes[i]);
    larger.meshes = meshes;
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++) {
        if (!teams[isa]) continue;
        const struct zr_frame *got = scene_render(&arena, teams[isa], &larger);
        for (uint32_t i = 0; i < scene->views[0].output_count; i++) {
            const enum zr_channel c = outputs[i].channel;
            if (memcmp(got->channels[c], want->channels[c], pixels * 4 * zr_channel_rows[c].words) != 0)
                fail_msg("%s: other bytes of %s by %s", name, zr_channel_rows[c].name, zr_isa_name((enum zr_isa)isa));
        }
    }
    zr_arena_reset(&arena, ceiling);
}

static void compare_file(const char *path, void *context)
{
    size_t size;
    char *bytes = file_read(path, &size);
    assert_non_null(bytes);
    const struct zr_scene scene = read_scene(path, bytes, size);
    compare(path, &scene, context);
    free(bytes);
}

static void compare_text(const char *text, struct zr_team *const teams[ZR_ISA_COUNT])
{
    const struct zr_scene scene = read_scene("text", text, strlen(text));
    compare("text", &scene, teams);
}

/* A perspective whose eye is not the origin of eye space. */
static const char eye_elsewhere[] =
    "{\"window\":{\"width\":90,\"height\":70},\"look\":\"studio\",\"view\":{\"projectionMatrix\":"
    "[[1,0.2,0.1,0],[0,1,0.3,0],[0.1,0.1,0,0.5],[0.1,0.2,0.3,4]]},\"meshes\":[{\"positions\":"
    "[[-1,-1,-1],[-1,-1,1],[-1,1,-1],[-1,1,1],[1,-1,-1],[1,-1,1],[1,1,-1],[1,1,1]],"
    "\"faces\":[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]}]}";

TEST(scenes_with_many_unused_vertices_have_the_same_pixels)
{
    struct zr_team *teams[ZR_ISA_COUNT] = {NULL};
    zr_arena_init(&arena, ceiling);
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        if (zr_isa_is_available((enum zr_isa)isa)) teams[isa] = zr_team_create_for(2, (enum zr_isa)isa);
    assert_true(files_each("tests/scenes", ".json", compare_file, teams) > 30);
    compare_text(eye_elsewhere, teams);
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        zr_team_destroy(teams[isa]);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
