/* input.h - client: a file to draw, and the files that it needs. */
#ifndef INPUT_H
#define INPUT_H

#include "api/zraster.h"

#include "bytes.h"
#include "options/options.h"

enum { INPUT_PARTS_MAX = 255 }; /* with the scene, as many parts as a server reads */

struct input_part {
    char *name;
    struct bytes bytes;
    bool is_neighbour; /* the file refers to it (neighbours.h); false: given by --part */
};

struct input {
    const char *path; /* "-": standard input */
    struct bytes body;
    char type[64]; /* media type by --type or the file's ending */
    bool is_known; /* otherwise it is detected from the bytes */
    bool is_scene; /* by the type; a scene has keys instead of parameters for meshes */
    bool is_usage; /* the failure is a wrong command line */
    size_t part_count;
    struct input_part parts[INPUT_PARTS_MAX];
    struct bytes warnings; /* lines */
};

/* Reads the file and its parts. On failure, returns false and adds lines with advice to *faults. The
 * caller calls input_free in both cases. */
bool input_read(struct input *input, const char *path, const struct options *options, struct bytes *faults);
void input_free(struct input *input);

/* Fills the parts for the library or the server; returns their count. Names and bytes belong to the input. */
size_t input_parts(const struct input *input, struct zraster_part parts[INPUT_PARTS_MAX]);

/* Returns true if a name has the ending of an input format. */
bool input_has_ending(const char *path);

/* Returns the kind of a file, by --type or its ending. */
enum input_kind { INPUT_UNKNOWN, INPUT_MESH, INPUT_SCENE };
enum input_kind input_kind_of(const char *path, const struct options *options);

/* Checks --type. Returns 0 or an exit status, reported on stderr. */
int input_check_type(const struct options *options);

#endif
