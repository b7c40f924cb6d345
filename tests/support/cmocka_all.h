/* cmocka_all.h - support: cmocka.h and the headers that it wants in front of it. */
#ifndef ZR_TEST_CMOCKA_ALL_H
#define ZR_TEST_CMOCKA_ALL_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#endif
