/* A message of MCP. The scene that a tool makes of it is JSON, and so is the answer. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "support/mcp_host.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct mcp_test_host test;
    mcp_test_host_open(&test);
    struct mcp_reply reply = mcp_test_handle(&test, (const char *)data, size);
    fuzz_expect(test.wrong_scenes == 0, "a scene is a JSON object");
    if (reply.text.size > 0) {
        fuzz_expect(mcp_test_is_json(reply.text.data, reply.text.size, 0), "an answer is JSON");
        fuzz_expect(!memchr(reply.text.data, '\n', reply.text.size), "an answer is one line");
    }
    fuzz_accepted = reply.text.size == 0 || !strstr(reply.text.data, "\"error\":");
    mcp_text_free(&reply.text);
    mcp_test_host_close(&test);
    return 0;
}
