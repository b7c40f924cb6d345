/* health_check.h - a health check for containers that have no curl. */
#ifndef ZRASTERD_HEALTH_CHECK_H
#define ZRASTERD_HEALTH_CHECK_H

#include <stdbool.h>

#include "config.h"

/* Asks GET /healthz of the daemon that has this configuration. */
bool health_check(const struct config *config);

#endif
