/* sched.h of WebAssembly: one processor. */
#ifndef ZR_WASM_SCHED_H
#define ZR_WASM_SCHED_H

#include <stddef.h>

typedef int cpu_set_t;
#define sched_yield()              ((void)0)
#define sched_getaffinity(p, n, s) ((void)(s), -1)
#define CPU_COUNT(s)               1

#endif
