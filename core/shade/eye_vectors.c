#include "shade/eye_vectors.h"

#include "base/cancel.h"
#include "base/team.h"

/* Vectors per range: less than a millisecond. */
enum { VECTORS_PER_RANGE = 1 << 14 };

struct making {
    const struct zr_eye_vectors *of;
    const struct zr_cancel *cancel;
    zr_vec4 *out;
};

static void make_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->cancel)) return;
    for (size_t i = begin; i < end; i++)
        m->out[i] = zr_eye_vector(m->of, (uint32_t)i);
}

void zr_eye_vectors_make(const struct zr_run *run, const struct zr_eye_vectors *of, zr_vec4 *out)
{
    struct making making = {of, run->cancel, out};
    zr_team_ranges(run->team, of->count, VECTORS_PER_RANGE, make_range, &making);
}
