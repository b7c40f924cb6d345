/* show.h - client: pictures in the terminal. */
#ifndef SHOW_H
#define SHOW_H

#include "engine/job.h"

/* Draws and shows a job. With -o, also saves it. */
void show_run(const struct engine *engine, struct job *job);

#endif
