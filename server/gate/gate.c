#include "gate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

#include "config.h"
#include "input/text/text.h"
#include "lines.h"
#include "preset.h"

enum { WARNING_SIZE = 1024, PRINTABLE_FIRST = '!', PRINTABLE_LAST = '~' };

struct preset {
    const char *name, *query;
};

struct gate {
    size_t token_count, preset_count;
    uint8_t tokens[GATE_TOKENS_MAX][SIGNATURE_BYTES]; /* SHA-256: equal in length, whatever the tokens are */
    struct signature_keys keys;
    struct preset presets[GATE_PRESETS_MAX]; /* in `preset_lines` */
    struct lines preset_lines;
    bool has_only_presets;
    struct zr_limits limits;
    char warning[WARNING_SIZE];
};

/* Message of a fault, written by the readers. */
struct fault {
    char *message;
    size_t size;
};

static void hash(uint8_t out[SIGNATURE_BYTES], const char *text, size_t length)
{
    struct sha256_ctx state;
    sha256_init(&state);
    sha256_update(&state, length, (const uint8_t *)text);
    sha256_digest(&state, SIGNATURE_BYTES, out);
}

static void warn(struct gate *gate, const char *text, const char *path)
{
    const size_t used = strlen(gate->warning);
    snprintf(gate->warning + used, sizeof gate->warning - used, "%s%s%s", used ? "; " : "", path, text);
}

/* ---- lines of the files ---- */

static const char wrong_token[] = "a token has printable ASCII without spaces at its ends";

/* Readers of headers cut spaces at the ends off. */
static bool is_token(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if ((text[i] < PRINTABLE_FIRST || text[i] > PRINTABLE_LAST) && (text[i] != ' ' || i == 0 || i + 1 == length))
            return false;
    return true;
}

static bool add_token(struct gate *gate, struct lines *lines, char *line, struct fault *fault)
{
    const size_t length = strlen(line);
    if (!is_token(line, length)) return lines_fault(lines, fault->message, fault->size, wrong_token);
    if (length > GATE_TOKEN_MAX)
        return lines_fault(lines, fault->message, fault->size, "a token has at most %d bytes", GATE_TOKEN_MAX);
    if (gate->token_count == GATE_TOKENS_MAX)
        return lines_fault(lines, fault->message, fault->size, "more than %d tokens", GATE_TOKENS_MAX);
    hash(gate->tokens[gate->token_count++], line, length);
    return true;
}

static bool add_key(struct gate *gate, struct lines *lines, char *line, struct fault *fault)
{
    uint8_t key[SIGNATURE_KEY_MAX];
    const size_t digits = strlen(line);
    if (digits % 2 || digits < 2 * SIGNATURE_KEY_MIN || digits > 2 * SIGNATURE_KEY_MAX)
        return lines_fault(lines, fault->message, fault->size,
                           "a key has %d to %d bytes, each of two hexadecimal digits; this line has %zu digits",
                           SIGNATURE_KEY_MIN, SIGNATURE_KEY_MAX, digits);
    for (size_t i = 0; i < digits; i++) {
        const int digit = zr_hex_digit(line[i]);
        if (digit < 0)
            return lines_fault(lines, fault->message, fault->size, "byte %zu is no hexadecimal digit", i + 1);
        key[i / 2] = (uint8_t)(i % 2 ? key[i / 2] << 4 | digit : digit);
    }
    if (gate->keys.count == SIGNATURE_KEYS_MAX)
        return lines_fault(lines, fault->message, fault->size, "more than %d keys", SIGNATURE_KEYS_MAX);
    signature_add_key(&gate->keys, key, digits / 2);
    explicit_bzero(key, sizeof key);
    return true;
}

