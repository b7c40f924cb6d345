/* mcp_host.h - tests: a host of the handler of MCP that draws nothing: it looks at each scene, and answers facts and
 * pictures of its own. */
#ifndef ZR_TESTS_MCP_HOST_H
#define ZR_TESTS_MCP_HOST_H

#include "mcp/handler.h"

/* Counts of what was asked for, and the text of the last scene. */
struct mcp_test_host {
    struct mcp_host host;
    size_t draws, wrong_scenes; /* scenes that are no JSON objects */
    char *scene;
    size_t scene_size;
    void **blocks;
    size_t block_count;
    struct zr_cancel cancel;
    char answer[4096];
};

void mcp_test_host_open(struct mcp_test_host *test);
void mcp_test_host_close(struct mcp_test_host *test);

/* Returns true for a text of JSON that begins with `first`; 0: with any byte. */
bool mcp_test_is_json(const char *bytes, size_t size, char first);

/* Handles a message. The caller frees the text. */
struct mcp_reply mcp_test_handle(struct mcp_test_host *test, const char *bytes, size_t size);

#endif
