#include "reference/harness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/viewport.h"
#include "reference/average.h"
#include "reference/generate/batches.h"
#include "reference/gl/layers_twin.h"
#include "reference/page/report.h"
#include "reference/subject.h"
#include "scene/picture.h"

enum { FAILURES_MAX = 3, ALONE_MAX = 8 };
/* Beyond these no two transforms in float can be asked to agree: a corner may move by a step of the subpixel grid,
 * or fewer than 16 bits of depth are left. */
static const double rounding_max_px = 1.0 / 256.0, rounding_max_depth = 0x1p-16;
static const size_t arena_ceiling = (size_t)4 << 30, arena_keep = (size_t)256 << 20;

/* False where lines are drawn by no rule that is known. Softpipe's are never compared. */
static bool follow_lines(struct harness *harness, struct reference_error *error)
{
    if (harness->options.bar == COMPARE_SECOND_OPINION) return true;
    if (!line_rule_find(harness->reference, &harness->line_rule, error)) return false;
    harness->lines_compare = line_rule_choose(harness->line_rule);
    return true;
}

bool harness_open(struct harness *harness, const struct harness_options *options)
{
    memset(harness, 0, sizeof *harness);
    zr_arena_init(&harness->arena, arena_ceiling);
    harness->options = *options;
    harness->failures_left = *options->failures ? FAILURES_MAX : 0;
    struct reference_error error = {""};
    harness->reference = reference_open(
        &(struct reference_options){.driver = options->driver, .native = false, .threads = options->threads}, &error);
    harness->team = zr_team_create_for(options->threads, options->isa);
    bool known = harness->reference && follow_lines(harness, &error);
    if (!known) fprintf(stderr, "no reference: %s\n", error.text);
    if (!harness->team) fprintf(stderr, "no threads\n");
    return known && harness->team;
}

void harness_close(struct harness *harness)
{
    reference_close(harness->reference);
    if (harness->team) zr_team_destroy(harness->team);
    zr_arena_free(&harness->arena);
    free(harness->rgba);
    free(harness->gaps);
    free(harness->depth);
    free(harness->owner);
}

static bool make_room(struct harness *harness, size_t pixels)
{
    if (pixels <= harness->room) return true;
    free(harness->rgba);
    free(harness->gaps);
    free(harness->depth);
    free(harness->owner);
    harness->rgba = malloc(pixels * 4);
    harness->gaps = malloc(pixels);
    harness->depth = malloc(pixels * sizeof *harness->depth);
    harness->owner = malloc(pixels * sizeof *harness->owner);
    harness->room = harness->rgba && harness->gaps && harness->depth && harness->owner ? pixels : 0;
    return harness->room > 0;
}

/* ---- the reference's side ---- */

/* Where a picture goes; depth and gaps NULL: not wanted. */
struct target {
    uint8_t *rgba, *gaps;
    float *depth;
};

static bool draw_and_read(struct harness *harness, const struct zr_scene *scene, const struct batches *batches,
                          const struct target *to)
{
    struct reference_error error = {""};
    if (reference_resize(harness->reference, scene->views[0].width, scene->views[0].height, batches->parity_faces > 0,
                         &error) &&
        reference_draw(harness->reference, &batches->arrays, &error) &&
        reference_read(harness->reference, to->rgba, to->depth, &error) &&
        (!to->gaps || reference_read_gaps(harness->reference, to->gaps, &error)))
        return true;
    fprintf(stderr, "reference: %s\n", error.text);
    return false;
}

/* With what is see-through; to->depth may be NULL, and `owner`. Our own sums before the last rounding must be the
 * reference's. */
static bool draw_layers(struct harness *harness, const struct zr_scene *scene, const struct zr_camera *camera,
                        const struct batches_options *options, const struct target *to, uint32_t *owner)
{
    const struct layers_twin twin = {harness->reference, &harness->arena, scene, camera, *options};
    const size_t pixels = (size_t)scene->views[0].width * scene->views[0].height;
    struct layers_picture picture = {.rgba = to->rgba, .gaps = to->gaps, .depth = to->depth, .owner = owner};
    struct reference_error error = {"out of memory"};
    if (!picture.depth) picture.depth = zr_arena_alloc(&harness->arena, pixels, sizeof *picture.depth);
    if (!picture.owner) picture.owner = zr_arena_alloc(&harness->arena, pixels, sizeof *picture.owner);
    picture.sum = zr_arena_alloc(&harness->arena, pixels, 4 * sizeof *picture.sum);
    picture.count = zr_arena_alloc(&harness->arena, pixels, sizeof *picture.count);
    if (!zr_arena_ok(&harness->arena) || !layers_twin_draw(&twin, &picture, &error)) {
        fprintf(stderr, "reference: layers: %s\n", error.text);
        return false;
    }
    for (size_t i = 0; i < pixels; i++)
        harness->layers_alone += picture.count[i] > 0 && picture.owner[i] == 0;
    if (!scene->picture->is_linear && harness->options.bar == COMPARE_EXACT)
        harness->sums_different += layers_twin_compare(&harness->arena, harness->team, scene, camera, &picture);
    return true;
}

