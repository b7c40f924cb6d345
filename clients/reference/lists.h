/* lists.h - reference pages: tables of channels, of looks, of formats of models, and of commands and options of the
 * client, each from its rows. They go to values.out. */
#ifndef LISTS_H
#define LISTS_H

#include "tables.h"

void lists_print_channels(const struct tables *tables);
void lists_print_looks(const struct tables *tables);
void lists_print_formats(const struct tables *tables);
void lists_print_commands(const struct tables *tables);
void lists_print_options(const struct tables *tables);

#endif
