#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "unknown.h"
#include "value.h"

enum { PLACE_SIZE = CONFIG_TEXT_SIZE + 16, QUOTED = 40 };

/* Reads at most FILE_BYTES_MAX bytes and a 0 after them. NULL: that is a fault. */
static char *read_whole(const char *path, size_t *size, struct faults *faults)
{
    struct stat info;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* no waiting for the other end of a pipe */
    FILE *in = fd >= 0 ? fdopen(fd, "r") : NULL;
    const bool is_regular = in && fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
    char *bytes = is_regular ? malloc(FILE_BYTES_MAX + 2) : NULL;
    if (bytes) *size = fread(bytes, 1, FILE_BYTES_MAX + 1, in);
    if (in && !is_regular) {
        faults_add(faults, "the file of settings '%.200s' is no regular file", path);
    } else if (!bytes || ferror(in)) {
        faults_add(faults, "cannot read the file of settings '%.200s': %s", path, strerror(errno));
    } else if (*size > FILE_BYTES_MAX) {
        faults_add(faults, "the file of settings '%.200s' has more than %d bytes", path, FILE_BYTES_MAX);
    } else {
        bytes[*size] = '\0';
        fclose(in);
        return bytes;
    }
    free(bytes);
    if (in) fclose(in);
    return NULL;
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t';
}

static char *skip_spaces(char *at)
{
    while (is_space(*at))
        at++;
    return at;
}

/* Ends a text before the spaces at its end. */
static void trim(char *begin, char *end)
{
    while (end > begin && is_space(end[-1]))
        end--;
    *end = '\0';
}

/* Reads a value in quotes where it stands. NULL: it has no end, or something but a comment follows. */
static char *unquote(char *value)
{
    char *in = value + 1, *out = value;
    for (; *in && *in != '"'; in++) {
        if (*in == '\\' && (in[1] == '"' || in[1] == '\\')) in++;
        *out++ = *in;
    }
    if (*in != '"') return NULL;
    char *rest = skip_spaces(in + 1);
    if (*rest != '\0' && !(*rest == '#' && rest > in + 1)) return NULL;
    *out = '\0';
    return value;
}

/* Reads a value after its =. */
static char *read_value(char *at)
{
    char *value = skip_spaces(at);
    if (*value == '"') return unquote(value);
    char *end = value;
    while (*end && !(*end == '#' && is_space(end[-1])))
        end++;
    trim(value, end);
    return value;
}

/* Reads a line that is none of comments. */
static void read_line(struct config *config, char *line, unsigned number, struct faults *faults)
{
    char place[PLACE_SIZE], hint[UNKNOWN_HINT_SIZE];
    char *equals = strchr(line, '=');
    snprintf(place, sizeof place, "%s:%u", config->config, number);
    if (!equals) {
        const int word = (int)strcspn(line, " \t"); /* the rest may be a secret */
        faults_add(faults, "%s: '%.*s' has no =; a line is KEY = VALUE", place, word < QUOTED ? word : QUOTED, line);
        return;
    }
    trim(line, equals);
    const struct setting *s = setting_find(line, strlen(line));
    if (!s) {
        unknown_hint(hint, UNKNOWN_KEY, line, strlen(line));
        faults_add(faults, "%s: '%.*s' is no setting; %s", place, QUOTED, line, hint);
        return;
    }
    const struct config_source *before = setting_source(config, s);
    const char *value = read_value(equals + 1);
    if (setting_is_file(s))
        faults_add(faults, "%s: %s: a file of settings cannot name another one", place, s->flag);
    else if (before->kind == CONFIG_FILE)
        faults_add(faults, "%s: %s: is set in line %u, too", place, s->flag, before->line);
    else if (!value)
        faults_add(faults, "%s: %s: the value in quotes does not end, or something follows it", place, s->flag);
    else
        value_set(config, s, (struct config_source){CONFIG_FILE, number}, value, faults);
}

void file_read(struct config *config, struct faults *faults)
{
    static const char MARK[] = "\xef\xbb\xbf";
    size_t size = 0;
    char *bytes = read_whole(config->config, &size, faults);
    if (!bytes) return;
    char *line = bytes, *end;
    if (strncmp(line, MARK, sizeof MARK - 1) == 0) line += sizeof MARK - 1;
    for (unsigned number = 1; line < bytes + size; number++, line = end + 1) {
        end = memchr(line, '\n', (size_t)(bytes + size - line));
        if (!end) end = bytes + size;
        *end = '\0';
        const bool has_zero = strlen(line) < (size_t)(end - line);
        if (end > line && end[-1] == '\r') end[-1] = '\0';
        char *begin = skip_spaces(line);
        if (has_zero)
            faults_add(faults, "%s:%u: the line has a zero byte", config->config, number);
        else if (*begin && *begin != '#')
            read_line(config, begin, number, faults);
    }
    free(bytes);
}

void file_print_text(const char *text, FILE *out)
{
    const size_t length = strlen(text);
    const bool is_plain = length == 0 || !(is_space(*text) || *text == '"' || *text == '#' ||
                                           is_space(text[length - 1]) || strstr(text, " #"));
    if (is_plain) {
        fputs(text, out);
        return;
    }
    putc('"', out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') putc('\\', out);
        putc(*text, out);
    }
    putc('"', out);
}
