/* health_check.h - a health check for containers without curl. */
#ifndef ZRASTERD_HEALTH_CHECK_H
#define ZRASTERD_HEALTH_CHECK_H

#include <stdbool.h>

#include "config.h"

/* Sends GET /healthz to the daemon with this configuration. True: the answer has status 200 within some seconds. */
bool health_check(const struct config *config);

#endif
