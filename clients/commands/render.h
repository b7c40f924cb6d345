/* render.h - client: one file, from the options to the report. */
#ifndef RENDER_H
#define RENDER_H

#include "engine/job.h"

/* Draws the first file of the options, saves or shows the picture, and reports to people on stderr. Returns the exit
 * status. */
int render_draw(const struct engine *engine, const struct options *options);

#endif
