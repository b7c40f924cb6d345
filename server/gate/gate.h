/* gate.h - tokens, keys of signatures and presets, which may change while the daemon runs.
 *
 * A gate is read from the settings and the files that they name, and constant afterwards. Another one replaces it on
 * the thread that serves all connections (http_change_gate). Only that thread may use service->gate: a worker gets a
 * copy of what it needs.
 */
#ifndef ZRASTERD_GATE_H
#define ZRASTERD_GATE_H

#include <stdbool.h>
#include <stddef.h>

#include "signature.h"

struct config;
struct gate;

enum {
    GATE_TOKENS_MAX = 64,
    GATE_TOKEN_MAX = 255, /* bytes */
    GATE_PRESETS_MAX = 256,
    GATE_PRESET_NAME_MAX = 64 /* bytes */
};

/* Reads all of it: --token, --token-file, --keys-file, --presets. Returns NULL if something is wrong; `message` names
 * the file, the line and the fault, and no secret. Free with gate_free, which takes NULL, too. */
struct gate *gate_read(const struct config *config, char *message, size_t message_size);
void gate_free(struct gate *gate);

/* Returns warnings for the operator, "" if there are none. */
const char *gate_warning(const struct gate *gate);

/* Writes the numbers of tokens, keys and presets, with those of `before` where they differ; it may be NULL. */
void gate_describe(const struct gate *gate, const struct gate *before, char *text, size_t size);

/* Returns true if clients must send a token. */
bool gate_asks_for_token(const struct gate *gate);

/* Compares with all tokens, in a time that depends on the length of the given one only. */
bool gate_knows_token(const struct gate *gate, const char *token, size_t length);

/* Returns the keys of signatures; count 0: addresses need none. */
const struct signature_keys *gate_keys(const struct gate *gate);

/* Returns the query of a preset, as it is in the file, NULL if there is no such preset. Belongs to the gate. */
const char *gate_preset(const struct gate *gate, const char *name);

/* Returns true if addresses take a preset and no parameters of their own. */
bool gate_has_only_presets(const struct gate *gate);

/* Writes the names of the presets with commas between them, those that have room, in the order of the file. */
void gate_list_presets(const struct gate *gate, char *text, size_t size);

#endif
