/* engine.h - client: draws a request in this process, or has a server draw it. */
#ifndef ENGINE_H
#define ENGINE_H

#include "api/zraster.h"

#include "answer.h"
#include "files/input.h"
#include "token.h"

struct engine {
    zraster *renderer;      /* NULL: the server draws */
    zraster_cancel *cancel; /* raised by SIGINT and SIGTERM */
    const char *server;
    struct token token;
    void (*progress)(void *context, uint32_t done, uint32_t total); /* of views that this process draws; NULL: none */
    void *progress_context;
};

/* Opens an engine for the options; `threads` share one picture (0: all processors), and `at_once` pictures share the
 * memory. Returns 0, or the exit status of a fault reported on stderr. From then on, SIGINT and SIGTERM cancel drawing
 * (interruption.h). */
int engine_open(struct engine *engine, const struct options *options, unsigned threads, size_t at_once);

/* Returns the bytes of --memory for each of the pictures that are drawn at once; 0: the default of the library. */
size_t engine_memory(const struct options *options, size_t at_once);
void engine_close(struct engine *engine);

/* Reads a scene in this process. The caller frees scene and error in every case; they start as NULL. Thread-safe.
 * `query` may be NULL. */
zraster_status engine_read_here(const struct engine *engine, const struct input *input, const char *query,
                                zraster_scene **scene, zraster_error **error);

/* Draws in this process. The picture owns the bytes of `file`. The caller frees picture and error in every case; they
 * start as NULL. Thread-safe. `query` may be NULL. */
zraster_status engine_draw_here(const struct engine *engine, const struct input *input, const char *query,
                                zraster_picture **picture, struct zraster_bytes *file, zraster_error **error);

/* Draws. Thread-safe. The caller frees the answer in every case. */
void engine_draw(const struct engine *engine, const struct input *input, const struct options *options,
                 struct answer *answer);

#endif
