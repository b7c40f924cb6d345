/* options.h - client: reads the command line. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "command_rows.h"

/* Exit statuses. */
enum {
    STATUS_DONE,
    STATUS_FAILED,    /* a file cannot be read, drawn or written */
    STATUS_USAGE,     /* the command line is wrong */
    STATUS_WARNED,    /* warnings, with --strict */
    STATUS_DIFFERENT, /* compare, info --expect: something differs */
    STATUS_INTERRUPTED = 130
};

struct options;

struct command {
    const char *name;
    char letter; /* in the rows of options */
    const char *arguments, *summary;
    int (*run)(struct options *options); /* returns the exit status */
};
#define OPTIONS_COUNT(...) +1
enum {
    COMMAND_COUNT = 0 COMMAND_ROWS(OPTIONS_COUNT),
    PARAMETERS_MAX = 128,
    PARTS_MAX = 31,
    THREADS_MAX = 256,
    FLAG_SIZE = 32
};
#undef OPTIONS_COUNT
extern const struct command commands[COMMAND_COUNT];

#define COMMAND_DECLARED(name, ...) int command_##name(struct options *options);
COMMAND_ROWS(COMMAND_DECLARED)
#undef COMMAND_DECLARED

/* Options of the client itself. */
enum option {
#define OPTION_ENUM(ID, ...) OPTION_##ID,
    OPTION_ROWS(OPTION_ENUM)
#undef OPTION_ENUM
        OPTION_COUNT
};
struct option_row {
    const char *name;
    char letter;       /* 0: none */
    const char *value; /* placeholder; NULL: a switch */
    const char *commands, *help;
};
extern const struct option_row option_rows[OPTION_COUNT];

/* Writes the option of a parameter, whose name has `length` characters: "--name". */
void options_flag_of(const char *name, size_t length, char flag[FLAG_SIZE]);

/* Options as given; NULL: not given. Switches have the text "true". */
struct options {
    const struct command *command;
    const char *own[OPTION_COUNT];
    const char *parameters[PARAMETERS_MAX]; /* by enum parameter (parameters.h) */
    const char **files;                     /* in the arguments */
    size_t file_count;
    const char *parts[PARTS_MAX]; /* NAME=FILE */
    size_t part_count;
    char width[12], height[12]; /* texts of these parameters */
    const char *completed;      /* the one that was computed from the other, for models; NULL: none */
};

/* Reads the arguments of the program, without its name; moves the files among them to the front. Returns 0, or the
 * exit status of a wrong command line, reported on stderr. */
int options_read(int count, const char **arguments, struct options *options);

/* Sets a parameter by its name in queries. False if there is none. */
bool options_set(struct options *options, const char *name, const char *value);

/* Reports a fault of the command line on stderr; returns the exit status. */
__attribute__((format(printf, 1, 2))) int options_wrong(const char *format, ...);

bool options_strict(const struct options *options);

/* Returns the number of --threads; 0: all processors. */
unsigned options_threads(const struct options *options);

/* The files of a batch whose number in the list leaves `index` when divided by `count`; 0 of 1: all. */
struct shard {
    size_t index, count;
};
struct shard options_shard(const struct options *options);

#endif
