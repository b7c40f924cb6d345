#include "scene/validate.h"

#include <inttypes.h>
#include <stdio.h>

#include "scene/output.h"
#include "scene/picture.h"
static void check_side(const char *pointer, uint32_t side, const struct zr_limits *limits, struct zr_error *error)
{
    if (side < 1 || side > limits->window_side_max)
        zr_error_add(error, ZR_BAD_SCENE, pointer, "%" PRIu32 " pixels; 1 to %" PRIu32 " are allowed", side,
                     limits->window_side_max);
}

static void check_view(const struct zr_view *view, const struct zr_limits *limits, struct zr_error *error)
{
    size_t before = error->count;
    check_side("/window/width", view->width, limits, error);
    check_side("/window/height", view->height, limits, error);
    if (error->count > before) return; /* else the product below could overflow */
    uint64_t images = 0, pixels = (uint64_t)view->width * view->height;
    for (uint32_t i = 0; i < view->output_count; i++)
        images += zr_channel_rows[view->outputs[i].channel].words;
    if (images > 0 && pixels > limits->window_pixels_max / images)
        zr_error_add(error, ZR_BAD_SCENE, "/window",
                     "%" PRIu32 " x %" PRIu32 " pixels x %" PRIu64 " image outputs is more than the limit of %" PRIu64,
                     view->width, view->height, images, limits->window_pixels_max);
}

static void check_geometry(const struct zr_scene *scene, struct zr_error *error)
{
    uint64_t primitives = 0, corners = 0;
    for (uint32_t i = 0; i < scene->instance_count && corners <= ZR_SCENE_CORNERS_MAX; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        primitives += zr_mesh_ids(mesh);
        corners += zr_mesh_corners(mesh);
    }
    if (primitives == 0)
        zr_error_add(error, ZR_BAD_SCENE, NULL, "no geometry: %s",
                     scene->mesh_count > 0 && scene->instance_count == 0
                         ? "no node places a mesh"
                         : "the scene has no face, line or point to draw");
    if (corners > ZR_SCENE_CORNERS_MAX)
        zr_error_add(error, ZR_BAD_SCENE, NULL,
                     "the faces, lines and points have more than the limit of %" PRIu64 " corners in all",
                     ZR_SCENE_CORNERS_MAX);
}

/* Point and spot lights need w = 1: positions are interpolated up to their w, which does not give distances
 * (shade/draw_attributes.h). */
static void check_lamps(const struct zr_scene *scene, struct zr_error *error)
{
    uint32_t lamp = 0;
    while (lamp < scene->light_count && !zr_light_has_place(&scene->lights[lamp]))
        lamp++;
    for (uint32_t i = 0; lamp < scene->light_count && i < scene->mesh_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[i];
        for (uint32_t v = 0; v < mesh->position_count; v++)
            if (mesh->positions[v].w != 1.0f) {
                zr_error_add(error, ZR_BAD_SCENE, "/lights",
                             "point and spot lamps light positions of three numbers, or with a fourth of 1; a position "
                             "of mesh %" PRIu32 " has %.9g",
                             i, (double)mesh->positions[v].w);
                return;
            }
    }
}

/* Pixels of the base need values in every requested channel. */
static void check_base(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    const struct zr_base *base = scene->base;
    if (scene->sections.count > 0)
        zr_error_add(error, ZR_BAD_SCENE, "/sections", "a scene with a base cannot be cut open: the base stays whole");
    bool color = false, depth = false, face_id = false;
    const enum zr_channel last_of_base = ZR_CHANNEL_INFO;
    for (uint32_t i = 0; i < view->output_count; i++) {
        enum zr_channel channel = view->outputs[i].channel;
        if (channel > last_of_base)
            zr_error_add(error, ZR_BAD_SCENE, "/base", "no base has the channel %s, so it cannot be an output",
                         zr_channel_rows[channel].name);
        color |= channel == ZR_CHANNEL_COLOR;
        depth |= channel == ZR_CHANNEL_DEPTH;
        face_id |= channel == ZR_CHANNEL_FACE_ID || channel == ZR_CHANNEL_INFO;
    }
    if (color && !base->color) zr_error_add(error, ZR_BAD_SCENE, "/base/color", "missing: the output color needs it");
    if (depth && !base->depth) zr_error_add(error, ZR_BAD_SCENE, "/base/depth", "missing: the output depth needs it");
    if (face_id && !base->face_id)
        zr_error_add(error, ZR_BAD_SCENE, "/base/faceId", "missing: the outputs faceId and info need it");
}

