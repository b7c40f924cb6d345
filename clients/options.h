/* options.h - client: the command line of `zraster render`. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "format_rows.h"
#include "parameter_rows.h"

#define DEFAULT_SERVER "http://127.0.0.1:8080"

/* What the query may say: each is an option, doubleSided being --double-sided. */
struct parameter {
    const char *name;
    bool of_mesh; /* and not of scenes */
    const char *value,
        *help; /* what stands for it, and what it is; in brackets: it may be left out, and is true then */
};
#define OPTIONS_COUNT(...) +1
enum { OPTIONS_PARAMETERS = 0 ZR_PARAMETER_ROWS(OPTIONS_COUNT) };
#undef OPTIONS_COUNT
extern const struct parameter options_parameters[OPTIONS_PARAMETERS];

enum { OPTIONS_FLAG_SIZE = 32 };

/* Of a parameter whose name has `length` characters: "--name". */
void options_flag_of(const char *name, size_t length, char flag[OPTIONS_FLAG_SIZE]);

/* NULL: not given. */
struct options {
    const char *file, *out, *server, *token_file, *type, *size;
    const char *parameters[OPTIONS_PARAMETERS];
    char width[12], height[12]; /* of size */
    const char *content_type;   /* of the file */
    bool has_view;              /* it is known to say itself what it is seen from, and how */
};

/* Arguments behind "render". 0, or the exit status for a wrong command line, which is then explained on stderr. */
int options_read(int count, char **arguments, struct options *options);

/* Says on stderr what is wrong with the command line, and where help is; returns the exit status for that. `which`
 * may be "". */
int options_wrong(const char *what, const char *which);

/* Endings of names, for messages: " .obj .stl", those of meshes; " json obj stl", all. */
#define OPTIONS_ENDING_true(suffix)
#define OPTIONS_ENDING_false(suffix)                                " ." suffix
#define OPTIONS_MESH_ENDING(ID, suffix, media_types, has_view, ...) OPTIONS_ENDING_##has_view(suffix)
#define OPTIONS_ANY_ENDING(ID, suffix, ...)                         " " suffix
#define OPTIONS_MESHES                                              ZR_FORMAT_ROWS(OPTIONS_MESH_ENDING)
#define OPTIONS_TYPES                                               ZR_FORMAT_ROWS(OPTIONS_ANY_ENDING)

#endif
