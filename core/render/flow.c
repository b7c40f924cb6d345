#include "render/flow.h"

#include "base/run.h"
#include "render/pass.h"
#include "render/stage.h"
#include "scene/camera/flow.h"

/* All that outlives the call. */
struct drawn {
    struct zr_scene scene;
    struct zr_frame frame;
    struct zr_pass pass;
    struct zr_flow_target target;
};

enum zr_status zr_flow_target_draw(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const size_t pixels = (size_t)frame->width * frame->height;
    enum zr_status status = ZR_OK;
    struct drawn *drawn = zr_arena_zero(run->arena, 1, sizeof *drawn);
    if (!drawn || !zr_flow_scene(run->arena, scene, &drawn->scene)) return ZR_NO_MEMORY;
    drawn->frame = (struct zr_frame){.width = frame->width,
                                     .height = frame->height,
                                     .camera = frame->flow_camera,
                                     .owners = zr_arena_alloc(run->arena, pixels, sizeof *drawn->frame.owners),
                                     .spans = zr_arena_alloc(run->arena, frame->height, sizeof *drawn->frame.spans)};
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    if (!zr_arena_clear(run->arena, drawn->frame.owners, pixels * sizeof *drawn->frame.owners)) return ZR_CANCELLED;
    const struct zr_pass_desc desc = {.scene = &drawn->scene,
                                      .camera = &drawn->frame.camera,
                                      .window = zr_window_of(scene, frame->width, frame->height, 1)};
    STAGE(zr_pass_make(run, &desc, &drawn->pass));
    STAGE(zr_tiles_draw(run, &drawn->pass.tiles, &drawn->frame));
    drawn->target = (struct zr_flow_target){&drawn->pass.geometry, &drawn->frame};
    frame->flow = &drawn->target;
    return status;
}
