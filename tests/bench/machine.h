/* machine.h - bench: what it runs on. */
#ifndef ZR_BENCH_MACHINE_H
#define ZR_BENCH_MACHINE_H

#include <stdbool.h>

#include "base/isa.h"

/* From now on the core uses what zr_isa_choose finds by this name, here and in all processes that are started; false
 * where that is nothing. */
bool machine_use_isa(const char *name);

/* The instruction set that the core uses here: that of the variable ZRASTER_ISA, as the daemon has it, else the best.
 */
enum zr_isa machine_isa(void);
const char *machine_isa_name(void);

/* Whether bars of the rendering are set for it: not for less than AVX2 on a machine that has more. */
bool machine_has_bars(void);

/* What a bar of the rendering, set for 512-bit vectors, is divided by here. */
double machine_bar_divisor(void);

int machine_cores(void);

/* The processor's name; "unknown processor" where the system does not tell. */
const char *machine_processor(void);

/* How many processors were at work in the last minute; below 0 where the system does not tell. */
double machine_load(void);

#endif
