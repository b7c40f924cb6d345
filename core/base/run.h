/* run.h - base: memory, threads, cancellation and error of the steps of one request.
 *
 * A function takes a run instead of three or more of its members, as its first parameter. Its comment names the members
 * that it uses: those may not be NULL unless their own header says so; others are not read.
 * Threads: a run itself is read only, so that threads may share it. Arenas and errors are not thread-safe: each
 *          thread of a team has its own arena, or its own run. */
#ifndef ZR_RUN_H
#define ZR_RUN_H

struct zr_arena;
struct zr_cancel;
struct zr_error;
struct zr_team;

struct zr_run {
    struct zr_arena *arena;         /* holds results */
    struct zr_arena *scratch;       /* holds what only the caller's step needs; may be `arena` */
    struct zr_team *team;           /* NULL: the calling thread alone */
    const struct zr_cancel *cancel; /* NULL: never */
    struct zr_error *error;
};

/* Returns the run for a step whose results go to another arena, such as `scratch`. */
static inline struct zr_run zr_run_in(const struct zr_run *run, struct zr_arena *arena)
{
    struct zr_run inner = *run;
    inner.arena = arena;
    return inner;
}

/* Returns the run for a step that reports to another error. */
static inline struct zr_run zr_run_reporting(const struct zr_run *run, struct zr_error *error)
{
    struct zr_run inner = *run;
    inner.error = error;
    return inner;
}

#endif
