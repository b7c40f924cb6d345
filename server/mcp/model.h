/* model.h - mcp: the argument `model` of a tool: a file's bytes, text, path or asset. */
#ifndef MCP_MODEL_H
#define MCP_MODEL_H

#include "host.h"
#include "message.h"

enum { MCP_NAME_SIZE = 256 };

struct mcp_model {
    char name[MCP_NAME_SIZE]; /* by which a scene refers to it */
    const char *path;         /* below the host's root; NULL: none */
    const void *bytes;        /* NULL: the host has the file, or there is none */
    size_t size;
    bool is_given, z_is_up; /* of its format */
};

/* Reads `model`. False: there are faults, memory is exhausted or the request is cancelled. */
bool mcp_model_read(const struct mcp_host *host, const struct mcp_message *message, struct mcp_model *model,
                    struct mcp_faults *faults);

/* Turns a pointer into /model, or into the only mesh of a scene, into one into a (side 0) or b. */
void mcp_side_point(char pointer[MCP_POINTER_SIZE], int side);

/* Reads `a` (side 0) or `b` of MCP_COMPARE in the same way; both are required. */
bool mcp_side_read(const struct mcp_host *host, const struct mcp_message *message, int side, struct mcp_model *model,
                   struct mcp_faults *faults);

#endif
