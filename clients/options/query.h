/* query.h - client: the query of a request. */
#ifndef QUERY_H
#define QUERY_H

#include "files/bytes.h"
#include "options.h"

/* Returns "look=technical&width=800", percent-encoded, to be freed; NULL without memory. Leaves out --strict: the
 * client itself turns warnings into an exit status; of a scene, also parameters for meshes. The title of a model
 * is the name of its file, unless given. */
char *query_make(const struct options *options, const char *path, bool is_scene);

/* Adds a parameter, percent-encoded, with "&" before it unless it is the first one. */
void query_add(struct bytes *query, const char *name, const char *text);

/* Moves the parameters that `zraster drawing` shares with pictures, such as scale and title, to the query of a drawing. */
void query_take_drawing(struct options *options, struct bytes *query);

#endif