static bool is_preset_name(const char *name)
{
    static const char ALLOWED[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
    const size_t length = strlen(name);
    return length >= 1 && length <= GATE_PRESET_NAME_MAX && strspn(name, ALLOWED) == length;
}

static bool check_query(const struct gate *gate, const struct lines *lines, const char *query, struct fault *fault)
{
    struct zr_error error = {0};
    if (strlen(query) > PRESET_QUERY_MAX)
        return lines_fault(lines, fault->message, fault->size, "a query has at most %d bytes", PRESET_QUERY_MAX);
    for (const char *c = query; *c; c++)
        if (*c < PRINTABLE_FIRST || *c > PRINTABLE_LAST || *c == '#' || *c == '?')
            return lines_fault(lines, fault->message, fault->size,
                               "a query cannot have a space, '?' or '#'; write bytes beyond ASCII as %%XX");
    if (preset_check(query, &gate->limits, &error)) return true;
    const char *detail = error.items[0].detail, *known = strstr(detail, "; known: ");
    return lines_fault(lines, fault->message, fault->size, "%.*s", known ? (int)(known - detail) : (int)strlen(detail),
                       detail);
}

static bool add_preset(struct gate *gate, struct lines *lines, char *line, struct fault *fault)
{
    char *equals = strchr(line, '=');
    if (!equals) return lines_fault(lines, fault->message, fault->size, "this is not NAME = QUERY");
    char *query = equals + 1 + strspn(equals + 1, " \t");
    while (equals > line && strchr(" \t", equals[-1]))
        equals--;
    *equals = '\0';
    if (!is_preset_name(line))
        return lines_fault(lines, fault->message, fault->size,
                           "'%.80s' is no name of a preset: 1 to %d characters of A-Z, a-z, 0-9, _ and - are allowed",
                           line, GATE_PRESET_NAME_MAX);
    if (gate_preset(gate, line))
        return lines_fault(lines, fault->message, fault->size, "the preset '%s' is here twice", line);
    if (gate->preset_count == GATE_PRESETS_MAX)
        return lines_fault(lines, fault->message, fault->size, "more than %d presets", GATE_PRESETS_MAX);
    if (!check_query(gate, lines, query, fault)) return false;
    gate->presets[gate->preset_count++] = (struct preset){line, query};
    return true;
}

/* ---- files ---- */

typedef bool add_fn(struct gate *gate, struct lines *lines, char *line, struct fault *fault);

/* Reads a file, which must have at least one entry: an empty one would open the daemon to everybody. */
static bool read_entries(struct gate *gate, const char *path, add_fn *add, struct lines *lines, struct fault *fault)
{
    size_t count = 0;
    if (!lines_open(lines, path, fault->message, fault->size)) return false;
    for (char *line; (line = lines_next(lines)); count++)
        if (!add(gate, lines, line, fault)) return false;
    if (count > 0) return true;
    snprintf(fault->message, fault->size, "%s: the file has no entry", path);
    return false;
}

static bool read_secrets(struct gate *gate, const char *path, add_fn *add, struct fault *fault)
{
    struct lines lines = {0};
    if (!*path) return true;
    const bool is_read = read_entries(gate, path, add, &lines, fault);
    if (is_read && lines.is_public) warn(gate, " may be read by all users of this machine", path);
    lines_close(&lines);
    return is_read;
}

static bool read_all(struct gate *gate, const struct config *config, struct fault *fault)
{
    const size_t length = strlen(config->token);
    if (!is_token(config->token, length)) {
        snprintf(fault->message, fault->size, "--token: %s", wrong_token);
        return false;
    }
    if (length > 0) hash(gate->tokens[gate->token_count++], config->token, length);
    if (!read_secrets(gate, config->token_file, add_token, fault) ||
        !read_secrets(gate, config->keys_file, add_key, fault))
        return false;
    if (gate->keys.count > 0 && gate->token_count == 0)
        warn(gate, "there are keys and no token: clients without a signature may still POST and PUT", "");
    if (*config->presets) return read_entries(gate, config->presets, add_preset, &gate->preset_lines, fault);
    if (gate->has_only_presets) snprintf(fault->message, fault->size, "--only-presets=on needs --presets");
    return !gate->has_only_presets;
}

struct gate *gate_read(const struct config *config, char *message, size_t message_size)
{
    struct fault fault = {message, message_size};
    struct gate *gate = calloc(1, sizeof *gate);
    if (!gate) {
        snprintf(message, message_size, "out of memory");
        return NULL;
    }
    gate->limits = config_limits(config);
    gate->has_only_presets = strcmp(config->only_presets, "on") == 0;
    if (read_all(gate, config, &fault)) return gate;
    gate_free(gate);
    return NULL;
}

void gate_free(struct gate *gate)
{
    if (!gate) return;
    lines_close(&gate->preset_lines);
    explicit_bzero(gate, sizeof *gate);
    free(gate);
}

/* ---- questions ---- */

const char *gate_warning(const struct gate *gate)
{
    return gate->warning;
}

void gate_describe(const struct gate *gate, const struct gate *before, char *text, size_t size)
{
    const struct {
        const char *what;
        size_t now, before;
    } rows[] = {{"tokens", gate->token_count, before ? before->token_count : gate->token_count},
                {"keys", gate->keys.count, before ? before->keys.count : gate->keys.count},
                {"presets", gate->preset_count, before ? before->preset_count : gate->preset_count}};
    size_t used = 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0] && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%s: %zu", i ? ", " : "", rows[i].what, rows[i].now);
        if (rows[i].now != rows[i].before && used < size)
            used += (size_t)snprintf(text + used, size - used, " (before: %zu)", rows[i].before);
    }
}

bool gate_asks_for_token(const struct gate *gate)
{
    return gate->token_count > 0;
}

bool gate_knows_token(const struct gate *gate, const char *token, size_t length)
{
    uint8_t given[SIGNATURE_BYTES];
    unsigned fitting = 0;
    hash(given, token, length);
    for (size_t i = 0; i < gate->token_count; i++)
        fitting |= signature_same(given, gate->tokens[i]);
    return fitting;
}

const struct signature_keys *gate_keys(const struct gate *gate)
{
    return &gate->keys;
}

const char *gate_preset(const struct gate *gate, const char *name)
{
    for (size_t i = 0; i < gate->preset_count; i++)
        if (strcmp(gate->presets[i].name, name) == 0) return gate->presets[i].query;
    return NULL;
}

bool gate_has_only_presets(const struct gate *gate)
{
    return gate->has_only_presets;
}

void gate_list_presets(const struct gate *gate, char *text, size_t size)
{
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < gate->preset_count; i++) {
        const size_t length = strlen(gate->presets[i].name);
        if (used + length + 3 > size) return;
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", gate->presets[i].name);
    }
}