static void check_layers(const struct zr_view *view, struct zr_error *error)
{
    static const enum zr_channel channels[] = {ZR_CHANNEL_LAYERS, ZR_CHANNEL_THICKNESS, ZR_CHANNEL_FRAGMENTS};
    for (size_t i = 0; i < sizeof channels / sizeof channels[0]; i++)
        if (zr_view_wants(view, channels[i]))
            zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                         "painter keeps no fragments, which the channel %s needs; the other algorithms do",
                         zr_channel_rows[channels[i]].name);
}

/* Checks the pixels of ends of dimensions. */
static void check_dimensions(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    static const char *const keys[] = {"from", "to", "at"};
    char pointer[48];
    for (uint32_t i = 0; i < view->annotate.dimension_count; i++) {
        const struct zr_dimension *d = &view->annotate.dimensions[i];
        const struct zr_dimension_end *const ends[] = {&d->from, &d->to, &d->at};
        for (int k = 0; k < 3; k++) {
            if (ends[k]->is_pick && scene->algorithm == ZR_ALGORITHM_PAINTER)
                zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                             "painter keeps no fragments, which picks need; the other algorithms do");
            if (!ends[k]->is_pick || (ends[k]->pixel[0] < view->width && ends[k]->pixel[1] < view->height)) continue;
            snprintf(pointer, sizeof pointer, "/dimensions/%" PRIu32 "/%s/pick", i, keys[k]);
            zr_error_add(error, ZR_BAD_SCENE, pointer,
                         "pixel %" PRIu32 ", %" PRIu32 " lies beside the window of %" PRIu32 "x%" PRIu32
                         " pixels, the first of which is 0, 0",
                         ends[k]->pixel[0], ends[k]->pixel[1], view->width, view->height);
        }
    }
}

static void check_picks(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    char pointer[24];
    if (!zr_view_wants(view, ZR_CHANNEL_INFO))
        zr_error_add(error, ZR_BAD_SCENE, "/picks", "no output describes them: add the channel info");
    if (scene->is_undrawn)
        zr_error_add(error, ZR_BAD_SCENE, "/picks", "nothing is drawn that could be picked, since render is false");
    if (scene->algorithm == ZR_ALGORITHM_PAINTER)
        zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                     "painter keeps no fragments, which picks need; the other algorithms do");
    for (uint32_t i = 0; i < view->picks.count; i++) {
        const uint32_t x = view->picks.at[i][0], y = view->picks.at[i][1];
        snprintf(pointer, sizeof pointer, "/picks/%" PRIu32, i);
        if (x >= view->width || y >= view->height)
            zr_error_add(error, ZR_BAD_SCENE, pointer,
                         "pixel %" PRIu32 ", %" PRIu32 " lies beside the window of %" PRIu32 "x%" PRIu32
                         " pixels, the first of which is 0, 0",
                         x, y, view->width, view->height);
    }
}

/* Masks of instances are drawn from all fragments of the scene. */
static void check_visibility(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    const char *what = view->has_visibility ? "visibility" : "the channel masks";
    if (view->has_visibility && !zr_view_wants(view, ZR_CHANNEL_INFO) && !zr_view_wants(view, ZR_CHANNEL_MASKS))
        zr_error_add(error, ZR_BAD_SCENE, "/visibility", "no output shows it: add the channel info or masks");
    if (view->has_visibility && scene->is_undrawn)
        zr_error_add(error, ZR_BAD_SCENE, "/visibility", "nothing is visible, since render is false");
    if (view->has_visibility && scene->base)
        zr_error_add(error, ZR_BAD_SCENE, "/visibility",
                     "cannot be combined with a base, which may hide an instance and has none itself");
    if (scene->sections.count > 0)
        zr_error_add(error, ZR_BAD_SCENE, "/sections", "cannot be combined with %s, which needs whole instances", what);
    if (scene->algorithm == ZR_ALGORITHM_PAINTER)
        zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                     "painter keeps no fragments, which %s needs; the other algorithms do", what);
}

