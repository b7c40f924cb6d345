/* tests.h - support: a program of tests, which is one file.
 *
 *     TEST(name) { ... }                           a test; `state` is cmocka's
 *     TEST_AROUND(name, before, after) { ... }     with setup and teardown of its own
 *     RUN_TESTS(before, after)                     last in the file: main, which runs its tests from top to bottom
 *
 * ONLY=NAME in the environment runs that test alone. Status 1 if no test has that name.
 */
#ifndef ZR_TEST_TESTS_H
#define ZR_TEST_TESTS_H

#include <stdlib.h>
#include <string.h>

#include "support/cmocka_all.h"

/* cmocka passes over entries without a name. */
static struct CMUnitTest listed_tests[256];
static int lines_of_tests[256];

/* Keeps the order of lines, since the compiler decides about the order of constructors. */
static inline void list_test(int line, struct CMUnitTest test)
{
    size_t place = 0;
    while (listed_tests[place].name)
        place++;
    if (place + 1 == sizeof listed_tests / sizeof *listed_tests) abort();
    for (; place > 0 && lines_of_tests[place - 1] > line; place--) {
        listed_tests[place] = listed_tests[place - 1];
        lines_of_tests[place] = lines_of_tests[place - 1];
    }
    listed_tests[place] = test;
    lines_of_tests[place] = line;
}

/* Takes away the tests of other names. Returns how many are left. */
static inline int keep_only(const char *name)
{
    int left = 0;
    for (size_t i = 0; listed_tests[i].name; i++) {
        if (strcmp(listed_tests[i].name, name) == 0) listed_tests[left++] = listed_tests[i];
    }
    for (size_t i = (size_t)left; i < sizeof listed_tests / sizeof *listed_tests; i++)
        listed_tests[i].name = NULL;
    return left;
}

#define TEST_LISTED(f, ...)                                                                                            \
    static void f(void **state);                                                                                       \
    __attribute__((constructor)) static void list_##f(void)                                                            \
    {                                                                                                                  \
        __VA_ARGS__;                                                                                                   \
    }                                                                                                                  \
    static void f(void **state __attribute__((unused)))

#define TEST(f) TEST_LISTED(f, list_test(__LINE__, (struct CMUnitTest)cmocka_unit_test(f)))
#define TEST_AROUND(f, before, after)                                                                                  \
    TEST_LISTED(f, list_test(__LINE__, (struct CMUnitTest)cmocka_unit_test_setup_teardown(f, before, after)))

#define RUN_TESTS(before, after)                                                                                       \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        const char *only = getenv("ONLY");                                                                             \
        if (only && keep_only(only) == 0) return 1;                                                                    \
        return cmocka_run_group_tests(listed_tests, before, after);                                                    \
    }

#endif
