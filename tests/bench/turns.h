/* turns.h - bench: two benches, of two builds, that take turns round by round (bench/compare.h).
 *
 * Only who has the turn works, so that whatever else happens on the machine happens to both. They need not measure the
 * same rows.
 */
#ifndef ZR_BENCH_TURNS_H
#define ZR_BENCH_TURNS_H

/* What says in the environment that there is another one. Then standard input gives the turn, a byte each, standard
 * output gives it back, and nothing is printed. */
#define TURNS_VARIABLE "ZRASTER_BENCH_TURNS"

/* Waits for the first turn. At once where this bench is the only one, as turns_pass is. */
void turns_begin(void);

/* Ends this turn and waits for the next one. Also from a child, whose parent waits for it. */
void turns_pass(void);

#endif
