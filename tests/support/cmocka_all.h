/* cmocka_all.h - support: cmocka.h and the headers that it requires. */
#ifndef ZR_TEST_CMOCKA_ALL_H
#define ZR_TEST_CMOCKA_ALL_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* cmocka 2 deprecates assert_in_range, and cmocka 1 lacks its successor. cmocka 2 defines a macro `stop`. */
#ifdef assert_int_in_range
#undef assert_in_range
#define assert_in_range(value, low, high) assert_int_in_range((intmax_t)(value), (intmax_t)(low), (intmax_t)(high))
#endif
#undef stop

#endif