/* Of several samples per pixel, as bytes. */
static bool draw_average(struct harness *harness, const struct zr_scene *scene, const struct zr_camera *camera,
                         const struct batches_options *options)
{
    struct zr_picture picture;
    const struct zr_scene large = average_scene(&harness->arena, scene, &picture);
    const uint32_t side = scene->picture->side, width = scene->views[0].width, height = scene->views[0].height;
    const size_t samples = (size_t)large.views[0].width * large.views[0].height;
    const struct target to = {zr_arena_alloc(&harness->arena, samples, 4), zr_arena_alloc(&harness->arena, samples, 1),
                              NULL};
    struct batches batches;
    if (!to.rgba || !to.gaps) return false;
    if (layers_twin_is_for(scene)) {
        if (!draw_layers(harness, &large, camera, options, &to, NULL)) return false;
    } else {
        if (!batches_make(&harness->arena, &large, camera, options, &batches) ||
            !draw_and_read(harness, &large, &batches, &to))
            return false;
        batches_mark_thin(&batches, large.views[0].width, large.views[0].height, to.gaps);
    }
    average_bytes(to.rgba, side, width, height, harness->rgba);
    average_gaps(to.gaps, side, width, height, harness->gaps);
    return true;
}

static bool draw_look(struct harness *harness, const struct zr_scene *scene, const struct zr_camera *camera,
                      const struct batches_options *options)
{
    struct look_twin twin = {harness->reference, &harness->arena,    &harness->look_programs, scene, camera,
                             *options,           &harness->undecided};
    struct reference_error error = {"out of memory, or too many lamps"};
    twin.options.purpose = BATCHES_LIGHT;
    if (look_twin_draw(&twin, harness->rgba, harness->gaps, &error)) return true;
    fprintf(stderr, "reference: linear light: %s\n", error.text);
    return false;
}

/* Colours are for the exact comparison alone where they are not those of pixels' centres. */
static bool has_colors(const struct harness *harness, const struct zr_scene *scene)
{
    const bool is_exact = harness->options.bar == COMPARE_EXACT;
    if (scene->picture->is_linear) return is_exact && !look_twin_lacks(scene);
    return is_exact || scene->picture->side <= 1;
}

/* Instead of the colours of pixels' centres, which may be others than the picture's. */
static bool draw_colors(struct harness *harness, const struct zr_scene *scene, const struct zr_camera *camera,
                        const struct batches_options *options)
{
    if (!has_colors(harness, scene)) return true;
    if (scene->picture->is_linear) return draw_look(harness, scene, camera, options);
    return scene->picture->side <= 1 || draw_average(harness, scene, camera, options);
}

/* Who owns a pixel is read from one colour a face; then the scene is drawn as it looks. */
static bool reference_render(struct harness *harness, const struct zr_scene *scene, const struct zr_frame *frame,
                             struct batches *batches)
{
    size_t pixels = (size_t)scene->views[0].width * scene->views[0].height;
    struct zr_camera camera = frame->camera;
    camera.projection.m[12] += (float)harness->options.perturbation;
    struct batches_options options = {.purpose = BATCHES_OWNERS,
                                      .transformed = harness->options.transformed,
                                      .all_parity = harness->options.all_parity,
                                      .more_ambient = harness->options.more_ambient,
                                      .more_to_x = harness->options.more_to_x};
    if (!make_room(harness, pixels) || !batches_make(&harness->arena, scene, &camera, &options, batches)) {
        fprintf(stderr, "reference: out of memory, or too many faces\n");
        return false;
    }
    if (layers_twin_is_for(scene))
        return draw_layers(harness, scene, &camera, &options,
                           &(struct target){harness->rgba, harness->gaps, harness->depth}, harness->owner) &&
               draw_colors(harness, scene, &camera, &options);
    if (!draw_and_read(harness, scene, batches, &(struct target){harness->rgba, NULL, NULL})) return false;
    for (size_t i = 0; i < pixels; i++)
        harness->owner[i] = batches_owner_number(harness->rgba + i * 4);
    options.purpose = BATCHES_COLORS;
    if (!batches_make(&harness->arena, scene, &camera, &options, batches) ||
        !draw_and_read(harness, scene, batches, &(struct target){harness->rgba, harness->gaps, harness->depth}))
        return false;
    batches_mark_thin(batches, scene->views[0].width, scene->views[0].height, harness->gaps);
    return draw_colors(harness, scene, &camera, &options);
}