/* Moved parts and cut ones have no matrices of their own. */
static void check_flow(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    char pointer[48];
    const struct zr_flow *flow = scene->flow;
    snprintf(pointer, sizeof pointer, "/outputs/%" PRIu32 "%s", flow->output, flow->matrices ? "/to/poses" : "");
    if (flow->matrices && scene->parts.explode > 0.0)
        zr_error_add(error, ZR_BAD_SCENE, pointer, "poses of a flow cannot be combined with explode");
    if (flow->matrices && scene->sections.count > 0)
        zr_error_add(error, ZR_BAD_SCENE, pointer, "poses of a flow cannot be combined with sections");
    if (view->lens.model != ZR_LENS_NONE || (flow->has_view && flow->view.lens.model != ZR_LENS_NONE))
        zr_error_add(error, ZR_BAD_SCENE, pointer, "the channel flow cannot be combined with a distortion");
}

static bool has_faces(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->instance_count; i++)
        if (scene->meshes[scene->instances[i].mesh].face_count > 0) return true;
    return false;
}

/* An SVG has lines of the mesh, and nothing else. */
static void check_svg(const struct zr_scene *scene, struct zr_error *error)
{
    const struct zr_edges *edges = &scene->picture->edges;
    if (scene->csg)
        zr_error_add(error, ZR_BAD_SCENE, "/csg",
                     "the encoding svg has the lines of meshes, which do not end where operands are cut");
    else if (scene->base)
        zr_error_add(error, ZR_BAD_SCENE, "/base",
                     "the encoding svg has only the lines of the mesh, so it cannot be combined with a base");
    else if (!edges->is_on)
        zr_error_add(error, ZR_BAD_SCENE, "/edges",
                     "none: the encoding svg has only the lines of the mesh; give \"edges\": {\"from\": \"mesh\"}, or "
                     "the look technical");
    else if (!edges->is_from_mesh)
        zr_error_add(
            error, ZR_BAD_SCENE, "/edges",
            "these edges come from pixels, and the encoding svg has none: give \"edges\": {\"from\": \"mesh\"}, "
            "or the look technical");
    else if (!has_faces(scene))
        zr_error_add(error, ZR_BAD_SCENE, NULL, "the encoding svg has the lines of faces, and the scene has no face");
}

/* Steps are those of one pass over opaque faces at the centres of a small window's pixels. */
static void check_trace(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    static const char pointers[2][16] = {"/window/width", "/window/height"};
    const uint32_t sides[] = {view->width, view->height};
    char pointer[24];
    snprintf(pointer, sizeof pointer, "/outputs/%u",
             (unsigned)(zr_view_output(view, ZR_CHANNEL_TRACE) - view->outputs));
    for (int i = 0; i < 2; i++)
        if (sides[i] > ZR_TRACE_SIDE_MAX)
            zr_error_add(error, ZR_BAD_SCENE, pointers[i],
                         "%" PRIu32 " pixels; the channel trace is limited to a window of %d x %d", sides[i],
                         ZR_TRACE_SIDE_MAX, ZR_TRACE_SIDE_MAX);
    if (zr_any_is_see_through(scene->materials, scene->material_count))
        zr_error_add(
            error, ZR_BAD_SCENE, pointer,
            "the channel trace cannot be combined with the alphaMode MASK or BLEND, whose layers are drawn apart");
    if (scene->sections.count > 0)
        zr_error_add(error, ZR_BAD_SCENE, "/sections",
                     "cannot be combined with the channel trace, which needs whole faces");
    if (view->lens.model != ZR_LENS_NONE)
        zr_error_add(error, ZR_BAD_SCENE, "/view/distortion",
                     "cannot be combined with the channel trace: algorithms draw the picture of the pinhole");
}

