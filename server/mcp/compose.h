/* compose.h - mcp: the scene that the arguments of a call make. */
#ifndef MCP_COMPOSE_H
#define MCP_COMPOSE_H

#include "job.h"

/* A picture to draw of a scene. */
struct mcp_picture {
    const char *outputs;    /* JSON */
    unsigned width, height; /* 0: no picture of the renderer */
    const char *view;       /* JSON of one view that replaces all; NULL: those of the job */
    const char *picks;      /* JSON of pixels that info describes; NULL: none */
    int only;               /* number of the job's only view to draw; -1: all */
};

/* Makes the scene in memory of the host. False: no memory. */
bool mcp_compose(const struct mcp_job *job, const struct mcp_picture *picture, struct mcp_draw *draw);

#endif
