/* replay.h - support: plays back a channel trace from its JSON alone.
 *
 * Crossings, coverage and edge functions are computed again from the edges of the primitives; z-tests, stepped edges,
 * intervals and pieces are repeated step by step. The running test fails at the first step that differs.
 */
#ifndef ZR_TEST_REPLAY_H
#define ZR_TEST_REPLAY_H

#include <stdbool.h>
#include <stdint.h>

enum { REPLAY_SIDE_MAX = 64 };

/* Rows count from the top, as in channels. */
struct replay {
    uint32_t width, height, primitives, steps;
    uint32_t face_id[REPLAY_SIDE_MAX * REPLAY_SIDE_MAX];
    bool has_depth; /* the algorithm has a z-buffer */
    float depth[REPLAY_SIDE_MAX * REPLAY_SIDE_MAX];
    uint32_t lost, cuts, cycles, polygons, inner_tiles; /* samples lost by z-tests; of the painter; of halfspace */
};

/* `name` is put in front of messages. */
void replay_trace(const char *name, const char *json, struct replay *out);

#endif
