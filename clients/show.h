/* show.h - client: pictures in the terminal. */
#ifndef SHOW_H
#define SHOW_H

#include "job.h"

/* Finds the terminal's protocol. Returns 0, or an exit status with lines in *faults. */
int show_check(struct bytes *faults);

/* Draws and shows a job; saves it, too, if it has a name by -o. */
void show_run(const struct engine *engine, struct job *job);

#endif
