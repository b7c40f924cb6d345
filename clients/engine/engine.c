#include "engine.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interruption.h"
#include "options/memory.h"
#include "options/query.h"
#include "options/wording.h"
#include "post.h"

/* ---- opening ---- */

/* More than the default: a game's scene has tens of textures of 2048 x 2048, and the command serves one user. A texel
 * takes 4 bytes, and a third more for smaller levels. */
#define IMAGE_PIXELS_MAX ((uint64_t)1 << 28)

size_t engine_memory(const struct options *options, size_t at_once)
{
    const char *given = options->own[OPTION_MEMORY];
    const size_t spare = zraster_spare_memory();
    size_t bytes = 0;
    if (!given && at_once == 1) return 0;
    memory_read(given ? given : "75%", spare == SIZE_MAX ? (size_t)1 << 32 : spare, &bytes);
    return bytes / at_once;
}

int engine_open(struct engine *engine, const struct options *options, unsigned threads, size_t at_once)
{
    struct zraster_options wanted = {.struct_size = sizeof wanted,
                                     .memory_max = engine_memory(options, at_once),
                                     .threads = threads,
                                     .image_pixels_max = IMAGE_PIXELS_MAX};
    *engine = (struct engine){.server = options->own[OPTION_SERVER]};
    interruption_catch();
    if (engine->server)
        return token_read(&engine->token, options->own[OPTION_TOKEN_FILE]) ? post_open() : STATUS_FAILED;
    engine->cancel = zraster_cancel_new();
    interruption_raises(engine->cancel);
    if (!engine->cancel || zraster_open(&wanted, &engine->renderer) != ZRASTER_OK) {
        fputs("zraster: out of memory\n", stderr);
        return STATUS_FAILED;
    }
    return 0;
}

void engine_close(struct engine *engine)
{
    if (engine->server) post_close();
    zraster_close(engine->renderer);
    interruption_raises(NULL);
    zraster_cancel_free(engine->cancel);
}

/* ---- drawing ---- */

static void take_picture(struct answer *answer)
{
    const char *warning;
    for (size_t i = 0; (warning = zraster_picture_warning(answer->picture, i)) != NULL; i++)
        bytes_print(&answer->warnings, "%s\n", warning);
    snprintf(answer->look, sizeof answer->look, "%s", zraster_picture_look(answer->picture));
}

/* Returns a request whose parts are in `parts`. */
static struct zraster_request request_of(const struct engine *engine, const struct input *input, const char *query,
                                         struct zraster_part parts[INPUT_PARTS_MAX])
{
    return (struct zraster_request){.struct_size = sizeof(struct zraster_request),
                                    .body = input->body.data,
                                    .body_size = input->body.size,
                                    .type = input->is_known ? input->type : NULL,
                                    .query = query,
                                    .parts = parts,
                                    .part_count = input_parts(input, parts),
                                    .cancel = engine->cancel};
}

zraster_status engine_read_here(const struct engine *engine, const struct input *input, const char *query,
                                zraster_scene **scene, zraster_error **error)
{
    struct zraster_part parts[INPUT_PARTS_MAX];
    const struct zraster_request request = request_of(engine, input, query, parts);
    return zraster_scene_read(engine->renderer, &request, scene, error);
}

zraster_status engine_draw_here(const struct engine *engine, const struct input *input, const char *query,
                                zraster_picture **picture, struct zraster_bytes *file, zraster_error **error)
{
    struct zraster_part parts[INPUT_PARTS_MAX];
    struct zraster_request request = request_of(engine, input, query, parts);
    request.progress = engine->progress;
    request.progress_context = engine->progress_context;
    const zraster_status status = zraster_draw(engine->renderer, &request, picture, error);
    return status == ZRASTER_OK ? zraster_picture_encode(*picture, NULL, file, error) : status;
}

/* Adds the spare memory of the system, and --memory if it can help. */
static void advise(struct answer *answer)
{
    const size_t spare = zraster_spare_memory();
    const bool has_limit = strstr(bytes_text(&answer->faults), "may use") != NULL;
    if (spare != SIZE_MAX)
        bytes_print(&answer->faults,
                    has_limit ? "\n--memory allows more: the system can spare %.1f GB"
                              : "\nthe system can spare %.1f GB for this process",
                    1e-9 * (double)spare);
}

static void draw_here(const struct engine *engine, const struct input *input, const char *query, struct answer *answer)
{
    zraster_error *error = NULL;
    const zraster_status status = engine_draw_here(engine, input, query, &answer->picture, &answer->file, &error);
    if (status == ZRASTER_OK)
        take_picture(answer);
    else {
        bytes_print(&answer->faults, "%s", zraster_error_text(error));
        if (status == ZRASTER_NO_MEMORY) advise(answer);
        answer_refuse(answer);
    }
    if (interrupted()) answer->status = STATUS_INTERRUPTED;
    zraster_error_free(error);
}

void engine_draw(const struct engine *engine, const struct input *input, const struct options *options,
                 struct answer *answer)
{
    char *query = query_make(options, input->path, input->is_scene);
    *answer = (struct answer){.status = STATUS_DONE};
    if (!query) {
        bytes_print(&answer->faults, "out of memory");
        answer->status = STATUS_FAILED;
    } else if (engine->server)
        post(engine->server, &engine->token, input, query, answer);
    else
        draw_here(engine, input, query, answer);
    free(query);
    if (answer->status == STATUS_DONE) bytes_print(&answer->warnings, "%s", bytes_text(&input->warnings));
    wording_translate(&answer->faults, input, options);
    if (answer->status != STATUS_DONE || !options_strict(options) || answer->warnings.size == 0) return;
    bytes_print(&answer->faults, "%s", bytes_text(&answer->warnings));
    answer->status = STATUS_WARNED;
}
