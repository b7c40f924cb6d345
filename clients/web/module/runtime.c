/* runtime.c of WebAssembly: the functions that clang's setjmp calls (LLVM 19), and the library's question about spare memory. */
#include <stddef.h>
#include <stdint.h>

#include "api/spare_memory.h"

struct jump {
    void *invocation;
    uint32_t label;
    struct {
        void *env;
        int value;
    } thrown;
};

void __wasm_setjmp(void *env, uint32_t label, void *invocation);
uint32_t __wasm_setjmp_test(void *env, void *invocation);
void __wasm_longjmp(void *env, int value);

void __wasm_setjmp(void *env, uint32_t label, void *invocation)
{
    struct jump *jump = env;
    jump->invocation = invocation;
    jump->label = label;
}

uint32_t __wasm_setjmp_test(void *env, void *invocation)
{
    const struct jump *jump = env;
    return jump->invocation == invocation ? jump->label : 0;
}

/* C's tag is number 1. */
void __wasm_longjmp(void *env, int value)
{
    struct jump *jump = env;
    jump->thrown.env = env;
    jump->thrown.value = value ? value : 1;
    __builtin_wasm_throw(1, &jump->thrown);
}
__asm__(".globl __c_longjmp\n.tagtype __c_longjmp i32\n__c_longjmp:\n");

/* The memory of a module has a maximum, which its caller knows and hands on. */
size_t zr_spare_memory(void)
{
    return SIZE_MAX;
}

size_t zr_default_memory(void)
{
    return (size_t)1 << 30;
}
