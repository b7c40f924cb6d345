#include "show.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "files/pixels.h"
#include "files/sixel.h"
#include "options/parameters.h"

enum protocol { NONE, KITTY, ITERM, SIXEL };
enum { ANSWER_MS = 300, CHUNK = 4096 };

/* ---- the terminal's protocol ---- */

static bool is_set(const char *variable, const char *word)
{
    const char *value = getenv(variable);
    return value && (!word || strstr(value, word));
}

/* Asks the terminal for its device attributes, of which 4 means sixels. */
static bool answers_sixel(void)
{
    struct termios before, raw;
    char answer[64];
    size_t used = 0;
    if (tcgetattr(STDOUT_FILENO, &before) != 0) return false;
    raw = before;
    raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    tcsetattr(STDOUT_FILENO, TCSANOW, &raw);
    struct pollfd wait = {.fd = STDOUT_FILENO, .events = POLLIN};
    if (write(STDOUT_FILENO, "\033[c", 3) == 3)
        while (used < sizeof answer - 1 && poll(&wait, 1, ANSWER_MS) == 1 &&
               read(STDOUT_FILENO, answer + used, 1) == 1 && answer[used++] != 'c') {
        }
    tcsetattr(STDOUT_FILENO, TCSANOW, &before);
    answer[used] = '\0';
    return strstr(answer, ";4;") || strstr(answer, ";4c");
}

static enum protocol find_protocol(void)
{
    static enum protocol found;
    if (found || !isatty(STDOUT_FILENO)) return found;
    if (is_set("KITTY_WINDOW_ID", NULL) || is_set("TERM", "kitty") || is_set("TERM_PROGRAM", "ghostty"))
        return found = KITTY;
    if (is_set("TERM_PROGRAM", "iTerm") || is_set("TERM_PROGRAM", "WezTerm") || is_set("LC_TERMINAL", "iTerm"))
        return found = ITERM;
    return found = answers_sixel() ? SIXEL : NONE;
}

/* Finds the terminal's protocol. Returns 0, or an exit status with lines in *faults. */
static int check_terminal(struct bytes *faults)
{
    if (!isatty(STDOUT_FILENO))
        bytes_print(faults, "--show needs a terminal, and standard output is not one; -o FILE saves the picture");
    else if (find_protocol() == NONE)
        bytes_print(faults,
                    "--show needs a terminal with the protocol of kitty, iTerm2 or sixels, and this one has none "
                    "of them; -o FILE saves the picture");
    else
        return STATUS_DONE;
    return STATUS_USAGE;
}

/* ---- writing ---- */

static char *base64(const unsigned char *bytes, size_t size, size_t *length)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc(size / 3 * 4 + 8), *at = text;
    for (size_t i = 0; text && i < size; i += 3) {
        const unsigned a = bytes[i], b = i + 1 < size ? bytes[i + 1] : 0, c = i + 2 < size ? bytes[i + 2] : 0;
        *at++ = digits[a >> 2];
        *at++ = digits[(a & 3) << 4 | b >> 4];
        *at++ = i + 1 < size ? digits[(b & 15) << 2 | c >> 6] : '=';
        *at++ = i + 2 < size ? digits[c & 63] : '=';
    }
    *length = text ? (size_t)(at - text) : 0;
    return text;
}

static void write_kitty(struct bytes *out, const char *text, size_t length)
{
    for (size_t at = 0; at < length; at += CHUNK) {
        const size_t some = length - at < CHUNK ? length - at : CHUNK;
        bytes_print(out, "\033_G%sm=%d;%.*s\033\\", at ? "" : "f=100,a=T,", at + some < length, (int)some, text + at);
    }
    bytes_print(out, "\n");
}

static bool show(const struct zraster_bytes *file, struct bytes *faults)
{
    struct bytes out = {.data = NULL};
    struct pixels pixels;
    size_t length;
    if (strcmp(file->type, "image/png") != 0) {
        bytes_print(
            faults,
            "--show draws pictures, and this output is not a picture; leave out --show, or choose --channel color");
        return false;
    }
    if (find_protocol() == SIXEL) {
        if (!pixels_read(&pixels, file->data, file->size, faults)) return false;
        sixel_write(&out, &pixels);
        bytes_print(&out, "\n");
        pixels_free(&pixels);
    } else {
        char *text = base64(file->data, file->size, &length);
        if (text && find_protocol() == KITTY)
            write_kitty(&out, text, length);
        else if (text)
            bytes_print(&out, "\033]1337;File=inline=1;size=%zu:%s\a\n", file->size, (text[length] = '\0', text));
        free(text);
    }
    const bool ok = fwrite(bytes_text(&out), 1, out.size, stdout) == out.size && fflush(stdout) == 0;
    bytes_free(&out);
    return ok;
}

void show_run(const struct engine *engine, struct job *job)
{
    struct answer answer;
    const bool is_saved = job->options->own[OPTION_OUTPUT] != NULL;
    job->status = check_terminal(&job->faults);
    if (job->status == STATUS_DONE && is_saved)
        job->status = output_check(&job->target, job->options->parameters[PARAMETER_encoding], &job->faults);
    if (job->status != STATUS_DONE) return;
    job_draw(engine, job, &answer);
    if (job->status == STATUS_DONE && !show(&answer.file, &job->faults)) job->status = STATUS_USAGE;
    if (job->status == STATUS_DONE && is_saved) job_save(job, &answer);
    answer_free(&answer);
}
