/* setjmp.h of WebAssembly. clang makes exceptions of it (-wasm-enable-sjlj); runtime.c has the functions that they call. */
#ifndef ZR_WASM_SETJMP_H
#define ZR_WASM_SETJMP_H

typedef struct {
    void *invocation;
    unsigned label;
    struct {
        void *env;
        int value;
    } thrown;
} jmp_buf[1];

int setjmp(jmp_buf) __attribute__((returns_twice));
_Noreturn void longjmp(jmp_buf, int);

#endif
