/* signal.h of WebAssembly, which has none. */
#ifndef ZR_WASM_SIGNAL_H
#define ZR_WASM_SIGNAL_H

typedef int zr_wasm_signals;
#define sigset_t    zr_wasm_signals
#define SIG_SETMASK 0
enum { SIGILL = 4, SIGBUS = 7, SIGFPE = 8, SIGSEGV = 11 };
#define sigfillset(s)            ((void)(s))
#define sigdelset(s, n)          ((void)(s), (void)(n))
#define pthread_sigmask(h, s, o) ((void)(s), (void)(o))

#endif
