/* batch.h - reference/lines: a batch of lines, outlines or pushed triangles, and its pictures.
 *
 * Drawn twice, with the same floats: by the reference (draw_reference.c), and by a plain
 * drawer that takes every number from the core's own functions (draw_own.c).
 */
#ifndef ZR_TEST_BATCH_H
#define ZR_TEST_BATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "reference/line_rule.h"
#include "support/random.h"

enum batch_mode { BATCH_LINES, BATCH_OUTLINES, BATCH_FILLED };

/* How lines of more than two corners go on: from corner to corner, and back to the first. */
enum batch_chain { CHAIN_STRIP, CHAIN_LOOP };

enum { BATCH_PRIMITIVES = 300, BATCH_CORNERS = 8, BATCH_SIDE = 256 };

struct batch {
    enum batch_mode mode;
    uint32_t width, height;
    enum batch_chain chain;
    bool smooth;         /* else each primitive has one colour: its number, or, lines, its last corner's */
    bool sided;          /* outlines: one colour for the front and one for the back, by facing */
    unsigned faces;      /* outlines: ZR_SIDE_FRONT, _BACK or _BOTH; not culled */
    float factor, units; /* filled: the offset */
    uint32_t count;      /* primitives, each of 2, 3 or more corners, one after the other */
    uint32_t offsets[BATCH_PRIMITIVES + 1];
    zr_vec4 positions[BATCH_PRIMITIVES * BATCH_CORNERS]; /* clip space */
    zr_vec4 colors[BATCH_PRIMITIVES * BATCH_CORNERS];
};

/* The two colours of a sided batch. */
static const zr_vec4 batch_front = {1.0f, 0.2f, 0.0f, 1.0f}, batch_back = {0.0f, 0.4f, 1.0f, 1.0f};

/* Row 0 on top. Alpha is 0 where nothing was drawn. */
struct batch_picture {
    uint8_t rgba[BATCH_SIDE * BATCH_SIDE * 4];
    float depth[BATCH_SIDE * BATCH_SIDE];
};

/* What the plain drawer can do wrong on purpose: the comparison must notice each. */
enum fault {
    FAULT_NONE,
    FAULT_REVERSED,        /* lines drawn from their far end */
    FAULT_OTHER_RULE,      /* lines of another Mesa: for builds that have mutants */
    FAULT_SNAPPED_FIRST,   /* ends snapped before they move */
    FAULT_INCLUSIVE,       /* all four edges keep what lies on them */
    FAULT_PLANE_SWAPPED,   /* planes from v1 */
    FAULT_PLANE_SHORT,     /* the major axis not lengthened by the slope */
    FAULT_CLIP_ONE_BY_ONE, /* a line cut plane after plane */
    FAULT_CLIP_EDGES,      /* outlines: each edge clipped as a line */
    FAULT_EDGES_OF_PLANES, /* outlines: edges along the view volume drawn */
    FAULT_ORDER,           /* outlines: 0 to 1, 1 to 2, 2 to 0 */
    FAULT_CULL_AREA,       /* outlines: no area counts as front */
    FAULT_OFFSET_IN_PLANE, /* filled: added to a0 */
    FAULT_OFFSET_SLOPE,    /* filled: from the depth plane's own slopes */
    FAULT_OFFSET_CLAMPED,  /* filled: added after clamping */
    FAULT_COUNT
};
extern const char *const fault_names[FAULT_COUNT];

struct batch_stats {
    uint64_t primitives, clipped, lines, dropped;
};

/* draw_own leaves FAULT_OTHER_RULE to line_rule_choose. */
void draw_own(const struct batch *batch, enum fault fault, struct batch_picture *picture, struct batch_stats *stats);

/* The context stays open for the process. False, explained on stderr. */
bool draw_reference_open(enum line_rule *rule);
bool draw_reference(const struct batch *batch, struct batch_picture *picture);

/* How corners are placed; each aims at one part of the rules. */
struct placing {
    const char *name;
    bool binary_window; /* sizes are powers of two, so that places on the grid are exact floats */
    zr_vec4 (*corner)(struct random *r, const struct batch *batch, const zr_vec4 *first);
};
extern const struct placing placings[];
extern const uint32_t placing_count;

void batch_generate(struct batch *batch, enum batch_mode mode, const struct placing *placing, struct random *r);

zr_vec4 batch_color(uint32_t number);

#endif