/* A lens distorts a pinhole's pixels. */
static void check_lens(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    static const char pointer[] = "/view/distortion";
    if (view->projection != ZR_PROJECTION_PERSPECTIVE && view->projection != ZR_PROJECTION_INTRINSICS)
        zr_error_add(error, ZR_BAD_SCENE, pointer,
                     "belongs to a pinhole: give intrinsics, K or perspective as the projection");
    if (scene->base) zr_error_add(error, ZR_BAD_SCENE, pointer, "a distortion cannot be combined with a base");
    if (zr_view_encodes(view, ZR_ENCODING_SVG))
        zr_error_add(error, ZR_BAD_SCENE, pointer,
                     "the encoding svg has straight lines, which a lens bends; the others have pixels");
}

/* Checks that formats of pictures hold the window, and that a JPEG needs no alpha. */
static void check_formats(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    const uint32_t side = view->width > view->height ? view->width : view->height;
    for (uint32_t i = 0; i < view->output_count; i++) {
        char pointer[48];
        const struct zr_output *output = &view->outputs[i];
        const uint64_t bytes = 4 * (uint64_t)view->width * view->height * zr_channel_rows[output->channel].words;
        const struct zr_encoding_row *row = &zr_encoding_rows[output->encoding];
        snprintf(pointer, sizeof pointer, "/outputs/%" PRIu32 "/encoding", i);
        if (row->side_max > 0 && side > row->side_max)
            zr_error_add(error, ZR_BAD_SCENE, pointer,
                         "a %s has up to %" PRIu32 " pixels per side, and the window is %" PRIu32 "x%" PRIu32,
                         row->word, row->side_max, view->width, view->height);
        if (output->encoding == ZR_ENCODING_JPEG && scene->background.w < 1.0f)
            zr_error_add(error, ZR_BAD_SCENE, pointer,
                         "a jpeg has no alpha, and the background has: give an opaque background, or the encoding webp "
                         "or png");
        if (output->encoding == ZR_ENCODING_TIFF && bytes > ZR_TIFF_BYTES_MAX)
            zr_error_add(error, ZR_BAD_SCENE, pointer,
                         "a tiff has less than 4 GiB, and this window has %" PRIu64 " bytes: npy has no such limit",
                         bytes);
    }
}

/* A request without drawing has only facts as outputs. */
static void check_undrawn(const struct zr_view *view, struct zr_error *error)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel != ZR_CHANNEL_INFO)
            zr_error_add(error, ZR_BAD_SCENE, "/render",
                         "false draws nothing, so the channel %s has no values; info is the one channel that needs no "
                         "picture",
                         zr_channel_rows[view->outputs[i].channel].name);
}

/* Checks the pixel of outputs `fragments`. There is no pointer, since the output may come from the query. */
static void check_pixels(const struct zr_view *view, struct zr_error *error)
{
    for (uint32_t i = 0; i < view->output_count; i++) {
        const struct zr_output *output = &view->outputs[i];
        if (output->channel == ZR_CHANNEL_FRAGMENTS && (output->x >= view->width || output->y >= view->height))
            zr_error_add(error, ZR_BAD_SCENE, NULL,
                         "the output fragments is of pixel %" PRIu32 ", %" PRIu32 ", beside the window of %" PRIu32
                         "x%" PRIu32 " pixels, the first of which has 0, 0",
                         output->x, output->y, view->width, view->height);
    }
}

static void check_xrays(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    const bool has_color = zr_view_wants(view, ZR_CHANNEL_COLOR);
    if (has_color && zr_any_is_xray(scene->materials, scene->material_count))
        zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                     "painter keeps no fragments, which the shading xray needs; the other algorithms do");
    if (has_color && zr_any_is_glass(scene->materials, scene->material_count))
        zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                     "painter keeps no fragments, which transmissionFactor needs; the other algorithms do");
}

