/* The handler of MCP, apart from drawing: JSON, the scenes that arguments make, and bodies at random. The protocol's
 * errors are in tests/server/test_mcp.py. */
#include "support/mcp_host.h"
#include "support/tests.h"
#include "unit/common/mutate.h"

static struct mcp_test_host test;

static int open_host(void **state)
{
    (void)state;
    mcp_test_host_open(&test);
    return 0;
}

static int close_host(void **state)
{
    (void)state;
    mcp_test_host_close(&test);
    return 0;
}

/* ---- messages ---- */

static char *handle(const char *message)
{
    struct mcp_reply reply = mcp_test_handle(&test, message, strlen(message));
    return reply.text.data;
}

/* Calls a tool with arguments, which must be accepted, and returns the scene that is drawn. */
static const char *scene_of(const char *tool, const char *arguments)
{
    struct text message = {0};
    add(&message,
        "{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"tools/call\",\"params\":{\"name\":\"%s\",\"arguments\":%s}}", tool,
        arguments);
    char *answer = handle(message.bytes);
    if (!strstr(answer, "\"isError\":false")) fail_msg("%s", answer);
    free(answer);
    drop(&message);
    return test.scene;
}

TEST(arguments_make_a_scene)
{
    assert_string_equal(
        scene_of("facts", "{\"model\":{\"text\":\"v 0 0 0\"}}"),
        "{\"outputs\":[{\"channel\":\"info\"}],\"meshes\":[{\"asset\":\"model\"}],\"render\":false,\"features\":true}");
    assert_string_equal(scene_of("render", "{\"model\":{\"text\":\"v\"},\"views\":[\"top\"],\"up\":\"z\",\"parts\":{"
                                           "\"hide\":[\"a\",3]},\"width\":99}"),
                        "{\"outputs\":[{\"channel\":\"color\",\"encoding\":\"png\"},{\"channel\":\"info\"}],\"meshes\":"
                        "[{\"asset\":\"model\"}],"
                        "\"window\":{\"width\":99,\"height\":600},\"views\":[\"top\"],\"view\":{\"preset\":"
                        "\"isometric\",\"orthographic\":{}},"
                        "\"look\":\"studio\",\"up\":\"z\",\"hide\":[\"a\",3]}");
}

TEST(own_keys_of_a_scene_stay_as_written_unless_an_argument_gives_them)
{
    assert_string_equal(
        scene_of("render", "{\"scene\":{ \"polygons\" : [1.50, "
                           "{\"a\":\"\\u00e9\"}],\"look\":\"clay\",\"outputs\":[{\"channel\":\"color\"}], \"view\":{}},"
                           "\"look\":\"dark\",\"width\":20,\"height\":30}"),
        "{\"outputs\":[{\"channel\":\"color\",\"encoding\":\"png\"},{\"channel\":\"info\"}],\"window\":{\"width\":20,"
        "\"height\":30},"
        "\"look\":\"dark\",\"polygons\" : [1.50, {\"a\":\"\\u00e9\"}],\"view\":{}}");
}

TEST(a_scene_names_the_model_of_any_name)
{
    assert_string_equal(
        scene_of("facts",
                 "{\"model\":{\"asset\":\"sha256:ab\"},\"scene\":{\"meshes\":[7,{\"name\":\"model\","
                 "\"asset\": \"model\"},{\"asset\":\"b\"},{\"asset\":\"model\",\"x\":{\"asset\":\"model\"}}]}}"),
        "{\"outputs\":[{\"channel\":\"info\"}],\"render\":false,\"features\":true,\"meshes\":[7,{\"name\":\"model\","
        "\"asset\": "
        "\"sha256:ab\"},{\"asset\":\"b\"},{\"asset\":\"sha256:ab\",\"x\":{\"asset\":\"model\"}}]}");
}

TEST(large_pictures_begin_as_jpeg)
{
    assert_non_null(
        strstr(scene_of("render", "{\"model\":{\"text\":\"v\"},\"width\":1200,\"height\":1000}"), "\"png\""));
    assert_non_null(strstr(scene_of("render", "{\"model\":{\"text\":\"v\"},\"width\":1568,\"height\":1000}"),
                           "\"jpeg\",\"maxBytes\":"));
}

