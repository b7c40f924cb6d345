#include "for_agents.h"

#include "base/arena.h"
#include "mcp/faults.h"
#include "rendering.h"
#include "request/change.h"
#include "routes.h"

enum zr_status for_agent_read(const struct work *work, const struct zr_run *run, const struct mcp_draw *draw,
                              const struct zr_scene **scene)
{
    const struct zr_stored stored = assets_stored(work->service);
    const struct zr_asset asset = {.name = draw->file_name, .bytes = draw->file, .size = draw->file_size};
    const struct zr_scene_file file = {.type = "application/json",
                                       .bytes = draw->scene,
                                       .size = draw->scene_size,
                                       .assets = zr_arena_copy(run->arena, &asset, sizeof asset),
                                       .asset_count = draw->file_name ? 1 : 0,
                                       .stored = zr_arena_copy(run->arena, &stored, sizeof stored)};
    return zr_arena_ok(run->arena) ? zr_scene_read_file(run, &file, &work->service->limits, scene) : ZR_NO_MEMORY;
}

enum mcp_draw_status for_agent_refuse(const struct zr_run *run, enum zr_status status, struct mcp_faults *faults)
{
    if (status == ZR_CANCELLED) return MCP_CANCELLED;
    for (size_t i = 0; i < zr_error_held(run->error); i++)
        mcp_fault(faults, run->error->items[i].pointer, "%s", run->error->items[i].detail);
    if (faults->count == 0) mcp_fault(faults, "", "out of memory");
    return MCP_REFUSED;
}
