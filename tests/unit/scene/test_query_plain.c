/* input/query/query_plain.c: spellings of a query that are one, and those that are not. routes/render_key.c: their hashes. */
#include <stdlib.h>
#include <string.h>

#include "input/query/query_plain.h"
#include "input/query/query_text.h"
#include "render_request.h"
#include "routes/render_key.h"
#include "support/tests.h"

/* The query in its one spelling; free it. */
static char *plain_of(const char *query)
{
    struct zr_request request = {0};
    struct zr_error error = {0};
    const struct zr_limits limits = zr_limits_default();
    char *values = malloc(zr_query_room(query));
    assert_int_equal(zr_query_split(query, values, &request, &error), ZR_OK);
    const size_t room = zr_query_plain_room(&request);
    char *plain = malloc(room);
    zr_query_plain(&request, &limits, plain);
    assert_true(strlen(plain) < room);
    free(values);
    return plain;
}

static void assert_plain(const char *query, const char *wanted)
{
    char *plain = plain_of(query);
    if (strcmp(plain, wanted) != 0) fail_msg("%s: %s, not %s", query, plain, wanted);
    free(plain);
}

TEST(spelling_does_not_matter)
{
    assert_plain("", "{}");
    assert_plain("width=800&azimuth=100", "{\"width\":800,\"azimuth\":100}");
    assert_plain("azimuth=1e2&width=0800", "{\"width\":800,\"azimuth\":100}");
    assert_plain("azimuth=100.0&&width=%38%300&", "{\"width\":800,\"azimuth\":100}");
    assert_plain("color=red", "{\"color\":[1,0,0,1]}");
    assert_plain("color=%23f00", "{\"color\":[1,0,0,1]}");
    assert_plain("color=%23FF0000", "{\"color\":[1,0,0,1]}");
    assert_plain("background=transparent&outline=true", "{\"background\":[0,0,0,0],\"outline\":true}");
    assert_plain("edges=1", "{\"edges\":true}");
    assert_plain("edges=true", "{\"edges\":true}");
    assert_plain("section=x", "{\"section\":[{\"axis\":\"x\",\"fraction\":0.5,\"keep\":\"far\"}]}");
    assert_plain("section=x:5e-1", "{\"section\":[{\"axis\":\"x\",\"fraction\":0.5,\"keep\":\"far\"}]}");
    assert_plain("hide=a+b,c", "{\"hide\":[\"a b\",\"c\"]}");
}

TEST(look_has_its_version)
{
    char *studio = plain_of("look=studio");
    assert_non_null(strstr(studio, "studio@"));
    assert_plain("look=studio@1", "{\"look\":\"studio@1\"}");
    assert_plain("look=textbook", "{\"look\":\"textbook@1\"}");
    assert_plain("look=nothing", "{\"look\":\"nothing\"}");
    free(studio);
}

TEST(defaults_are_left_out_where_no_file_tells_them_apart)
{
    assert_plain("compress=fast&strict=0", "{}");
    assert_plain("compress=small&strict=1", "{\"compress\":\"small\",\"strict\":true}");
    assert_plain("look=studio@1&fileLights=false", "{\"look\":\"studio@1\"}");
    assert_plain("fileLights=0", "{\"mesh\":true}"); /* a scene refuses it */
    assert_plain("fileLights=0&channel=depth", "{\"channel\":\"depth\",\"mesh\":true}");
    assert_plain("width=640&height=480", "{\"width\":640,\"height\":480}"); /* a scene may have another window */
}

TEST(wrong_values_stay_apart)
{
    assert_plain("width=wide", "{\"width\":\"wide\"}");
    assert_plain("width=0", "{\"width\":\"0\"}");
    assert_plain("color=%22%5C", "{\"color\":\"\\\"\\\\\"}");
    assert_plain("edges=maybe", "{\"edges\":\"maybe\"}");
    assert_plain("section=x:2", "{\"section\":\"x:2\"}");
}

TEST(longest_values_have_room)
{
    enum { LONG = 4000 };
    char query[LONG + 16] = "hide=", *at = query + strlen(query);
    for (int i = 0; i < LONG; i++)
        *at++ = i % 2 ? ',' : '"';
    at[-1] = '\0';
    free(plain_of(query));
    free(plain_of("section=x,y,z,x:0.1234567890123456,y:0.1234567890123456:positive,z:0.1234567890123456:negative"));
    free(plain_of("lightDirection=-1.2345678901234567e-38,-1.2345678901234567e-38,-1.2345678901234567e-38"));
}

static struct zr_file_hash key_of(const char *scene, struct zr_request request)
{
    struct zr_file_hash key;
    const struct zr_limits limits = zr_limits_default();
    assert_true(render_key(scene, &request, &limits, &key));
    return key;
}

TEST(key_has_scene_and_parameters)
{
    const struct zr_file_hash plain = key_of("a", (struct zr_request){0}), same = key_of("a", (struct zr_request){0}),
                              other = key_of("b", (struct zr_request){0}),
                              wide = key_of("a", (struct zr_request){.width = "800"}),
                              look = key_of("a", (struct zr_request){.look = "studio"});
    assert_memory_equal(&plain, &same, sizeof plain);
    assert_memory_not_equal(&plain, &other, sizeof plain);
    assert_memory_not_equal(&plain, &wide, sizeof plain);
    assert_memory_not_equal(&plain, &look, sizeof plain);
}

RUN_TESTS(NULL, NULL)
