/* spare_memory.h - api: memory that this process can still take.
 *
 * The least of: MemAvailable of /proc/meminfo; of each control group of the process, version 1 or 2, its limit less
 * what it uses, without file cache that can be dropped; and the limit of the address space, less what is mapped.
 */
#ifndef ZR_SPARE_MEMORY_H
#define ZR_SPARE_MEMORY_H

#include <stddef.h>

/* Returns bytes; SIZE_MAX if nothing is known. Reads files of the system. */
size_t zr_spare_memory(void);

/* Returns the default of zraster_options.memory_max: three quarters of the spare memory, at least 1 GiB. */
size_t zr_default_memory(void);

#endif
