/* inlined.h - base: functions that must be inlined because a call per item (a digit, a vector, a row) costs too much
 * and compilers do not inline them by themselves. */
#ifndef ZR_INLINED_H
#define ZR_INLINED_H

#define ZR_INLINED static inline __attribute__((always_inline))

#endif
