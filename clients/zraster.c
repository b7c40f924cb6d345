/* zraster.c - the command-line client: sends a file to the daemon and saves the picture.
 *
 * Exit status: 0: the picture is saved; 1: the server refused the request or cannot be reached, or a file cannot be
 * read or written; 2: the command line is wrong.
 */
#include <curl/curl.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bytes.h"
#include "options.h"
#include "output.h"
#include "post.h"
#include "report.h"
#include "scene/looks.h"
#include "token.h"
#include "version.h"

enum { HELP_COLUMN = 28 }; /* of --help: behind the longest option with its placeholder */

static void print_usage(void)
{
    fputs("usage: zraster render FILE [options]\n"
          "\n"
          "Sends a scene (.json) or a mesh (one of" OPTIONS_MESHES ") to zrasterd and saves the answer.\n"
          "FILE may be - for standard input; the answer then goes to standard output.\n"
          "\n"
          "  -o FILE                   output file; - is standard output\n"
          "                            (default: in this folder, FILE's name with the ending of the answer's format)\n",
          stdout);
    for (size_t i = 0; i < OPTIONS_PARAMETERS; i++) {
        const struct parameter *p = &options_parameters[i];
        char flag[OPTIONS_FLAG_SIZE];
        options_flag_of(p->name, strlen(p->name), flag);
        if (p->of_mesh && !options_parameters[i - 1].of_mesh) puts("\nFor meshes; a scene has keys of its own:\n");
        const int used = printf("  %s %s", flag, p->value);
        const bool is_look = strcmp(p->name, "look") == 0;
        printf("%*s%s%s\n", used < HELP_COLUMN ? HELP_COLUMN - used : 1, "", is_look ? zr_looks_join().text : "",
               p->help);
    }
    fputs("  --size WxH                width and height of the window, such as 800x600\n"
          "\n"
          "  --type TYPE               format of FILE, one of" OPTIONS_TYPES
          " (default: by its ending, else by its bytes)\n"
          "  --server ADDRESS          HOST:PORT or a URL (default: $ZRASTER_SERVER, else " DEFAULT_SERVER ")\n"
          "  --token-file FILE         file whose first line is the server's token (default: $ZRASTER_TOKEN)\n"
          "  --help, --version\n"
          "\n"
          "--name=value is the same as --name value. [BOOL] may be omitted and is true then. An argument behind -- is "
          "a file, even with a leading dash.\n",
          stdout);
}

static void report(const struct options *options, const struct token *token, const struct reply *reply)
{
    report_problem(stderr, options->file, reply->status, &reply->body);
    if (reply->status == 401 && *token->text)
        fprintf(stderr, "  The token of %s is not the server's.\n", token->from);
    else if (reply->status == 401)
        fprintf(stderr, "  --token-file FILE, or the variable ZRASTER_TOKEN, gives the token.\n");
    if (reply->retry_seconds > 0) fprintf(stderr, "  Try again in %ld s.\n", reply->retry_seconds);
}

static bool render(const struct options *options)
{
    struct token token;
    struct reply reply = {.status = 0};
    struct bytes body = {NULL, 0, 0};
    bool saved = false;
    if (!token_read(&token, options->token_file)) return false;
    if (options->out && output_is_input(options, options->out)) return false;
    if (!bytes_read(&body, options->file))
        fprintf(stderr, "zraster: cannot read %s: %s\n", options->file, strerror(errno));
    else if (post(options, &token, &body, &reply)) {
        if (reply.status == 200)
            saved = output_save(options, &reply.body, reply.type);
        else
            report(options, &token, &reply);
    }
    bytes_free(&body);
    bytes_free(&reply.body);
    return saved;
}

int main(int count, char **arguments)
{
    for (int i = 1; i < count && strcmp(arguments[i], "--") != 0; i++) {
        if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) {
            print_usage();
            return 0;
        }
        if (strcmp(arguments[i], "--version") == 0) {
            puts("zraster " ZR_VERSION);
            return 0;
        }
    }
    if (count < 2) return options_wrong("what shall it do? usage: zraster render FILE", "");
    if (strcmp(arguments[1], "render") != 0)
        return options_wrong("unknown command; there is one: render", arguments[1]);
    const char *server = getenv("ZRASTER_SERVER");
    struct options options = {.server = server && *server ? server : DEFAULT_SERVER};
    int wrong = options_read(count - 2, arguments + 2, &options);
    if (wrong) return wrong;
    curl_global_init(CURL_GLOBAL_DEFAULT);
    bool saved = render(&options);
    curl_global_cleanup();
    return saved ? 0 : 1;
}
