/* input.h - client: a file to draw, and the parts of its scene. */
#ifndef INPUT_H
#define INPUT_H

#include "library/zraster.h"

#include "bytes.h"
#include "options.h"

struct input {
    const char *path; /* "-": standard input */
    struct bytes body;
    char type[64]; /* media type by --type or the file's ending */
    bool is_known; /* otherwise the bytes tell it */
    bool is_scene; /* by the type; a scene has keys instead of parameters for meshes */
    bool is_usage; /* a failure is a wrong command line */
    struct bytes part_bytes[PARTS_MAX];
    char part_names[PARTS_MAX][128];
    size_t part_count;
};

/* Reads the file and its parts. False: adds lines to *faults that say what to do instead. input_free in both cases. */
bool input_read(struct input *input, const char *path, const struct options *options, struct bytes *faults);
void input_free(struct input *input);

/* Returns the parts for the library or the server; the names and bytes are the input's. */
size_t input_parts(const struct input *input, struct zraster_part parts[PARTS_MAX]);

/* Returns true if the ending of a name is that of a format that is read. */
bool input_has_ending(const char *path);

/* Returns what a file holds, by --type or its ending. */
enum input_kind { INPUT_UNKNOWN, INPUT_MESH, INPUT_SCENE };
enum input_kind input_kind_of(const char *path, const struct options *options);

/* Checks --type. Returns 0 or an exit status, reported on stderr. */
int input_check_type(const struct options *options);

#endif
