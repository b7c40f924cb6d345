/* faults.h - a text that takes up to FAULTS_MAX faults of settings, a line each. */
#ifndef ZRASTERD_FAULTS_H
#define ZRASTERD_FAULTS_H

#include <stddef.h>

enum { FAULTS_MAX = 20 };

struct faults {
    char *text; /* a C string of up to `size` bytes */
    size_t size, used;
    unsigned count; /* those beyond FAULTS_MAX, too */
};

void faults_begin(struct faults *faults, char *text, size_t size);
void faults_add(struct faults *faults, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds how many faults there are beyond FAULTS_MAX. */
void faults_end(struct faults *faults);

#endif
