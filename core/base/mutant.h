/* mutant.h - base: mutants, which are wrong on purpose, so that tests can prove that they would notice.
 *
 *     return ZR_MUTANT(older_lines, half_to_even(v), half_away(v));
 *
 * is half_to_even(v) in every build but `make MUTANTS=1`, whose programs choose at most one mutant while they run.
 * `make tests` puts that build beside the other one, into build/mutant. Both expressions are compiled everywhere, so
 * that no mutant rots. A new one needs its name in the list below, and a test that must fail with it.
 */
#ifndef ZR_MUTANT_H
#define ZR_MUTANT_H

#include <stdbool.h>

/* older_lines: lines as Mesa 22.3 draws them; what they are compared with where Mesa is that old. */
#define ZR_EACH_MUTANT(row) row(older_lines)

#ifdef ZR_MUTANTS
#define ZR_MUTANT_ITEM(name) ZR_MUTANT_##name,
enum zr_mutant { ZR_MUTANT_NONE, ZR_EACH_MUTANT(ZR_MUTANT_ITEM) };
extern enum zr_mutant zr_mutant_chosen;
#define ZR_MUTANT(name, right, wrong) (zr_mutant_chosen != ZR_MUTANT_##name ? (right) : (wrong))
#else
#define ZR_MUTANT(name, right, wrong) (true ? (right) : (wrong))
#endif

/* By its name; NULL: none. Not while another thread renders. False, and none is chosen, where this build has no such
 * mutant. */
bool zr_mutant_choose(const char *name);

#endif
