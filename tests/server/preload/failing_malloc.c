/* failing_malloc.so - preloaded into a daemon, it lets allocations fail when a test says so: the test shares a page
 * with it, the file named by FAILING_MALLOC (support/failing_malloc.h). */
#include "support/failing_malloc.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/mman.h>

static struct failing_malloc *control;

static void __attribute__((constructor)) find_control(void)
{
    const char *path = getenv("FAILING_MALLOC");
    const int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *page = fd >= 0 ? mmap(NULL, sizeof *control, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
    if (page != MAP_FAILED) control = page;
}

static bool fails(void)
{
    return control && failing_malloc_fails(control);
}

/* The next one behind us: the C library's, or a sanitizer's. */
#define NEXT(name)                                                                                                     \
    static __typeof__(name) *next;                                                                                     \
    if (!next) *(void **)(void *)&next = dlsym(RTLD_NEXT, #name)

void *malloc(size_t size)
{
    NEXT(malloc);
    return fails() ? NULL : next(size);
}

void *calloc(size_t count, size_t size)
{
    NEXT(calloc);
    return fails() ? NULL : next(count, size);
}

void *realloc(void *old, size_t size)
{
    NEXT(realloc);
    return fails() ? NULL : next(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    NEXT(aligned_alloc);
    return fails() ? NULL : next(alignment, size);
}

int posix_memalign(void **out, size_t alignment, size_t size)
{
    NEXT(posix_memalign);
    return fails() ? ENOMEM : next(out, alignment, size);
}
