/* contract.h - the contract for programs: JSON Schema of scenes, and OpenAPI. */
#ifndef ZRASTERD_CONTRACT_H
#define ZRASTERD_CONTRACT_H

#include "request.h"

#define SCENE_SCHEMA_PATH "/v1/scene.schema.json"
#define SCHEMA_PATH       "/v1/schema/" /* with the name of an object, and .json */
#define OPENAPI_PATH      "/v1/openapi.json"

/* Answer the schema of a scene or of one object, and the description of all paths. */
bool contract_open_schema(const struct service *service, const struct load *load, struct request *request,
                          struct answer *answer);
bool contract_open_openapi(const struct service *service, const struct load *load, struct request *request,
                           struct answer *answer);

#endif
