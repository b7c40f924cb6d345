/* compare.h - client: all kinds of `zraster compare`. They return the exit status. */
#ifndef COMPARE_H
#define COMPARE_H

#include "options/options.h"

/* Counts the pixels of two pictures that differ; -o saves the differences. */
int compare_pictures(const struct options *options);

/* Counts the pixels of two arrays, NPY or PFM, that differ. */
int compare_numbers(const struct options *options);

/* Compares two models in numbers. */
int compare_models(const struct options *options);

#endif
