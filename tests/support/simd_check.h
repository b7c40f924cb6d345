/* simd_check.h - support: compares base/simd/simd.h for one instruction set with plain C, lane by lane.
 *
 * Operands are all pairs of special numbers (NaN, infinities, -0, denormals, halfway cases, INT32_MIN ...) and random
 * bits. Results must be equal bit by bit, except for the sign and payload of a NaN from arithmetic: these depend on the
 * processor and affect no pixel.
 */
#ifndef ZR_TEST_SIMD_CHECK_H
#define ZR_TEST_SIMD_CHECK_H

#include <stddef.h>
#include <stdint.h>

#include "base/isa.h"

/* If a lane differs, returns false and a message with the operation and its operands. `isa` must be available. */
bool simd_check(enum zr_isa isa, uint64_t seed, char *message, size_t size);

#endif
