#include "meshes.h"

enum { IN_MESH = 2 };

bool mcp_meshes_next(struct mcp_walk *walk, struct mcp_span *name)
{
    struct mcp_span key;
    if (walk->depth == 0 && mcp_walk_peek(walk) == '[') mcp_walk_enter(walk, '[');
    while (walk->depth > 0 && walk->fault == MCP_WALK_OK) {
        if (walk->depth == IN_MESH) {
            if (!mcp_walk_member(walk, &key)) continue;
            mcp_walk_value(walk, name);
            if (mcp_span_is(key, "asset") && mcp_span_is(*name, "\"model\"")) return true;
        } else if (mcp_walk_item(walk)) {
            if (mcp_walk_peek(walk) == '{')
                mcp_walk_enter(walk, '{');
            else
                mcp_walk_value(walk, NULL);
        }
    }
    return false;
}
