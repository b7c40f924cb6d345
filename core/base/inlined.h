/* inlined.h - base: what compilers, left to themselves, call once for each number, word or line of a text. */
#ifndef ZR_INLINED_H
#define ZR_INLINED_H

#define ZR_INLINED static inline __attribute__((always_inline))

#endif
