/* seeds.h - fuzz: writes seeds. A call that fails ends the program. */
#ifndef ZR_FUZZ_SEEDS_H
#define ZR_FUZZ_SEEDS_H

#include <stddef.h>

struct text {
    const char *name, *text;
};

/* Prints what failed, and why. */
_Noreturn void fail(const char *what);

void write_seed(const char *target, const char *name, const void *bytes, size_t size);
void write_texts(const char *target, const struct text *texts, size_t count);
#define WRITE_TEXTS(target, texts) write_texts(target, texts, sizeof(texts) / sizeof *(texts))

/* seeds_models.c: writes the seeds of model files. */
void write_models(void);

/* seeds_draco.c: writes the seeds of Draco meshes. */
void write_draco(void);

#endif
