/* jpeg_memory.h - input: libjpeg's memory, from an arena.
 *
 * Why:    what libjpeg takes is foreign bytes' choice, the coefficients of a whole picture where it is progressive. Its
 *         own manager asks malloc and knows no ceiling; it may be replaced (jpeglib.h: struct jpeg_memory_mgr).
 * Layout: rows of samples are padded to ROW_ALIGN bytes, since its SIMD code reads and writes whole vectors. Virtual
 *         arrays are there as a whole; their rows become zeros when they are first asked for, since to fill them all at
 *         once takes longer than a cancelled request may.
 */
#ifndef ZR_JPEG_MEMORY_H
#define ZR_JPEG_MEMORY_H

#include <stddef.h>
#include <stdio.h>

#include <jpeglib.h>

#include "base/arena.h"

/* Begins with the table of methods that libjpeg calls. */
struct zr_jpeg_memory {
    struct jpeg_memory_mgr methods;
    struct jpeg_memory_mgr *before; /* libjpeg's own, which has what jpeg_create_decompress needed */
    struct zr_arena *arena;
    struct jvirt_sarray_control *samples; /* lists */
    struct jvirt_barray_control *blocks;
};

/* After jpeg_create_decompress: from here on all memory is the arena's. Where that has none, libjpeg's error_exit is
 * called with JERR_OUT_OF_MEMORY. */
void zr_jpeg_memory_begin(struct zr_jpeg_memory *memory, struct zr_arena *arena, struct jpeg_decompress_struct *jpeg);

/* Before jpeg_destroy_decompress, which gives back what there was before. Not begun, memory being zero, nothing
 * happens. */
void zr_jpeg_memory_end(struct zr_jpeg_memory *memory, struct jpeg_decompress_struct *jpeg);

#endif
