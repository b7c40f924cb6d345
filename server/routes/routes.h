/* routes.h - handlers of the paths of router.c, one file per resource.
 *
 * NAME_open checks all that is known before the body. False: the answer is ready. NAME_work makes the answer on a
 * worker (struct route).
 */
#ifndef ZRASTERD_ROUTES_H
#define ZRASTERD_ROUTES_H

#include "request.h"

/* POST /v1/render: the picture of a scene or model. */
bool rendering_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next rendering_work(const struct work *work);

/* POST /render: the glTF render client-server protocol of Drake, a robotics toolbox. A form has a glTF file, the
 * intrinsics of a camera, and the kind of image. It becomes a scene in JSON that names the file as its mesh, so an
 * answer equals that of POST /v1/render for this scene. */
#define DRAKE_PATH "/render"
bool drake_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next drake_work(const struct work *work);

/* POST /v1/compare: the numbers of two models, and with `show` a picture of their differences. A form has the parts a and
 * b, and the files that these refer to. */
#define COMPARE_PATH "/v1/compare"
bool comparing_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next comparing_work(const struct work *work);

/* POST /v1/drawing: a technical drawing of a scene or model, as SVG or PNG. The body is that of /v1/render. */
#define DRAWING_PATH "/v1/drawing"
bool drawing_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next drawing_work(const struct work *work);

/* Pictures that have an address:
 *
 *     GET, HEAD /v1/renders/{sha256}?parameters             the picture of a stored scene or model
 *     GET, HEAD /v1/renders/{sha256}/{preset}?parameters    with the parameters of a preset, too
 *
 * The ETag is known before drawing (render_key.h). A client that has the picture gets 304, and kept answers are sent by
 * renders_open. */
#define RENDERS_PATH "/v1/renders/"
bool renders_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next renders_work(const struct work *work);

/* POST /mcp: the tools of the Model Context Protocol (mcp/handler.h), whose pictures are those of /v1/render. */
#define AGENTS_PATH "/mcp"
bool agents_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next agents_work(const struct work *work);

/* Assets and scenes, which are one store:
 *
 *     POST      /v1/assets             bytes -> their name
 *     PUT       /v1/assets/{sha256}    bytes, checked against the name
 *     GET, HEAD /v1/assets/{sha256}    the bytes
 *
 * assets_open sets request->asset and has_asset. */
#define ASSETS_PATH "/v1/assets/"
#define SCENES_PATH "/v1/scenes/"
bool assets_open(const struct service *service, struct request *request, struct answer *answer);
enum request_next assets_work(const struct work *work);

/* Returns the reader of stored assets for zr_request. */
struct zr_stored assets_stored(const struct service *service);

/* The contract for programs: JSON Schema of a scene or of one object, and the description of all paths. */
#define SCENE_SCHEMA_PATH "/v1/scene.schema.json"
#define SCHEMA_PATH       "/v1/schema/" /* with the name of an object, and .json */
#define OPENAPI_PATH      "/v1/openapi.json"
bool contract_open_schema(const struct service *service, struct request *request, struct answer *answer);
bool contract_open_openapi(const struct service *service, struct request *request, struct answer *answer);

/* GET /healthz: the daemon is alive; GET /readyz: it accepts work; GET /v1/limits: the limits in force. */
bool health_open(const struct service *service, struct request *request, struct answer *answer);
bool health_open_ready(const struct service *service, struct request *request, struct answer *answer);
bool limits_open(const struct service *service, struct request *request, struct answer *answer);

/* Returns the reason why the daemon is not ready, or REFUSAL_NONE. Not ready if either queue is full: a client that
 * checks readiness may send large requests, too. */
enum refusal health_busy_with(const struct service *service, const struct request *request);

/* GET /metrics: counts and state of the daemon for Prometheus. */
bool metrics_open(const struct service *service, struct request *request, struct answer *answer);

/* GET /: the page. GET /docs/ADDRESS: a page of the manual, its style or a picture; /docs leads there. 404 with
 * --page=off. */
#define MANUAL_PATH "/docs/"
bool site_open(const struct service *service, struct request *request, struct answer *answer);
bool manual_open(const struct service *service, struct request *request, struct answer *answer);

/* GET /engine/NAME: a file of --engine-dir, for the page. 404 without it, and with --page=off. */
#define ENGINE_PATH "/engine/"
bool engine_open(const struct service *service, struct request *request, struct answer *answer);

/* GET /v1/examples: names, titles and files of the scenes. GET /v1/examples/NAME: a scene or a file. */
#define EXAMPLES_PATH "/v1/examples/"
bool examples_open(const struct service *service, struct request *request, struct answer *answer);

/* GET /v1/looks: names, versions and texts of all looks. */
bool looks_open(const struct service *service, struct request *request, struct answer *answer);

#endif
