/* value.h - values of settings in struct config: defaults, and texts that are checked. */
#ifndef ZRASTERD_VALUE_H
#define ZRASTERD_VALUE_H

#include "settings.h"

void value_set_defaults(struct config *config);

/* Sets any setting. False: the value is wrong, and `message` names the setting by `name` (the flag or variable as the
 * user wrote it), the value and the allowed values. */
bool value_set(struct config *config, const struct setting *setting, const char *name, const char *value, char *message,
               size_t message_size);

uint64_t value_number(const struct config *config, const struct setting *setting);
const char *value_text(const struct config *config, const struct setting *setting);

#endif
