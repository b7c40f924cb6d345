/* Texts of strangers in the log. */
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "log/log_text.h"
#include "support/tests.h"

TEST(texts_are_inside_of_one_line_of_json)
{
    static const struct {
        const char *text, *escaped;
    } CASES[] = {
        {"plain", "plain"},
        {"a\"b\\c", "a\\\"b\\\\c"},
        {"a\r\nb\tc", "a\\u000d\\u000ab\\u0009c"},
        {"\x1b[31mred\x1b[0m", "\\u001b[31mred\\u001b[0m"},
        {"\x7f", "\\u007f"},
        {"\xc2\x9b"
         "31m",
         "\\u009b31m"}, /* CSI as one character */
        {"a\xe2\x80\xa8"
         "b\xe2\x80\xa9",
         "a\\u2028b\\u2029"}, /* line ends of JavaScript */
        {"\xe2\x80\xae"
         "gnp\xe2\x81\xa6",
         "\\u202egnp\\u2066"},                                    /* directions */
        {"\xff\xc0\xaf", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"}, /* no UTF-8 */
        {"\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"}, /* half of a surrogate */
        {"K\xc3\xb6ln \xe4\xb8\xad \xf0\x9f\x99\x82", "K\xc3\xb6ln \xe4\xb8\xad \xf0\x9f\x99\x82"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        char escaped[LOG_TEXT_ESCAPED_SIZE];
        log_text_escape(escaped, CASES[i].text);
        assert_string_equal(escaped, CASES[i].escaped);
    }
}

TEST(any_bytes_are_a_string_of_json)
{
    unsigned seed = 3;
    for (int round = 0; round < 20000; round++) {
        char text[600], escaped[LOG_TEXT_ESCAPED_SIZE + 2] = "\"";
        const size_t length = (seed = seed * 1103515245 + 12345) >> 16 & 511;
        for (size_t i = 0; i < length; i++) {
            seed = seed * 1103515245 + 12345;
            text[i] = (char)(seed >> 24 ? seed >> 24 : 1);
        }
        text[length] = '\0';
        log_text_escape(escaped + 1, text);
        assert_null(strpbrk(escaped, "\r\n\x1b\x7f"));
        strcat(escaped, "\"");
        cJSON *parsed = cJSON_ParseWithOpts(escaped, NULL, 1);
        assert_true(cJSON_IsString(parsed));
        cJSON_Delete(parsed);
    }
}

TEST(long_texts_are_cut_at_a_character)
{
    char text[2001], escaped[LOG_TEXT_ESCAPED_SIZE];
    memset(text, 1, 2000);
    text[2000] = '\0';
    log_text_escape(escaped, text);
    assert_int_equal(strlen(escaped), 6 * (LOG_TEXT_SIZE - 1));
    for (int i = 0; i < 1000; i++)
        memcpy(text + 2 * i, "\xc3\xb6", 2);
    text[0] = 'a';
    text[1] = 'b';
    log_text_escape(escaped, text);
    assert_int_equal(strlen(escaped), LOG_TEXT_SIZE - 1);
    assert_null(strstr(escaped, "\xef\xbf\xbd"));
}

TEST(secrets_of_a_query_are_not_shown)
{
    static const struct {
        const char *query, *shown;
    } CASES[] = {
        {"", ""},
        {"width=3&look=studio", "width=3&look=studio"},
        {"signature=abc", "signature=-"},
        {"a=1&signature=abc%20d=e&b=2", "a=1&signature=-&b=2"},
        {"Signature=abc&&TOKEN=x&", "Signature=-&&TOKEN=-&"},
        {"%73ignatur%65=abc&access_token=x=y", "%73ignatur%65=-&access_token=-"},
        {"signature", "signature"},
        {"signatures=abc&xsignature=abc&sign=abc", "signatures=abc&xsignature=abc&sign=abc"},
        {"%7=1&%=2&%zz=3", "%7=1&%=2&%zz=3"},
        {"signature=a&signature=b", "signature=-&signature=-"},
    };
    char shown[128], small[16];
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        log_text_redact(shown, sizeof shown, CASES[i].query);
        assert_string_equal(shown, CASES[i].shown);
    }
    log_text_redact(small, sizeof small, "a=123456789&signature=secret");
    assert_string_equal(small, "a=123456789&sig");
}

RUN_TESTS(NULL, NULL)
