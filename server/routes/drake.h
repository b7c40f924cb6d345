/* drake.h - POST /render: the glTF render client-server protocol of Drake, a robotics toolbox.
 *
 * A form has a glTF file, the intrinsics of a camera, and the kind of image. It becomes a scene in JSON that names the
 * file as its mesh, so an answer equals that of POST /v1/render for this scene.
 */
#ifndef ZRASTERD_DRAKE_H
#define ZRASTERD_DRAKE_H

#include "request.h"

#define DRAKE_PATH "/render"

/* Checks the type of the body. */
bool drake_open(const struct service *service, const struct load *load, struct request *request, struct answer *answer);

/* Checks the fields of the form, makes the scene and renders it. */
enum request_next drake_work(const struct work *work);

#endif
