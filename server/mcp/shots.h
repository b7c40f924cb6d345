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
    bool is_smaller;  /* than asked for, since the pictures would have had too many bytes */
    cJSON *fragments; /* channel of a single view; NULL: not drawn */
    struct mcp_drawn drawn;
    bool has_drawn;
};

/* Draws the pictures of a job, or with `only_info` just what they show. Faults go to the job. If nothing fits, tries
 * fewer bytes a pixel, then fewer pixels. */
enum mcp_draw_status mcp_shots_draw(struct mcp_job *job, bool only_info, struct mcp_shots *shots);

/* Draws what `picture` says, once. */
enum mcp_draw_status mcp_shots_draw_once(struct mcp_job *job, const struct mcp_picture *picture,
                                         struct mcp_shots *shots);
void mcp_shots_free(const struct mcp_host *host, struct mcp_shots *shots);

#endif
