/* arguments.h - mcp: tools and their arguments, one row each. The list of tools (tools.c) and the checks of a call
 * (job.c, model.c) follow from the rows; formats, looks, views and encodings come from the tables of the core. */
#ifndef MCP_ARGUMENTS_H
#define MCP_ARGUMENTS_H

#include <stdbool.h>

#include "faults.h"
#include "text.h"

/* ROW(ID, whether it draws: it then has the arguments of pictures, and its answer lists their views) */
#define MCP_TOOL_ROWS(ROW)                                                                                             \
    ROW(RENDER, true)                                                                                                  \
    ROW(FACTS, false)                                                                                                  \
    ROW(PICK, true)                                                                                                    \
    ROW(COMPARE, false)                                                                                                \
    ROW(DRAWING, false)

#define MCP_TOOL(ID, draws) MCP_##ID,
enum mcp_tool { MCP_TOOL_ROWS(MCP_TOOL) MCP_TOOLS };
#undef MCP_TOOL

/* Sets of tools. */
#define MCP_DRAWING_TOOL(ID, draws) | (draws) << MCP_##ID
enum { MCP_ALL_TOOLS = (1 << MCP_TOOLS) - 1, MCP_DRAWING_TOOLS = 0 MCP_TOOL_ROWS(MCP_DRAWING_TOOL) };
#undef MCP_DRAWING_TOOL

/* Those of one model. */
enum { MCP_MODEL_TOOLS = MCP_ALL_TOOLS & ~(1 << MCP_COMPARE) };

static inline bool mcp_draws(enum mcp_tool tool)
{
    return MCP_DRAWING_TOOLS >> tool & 1;
}

/* A key of an object. */
struct mcp_key {
    const char *name; /* NULL: the end of the list */
    unsigned of;      /* set of the tools that have it (1 << tool); of sources of a model: MCP_OF_* */
    const char *schema;
    /* Puts words in place of the $ of the schema; NULL: there is none. */
    void (*put)(struct mcp_text *text, const struct mcp_host *host);
};
enum { MCP_OF_FILES = 1, MCP_OF_ASSETS = 2 }; /* hosts that read files, and hosts that have assets */

extern const struct mcp_key mcp_arguments[], mcp_model_sources[], mcp_part_keys[];

/* Adds the keys of a set as the properties of a schema. */
void mcp_keys_put(struct mcp_text *text, const struct mcp_key *keys, unsigned of, const struct mcp_host *host);

/* Returns true if z is the default up axis of a model's format: by the ending of its path, or by its bytes. */
bool mcp_model_is_z_up(const char *path, const void *bytes, size_t size);

struct mcp_words mcp_words_of_keys(const struct mcp_key *keys, unsigned of);
struct mcp_words mcp_words_of_formats(void); /* encodings of pictures: ZR_ENCODING_FOR_AGENTS */

/* Returns the word of the list that equals `word`; NULL: none. */
const char *mcp_words_find(const struct mcp_words *words, const char *word);

#endif
