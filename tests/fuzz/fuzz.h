/* fuzz.h - tests/fuzz: what the targets share.
 *
 * A target is one file fuzz_NAME.c with LLVMFuzzerTestOneInput. `make fuzz` links it with clang's libFuzzer, which
 * makes inputs up; `make test` links it with replay.c, which hands it the seeds (seeds.c, seeds_models.c) and
 * the crashers that were found before (crashers/NAME). It may only end the process where something is wrong.
 */
#ifndef ZR_FUZZ_H
#define ZR_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max, unsigned seed);

/* libFuzzer's own; there is none in a replay. */
__attribute__((weak)) size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max);

enum { FUZZ_SIDE_MAX = 64, FUZZ_ARENA_BYTES = 1 << 26, FUZZ_TEXELS_MAX = 1 << 16 };

/* Whether the last input was accepted, and went all the way: seeds must. */
extern bool fuzz_accepted;

/* The four steps of a request, up to where it is refused. Windows of FUZZ_SIDE_MAX pixels at most, and work that does
 * not take long, since a slow input finds less than a thousand small ones. Where the scene is drawn, all algorithms
 * must agree. */
void fuzz_request(const struct zr_request *request);

/* The bytes as an image, twice: what was in memory before must not show. */
void fuzz_image(const uint8_t *data, size_t size);

/* Says what is wrong and aborts, where `holds` is false. */
void fuzz_expect(bool holds, const char *what);

#endif
