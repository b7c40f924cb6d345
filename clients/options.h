/* options.h - client: the command line of `zraster render`. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdbool.h>

#define DEFAULT_SERVER "http://127.0.0.1:8080"

/* NULL: not given. */
struct options {
    const char *file, *out, *server, *token_file, *type;
    const char *channel, *encoding, *scale, *preset, *shading, *size, *compress;
    char width[12], height[12]; /* of size; "" where there is none */
    const char *content_type;   /* of the file */
    bool has_view;              /* it is known to say itself what it is seen from, and how */
};

/* Arguments behind "render". 0, or the exit status for a wrong command line, which is then explained on stderr. */
int options_read(int count, char **arguments, struct options *options);

/* Says on stderr what is wrong with the command line, and where help is; returns the exit status for that. `which`
 * may be "". */
int options_wrong(const char *what, const char *which);

#endif
