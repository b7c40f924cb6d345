#include "unknown.h"

#include <ctype.h>
#include <string.h>

#include "mcp/near.h"
#include "settings.h"

void unknown_hint(char hint[UNKNOWN_HINT_SIZE], enum unknown_form form, const char *name, size_t length)
{
    static const char *const QUESTIONS[] = {"help", "version", "health", "check-config", "print-config"};
    char word[SETTING_NAME_SIZE] = "", shown[SETTING_NAME_SIZE];
    const struct setting *s;
    struct near_word near = {.word = word};
    for (; length > 0 && *name == '-'; length--)
        name++;
    for (size_t i = 0; i < length && i < sizeof word - 1; i++)
        word[i] = name[i] == '_' ? '-' : (char)tolower((unsigned char)name[i]);
    for (size_t i = 0; (s = setting_at(i)); i++)
        near_offer(&near, s->flag);
    for (size_t i = 0; form == UNKNOWN_FLAG && i < sizeof QUESTIONS / sizeof *QUESTIONS; i++)
        near_offer(&near, QUESTIONS[i]);
    if (!near.best) {
        snprintf(hint, UNKNOWN_HINT_SIZE, "--help lists the known ones");
        return;
    }
    if (form == UNKNOWN_VARIABLE)
        setting_variable(shown, near.best);
    else
        snprintf(shown, sizeof shown, "%s%s", form == UNKNOWN_FLAG ? "--" : "", near.best);
    snprintf(hint, UNKNOWN_HINT_SIZE, "did you mean %s?", shown);
}

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* Kubernetes sets ZRASTER_PORT=tcp://ADDRESS:PORT. */
static bool is_link_value(const char *value)
{
    return begins(value, "tcp://") || begins(value, "udp://") || begins(value, "sctp://");
}

static bool ends(const char *name, const char *with)
{
    const size_t length = strlen(name), wanted = strlen(with);
    return length >= wanted && strcmp(name + length - wanted, with) == 0;
}

/* Returns true for 8080_TCP and 8080_TCP_ADDR. */
static bool is_link_port(const char *text)
{
    static const char *const ENDS[] = {"", "_PROTO", "_PORT", "_ADDR"};
    const size_t digits = strspn(text, "0123456789");
    text += digits;
    if (digits == 0 || !(begins(text, "_TCP") || begins(text, "_UDP") || begins(text, "_SCTP"))) return false;
    text += strcspn(text + 1, "_") + 1;
    for (size_t i = 0; i < sizeof ENDS / sizeof *ENDS; i++)
        if (strcmp(text, ENDS[i]) == 0) return true;
    return false;
}

bool unknown_is_others(const char *name, size_t length, const char *value)
{
    /* Of the command, the Python package, files of server/deploy, tests and the bench. */
    static const char *const OTHERS[] = {"ZRASTER_SERVER", "ZRASTER_LIBRARY",    "ZRASTER_FRONT", "ZRASTER_STATUS",
                                         "ZRASTER_SHARDS", "ZRASTER_1",          "ZRASTER_2",     "ZRASTER_DATA",
                                         "ZRASTER_BUILD",  "ZRASTER_BENCH_TURNS"};
    char text[256];
    if (length >= sizeof text) return false;
    memcpy(text, name, length);
    text[length] = '\0';
    for (size_t i = 0; i < sizeof OTHERS / sizeof *OTHERS; i++)
        if (strcmp(text, OTHERS[i]) == 0) return true;
    if (ends(text, "_SERVICE_HOST") || ends(text, "_SERVICE_PORT") || strstr(text, "_SERVICE_PORT_")) return true;
    if (ends(text, "_PORT") && is_link_value(value)) return true;
    for (const char *port = text; (port = strstr(port, "_PORT_")); port++)
        if (is_link_port(port + strlen("_PORT_"))) return true;
    return false;
}
