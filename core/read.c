/* A request -> a scene: picks the reader, puts a scene around a bare mesh, and
 * lets the query have its say. */
#include "geometry/geometry.h"
#include "input/formats.h"
#include "input/names.h"
#include "input/parameters.h"
#include "input/sniff.h"
#include "overlay/color_bar_layout.h"
#include "scene/defaults.h"
#include "scene/validate.h"
#include "strict.h"

/* Turns what is up in the mesh to the y axis. */
static zr_mat4 upright(bool z_is_up)
{
    if (!z_is_up) return zr_mat4_identity();
    return (zr_mat4){{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}};
}

/* A query that says how many samples is refused where the window cannot have them. */
static enum zr_status fit_samples(struct zr_scene_builder *builder, const struct zr_query *query,
                                  struct zr_error *error)
{
    struct zr_picture *picture = &builder->scene->picture;
    const struct zr_view *view = &query->view;
    const uint32_t side = picture->side, fits = zr_picture_side_in(side, view->width, view->height);
    picture->side = fits;
    if (fits == side) return ZR_OK;
    if (zr_picture_gives(&query->picture, ZR_PICTURE_SIDE))
        return zr_error_add(error, ZR_BAD_SCENE, NULL,
                            "query parameter samples: %u; in a window of %u x %u up to %u are allowed", side * side,
                            view->width, view->height, fits * fits);
    zr_warn_of_fewer_samples(builder, side, fits);
    return ZR_OK;
}

static bool is_of_linear_light(const struct zr_query *query)
{
    return query->look->picture.is_linear || query->face_style.shading >= ZR_SHADING_PBR;
}

static void warn_of_soup(struct zr_scene_builder *builder, const struct zr_format_row *format, int shading)
{
    if (!format->is_soup || builder->scene->picture.is_linear || shading < ZR_SHADING_GOURAUD) return;
    zr_warning_list_add(builder->arena, &builder->color_warnings,
                        "shading=%s looks flat here: the triangles of %s share no corners; OBJ can be smooth",
                        zr_shading_names.words[shading], format->name);
}

/* Bare meshes become what the query makes of them: their looks, where they are, and the view of them. */
static enum zr_status apply_query(struct zr_scene_builder *builder, const struct zr_request *request,
                                  const struct zr_query *query, struct zr_error *error)
{
    struct zr_scene *scene = builder->scene;
    struct zr_instance *instances = zr_arena_alloc(builder->arena, scene->mesh_count, sizeof *instances);
    if (!instances) return ZR_NO_MEMORY;
    zr_look_apply(query->look, scene);
    scene->picture = zr_picture_merge(&query->picture, query->look);
    scene->picture.is_linear = is_of_linear_light(query);
    scene->background = query->background;
    scene->views[0] = query->view;
    for (size_t i = 0; i < request->asset_count; i++)
        zr_warn_of_unused_asset(builder, &request->assets[i]);
    warn_of_soup(builder, &zr_format_rows[request->format], query->face_style.shading);
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        struct zr_mesh *mesh = &builder->meshes[i];
        const bool is_colored = mesh->colors != NULL;
        const zr_vec4 color = query->has_color ? query->color : zr_default_base_color(query->look, is_colored);
        const struct zr_material material =
            zr_face_style_material(&query->face_style, query->look, color, mesh->normal_count > 0 || is_colored);
        mesh->material = zr_scene_builder_material(builder, &material);
        instances[i] = (struct zr_instance){.mesh = i, .object_to_world = upright(query->z_is_up)};
    }
    zr_scene_builder_place(builder, instances, scene->mesh_count);
    return fit_samples(builder, query, error);
}

static enum zr_status apply_output(struct zr_arena *arena, const struct zr_query *query, struct zr_scene *scene)
{
    if (!query->has_output) return ZR_OK;
    struct zr_output *output = zr_arena_alloc(arena, 1, sizeof *output);
    if (!output) return ZR_NO_MEMORY;
    *output = query->output;
    scene->views[0].outputs = output;
    scene->views[0].output_count = 1;
    return ZR_OK;
}

/* Nodes can place a large mesh so often that to walk over its points would take minutes. What
 * drawing will keep of each placed point must fit, and so it never comes to that. */
static bool fits_memory(struct zr_arena *arena, const struct zr_scene *scene)
{
    uint64_t points = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        points += scene->meshes[scene->instances[i].mesh].position_count;
    const uint64_t point_bytes = sizeof(struct zr_window_vertex) + sizeof(struct zr_eye);
    if (points <= zr_arena_left(arena) / point_bytes) return true;
    return zr_arena_charge(arena, points < SIZE_MAX / point_bytes ? points * point_bytes : SIZE_MAX); /* fails */
}

