/* simd_check.h - support: base/simd.h for one instruction set, held against plain C, lane by lane.
 *
 * Operands are all pairs of awkward numbers (NaN, infinities, -0, denormals, halfway cases, INT32_MIN ...) and
 * random bits. Every bit counts, but for the sign and the payload of a NaN that arithmetic makes: those are the
 * processor's own affair, and no pixel shows them.
 */
#ifndef ZR_TEST_SIMD_CHECK_H
#define ZR_TEST_SIMD_CHECK_H

#include <stddef.h>
#include <stdint.h>

#include "base/isa.h"

/* False, with a message that names the operation and its operands, where a lane differs. `isa` must be available. */
bool simd_check(enum zr_isa isa, uint64_t seed, char *message, size_t size);

#endif
