/* The client's own declarations of libcurl. Its functions are compared by the compiler. */
#define CURL_DISABLE_TYPECHECK
#include <curl/curl.h>
#undef curl_easy_getinfo
#undef curl_easy_setopt

#include "engine/curl_rows.h"
#include "support/tests.h"

TEST(numbers_of_libcurl_are_those_of_its_header)
{
#define ASSERT_NUMBER(name, value) assert_int_equal(name, value);
    CURL_NUMBERS(ASSERT_NUMBER)
}

RUN_TESTS(NULL, NULL)
