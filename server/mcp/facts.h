/* facts.h - mcp: facts of a model and its views, as structured content and as text. */
#ifndef MCP_FACTS_H
#define MCP_FACTS_H

#include "job.h"

/* One picture of an answer. */
struct mcp_shot {
    char name[65]; /* of the view; "": the only one */
    const void *image;
    size_t size;
    const char *type; /* "image/png" */
    cJSON *info;      /* channel info of the view; NULL: none */
    unsigned width, height;
};

/* Adds the unit of the model, or null, to the structured content. */
void mcp_facts_add_unit(cJSON *content, const cJSON *info);

/* Adds the facts of the model to the structured content: units, box, volume, area, closed, parts. */
void mcp_facts_add(cJSON *content, const cJSON *info);

/* Adds the views of a picture, which has this number, to the list of views. */
void mcp_facts_add_views(cJSON *views, const struct mcp_shot *shot, unsigned number, bool is_sheet);

/* Adds the warnings of an info that are not yet in the list. */
void mcp_facts_add_warnings(cJSON *warnings, const cJSON *info);

/* Writes the facts of the model. */
void mcp_facts_describe(struct mcp_text *text, const cJSON *content);

/* Writes what a picture shows, from the items of `views` that have its number. */
void mcp_facts_describe_shot(struct mcp_text *text, const cJSON *content, const struct mcp_shot *shot, unsigned number);

/* Returns the name of a unit as it is written after numbers: "mm", "units". */
const char *mcp_facts_unit(const cJSON *content);

#endif
