/* forbid.h - base: bytes that must not be accessed. AddressSanitizer reports any access; other builds do nothing. */
#ifndef ZR_FORBID_H
#define ZR_FORBID_H

#ifdef __SANITIZE_ADDRESS__
#define ZR_ASAN 1
#elif defined __has_feature
#define ZR_ASAN __has_feature(address_sanitizer)
#else
#define ZR_ASAN 0
#endif

#if ZR_ASAN
#include <sanitizer/asan_interface.h>
#define ZR_FORBID(at, size) ASAN_POISON_MEMORY_REGION(at, size)
#define ZR_PERMIT(at, size) ASAN_UNPOISON_MEMORY_REGION(at, size)
#else
#define ZR_FORBID(at, size) ((void)(at), (void)(size))
#define ZR_PERMIT(at, size) ((void)(at), (void)(size))
#endif

#endif