static void check_see_through(const struct zr_scene *scene, struct zr_error *error)
{
    if (!zr_any_is_see_through(scene->materials, scene->material_count)) return;
    if (scene->base)
        zr_error_add(error, ZR_BAD_SCENE, "/base", "the alphaMode MASK or BLEND cannot be combined with a base");
    if (scene->algorithm == ZR_ALGORITHM_PAINTER)
        zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                     "painter keeps no fragments, which the alphaMode MASK or BLEND needs; the other algorithms do");
}

/* Solids are walked through fragments; these channels show the operands. */
static void check_csg(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    static const enum zr_channel refused[] = {ZR_CHANNEL_LAYERS, ZR_CHANNEL_THICKNESS, ZR_CHANNEL_MASKS,
                                              ZR_CHANNEL_TRACE, ZR_CHANNEL_WALL};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++)
        if (zr_view_wants(view, refused[i]))
            zr_error_add(error, ZR_BAD_SCENE, "/csg", "the channel %s has the operands, not the solids that they make",
                         zr_channel_rows[refused[i]].name);
    if (view->has_visibility)
        zr_error_add(error, ZR_BAD_SCENE, "/visibility",
                     "cannot be combined with csg, whose operands are drawn in part");
    if (scene->algorithm == ZR_ALGORITHM_PAINTER)
        zr_error_add(error, ZR_BAD_SCENE, "/algorithm",
                     "painter keeps no fragments, which csg needs; the other algorithms do");
}

/* Checks the optional parts that a scene has. */
static void check_options(const struct zr_scene *scene, const struct zr_view *view, struct zr_error *error)
{
    const bool is_painter = scene->algorithm == ZR_ALGORITHM_PAINTER;
    if (scene->light_count > 0) check_lamps(scene, error);
    if (scene->base) check_base(scene, view, error);
    if (scene->base || is_painter) check_see_through(scene, error);
    if (is_painter) check_xrays(scene, view, error);
    if (is_painter) check_layers(view, error);
    if (scene->has_features && !zr_view_wants(view, ZR_CHANNEL_INFO))
        zr_error_add(error, ZR_BAD_SCENE, "/features", "no output shows them: add the channel info");
    check_dimensions(scene, view, error);
    if (scene->distance_count > 0 && !zr_view_wants(view, ZR_CHANNEL_INFO))
        zr_error_add(error, ZR_BAD_SCENE, "/distances", "no output shows them: add the channel info");
    if (view->picks.count > 0) check_picks(scene, view, error);
    if (zr_view_has_masks(view)) check_visibility(scene, view, error);
    if (zr_view_wants(view, ZR_CHANNEL_FRAGMENTS)) check_pixels(view, error);
    if (scene->flow && zr_view_wants(view, ZR_CHANNEL_FLOW)) check_flow(scene, view, error);
    if (zr_view_encodes(view, ZR_ENCODING_SVG)) check_svg(scene, error);
    if (view->lens.model != ZR_LENS_NONE) check_lens(scene, view, error);
    if (zr_view_wants(view, ZR_CHANNEL_TRACE)) check_trace(scene, view, error);
    check_formats(scene, view, error);
    if (scene->csg) check_csg(scene, view, error);
    if (scene->is_undrawn) check_undrawn(view, error);
}

enum zr_status zr_scene_validate(const struct zr_scene *scene, const struct zr_limits *limits, struct zr_error *error)
{
    size_t before = error->count;
    check_view(&scene->views[0], limits, error);
    check_geometry(scene, error);
    check_options(scene, &scene->views[0], error);
    return error->count > before ? ZR_BAD_SCENE : ZR_OK;
}

enum zr_status zr_strict_check(const struct zr_scene *scene, const char *const *texts, size_t count,
                               struct zr_error *error)
{
    enum zr_status status = ZR_OK;
    for (size_t i = 0; scene->is_strict && i < count; i++)
        status = zr_error_add(error, ZR_BAD_SCENE, NULL, "%s", texts[i]);
    return status;
}