/* ---- both ---- */

/* Points and lines end where rounding says: they are for the exact comparison alone. */
static bool has_points(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (scene->meshes[i].point_count > 0) return true;
    return false;
}

/* Points whose size in subpixels lies between two whole numbers, which older Mesas round up. */
static bool has_ties(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const float size = scene->meshes[i].point_size * (float)scene->picture->side * (float)ZR_SUBPIXELS;
        if (scene->meshes[i].point_count > 0 && size - floorf(size) == 0.5f) return true;
    }
    return false;
}

static bool has_wires(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].outline != ZR_OUTLINE_NONE) return true;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (scene->meshes[i].line_count > 0) return true;
    return false;
}

/* True if the reference draws parts of the scene by an older rule, which this build does not have. */
static bool lacks_line_rule(const struct harness *harness, const struct zr_scene *scene)
{
    static bool told;
    if (harness->options.bar != COMPARE_EXACT || harness->lines_compare) return false;
    if (!has_wires(scene) && !has_ties(scene) && !scene->fog.is_on) return false;
    if (!told)
        fprintf(stderr,
                "this Mesa draws lines, fog and some points by older rules, which zraster-verify of build/mutant has "
                "(%s)\n",
                reference_name(harness->reference));
    told = true;
    return true;
}

static uint32_t color_slack(const struct harness *harness, const struct zr_scene *scene)
{
    if (!has_colors(harness, scene)) return COMPARE_NO_COLORS;
    return scene->picture->is_linear ? LOOK_TWIN_SLACK : 0;
}

/* Off by one step now and then is what rounding does; more than that, and it is another light. */
static bool too_many_near(const struct comparison *before, const struct comparison *after)
{
    const uint64_t near = after->color_near - before->color_near, pixels = after->pixels - before->pixels;
    return near > LOOK_TWIN_NEAR_MAX + pixels / LOOK_TWIN_PIXELS_PER_NEAR;
}

/* Few pixels are left out. */
static bool too_many_undecided(const struct harness *harness, const struct zr_scene *scene)
{
    const uint64_t pixels = (uint64_t)scene->views[0].width * scene->views[0].height;
    return harness->undecided > LOOK_TWIN_UNDECIDED_MAX + pixels / LOOK_TWIN_PIXELS_PER_UNDECIDED;
}

/* Both pictures stand until the next call; out->frame tells whether both sides gave one. */
static enum verdict compare_sides(struct harness *harness, const struct zr_scene *scene, struct tally *tally,
                                  struct harness_pictures *out)
{
    *out = (struct harness_pictures){.frame = NULL};
    if (lacks_line_rule(harness, scene)) return VERDICT_UNPROVED;
    zr_arena_reset(&harness->arena, arena_keep);
    const struct zr_frame *frame = subject_render(&harness->arena, harness->team, scene);
    if (!frame) return VERDICT_DIFFERENT;
    struct batches batches;
    harness->layers_alone = harness->sums_different = harness->undecided = 0;
    if (!reference_render(harness, scene, frame, &batches)) return VERDICT_UNPROVED;
    out->frame = frame;
    out->want =
        (struct picture){harness->rgba, harness->depth, harness->owner, harness->gaps, color_slack(harness, scene)};
    out->got = (struct picture){frame->color, frame->window_depth, frame->face_id, NULL, 0};
    struct rounding rounding = nearness_rounding(scene, &frame->camera);
    bool too_coarse = rounding.px > rounding_max_px || rounding.depth > rounding_max_depth;
    const bool exact_alone = has_wires(scene) || has_points(scene);
    if ((harness->options.transformed && too_coarse) || (harness->options.bar != COMPARE_EXACT && exact_alone)) {
        tally->left_out++;
        return VERDICT_EQUAL;
    }
    tally->pictures++;
    tally->colors_left_out += scene->picture->is_linear && !has_colors(harness, scene);
    tally->triangles += batches.triangles;
    const struct zr_counts *counts = &frame->counts;
    tally->clipped += counts->clipped + counts->clipped_lines + counts->clipped_outlines + counts->outside_points;
    tally->parity_faces += batches.parity_faces;
    struct nearness nearness = {
        .scene = scene, .camera = &frame->camera, .arena = &harness->arena, .depth_rounding = rounding.depth};
    const struct comparison before = tally->comparison;
    out->missed = compare_pictures(&out->want, &out->got, scene->views[0].width, scene->views[0].height,
                                   harness->options.bar, &nearness, &tally->comparison);
    nearness_free(&nearness);
    tally->comparison.visible += harness->layers_alone;
    tally->comparison.color += harness->sums_different;
    tally->undecided += harness->undecided;
    if (too_many_undecided(harness, scene)) return VERDICT_UNPROVED;
    if (scene->picture->is_linear && too_many_near(&before, &tally->comparison)) {
        tally->comparison.color += tally->comparison.color_near - before.color_near;
        return VERDICT_DIFFERENT;
    }
    if (harness->sums_different > 0)
        fprintf(stderr, "%llu pixels of what is blended differ before they are rounded\n",
                (unsigned long long)harness->sums_different);
    return out->missed.count || harness->sums_different > 0 ? VERDICT_DIFFERENT : VERDICT_EQUAL;
}

