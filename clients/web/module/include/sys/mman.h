/* sys/mman.h of WebAssembly: no page is ever given back. */
#ifndef ZR_WASM_MMAN_H
#define ZR_WASM_MMAN_H

#define MADV_DONTNEED    4
#define MADV_HUGEPAGE    14
#define MADV_NOHUGEPAGE  15
#define madvise(p, n, a) ((void)(p), (void)(n), 0)

#endif
