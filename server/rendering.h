/* rendering.h - POST /v1/render: from the body to the answer. */
#ifndef ZRASTERD_RENDERING_H
#define ZRASTERD_RENDERING_H

#include "api.h"

/* As api_work. */
enum api_next rendering_work(const struct api *api, const struct api_request *request, struct zr_arena *arena,
                             const struct zr_cancel *cancel, struct step_times *times, struct answer *answer);

#endif
