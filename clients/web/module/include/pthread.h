/* pthread.h of WebAssembly: one thread. Locks do nothing, and no thread can be made: teams then have one member. */
#ifndef ZR_WASM_PTHREAD_H
#define ZR_WASM_PTHREAD_H

#include <errno.h>
#include <stddef.h>

typedef int zr_wasm_lock;
#define pthread_mutex_t zr_wasm_lock
#define pthread_cond_t  zr_wasm_lock
#define pthread_t       zr_wasm_lock
#define pthread_attr_t  zr_wasm_lock

#define PTHREAD_MUTEX_INITIALIZER       0
#define pthread_mutex_init(m, a)        ((void)(m), 0)
#define pthread_mutex_destroy(m)        ((void)(m), 0)
#define pthread_mutex_lock(m)           ((void)(m), 0)
#define pthread_mutex_unlock(m)         ((void)(m), 0)
#define pthread_cond_init(c, a)         ((void)(c), 0)
#define pthread_cond_destroy(c)         ((void)(c), 0)
#define pthread_cond_wait(c, m)         ((void)(c), (void)(m), 0)
#define pthread_cond_broadcast(c)       ((void)(c), 0)
#define pthread_attr_init(a)            ((void)(a), 0)
#define pthread_attr_setstacksize(a, s) ((void)(a), 0)
#define pthread_attr_destroy(a)         ((void)(a), 0)
#define pthread_create(t, a, f, x)      ((void)(t), (void)(a), (void)(f), (void)(x), EAGAIN)
#define pthread_join(t, r)              ((void)(t), 0)

#endif
