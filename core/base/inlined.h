/* inlined.h - base: forces inlining of functions called per item (a digit, a vector, a row), as calls cost too much. */
#ifndef ZR_INLINED_H
#define ZR_INLINED_H

#define ZR_INLINED static inline __attribute__((always_inline))

#endif
