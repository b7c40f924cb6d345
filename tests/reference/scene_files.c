#include "reference/scene_files.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/run.h"
#include "input/formats/formats.h"
#include "input/text/names.h"
#include "reference/gl/look_twin.h"
#include "reference/page/page.h"
#include "render/lens.h"
#include "render/section_pass.h"
#include "render_request.h"
#include "scene/scene_edit.h"
#include "support/files.h"

enum { PATH_SIZE = 1000, LABEL_SIZE = 100 };
static const size_t scene_ceiling = (size_t)2 << 30;
static const char all_presets[] = "all";

/* What is to be done with each file. */
struct checking {
    struct harness *harness;
    struct report *report;
    const struct scene_files_options *options;
    struct tally *sum;
    bool is_folder; /* the file was not named by itself */
};

static bool format_of(const char *path, enum zr_format *format)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < ZR_FORMAT_COUNT; i++)
        if (strcasecmp(dot + 1, zr_format_rows[i].suffix) == 0) {
            *format = (enum zr_format)i;
            return true;
        }
    return false;
}

/* The file's own name, without its folder and its suffix. */
static void name_of(const char *path, char name[LABEL_SIZE])
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    snprintf(name, LABEL_SIZE, "%.*s", (int)(dot ? dot - base : (long)strlen(base)), base);
}

/* ---- one file ---- */

static enum verdict refused(const struct checking *c, const char *path, const struct zr_error *error)
{
    char reason[ZR_POINTER_SIZE + ZR_DETAIL_SIZE + 4];
    snprintf(reason, sizeof reason, "%s%s%s", error->items[0].pointer, error->items[0].pointer[0] ? ": " : "",
             error->items[0].detail);
    report_refused(c->report, path, reason);
    return c->is_folder ? VERDICT_EQUAL : VERDICT_UNPROVED;
}

static enum verdict check_view(const struct checking *c, const struct zr_scene *scene, const char *name,
                               uint64_t number, struct tally *tally)
{
    struct harness_pictures pictures;
    const uint64_t left_out = tally->colors_left_out;
    enum verdict verdict = harness_check(c->harness, scene, name, number, tally, &pictures);
    enum verdict channels = twins_check(c->options->twins, c->harness, scene, name, &pictures, tally);
    if (channels > verdict) verdict = channels;
    if (tally->colors_left_out > left_out)
        report_no_colors(c->report, name, look_twin_lacks(scene) ? look_twin_lacks(scene) : "linear light by this bar");
    if (c->report->page) page_picture(c->report->page, name, verdict, &pictures);
    if (c->options->pictures && pictures.frame) report_pictures(c->options->pictures, name, number, &pictures);
    return verdict;
}

/* A scene that is cut open becomes one with the cut meshes and the same camera, which both sides draw. */
static bool open_scene(struct zr_arena *arena, struct zr_scene *scene, struct zr_error *error)
{
    const struct zr_resolved_view *resolved;
    const struct zr_scene *drawn;
    struct zr_frame *frame = zr_arena_zero(arena, 1, sizeof *frame);
    if (scene->sections.count == 0) return true;
    if (!frame || zr_resolved_view_find(&(struct zr_run){.arena = arena, .error = error}, scene, &resolved) != ZR_OK ||
        zr_render_sections(&(struct zr_run){.arena = arena, .scratch = arena, .error = error}, scene, resolved, frame,
                           &drawn) != ZR_OK)
        return false;
    *scene = *drawn;
    scene->sections.count = 0;
    scene->views[0].pose = ZR_POSE_MATRIX;
    scene->views[0].world_to_camera = resolved->camera.world_to_eye;
    scene->views[0].projection = ZR_PROJECTION_MATRIX;
    scene->views[0].projection_matrix = resolved->camera.projection;
    return true;
}

/* A view through a lens becomes that of the pinhole picture behind it, which both sides draw. */
static bool remove_lens(struct zr_arena *arena, struct zr_scene *scene, struct zr_error *error)
{
    const struct zr_resolved_view *resolved;
    struct zr_lens_drawing drawing;
    struct zr_view *view = &scene->views[0];
    if (view->lens.model == ZR_LENS_NONE) return true;
    if (zr_resolved_view_find(&(struct zr_run){.arena = arena, .error = error}, scene, &resolved) != ZR_OK)
        return false;
    zr_lens_drawing_open(scene, resolved, &drawing);
    *scene = drawing.scene;
    view->lens.model = ZR_LENS_NONE;
    view->pose = ZR_POSE_MATRIX;
    view->world_to_camera = drawing.resolved.camera.world_to_eye;
    view->projection = ZR_PROJECTION_MATRIX;
    view->projection_matrix = drawing.resolved.camera.projection;
    return true;
}

static void make_plain(struct zr_material *material)
{
    material->is_operand = false;
}

