/* job.h - mcp: the arguments of a call, and the scene that they make. */
#ifndef MCP_JOB_H
#define MCP_JOB_H

#include "arguments.h"
#include "model.h"

/* IMAGES_MAX: pictures of an answer. SIDE_MAX: pixels of a side; models shrink larger pictures before they read them.
 * SIDE_MIN: captions have no room in smaller ones. */
enum { MCP_IMAGES_MAX = 8, MCP_SIDE_MIN = 16, MCP_SIDE_MAX = 1568 };

/* Keys of a given scene that decide about its pictures and its model. Those from MCP_OWN_VIEW on choose its views;
 * those from MCP_OWN_TURNTABLE on make several. */
enum mcp_own {
    MCP_OWN_MESHES,
    MCP_OWN_LOOK,
    MCP_OWN_UP,
    MCP_OWN_OUTPUTS,
    MCP_OWN_VISIBILITY,
    MCP_OWN_RENDER,
    MCP_OWN_WINDOW,
    MCP_OWN_PICKS,
    MCP_OWN_VIEW,
    MCP_OWN_VIEWS,
    MCP_OWN_SHEET,
    MCP_OWN_TURNTABLE,
    MCP_OWN_ORBIT,
    MCP_OWN_ANIMATE,
    MCP_OWN_COUNT
};

struct mcp_job {
    const struct mcp_host *host;
    const struct mcp_message *message;
    enum mcp_tool tool;
    struct mcp_model model;
    struct mcp_faults faults;
    unsigned width, height; /* of each picture */
    bool is_resized;        /* the scene's window is larger than SIDE_MAX */
    bool is_sheet;
    unsigned images;
    const char *format;   /* of mcp_words_of_formats; NULL: by the size */
    unsigned image, x, y; /* of MCP_PICK */
    bool has_to;          /* of MCP_PICK: another pixel, to_x and to_y */
    unsigned to_x, to_y;
    bool is_bare;                       /* the model is the only mesh: the scene, if any, has no meshes */
    unsigned model_meshes;              /* meshes of the scene that are {"asset": "model"} */
    bool has_own_views;                 /* the scene's views are drawn, not those of the arguments */
    struct mcp_span own[MCP_OWN_COUNT]; /* values of the scene's keys */
};

/* Reads and checks the arguments. False: the job has faults, memory is exhausted or the request is cancelled. */
bool mcp_job_read(struct mcp_job *job, const struct mcp_host *host, const struct mcp_message *message,
                  enum mcp_tool tool);

/* Checks `outputs`, `visibility`, `render`, `sheet` and `meshes` of a given scene, which the answer of a tool cannot
 * follow (given.c). Counts the meshes that are the model. Adds faults, each with what to do instead. A picture's
 * encoding becomes the format of the job, unless the arguments have one. False: the job has faults. */
bool mcp_given_check(struct mcp_job *job);

/* Goes to the next mesh {"asset": "model"} of a list of meshes, which is the next value of `json`. `name`: the string
 * "model" with its quotes. False: there are no more. */
bool mcp_given_next(struct zr_json *json, struct mcp_span *name);

/* Turns a pointer into the scene to one into the arguments, in place. */
void mcp_job_point(const struct mcp_job *job, char pointer[MCP_POINTER_SIZE]);

/* Returns the argument of this name, or NULL. */
const cJSON *mcp_job_argument(const struct mcp_job *job, const char *name);

#endif