/* Whether there is a colour bar; what it is like, a scene says. */
static void apply_color_bar(struct zr_scene_builder *builder, const struct zr_query *query)
{
    if (query->has_color_bar) builder->scene->color_bar.is_on = query->color_bar != 0;
    zr_color_bar_warn(builder->arena, builder->scene, &builder->scene->views[0], &builder->warnings);
}

static void skip_byte_order_mark(struct zr_request *request)
{
    const size_t mark =
        zr_format_rows[request->format].is_binary ? 0 : zr_byte_order_mark(request->bytes, request->size);
    request->bytes += mark;
    request->size -= mark;
}

/* Bytes that cannot be read, since they are something else than their type says. */
static enum zr_status name_bytes(const struct zr_request *request, enum zr_status status, struct zr_error *error)
{
    const struct zr_format_row *said = &zr_format_rows[request->format];
    if (status != ZR_BAD_SYNTAX || said->looks_so(request->bytes, request->size) ||
        zr_format_of_bytes(request->bytes, request->size) == request->format)
        return status;
    const char *words = zr_bytes_in_words(request->bytes, request->size);
    if (!words) return status;
    const struct zr_error all = *error;
    *error = (struct zr_error){0};
    zr_error_add(error, status, NULL, "the body is said to be %s, and looks like %s", said->name, words);
    for (size_t i = 0; i < zr_error_held(&all); i++)
        zr_error_add(error, status, all.items[i].pointer, "%s", all.items[i].detail);
    return status;
}

/* What no type tells, the bytes do. */
static enum zr_status find_format(struct zr_request *request, struct zr_error *error)
{
    if (request->format != ZR_FORMAT_UNKNOWN) return ZR_OK;
    request->format = zr_format_of_bytes(request->bytes, request->size);
    if (request->format != ZR_FORMAT_UNKNOWN) return ZR_OK;
    const char *words = zr_bytes_in_words(request->bytes, request->size);
    return zr_error_add(error, ZR_BAD_TYPE, NULL,
                        "no Content-Type says what the body is; it looks like %s%snone of: %s", words ? words : "",
                        words ? ", which is " : "", zr_format_types_join().text);
}

static enum zr_status read_scene(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                                 const struct zr_limits *limits, struct zr_scene *scene, struct zr_error *error)
{
    struct zr_query query;
    zr_scene_defaults(scene);
    enum zr_status status = zr_query_read(request, limits, scene, &query, error);
    if (status != ZR_OK) return status;
    const struct zr_format_row *format = &zr_format_rows[request->format];
    struct zr_scene_builder builder = zr_scene_builder_open(arena, team, scene);
    status = name_bytes(request, format->read(&builder, request, limits, error), error);
    if (status != ZR_OK) return status;
    if (!format->has_view) status = apply_query(&builder, request, &query, error);
    if (status == ZR_OK) status = apply_output(arena, &query, scene);
    if (status != ZR_OK) return status;
    apply_color_bar(&builder, &query);
    zr_scene_builder_close(&builder);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    if (query.has_compress) scene->compress = query.compress;
    scene->is_strict = query.is_strict;
    status = zr_scene_validate(scene, limits, error);
    if (status == ZR_OK) status = zr_strict_check(scene, scene->warnings, scene->warning_count, error);
    return status == ZR_OK && !fits_memory(arena, scene) ? ZR_NO_MEMORY : status;
}

enum zr_status zr_scene_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                             const struct zr_limits *limits, const struct zr_scene **scene, struct zr_error *error)
{
    struct zr_scene *made = zr_arena_alloc(arena, 1, sizeof *made);
    struct zr_request body = *request;
    if (body.size == 0) body.bytes = ""; /* no arithmetic on a null pointer */
    enum zr_status status = made ? find_format(&body, error) : ZR_NO_MEMORY;
    if (status == ZR_OK) skip_byte_order_mark(&body);
    arena->cancel = request->cancel;
    if (status == ZR_OK) status = read_scene(arena, team, &body, limits, made, error);
    arena->cancel = NULL;
    if (zr_is_cancelled(request->cancel)) {
        *error = (struct zr_error){0}; /* of what was not read to its end */
        return zr_error_add(error, ZR_CANCELLED, NULL, "reading was stopped before it was done");
    }
    if ((status == ZR_OK && !zr_arena_ok(arena)) || (status == ZR_NO_MEMORY && error->count == 0))
        status =
            zr_error_add(error, ZR_NO_MEMORY, NULL,
                         "the scene needs more memory than the %zu bytes that one request may have", arena->ceiling);
    if (status != ZR_OK) return status;
    *scene = made;
    return ZR_OK;
}
