/* process.h - metrics of this process, as the kernel tells them. */
#ifndef ZRASTERD_PROCESS_H
#define ZRASTERD_PROCESS_H

/* -1: not available from the kernel. */
struct process_now {
    double cpu_s, resident_bytes, virtual_bytes, open_files, max_files;
};

struct process_now process_look(void);

#endif
