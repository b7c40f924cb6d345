/* When files are sent in parts, and of which type, by the Accept headers of their request. */
#include "http/accept.h"
#include "support/tests.h"

TEST(only_a_client_that_names_the_type_gets_parts)
{
    static const struct {
        const char *values[2];
        enum accept_parts wanted;
    } CASES[] = {
        {{"multipart/mixed"}, ACCEPT_MIXED},
        {{"Multipart/Mixed ; boundary=x"}, ACCEPT_MIXED},
        {{"image/png, multipart/mixed"}, ACCEPT_MIXED},
        {{"image/png", " multipart/mixed;q=0.001"}, ACCEPT_MIXED},
        {{"application/zip, multipart/mixed"}, ACCEPT_MIXED},
        {{"application/zip;q=0.5 ,multipart/mixed;q=0.6"}, ACCEPT_MIXED},
        {{"multipart/mixed;q=0.25;a=b, application/zip;q=0.2"}, ACCEPT_MIXED},
        {{"application/zip", "multipart/mixed;q=0.999"}, ACCEPT_NO_PARTS},
        {{""}, ACCEPT_NO_PARTS},
        {{"*/*"}, ACCEPT_NO_PARTS},
        {{"multipart/*"}, ACCEPT_NO_PARTS},
        {{"multipart/form-data"}, ACCEPT_FORM},
        {{"Multipart/Form-Data;q=0.2, */*"}, ACCEPT_FORM},
        {{"multipart/form-data, multipart/mixed"}, ACCEPT_MIXED},
        {{"multipart/form-data;q=0.6", "multipart/mixed;q=0.5"}, ACCEPT_FORM},
        {{"multipart/form-data;q=0.6, multipart/mixed;q=0.5, application/zip;q=0.7"}, ACCEPT_NO_PARTS},
        {{"multipart/form-data;q=0"}, ACCEPT_NO_PARTS},
        {{"multipart/mixed2"}, ACCEPT_NO_PARTS},
        {{"multipart/mixed;q=0"}, ACCEPT_NO_PARTS},
        {{"multipart/mixed;Q=0.000"}, ACCEPT_NO_PARTS},
        {{"multipart/mixed;q="}, ACCEPT_NO_PARTS},
        {{"multipart/mixed;q=1.001"}, ACCEPT_NO_PARTS},
        {{"multipart/mixed;q=0.5x"}, ACCEPT_NO_PARTS},
        {{"multipart/mixed;q=2"}, ACCEPT_NO_PARTS},
        {{",;,;q=1,,"}, ACCEPT_NO_PARTS},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct accept accept = {0};
        for (int k = 0; k < 2 && CASES[i].values[k]; k++)
            accept_read(&accept, CASES[i].values[k]);
        if (accept_parts(&accept) != CASES[i].wanted) fail_msg("%s", CASES[i].values[0]);
    }
}

TEST(metrics_are_open_metrics_for_those_who_prefer_them_to_text)
{
    static const struct {
        const char *value;
        bool wanted;
    } CASES[] = {
        {"application/openmetrics-text;version=1.0.0,text/plain;version=0.0.4;q=0.5,*/*;q=0.1", true},
        {"application/openmetrics-text", true},
        {"text/plain, application/openmetrics-text;q=0.5", false},
        {"application/openmetrics-text;q=0", false},
        {"text/plain", false},
        {"*/*", false},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct accept accept = {0};
        accept_read(&accept, CASES[i].value);
        if (accept_prefers(&accept, ACCEPT_TYPE_OPEN_METRICS, ACCEPT_TYPE_PLAIN) != CASES[i].wanted)
            fail_msg("%s", CASES[i].value);
    }
}

RUN_TESTS(NULL, NULL)
