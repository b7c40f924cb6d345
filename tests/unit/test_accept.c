/* When an answer is streamed, by the Accept headers of its request. */
#include "accept.h"
#include "support/tests.h"

TEST(only_a_client_that_names_the_type_gets_a_stream)
{
    static const struct {
        const char *values[2];
        bool is_wanted;
    } CASES[] = {
        {{"multipart/mixed"}, true},
        {{"Multipart/Mixed ; boundary=x"}, true},
        {{"image/png, multipart/mixed"}, true},
        {{"image/png", " multipart/mixed;q=0.001"}, true},
        {{"application/zip, multipart/mixed"}, true},
        {{"application/zip;q=0.5 ,multipart/mixed;q=0.6"}, true},
        {{"multipart/mixed;q=0.25;a=b, application/zip;q=0.2"}, true},
        {{"application/zip", "multipart/mixed;q=0.999"}, false},
        {{""}, false},
        {{"*/*"}, false},
        {{"multipart/*"}, false},
        {{"multipart/form-data"}, false},
        {{"multipart/mixed2"}, false},
        {{"multipart/mixed;q=0"}, false},
        {{"multipart/mixed;Q=0.000"}, false},
        {{"multipart/mixed;q="}, false},
        {{"multipart/mixed;q=1.001"}, false},
        {{"multipart/mixed;q=0.5x"}, false},
        {{"multipart/mixed;q=2"}, false},
        {{",;,;q=1,,"}, false},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct accept accept = {0};
        for (int k = 0; k < 2 && CASES[i].values[k]; k++)
            accept_read(&accept, CASES[i].values[k]);
        if (accept_wants_stream(&accept) != CASES[i].is_wanted) fail_msg("%s", CASES[i].values[0]);
    }
}

RUN_TESTS(NULL, NULL)
