/* arguments.h - mcp: tools and their arguments, one row each. The list of tools (tools.c) and the checks of a call
 * (job.c, model.c) follow from the rows; formats, looks, views and encodings come from the tables of the core. */
#ifndef MCP_ARGUMENTS_H
#define MCP_ARGUMENTS_H

#include "faults.h"
#include "text.h"

enum mcp_tool { MCP_RENDER, MCP_FACTS, MCP_PICK, MCP_TOOLS };

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
