/* machine.h - bench: what it runs on. */
#ifndef ZR_BENCH_MACHINE_H
#define ZR_BENCH_MACHINE_H

/* The instruction set that the core uses here, such as "avx512". */
const char *machine_isa(void);

/* What a bar of the rendering, set for 512-bit vectors, is divided by here. */
double machine_bar_divisor(void);

int machine_cores(void);

/* The processor's name; "unknown processor" where the system does not tell. */
const char *machine_processor(void);

/* How many processors were at work in the last minute; below 0 where the system does not tell. */
double machine_load(void);

#endif
