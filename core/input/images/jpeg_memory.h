/* jpeg_memory.h - input: a memory manager for libjpeg that allocates from an arena.
 *
 * Why:    the input decides how much memory libjpeg takes: for a progressive file, the coefficients of the whole
 *         picture, and as much for a file that is written. Its own manager uses malloc without a ceiling. It can be
 * replaced (jpeglib.h: struct jpeg_memory_mgr). Layout: rows of samples are padded to ROW_ALIGN bytes, since libjpeg's
 * SIMD code reads and writes whole vectors. Virtual arrays are allocated whole. Their rows are zeroed at the first
 * access: zeroing all of them at once would delay a cancellation too long.
 */
#ifndef ZR_JPEG_MEMORY_H
#define ZR_JPEG_MEMORY_H

#include <stddef.h>
#include <stdio.h>

#include <jpeglib.h>

#include "base/arena.h"

/* `methods`, which libjpeg calls, must be the first member. */
struct zr_jpeg_memory {
    struct jpeg_memory_mgr methods;
    struct jpeg_memory_mgr *before; /* libjpeg's own manager, with the memory of jpeg_create_... */
    struct zr_arena *arena;
    struct jvirt_sarray_control *samples; /* linked lists of virtual arrays */
    struct jvirt_barray_control *blocks;
};

/* Replaces the manager of `jpeg`, after jpeg_create_decompress or jpeg_create_compress. If the arena has no memory, it
 * calls libjpeg's error_exit with JERR_OUT_OF_MEMORY. */
void zr_jpeg_memory_begin(struct zr_jpeg_memory *memory, struct zr_arena *arena, j_common_ptr jpeg);

/* Restores libjpeg's manager, before jpeg_destroy. Does nothing if *memory is zero. */
void zr_jpeg_memory_end(struct zr_jpeg_memory *memory, j_common_ptr jpeg);

#endif