TEST(a_model_comes_as_base64_or_text)
{
    static const char *const SAME[] = {"{\"text\":\"solid \\u00e9\\ud83d\\ude00\\n\"}",
                                       "{\"base64\":\"c29saWQgw6nwn5iACg==\"}", "{\"base64\":\"c29saWQgw6nwn5iACg\"}",
                                       "{\"base64\":\"c29saWQg\\nw6nwn5iACg==\\n\"}",
                                       "{\"base64\":\"data:model/stl;base64,c29saWQgw6nwn5iACg==\"}"};
    for (size_t i = 0; i < sizeof SAME / sizeof *SAME; i++) {
        char arguments[256];
        snprintf(arguments, sizeof arguments, "{\"model\":%s,\"views\":[\"top\"]}", SAME[i]);
        assert_non_null(strstr(scene_of("render", arguments), "\"up\":\"z\"")); /* text that begins with solid is STL */
    }
}

TEST(a_message_that_is_no_json_keeps_its_id)
{
    char *reply = handle("{\"jsonrpc\":\"2.0\",\"id\":7,\"method\":\"tools/call\",\"params\":{\"name\":\"facts\","
                         "\"arguments\":{\"scene\":{\"meshes\":[{\"name\":\"\\ud800\"}]}}}}");
    assert_non_null(strstr(reply, "\"id\":7"));
    assert_non_null(strstr(reply, "-32700"));
    assert_non_null(strstr(reply, "line 1, column 113: expected both halves of a surrogate pair"));
    free(reply);
}

TEST(a_cancelled_message_has_no_answer)
{
    atomic_store(&test.cancel.raised, true);
    assert_null(handle("{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"ping\"}"));
    atomic_store(&test.cancel.raised, false);
}

/* ---- at random ---- */

static const char *const SEEDS[] = {
    "{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"tools/"
    "call\",\"params\":{\"name\":\"render\",\"arguments\":{\"model\":{\"base64\":"
    "\"AAECAwQ=\"},\"views\":[\"front\",{\"view\":{\"azimuthDegrees\":3}}],\"parts\":{\"hide\":[\"a\"]},\"annotate\":"
    "false}}}",
    "{\"jsonrpc\":\"2.0\",\"id\":\"x\",\"method\":\"tools/"
    "call\",\"params\":{\"name\":\"pick\",\"arguments\":{\"scene\":{\"polygons\":[],"
    "\"views\":[\"top\",{}],\"window\":{\"width\":3000,\"height\":20}},\"x\":1,\"y\":2,\"image\":1}}}",
    "{\"jsonrpc\":\"2.0\",\"id\":-3,\"method\":\"tools/"
    "call\",\"params\":{\"name\":\"facts\",\"arguments\":{\"model\":{\"text\":"
    "\"v 0 0 0\\n\\ud83d\\u0041\"}},\"_meta\":{\"io.modelcontextprotocol/protocolVersion\":\"2026-07-28\","
    "\"io.modelcontextprotocol/clientCapabilities\":{}}}}",
    "{\"jsonrpc\":\"2.0\",\"id\":5,\"method\":\"tools/call\",\"params\":{\"name\":\"facts\",\"arguments\":{\"model\":{"
    "\"asset\":\"sha256:ab\"},\"scene\":{\"meshes\":[{\"asset\":\"model\"},{\"asset\":\"model\"}],\"visibility\":true}}"
    "}}",
    "{\"jsonrpc\":\"2.0\",\"id\":0,\"method\":\"initialize\",\"params\":{\"protocolVersion\":\"2025-06-18\"}}",
    "{\"jsonrpc\":\"2.0\",\"method\":\"notifications/cancelled\",\"params\":{\"requestId\":1}}"};

/* Each body is answered by one line of JSON, or by nothing, and makes no scene that is not JSON. */
TEST(ten_thousand_random_bodies)
{
    size_t errors = 0, results = 0, silences = 0;
    for (int i = 0; i < 10000; i++) {
        struct text text = {0};
        if (below(8) == 0)
            for (size_t n = below(60); n > 0; n--)
                put(&text, (const char[]){(char)below(256)}, 1);
        else
            put(&text, SEEDS[i % 6], strlen(SEEDS[i % 6]));
        if (text.size > 0 && below(3) > 0) mutate(&text);
        char *exact = malloc(text.size ? text.size : 1); /* with nothing behind it */
        if (text.size) memcpy(exact, text.bytes, text.size);
        struct mcp_reply reply = mcp_test_handle(&test, exact, text.size);
        if (!reply.text.data) {
            silences++;
        } else {
            if (!mcp_test_is_json(reply.text.data, reply.text.size, 0)) fail_msg("%s", reply.text.data);
            if (strstr(reply.text.data, "\"error\":"))
                errors++;
            else
                results++;
        }
        mcp_text_free(&reply.text);
        free(exact);
        drop(&text);
    }
    assert_int_equal(test.wrong_scenes, 0);
    assert_true(errors > 1000 && results > 1000 && silences > 500 && test.draws > 1000);
}

RUN_TESTS(open_host, close_host)
