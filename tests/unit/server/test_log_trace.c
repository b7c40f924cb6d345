/* traceparent, as W3C Trace Context has it. */
#include <string.h>

#include "log/trace.h"
#include "support/tests.h"

#define ID     "0af7651916cd43dd8448eb211c80319c"
#define PARENT "b7ad6b7169203331"

TEST(valid_headers_are_taken)
{
    static const struct {
        const char *given;
        bool is_sampled;
        const char *flags;
    } CASES[] = {
        {"00-" ID "-" PARENT "-01", true, "01"},
        {"00-" ID "-" PARENT "-00", false, "00"},
        {"00-" ID "-" PARENT "-ff", true, "03"},
        {"00-" ID "-" PARENT "-02", false, "02"},
        {"cc-" ID "-" PARENT "-01", true, "01"},
        {"cc-" ID "-" PARENT "-01-", true, "01"},
        {"01-" ID "-" PARENT "-01-what-the-future-will-be-like", true, "01"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct trace trace;
        assert_true(trace_read(&trace, CASES[i].given, i));
        assert_string_equal(trace.id, ID);
        assert_string_equal(trace.parent, PARENT);
        assert_int_equal(strlen(trace.span), 16);
        assert_int_equal(strspn(trace.span, "0123456789abcdef"), 16);
        assert_memory_equal(trace.given, CASES[i].given, 55);
        assert_int_equal(trace.is_sampled, CASES[i].is_sampled);
        assert_memory_equal(trace.answer, "00-" ID "-", 36);
        assert_memory_equal(trace.answer + 36, trace.span, 16);
        assert_string_equal(trace.answer + 53, CASES[i].flags);
    }
}

TEST(each_request_has_its_own_span)
{
    struct trace one, two;
    assert_true(trace_read(&one, "00-" ID "-" PARENT "-01", 5) && trace_read(&two, "00-" ID "-" PARENT "-01", 6));
    assert_string_not_equal(one.span, two.span);
    assert_string_not_equal(one.span, PARENT);
}

TEST(other_headers_count_for_nothing)
{
    static const char *const GIVEN[] = {
        "",
        "00",
        "00-" ID "-" PARENT,
        "00-" ID "-" PARENT "-0",
        "00-" ID "-" PARENT "-0g",
        "00-" ID "-" PARENT "-01-",
        "00-" ID "-" PARENT "-01-more",
        "01-" ID "-" PARENT "-01more",
        "01-" ID "-" PARENT "-01.",
        "ff-" ID "-" PARENT "-01",
        "00-0AF7651916CD43DD8448EB211C80319C-" PARENT "-01",
        "00-00000000000000000000000000000000-" PARENT "-01",
        "00-" ID "-0000000000000000-01",
        " 00-" ID "-" PARENT "-01",
        "00_" ID "-" PARENT "-01",
        "0-" ID "-" PARENT "-011",
    };
    for (size_t i = 0; i < sizeof GIVEN / sizeof GIVEN[0]; i++) {
        struct trace trace;
        if (trace_read(&trace, GIVEN[i], 1)) fail_msg("%s", GIVEN[i]);
        assert_string_equal(trace.id, "");
    }
}

RUN_TESTS(NULL, NULL)
