#include "input/images/jpeg_memory.h"

#include <string.h>

#include <jerror.h>

/* The width of an AVX-512 vector; libjpeg-turbo needs less. */
enum { ROW_ALIGN = 64 };

_Static_assert(ZR_ARENA_ALIGN % ROW_ALIGN == 0, "the first row is aligned as all others");

struct jvirt_sarray_control {
    struct jvirt_sarray_control *next;
    JDIMENSION samples_per_row, rows;
    JDIMENSION zeroed; /* rows zeroed so far */
    JSAMPARRAY array;  /* NULL: not realized yet */
};

struct jvirt_barray_control {
    struct jvirt_barray_control *next;
    JDIMENSION blocks_per_row, rows, zeroed;
    JBLOCKARRAY array;
};

static struct zr_jpeg_memory *memory_of(j_common_ptr jpeg)
{
    return (struct zr_jpeg_memory *)(void *)jpeg->mem;
}

/* Never returns NULL, which libjpeg does not check. */
static void *allocate(j_common_ptr jpeg, size_t count, size_t size)
{
    void *result = zr_arena_alloc(memory_of(jpeg)->arena, count, size);
    if (!result) ERREXIT1(jpeg, JERR_OUT_OF_MEMORY, 0);
    return result;
}

static void *alloc_bytes(j_common_ptr jpeg, int pool, size_t size)
{
    (void)pool; /* all pools end together */
    return allocate(jpeg, size, 1);
}

static JSAMPARRAY alloc_samples(j_common_ptr jpeg, int pool, JDIMENSION samples_per_row, JDIMENSION rows)
{
    const size_t stride = ((size_t)samples_per_row * sizeof(JSAMPLE) + ROW_ALIGN - 1) / ROW_ALIGN * ROW_ALIGN;
    JSAMPARRAY array = allocate(jpeg, rows, sizeof *array);
    char *bytes = allocate(jpeg, rows, stride);
    (void)pool;
    for (size_t y = 0; y < rows; y++)
        array[y] = (JSAMPROW)(void *)(bytes + y * stride);
    return array;
}

static JBLOCKARRAY alloc_blocks(j_common_ptr jpeg, int pool, JDIMENSION blocks_per_row, JDIMENSION rows)
{
    JBLOCKARRAY array = allocate(jpeg, rows, sizeof *array);
    JBLOCKROW blocks = allocate(jpeg, rows, blocks_per_row * sizeof *blocks);
    (void)pool;
    for (size_t y = 0; y < rows; y++)
        array[y] = blocks + y * blocks_per_row;
    return array;
}

/* ---- virtual arrays ---- */

static jvirt_sarray_ptr request_samples(j_common_ptr jpeg, int pool, boolean zero, JDIMENSION samples_per_row,
                                        JDIMENSION rows, JDIMENSION at_once)
{
    struct zr_jpeg_memory *memory = memory_of(jpeg);
    jvirt_sarray_ptr virtual = allocate(jpeg, 1, sizeof *virtual);
    (void)pool;
    (void)zero;
    (void)at_once;
    *virtual = (struct jvirt_sarray_control){memory->samples, samples_per_row, rows, 0, NULL};
    memory->samples = virtual;
    return virtual;
}

static jvirt_barray_ptr request_blocks(j_common_ptr jpeg, int pool, boolean zero, JDIMENSION blocks_per_row,
                                       JDIMENSION rows, JDIMENSION at_once)
{
    struct zr_jpeg_memory *memory = memory_of(jpeg);
    jvirt_barray_ptr virtual = allocate(jpeg, 1, sizeof *virtual);
    (void)pool;
    (void)zero;
    (void)at_once;
    *virtual = (struct jvirt_barray_control){memory->blocks, blocks_per_row, rows, 0, NULL};
    memory->blocks = virtual;
    return virtual;
}

static void realize(j_common_ptr jpeg)
{
    const struct zr_jpeg_memory *memory = memory_of(jpeg);
    for (jvirt_sarray_ptr s = memory->samples; s; s = s->next)
        if (!s->array) s->array = alloc_samples(jpeg, JPOOL_IMAGE, s->samples_per_row, s->rows);
    for (jvirt_barray_ptr b = memory->blocks; b; b = b->next)
        if (!b->array) b->array = alloc_blocks(jpeg, JPOOL_IMAGE, b->blocks_per_row, b->rows);
}

static JSAMPARRAY access_samples(j_common_ptr jpeg, jvirt_sarray_ptr virtual, JDIMENSION first, JDIMENSION rows,
                                 boolean writes)
{
    (void)writes;
    if (!virtual->array || first > virtual->rows || rows > virtual->rows - first)
        ERREXIT(jpeg, JERR_BAD_VIRTUAL_ACCESS);
    for (; virtual->zeroed < first + rows; virtual->zeroed++)
        memset(virtual->array[virtual->zeroed], 0, virtual->samples_per_row * sizeof(JSAMPLE));
    return virtual->array + first;
}

static JBLOCKARRAY access_blocks(j_common_ptr jpeg, jvirt_barray_ptr virtual, JDIMENSION first, JDIMENSION rows,
                                 boolean writes)
{
    (void)writes;
    if (!virtual->array || first > virtual->rows || rows > virtual->rows - first)
        ERREXIT(jpeg, JERR_BAD_VIRTUAL_ACCESS);
    for (; virtual->zeroed < first + rows; virtual->zeroed++)
        memset(virtual->array[virtual->zeroed], 0, virtual->blocks_per_row * sizeof(JBLOCK));
    return virtual->array + first;
}

/* ---- the manager ---- */

static void free_pool(j_common_ptr jpeg, int pool)
{
    struct zr_jpeg_memory *memory = memory_of(jpeg);
    (void)pool; /* the arena frees it */
    memory->samples = NULL;
    memory->blocks = NULL;
}

static void self_destruct(j_common_ptr jpeg)
{
    (void)jpeg;
}

void zr_jpeg_memory_begin(struct zr_jpeg_memory *memory, struct zr_arena *arena, j_common_ptr jpeg)
{
    *memory = (struct zr_jpeg_memory){.methods = {.alloc_small = alloc_bytes,
                                                  .alloc_large = alloc_bytes,
                                                  .alloc_sarray = alloc_samples,
                                                  .alloc_barray = alloc_blocks,
                                                  .request_virt_sarray = request_samples,
                                                  .request_virt_barray = request_blocks,
                                                  .realize_virt_arrays = realize,
                                                  .access_virt_sarray = access_samples,
                                                  .access_virt_barray = access_blocks,
                                                  .free_pool = free_pool,
                                                  .self_destruct = self_destruct,
                                                  .max_alloc_chunk = jpeg->mem->max_alloc_chunk},
                                      .before = jpeg->mem,
                                      .arena = arena};
    jpeg->mem = &memory->methods;
}

void zr_jpeg_memory_end(struct zr_jpeg_memory *memory, j_common_ptr jpeg)
{
    if (memory->before) jpeg->mem = memory->before;
}
