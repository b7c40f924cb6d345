/* show.h - client: pictures in the terminal. */
#ifndef SHOW_H
#define SHOW_H

#include "job.h"

/* Draws and shows a job; saves it, too, if it has a name by -o. */
void show_run(const struct engine *engine, struct job *job);

#endif
