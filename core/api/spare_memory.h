/* spare_memory.h - api: memory that this process can still take.
 *
 * The least of three values: MemAvailable of /proc/meminfo; for each control group of the process, version 1 or 2, its
 * limit minus its use, in which droppable file cache does not count; the limit of the address space minus its size.
 */
#ifndef ZR_SPARE_MEMORY_H
#define ZR_SPARE_MEMORY_H

#include <stddef.h>

/* Returns bytes; SIZE_MAX if nothing is known. Reads files of the system. */
size_t zr_spare_memory(void);

/* Returns the default of zraster_options.memory_max: three quarters of the spare memory, at least 1 GiB. */
size_t zr_default_memory(void);

#endif
