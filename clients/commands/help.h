/* help.h - client: texts of --help. */
#ifndef HELP_H
#define HELP_H

#include "options/options.h"

/* Prints the first lines of help on stderr; returns STATUS_USAGE. */
int help_short(void);

/* Prints the help of a command on standard output. */
void help_print(const struct command *command);

/* Prints the completion of "bash", "zsh" or "fish". False for another word. */
bool help_complete(const char *shell);

#endif