/* Operands of solids are drawn as plain meshes: no GL walks through fragments. tests/property/test_csg.c is the judge of
 * solids. */
static bool leave_solids(struct zr_arena *arena, struct zr_scene *scene, const char *name)
{
    struct zr_scene plain;
    if (!scene->csg) return true;
    fprintf(stderr, "LEFT OUT: %s: its solids; its operands are drawn as meshes\n", name);
    if (!zr_scene_edit_materials(arena, scene, make_plain, &plain)) return false;
    *scene = plain;
    scene->csg = NULL;
    return true;
}

/* One scene, or one mesh from each view wanted. */
static enum verdict check_bytes(const struct checking *c, struct zr_arena *arena, struct zr_request *request,
                                const char *path)
{
    char name[LABEL_SIZE];
    struct tally tally = {0};
    enum verdict worst = VERDICT_EQUAL;
    struct zr_limits limits = zr_limits_default();
    bool all = request->format != ZR_FORMAT_JSON && strcmp(c->options->preset, all_presets) == 0;
    name_of(path, name);
    for (int preset = 0; preset < (all ? zr_preset_names.count : 1); preset++) {
        struct zr_error error = {.status = ZR_OK};
        const struct zr_scene *scene;
        if (all) request->preset = zr_preset_names.words[preset];
        zr_arena_reset(arena, scene_ceiling);
        if (zr_scene_read(&(struct zr_run){.arena = arena, .error = &error}, request, &limits, &scene) != ZR_OK)
            return refused(c, path, &error);
        struct zr_scene bare = *scene; /* no colour bar and marks, which Mesa does not draw */
        bare.color_bar.is_on = false;
        bare.views[0].annotate = (struct zr_annotate){.words = 0};
        if (!leave_solids(arena, &bare, name) || !remove_lens(arena, &bare, &error) ||
            !open_scene(arena, &bare, &error))
            return refused(c, path, &error);
        enum verdict verdict = check_view(c, &bare, name, (uint64_t)preset, &tally);
        if (verdict > worst) worst = verdict;
    }
    tally_add(c->sum, &tally);
    if (tally.left_out > 0) report_left_out(c->report, name, tally.left_out);
    if (worst == VERDICT_EQUAL && tally.left_out > 0 && tally.pictures == 0) return worst;
    if (worst == VERDICT_EQUAL && tally.comparison.visible == 0) worst = VERDICT_UNPROVED;
    report_line(c->report, name, worst, &tally);
    return worst;
}

static enum verdict check_file(const struct checking *c, const char *path, enum zr_format format)
{
    struct zr_request request = {.format = format};
    struct zr_arena arena;
    if (format != ZR_FORMAT_JSON) {
        request.preset = c->options->preset;
        request.look = "textbook"; /* the only one that Mesa knows */
    }
    char *bytes = file_read(path, &request.size);
    if (!bytes) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        return VERDICT_UNPROVED;
    }
    request.bytes = bytes;
    zr_arena_init(&arena, scene_ceiling);
    enum verdict verdict = check_bytes(c, &arena, &request, path);
    zr_arena_free(&arena);
    free(bytes);
    return verdict;
}

/* ---- folders ---- */

static enum verdict check_path(const struct checking *c, const char *path);

static enum verdict check_folder(const struct checking *c, const char *path)
{
    struct checking inside = *c;
    struct dirent **entries;
    enum verdict worst = VERDICT_EQUAL;
    int count = scandir(path, &entries, NULL, alphasort);
    inside.is_folder = true;
    for (int i = 0; i < count; i++) {
        char below[PATH_SIZE];
        int length = snprintf(below, sizeof below, "%s/%s", path, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.' && length < PATH_SIZE) {
            enum verdict verdict = check_path(&inside, below);
            if (verdict > worst) worst = verdict;
        }
        free(entries[i]);
    }
    if (count >= 0) free(entries);
    return worst;
}

static enum verdict check_path(const struct checking *c, const char *path)
{
    struct stat status;
    enum zr_format format;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) return check_folder(c, path);
    if (format_of(path, &format)) return check_file(c, path, format);
    if (c->is_folder) return VERDICT_EQUAL; /* something else, which lies there too */
    fprintf(stderr, "%s: none of", path);
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        fprintf(stderr, " .%s", zr_format_rows[i].suffix);
    fputc('\n', stderr);
    return VERDICT_UNPROVED;
}

enum verdict scene_files_check(struct harness *harness, struct report *report, const char *path,
                               const struct scene_files_options *options, struct tally *sum)
{
    struct checking checking = {harness, report, options, sum, false};
    int before = report->count + report->refused;
    enum verdict verdict = check_path(&checking, path);
    bool found = report->count + report->refused > before;
    if (verdict == VERDICT_EQUAL && !found) fprintf(stderr, "%s: no scene and no mesh\n", path);
    return verdict == VERDICT_EQUAL && !found ? VERDICT_UNPROVED : verdict;
}
