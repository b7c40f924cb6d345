/* shots.h - mcp: the pictures of a job, small enough for a message. */
#ifndef MCP_SHOTS_H
#define MCP_SHOTS_H

#include "compose.h"
#include "facts.h"

/* Characters of base64 of all pictures of an answer. */
enum { MCP_IMAGE_BYTES_MAX = 700000 };

struct mcp_shots {
    struct mcp_shot at[MCP_IMAGES_MAX];
    unsigned count;
    bool is_smaller;  /* than `width` and `height` of the job, to fit into IMAGE_BYTES_MAX */
    cJSON *fragments; /* channel of a single view; NULL: not drawn */
    struct mcp_drawn drawn;
    bool has_drawn;
};

/* Draws the pictures of a job, or with `only_info` the channel info alone. Faults go to the job. While they are too
 * large, draws them again with fewer bytes per pixel, then with fewer pixels. */
enum mcp_draw_status mcp_shots_draw(struct mcp_job *job, bool only_info, struct mcp_shots *shots);

/* Draws one picture, or several views of one request. */
enum mcp_draw_status mcp_shots_draw_once(struct mcp_job *job, const struct mcp_picture *picture,
                                         struct mcp_shots *shots);
void mcp_shots_free(const struct mcp_host *host, struct mcp_shots *shots);

#endif
