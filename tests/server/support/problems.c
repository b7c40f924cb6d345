#include "problems.h"

#include <string.h>

#include <cjson/cJSON.h>

#include "support/cmocka_all.h"

void assert_problem(struct reply reply, long status, const char *text)
{
    if (reply.status != status) fail_msg("wanted %ld and '%s', got %ld: %s", status, text, reply.status, reply.body);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/problem+json");
    cJSON *root = cJSON_Parse(reply.body);
    assert_non_null(root);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "type")), "about:blank");
    assert_true(strlen(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "title"))) > 0);
    assert_true((long)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(root, "status")) == status);
    const char *detail = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "detail"));
    if (!strstr(detail, text)) fail_msg("'%s' is not in '%s'", text, detail);
    cJSON_Delete(root);
    reply_free(&reply);
}
