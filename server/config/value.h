/* value.h - values of settings in struct config: defaults, and texts that are checked. */
#ifndef ZRASTERD_VALUE_H
#define ZRASTERD_VALUE_H

#include "faults.h"
#include "settings.h"

enum { VALUE_PLACE_SIZE = CONFIG_TEXT_SIZE + SETTING_NAME_SIZE + 16 };

void value_set_defaults(struct config *config);

/* Sets any setting, and where it comes from. A wrong value is a fault, which names the place, the value and the allowed
 * values. */
void value_set(struct config *config, const struct setting *setting, struct config_source source, const char *value,
               struct faults *faults);

/* Writes where a setting comes from, as messages name it: zrasterd.conf:3: port, ZRASTER_PORT or --port. */
void value_place(const struct config *config, const struct setting *setting, struct config_source source,
                 char place[VALUE_PLACE_SIZE]);

/* Replaces 0 by the number for this machine: workers, threads, queue. */
void value_settle(struct config *config);

uint64_t value_number(const struct config *config, const struct setting *setting);
const char *value_text(const struct config *config, const struct setting *setting);

#endif
