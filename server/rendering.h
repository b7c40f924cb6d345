/* rendering.h - POST /v1/render: from the body to the answer. */
#ifndef ZRASTERD_RENDERING_H
#define ZRASTERD_RENDERING_H

#include "request.h"

/* Checks the type of the body and reads the query. */
bool rendering_open(const struct service *service, const struct load *load, struct request *request,
                    struct answer *answer);

/* Unpacks the body, reads the scene, predicts its cost, draws it and encodes the outputs. */
enum request_next rendering_work(const struct service *service, const struct request *request, struct zr_arena *arena,
                                 const struct zr_cancel *cancel, struct step_times *times, struct answer *answer);

#endif
