/* options.h - client: the command line of `zraster render`. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "format_rows.h"
#include "parameter_rows.h"

#define DEFAULT_SERVER "http://127.0.0.1:8080"

/* A query parameter. Each one is an option: doubleSided is --double-sided. */
struct parameter {
    const char *name;
    bool of_mesh; /* for meshes only */
    const char *value,
        *help; /* placeholder and text of --help; a placeholder in brackets: may be omitted, and is true then */
};
#define OPTIONS_COUNT(...) +1
enum { OPTIONS_PARAMETERS = 0 ZR_PARAMETER_ROWS(OPTIONS_COUNT) };
#undef OPTIONS_COUNT
extern const struct parameter options_parameters[OPTIONS_PARAMETERS];

enum { OPTIONS_FLAG_SIZE = 32 };

/* Writes the option of a parameter, whose name has `length` characters: "--name". */
void options_flag_of(const char *name, size_t length, char flag[OPTIONS_FLAG_SIZE]);

/* Options as given; NULL: not given. */
struct options {
    const char *file, *out, *server, *token_file, *type, *size;
    const char *parameters[OPTIONS_PARAMETERS];
    char width[12], height[12]; /* from `size` */
    const char *content_type;   /* of the file */
    bool has_view;              /* the format includes a view (scenes) */
};

/* Reads the arguments behind "render". Returns 0, or the exit status of a wrong command line, reported on stderr. */
int options_read(int count, char **arguments, struct options *options);

/* Reports a fault of the command line on stderr; returns the exit status. `which` may be "". */
int options_wrong(const char *what, const char *which);

/* Endings of file names, for messages: of meshes " .obj .stl", of all formats " json obj stl". */
#define OPTIONS_ENDING_true(suffix)
#define OPTIONS_ENDING_false(suffix)                                " ." suffix
#define OPTIONS_MESH_ENDING(ID, suffix, media_types, has_view, ...) OPTIONS_ENDING_##has_view(suffix)
#define OPTIONS_ANY_ENDING(ID, suffix, ...)                         " " suffix
#define OPTIONS_MESHES                                              ZR_FORMAT_ROWS(OPTIONS_MESH_ENDING)
#define OPTIONS_TYPES                                               ZR_FORMAT_ROWS(OPTIONS_ANY_ENDING)

#endif
