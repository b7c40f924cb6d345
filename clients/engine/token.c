#include "token.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/say.h"

/* A token fits into a header line: printable ASCII, without spaces at its ends, which readers of headers cut off. */
static bool is_token(const char *text)
{
    const size_t length = strlen(text);
    if (length > 0 && (text[0] == ' ' || text[length - 1] == ' ')) return false;
    for (; *text; text++)
        if (*text < ' ' || *text > '~') return false;
    return true;
}

static bool read_file(struct token *token, const char *path)
{
    FILE *file = fopen(path, "r");
    const bool has_line = file && fgets(token->text, TOKEN_SIZE, file);
    const bool failed = !file || ferror(file);
    if (failed) say("cannot read the token file %s: %s", path, strerror(errno));
    if (file) fclose(file);
    if (failed) return false;
    const bool too_long = has_line && strlen(token->text) == TOKEN_SIZE - 1;
    token->text[strcspn(token->text, "\r\n")] = '\0';
    if (*token->text && !too_long && is_token(token->text)) return true;
    say("the first line of %s is no token: printable ASCII characters, without spaces at its ends", path);
    return false;
}

static bool read_variable(struct token *token)
{
    const char *value = getenv("ZRASTER_TOKEN");
    if (!value) return true;
    if (strlen(value) >= TOKEN_SIZE || !is_token(value)) {
        say("ZRASTER_TOKEN is no token: printable ASCII characters, without spaces at its ends");
        return false;
    }
    strcpy(token->text, value);
    return true;
}

bool token_read(struct token *token, const char *path)
{
    *token = (struct token){.from = path ? path : "ZRASTER_TOKEN"};
    return path ? read_file(token, path) : read_variable(token);
}
