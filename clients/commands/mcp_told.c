#include "commands/mcp_told.h"

#include <stdlib.h>
#include <string.h>

#include "commands/mcp_files.h"
#include "mcp/faults.h"
#include "mcp/model.h"

/* Objects behind the answer. */
struct owned {
    zraster_comparison *comparison;
    zraster_picture *picture;
    zraster_drawing *drawing;
};

void mcp_told_faults(const zraster_error *error, struct mcp_faults *faults)
{
    for (size_t i = 0; i < zraster_error_count(error); i++)
        mcp_fault(faults, zraster_error_pointer(error, i), "%s", zraster_error_detail(error, i));
    if (faults->count == 0) mcp_fault(faults, "", "%s", zraster_error_text(error));
}

static zraster_status read_input(const struct engine *engine, const struct input *input, zraster_scene **scene,
                                 struct mcp_faults *faults)
{
    zraster_error *error = NULL;
    const zraster_status status = engine_read_here(engine, input, NULL, scene, &error);
    if (status != ZRASTER_OK) mcp_told_faults(error, faults);
    zraster_error_free(error);
    return status;
}

/* Reads a model. Faults get the name of its argument, if it is a side of a comparison: 0 or 1; -1: it is none. */
static enum mcp_draw_status read_side(const struct engine *engine, const char *root, const struct mcp_draw *draw,
                                      int side, zraster_scene **scene, struct mcp_faults *faults)
{
    struct input *input = malloc(sizeof *input);
    enum mcp_draw_status status = MCP_REFUSED;
    if (input && mcp_files_read(input, root, draw, faults)) {
        const zraster_status read = read_input(engine, input, scene, faults);
        status = read == ZRASTER_OK ? MCP_DRAWN : read == ZRASTER_CANCELLED ? MCP_CANCELLED : MCP_REFUSED;
    } else if (faults->count == 0)
        mcp_fault(faults, "", "out of memory");
    if (input) mcp_files_free(input, draw);
    free(input);
    for (size_t i = 0; side >= 0 && i < faults->count; i++)
        mcp_side_point(faults->at[i].pointer, side);
    return status;
}

static zraster_status compare_scenes(const struct engine *engine, zraster_scene *const scenes[2], const char *query,
                                     struct owned *owned, struct zraster_bytes *picture, zraster_error **error)
{
    const struct zraster_request change = {
        .struct_size = sizeof change, .query = "width=800&height=600", .cancel = engine->cancel};
    zraster_status status = zraster_compare(scenes[0], scenes[1], query, engine->cancel, &owned->comparison, error);
    const zraster_scene *shown = status == ZRASTER_OK ? zraster_comparison_scene(owned->comparison) : NULL;
    if (!shown) return status;
    status = zraster_scene_draw(shown, &change, &owned->picture, error);
    return status == ZRASTER_OK ? zraster_picture_encode(owned->picture, NULL, picture, error) : status;
}

static void free_owned(struct owned *owned)
{
    if (!owned) return;
    zraster_picture_free(owned->picture);
    zraster_comparison_free(owned->comparison);
    zraster_drawing_free(owned->drawing);
    free(owned);
}

/* Ends a call whose result is `owned`: gives that to *told, or its faults. Frees the error. */
static enum mcp_draw_status hand_over(zraster_status status, struct owned *owned, const char *json,
                                      struct zraster_bytes picture, zraster_error *error, struct mcp_told *told)
{
    if (status == ZRASTER_OK) {
        told->json = json;
        told->picture = picture.data;
        told->picture_size = picture.size;
        told->owner = owned;
    } else {
        mcp_told_faults(error, &told->faults);
        free_owned(owned);
    }
    zraster_error_free(error);
    return status == ZRASTER_OK ? MCP_DRAWN : status == ZRASTER_CANCELLED ? MCP_CANCELLED : MCP_REFUSED;
}

/* Returns NULL, with a fault, without memory. */
static struct owned *make_owned(struct mcp_told *told)
{
    struct owned *owned = calloc(1, sizeof *owned);
    if (!owned) mcp_fault(&told->faults, "", "out of memory");
    return owned;
}

static enum mcp_draw_status compare_read(const struct engine *engine, zraster_scene *const scenes[2], const char *query,
                                         struct mcp_told *told)
{
    struct owned *owned = make_owned(told);
    struct zraster_bytes picture = {.data = NULL};
    zraster_error *error = NULL;
    if (!owned) return MCP_REFUSED;
    const zraster_status status = compare_scenes(engine, scenes, query, owned, &picture, &error);
    const char *json = status == ZRASTER_OK ? zraster_comparison_json(owned->comparison) : NULL;
    return hand_over(status, owned, json, picture, error, told);
}

enum mcp_draw_status mcp_told_compare(const struct engine *engine, const char *root, const struct mcp_compare *compare,
                                      struct mcp_told *told)
{
    zraster_scene *scenes[2] = {NULL, NULL};
    enum mcp_draw_status status = MCP_DRAWN;
    for (int i = 0; i < 2 && status == MCP_DRAWN; i++)
        status = read_side(engine, root, &compare->sides[i], i, &scenes[i], &told->faults);
    if (status == MCP_DRAWN) status = compare_read(engine, scenes, compare->query, told);
    for (int i = 0; i < 2; i++)
        zraster_scene_free(scenes[i]);
    return status;
}

static enum mcp_draw_status draw_read(const struct engine *engine, const zraster_scene *scene, const char *query,
                                      struct mcp_told *told)
{
    struct owned *owned = make_owned(told);
    struct zraster_bytes file = {.data = NULL};
    zraster_error *error = NULL;
    if (!owned) return MCP_REFUSED;
    const zraster_status status = zraster_drawing_make(scene, query, engine->cancel, &owned->drawing, &error);
    if (status == ZRASTER_OK) file = zraster_drawing_file(owned->drawing);
    const char *json = status == ZRASTER_OK ? zraster_drawing_json(owned->drawing) : NULL;
    return hand_over(status, owned, json, file, error, told);
}

enum mcp_draw_status mcp_told_drawing(const struct engine *engine, const char *root, const struct mcp_draw *draw,
                                      const char *query, struct mcp_told *told)
{
    zraster_scene *scene = NULL;
    enum mcp_draw_status status = read_side(engine, root, draw, -1, &scene, &told->faults);
    if (status == MCP_DRAWN) status = draw_read(engine, scene, query, told);
    zraster_scene_free(scene);
    return status;
}

void mcp_told_release(struct mcp_told *told)
{
    free_owned(told->owner);
}
