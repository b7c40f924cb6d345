/* drawing.c - client: `zraster drawing`: a technical drawing as SVG or PNG. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "engine/engine.h"
#include "engine/interruption.h"
#include "engine/report.h"
#include "files/input.h"
#include "files/neighbours.h"
#include "files/output.h"
#include "files/say.h"
#include "options/query.h"
#include "options/wording.h"

static bool ends_with(const char *text, const char *ending)
{
    const size_t length = strlen(text), size = strlen(ending);
    return length > size && strcasecmp(text + length - size, ending) == 0;
}

/* Moves the options of the drawing to its query. */
static void take_query(struct options *options, const struct target *target, struct bytes *query)
{
    const char *out = options->own[OPTION_OUTPUT];
    query_take_drawing(options, query);
    if (!query->data || !strstr(query->data, "title="))
        if (strcmp(target->file, "-") != 0) query_add(query, "title", output_base(target->file));
    if (options->own[OPTION_PAGE]) query_add(query, "page", options->own[OPTION_PAGE]);
    if (options->own[OPTION_HIDDEN]) query_add(query, "hidden", options->own[OPTION_HIDDEN]);
    if (options->own[OPTION_DATE]) query_add(query, "date", options->own[OPTION_DATE]);
    if (out && ends_with(out, ".png")) query_add(query, "format", "png");
}

static void list_warnings(const struct options *options, const zraster_drawing *drawing)
{
    struct bytes warnings = {.data = NULL};
    const char *warning;
    for (size_t i = 0; (warning = zraster_drawing_warning(drawing, i)); i++)
        bytes_print(&warnings, "%s\n", warning);
    if (!options->own[OPTION_QUIET]) report_warnings(stderr, NULL, &warnings);
    bytes_free(&warnings);
}

/* Draws a file that was read, and saves the drawing. Returns an exit status with lines in *faults. */
static int draw(const struct engine *engine, const struct options *options, const char *query,
                const struct input *input, const struct target *target, struct bytes *faults)
{
    static const char word[] = "parameter ";
    struct bytes names = {.data = NULL};
    struct answer answer = {.status = STATUS_DONE};
    zraster_scene *scene = NULL;
    zraster_drawing *drawing = NULL;
    zraster_error *error = NULL;
    int status = STATUS_FAILED;
    char *scene_query = query_make(options, input->path, input->is_scene);
    zraster_status result = engine_read_here(engine, input, scene_query, &scene, &error);
    if (result == ZRASTER_OK) result = zraster_drawing_make(scene, query, engine->cancel, &drawing, &error);
    if (result == ZRASTER_OK) {
        list_warnings(options, drawing);
        answer.file = zraster_drawing_file(drawing);
        status = output_save(target, &answer, options->own[OPTION_NO_CLOBBER] != NULL, &names, faults);
    } else if (interrupted()) {
        status = STATUS_INTERRUPTED;
    } else {
        const char *text = zraster_error_text(error);
        const bool is_option = result == ZRASTER_BAD_REQUEST && scene && strncmp(text, word, strlen(word)) == 0;
        bytes_print(faults, "%s%s", is_option ? "--" : "", is_option ? text + strlen(word) : text);
        if (!is_option) wording_translate(faults, input, options);
        status = result == ZRASTER_BAD_REQUEST ? STATUS_USAGE : STATUS_FAILED;
    }
    zraster_drawing_free(drawing);
    zraster_scene_free(scene);
    zraster_error_free(error);
    answer_free(&answer);
    bytes_free(&names);
    free(scene_query);
    return status;
}

int command_drawing(struct options *options)
{
    struct engine engine;
    struct input input;
    struct bytes faults = {.data = NULL};
    struct bytes query = {.data = NULL};
    if (options->file_count != 1)
        return options_wrong("drawing needs one file: \"zraster drawing part.stl -o part.svg\"");
    const char *out = options->own[OPTION_OUTPUT];
    const struct target target = output_target(options->files[0], out);
    int status = input_check_type(options);
    if (status != 0) return status;
    if (target.out && strcmp(target.out, "-") != 0 && !ends_with(target.out, ".svg") && !ends_with(target.out, ".png"))
        return options_wrong("-o %s: a drawing is saved as .svg or .png", target.out);
    take_query(options, &target, &query);
    options->own[OPTION_SERVER] = NULL; /* $ZRASTER_SERVER draws pictures, and no drawings */
    status = output_check(&target, false, &faults);
    if (status == 0) status = engine_open(&engine, options, options_threads(options), 1);
    if (status == 0) {
        if (!input_read(&input, options->files[0], options, &faults) ||
            !neighbours_read(&input, options->own[OPTION_ROOT], &faults))
            status = interrupted() ? STATUS_INTERRUPTED : input.is_usage ? STATUS_USAGE : STATUS_FAILED;
        else
            status = draw(&engine, options, bytes_text(&query), &input, &target, &faults);
        input_free(&input);
        engine_close(&engine);
    }
    if (status != 0 && status != STATUS_INTERRUPTED && faults.size > 0)
        report_of_file(stderr, options->files[0], &faults);
    bytes_free(&faults);
    bytes_free(&query);
    return status;
}
