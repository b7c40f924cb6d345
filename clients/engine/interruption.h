/* interruption.h - client: SIGINT and SIGTERM. */
#ifndef INTERRUPTION_H
#define INTERRUPTION_H

#include <stdbool.h>

#include "api/zraster.h"

/* Catches the first of these signals. The second one ends the process. */
void interruption_catch(void);

/* Sets the cancel that a signal raises; NULL: none. */
void interruption_raises(zraster_cancel *cancel);

/* Returns true once a signal was caught. */
bool interrupted(void);

#endif
