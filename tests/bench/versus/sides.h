/* sides.h - bench: the two renderers, each drawing a variant of a work its own best way. */
#ifndef ZR_BENCH_SIDES_H
#define ZR_BENCH_SIDES_H

#include "bench/works.h"
#include "reference/gl/reference.h"
#include "reference/subject.h"

/* Our core, through zr_render: a scene in memory, an arena that stays warm, a team that stays. */
struct ours {
    struct zr_arena arena, answers;
    struct zr_team *team;
    struct subject subject;
};

bool ours_open(struct ours *ours, int threads);
void ours_close(struct ours *ours);

/* What is drawn from now on. */
void ours_take(struct ours *ours, const struct work *work, const struct variant *variant);

/* Colour and float depth, and face ids where asked for. It stands until the next one. NULL, explained on stderr. */
const struct zr_frame *ours_draw(struct ours *ours, bool ids);

/* The same with outputs of one's own. */
const struct zr_frame *ours_render(struct ours *ours, const struct zr_output *outputs, uint32_t count);

/* The last frame, with the outputs it was drawn for, encoded. It stands until the next one. */
bool ours_encode(struct ours *ours, const struct zr_frame *frame, struct zr_answer *answer);

/* Mesa's llvmpipe: a frame buffer object, all triangles in one indexed call, from buffer objects.
 *
 * A flat triangle has the colour of its first corner. GL can be told so, but then Mesa turns some triangles
 * another way before it makes their depth planes (RULES.md, rule 6 exchanges other corners), which moves depths by
 * an ulp or two. That is as much work, so it is what is timed. What is compared to the last bit is drawn from
 * corners that are not shared, each of the colour of its triangle.
 */
struct theirs {
    struct reference *reference;
    bool exact;
    zr_vec4 *corners; /* positions, then colours, where they are not shared */
    struct reference_arrays arrays;
    struct reference_batch batch;
};

/* exact: as RULES.md says, to be compared with; else with all that the machine has, to be timed. It ends with the
 * child that opened it. */
bool theirs_open(struct theirs *theirs, bool exact, int threads);
bool theirs_take(struct theirs *theirs, const struct work *work, const struct variant *variant);
bool theirs_draw(struct theirs *theirs);

#endif
