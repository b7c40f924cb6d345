/* zraster-uninitialised: reads a scene, draws it with all channels that it can have, encodes them, and writes them
 * away, on one thread, so that valgrind sees every use of a value that was never written. Memory is new: nothing is
 * left in it by earlier work.
 *
 *     zraster-uninitialised SCENE.json [LEFT]
 *
 * With LEFT something is left unwritten on purpose: `position`, a coordinate of the scene, `color`, the red of its
 * materials, or `pixel`, a word of a channel. valgrind must find that, or it would find nothing else. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core.h"
#include "render_request.h"
#include "scene/output.h"
#include "support/files.h"

#include "base/run.h"
#include "scene/scene.h"
#include "shade/frame.h"

static const size_t ceiling = (size_t)1 << 31;
static struct zr_output outputs[ZR_CHANNEL_COUNT];

/* Each channel once, as the scene has it, if it asks for it. */
static uint32_t list_outputs(const struct zr_scene *scene)
{
    const struct zr_view *view = &scene->views[0];
    uint32_t count = 0;
    for (int c = 0; c < (scene->base ? ZR_CHANNEL_INFO + 1 : ZR_CHANNEL_COUNT); c++) {
        const enum zr_channel channel = (enum zr_channel)c;
        const struct zr_output *given = zr_view_output(view, channel);
        const bool needs_layers =
            channel == ZR_CHANNEL_LAYERS || channel == ZR_CHANNEL_THICKNESS || channel == ZR_CHANNEL_FRAGMENTS;
        if (channel == ZR_CHANNEL_TRACE && !given) continue; /* few scenes are that small */
        if (needs_layers && scene->algorithm == ZR_ALGORITHM_PAINTER) continue;
        if (scene->base && !given) continue; /* the base may lack it */
        outputs[count] = given ? *given
                               : (struct zr_output){.channel = channel,
                                                    .encoding = zr_channel_rows[c].encodings[0],
                                                    .space = ZR_SPACE_CAMERA};
        if (channel == ZR_CHANNEL_FRAGMENTS && !given)
            outputs[count].x = view->width / 2, outputs[count].y = view->height / 2;
        count++;
    }
    return count;
}

/* Its first coordinate is what nobody has written. */
static void leave_position(struct zr_arena *arena, struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_alloc(arena, scene->mesh_count, sizeof *meshes);
    const size_t count = scene->meshes[0].position_count;
    zr_vec4 *positions = zr_arena_alloc(arena, count, sizeof *positions);
    if (!meshes || !positions) return;
    memcpy(meshes, scene->meshes, scene->mesh_count * sizeof *meshes);
    memcpy((char *)positions + sizeof(float), (const char *)scene->meshes[0].positions + sizeof(float),
           count * sizeof *positions - sizeof(float));
    meshes[0].positions = positions;
    scene->meshes = meshes;
}

static void leave_color(struct zr_arena *arena, struct zr_scene *scene)
{
    struct zr_material *materials = zr_arena_alloc(arena, scene->material_count, sizeof *materials);
    for (uint32_t i = 0; materials && i < scene->material_count; i++) {
        const float unwritten = materials[i].base_color.x;
        materials[i] = scene->materials[i];
        materials[i].base_color.x = unwritten;
    }
    scene->materials = materials;
}

/* The arena may reuse memory that was written before. */
static void leave_pixel(const struct zr_frame *frame)
{
    float *unwritten = realloc(NULL, sizeof *unwritten);
    if (unwritten) memcpy(frame->depth, unwritten, sizeof *unwritten);
    free(unwritten);
}

/* What is not looked at by anything before is by the system, as valgrind has it. */
static bool write_away(const struct zr_answer *answer)
{
    const int file = open("/dev/null", O_WRONLY);
    const bool good = file >= 0 && write(file, answer->bytes, answer->size) == (ssize_t)answer->size;
    if (file >= 0) close(file);
    return good;
}

static enum zr_status draw(struct zr_arena *arena, const struct zr_request *request, const char *left,
                           struct zr_error *error)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *read;
    const struct zr_frame *frame;
    struct zr_answer answer;
    enum zr_status status = zr_scene_read(&(struct zr_run){.arena = arena, .error = error}, request, &limits, &read);
    if (status != ZR_OK) return status;
    struct zr_scene scene = *read;
    scene.views[0].output_count = list_outputs(read);
    scene.views[0].outputs = outputs;
    if (strcmp(left, "position") == 0) leave_position(arena, &scene);
    if (strcmp(left, "color") == 0) leave_color(arena, &scene);
    status = zr_render(&(struct zr_run){.arena = arena, .error = error}, &scene, NULL, &frame);
    if (status != ZR_OK) return status;
    if (strcmp(left, "pixel") == 0) leave_pixel(frame);
    status = zr_encode(&(struct zr_run){.arena = arena, .error = error}, &scene, frame, &answer);
    return status == ZR_OK && !write_away(&answer) ? ZR_INTERNAL : status;
}

int main(int count, char **arguments)
{
    struct zr_request request = {.format = ZR_FORMAT_JSON};
    struct zr_error error = {.count = 0};
    struct zr_arena arena;
    if (count < 2 || count > 3) return 2;
    char *bytes = file_read(arguments[1], &request.size);
    if (!bytes) {
        fprintf(stderr, "%s: cannot be read\n", arguments[1]);
        return 2;
    }
    request.bytes = bytes;
    zr_arena_init(&arena, ceiling);
    const enum zr_status status = draw(&arena, &request, count > 2 ? arguments[2] : "", &error);
    if (status != ZR_OK)
        fprintf(stderr, "%s: %s %s\n", arguments[1], error.items[0].pointer, error.count ? error.items[0].detail : "");
    zr_arena_free(&arena);
    free(bytes);
    return status == ZR_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