/* ---- the smallest failing case ---- */

/* The scene in the same view with one face only. Offsets of faces are absolute, so that the mesh
 * of one face is a window on the arrays of all. */
struct single {
    struct zr_scene scene;
    struct zr_mesh mesh;
    struct zr_instance instance;
};

static void single_make(struct single *single, const struct zr_scene *scene, const struct zr_camera *camera,
                        uint32_t instance, uint32_t face)
{
    const struct zr_mesh *from = &scene->meshes[scene->instances[instance].mesh];
    single->scene = *scene;
    single->mesh = *from;
    single->instance = (struct zr_instance){.object_to_world = scene->instances[instance].object_to_world};
    single->mesh.face_count = 1;
    single->mesh.line_count = single->mesh.point_count = 0;
    single->mesh.face_offsets = from->face_offsets + face;
    if (from->face_rings) single->mesh.face_rings = from->face_rings + face;
    if (from->face_colors) single->mesh.face_colors = from->face_colors + face;
    if (from->face_materials) single->mesh.face_materials = from->face_materials + face;
    single->scene.mesh_count = single->scene.instance_count = 1;
    single->scene.meshes = &single->mesh;
    single->scene.instances = &single->instance;
    single->scene.views[0].pose = ZR_POSE_MATRIX;
    single->scene.views[0].world_to_camera = camera->world_to_eye;
    single->scene.views[0].projection = ZR_PROJECTION_MATRIX;
    single->scene.views[0].projection_matrix = camera->projection;
}

/* Numbers of faces that differ when drawn alone. */
static uint32_t find_alone(struct harness *harness, const struct zr_scene *scene, const struct zr_camera *camera,
                           uint32_t alone[ALONE_MAX])
{
    enum { FACES_TRIED = 2048 };
    uint32_t found = 0, tried = 0, owner = 1;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t face = 0; face < mesh->face_count && tried < FACES_TRIED && found < ALONE_MAX; face++, tried++) {
            struct single single;
            struct harness_pictures unused_pictures;
            struct tally unused = {0};
            single_make(&single, scene, camera, i, face);
            if (compare_sides(harness, &single.scene, &unused, &unused_pictures) == VERDICT_DIFFERENT)
                alone[found++] = owner + face;
        }
        owner += (uint32_t)zr_mesh_ids(mesh);
    }
    return found;
}

enum verdict harness_check(struct harness *harness, const struct zr_scene *scene, const char *label, uint64_t number,
                           struct tally *tally, struct harness_pictures *pictures)
{
    struct harness_pictures own;
    if (!pictures) pictures = &own;
    enum verdict verdict = compare_sides(harness, scene, tally, pictures);
    if (verdict != VERDICT_DIFFERENT || !pictures->frame || harness->failures_left == 0) return verdict;
    harness->failures_left--;
    uint32_t alone[ALONE_MAX];
    struct zr_camera camera = pictures->frame->camera;
    uint32_t found = find_alone(harness, scene, &camera, alone);
    struct tally unused = {0};
    if (compare_sides(harness, scene, &unused, pictures) == VERDICT_DIFFERENT)
        report_difference(&(struct report_failure){.directory = harness->options.failures,
                                                   .label = label,
                                                   .number = number,
                                                   .scene = scene,
                                                   .camera = &camera,
                                                   .pictures = pictures,
                                                   .alone = alone,
                                                   .alone_count = found});
    return verdict;
}

void tally_add(struct tally *sum, const struct tally *more)
{
    sum->pictures += more->pictures;
    sum->triangles += more->triangles;
    sum->clipped += more->clipped;
    sum->left_out += more->left_out;
    sum->colors_left_out += more->colors_left_out;
    sum->undecided += more->undecided;
    sum->parity_faces += more->parity_faces;
    sum->twins_pixels += more->twins_pixels;
    sum->twins_beyond += more->twins_beyond;
    compare_add(&sum->comparison, &more->comparison);
}
