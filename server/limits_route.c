#include "limits_route.h"

#include <string.h>

#include <cjson/cJSON.h>

bool limits_open(const struct service *service, const struct load *load, struct request *request, struct answer *answer)
{
    (void)load;
    (void)request;
    cJSON *root = cJSON_CreateObject(), *limits = NULL;
    const bool is_whole = cJSON_AddStringToObject(root, "version", ZR_VERSION) &&
                          (limits = cJSON_AddObjectToObject(root, "limits")) &&
                          config_add_limits(service->config, limits);
    char *text = is_whole ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    answer->status = 200;
    answer->is_broken |= !text;
    if (text) answer_body(answer, "application/json", text, strlen(text));
    return false;
}
