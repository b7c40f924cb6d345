/* mcp.c - client: `zraster mcp`: an agent's tools on standard input and output, one message a line (server/mcp). A
 * thread answers messages in their order; this one reads on meanwhile, so that a call can be cancelled. */
#include "mcp/handler.h"

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "api/cancel.h"
#include "engine/engine.h"
#include "engine/interruption.h"
#include "files/say.h"
#include "mcp/faults.h"
#include "mcp/memory.h"
#include "mcp/message.h"
#include "mcp_files.h"
#include "mcp_told.h"

/* LINE_MAX_BYTES: of a message. WAITING_MAX: messages that were read and not answered. IDS_MAX: cancelled ids that are
 * remembered. SHORT: a notification that cancels has fewer bytes. */
enum { LINE_MAX_BYTES = 256 << 20, WAITING_MAX = 64, IDS_MAX = 64, ID_SIZE = 160, SHORT = 4096 };

struct line {
    struct line *next;
    struct bytes text;
};

struct serving {
    struct engine engine; /* with a cancel of its own for each message */
    const char *root;     /* real path */
    pthread_mutex_t lock;
    pthread_cond_t changed;
    struct line *first, **last;
    size_t waiting;
    bool is_over; /* no more lines */
    char ids[IDS_MAX][ID_SIZE];
    size_t id_count;
    char current[ID_SIZE]; /* id of the message that is answered; "": none yet */
    void **blocks;         /* memory of the message */
    size_t block_count;
};

/* ---- cancelling ---- */

/* Notes that an id is cancelled, and stops its request if it runs now. */
static void cancel(struct serving *serving, const char *id)
{
    pthread_mutex_lock(&serving->lock);
    snprintf(serving->ids[serving->id_count++ % IDS_MAX], ID_SIZE, "%s", id);
    if (strcmp(serving->current, id) == 0) zraster_cancel_raise(serving->engine.cancel);
    pthread_mutex_unlock(&serving->lock);
}

/* Takes the id of the request that runs now. It may be cancelled already. */
static void begin(void *context, struct mcp_span id)
{
    struct serving *serving = context;
    pthread_mutex_lock(&serving->lock);
    snprintf(serving->current, ID_SIZE, "%.*s", (int)(id.end - id.at < ID_SIZE ? id.end - id.at : ID_SIZE), id.at);
    for (size_t i = 0; i < IDS_MAX && i < serving->id_count; i++)
        if (strcmp(serving->ids[i], serving->current) == 0) zraster_cancel_raise(serving->engine.cancel);
    pthread_mutex_unlock(&serving->lock);
}

/* Looks for a notification that cancels a request, without waiting for its turn. */
static void look_for_cancel(struct serving *serving, const struct bytes *line)
{
    const struct mcp_span text = {line->data, line->data + line->size};
    const struct mcp_host host = {.context = serving};
    struct mcp_message message;
    const char *why;
    if (line->size > SHORT || !memmem(line->data, line->size, "notifications/cancelled", 23)) return;
    if (mcp_message_read(&message, text, &host, &why) == 0 && !message.id.at &&
        strcmp(message.method, "notifications/cancelled") == 0) {
        char *id = cJSON_PrintUnformatted(cJSON_GetObjectItemCaseSensitive(message.params, "requestId"));
        if (id) cancel(serving, id);
        cJSON_free(id);
    }
    mcp_message_free(&message);
}

/* ---- the host of the handler ---- */

static void *allocate(void *context, size_t size)
{
    struct serving *serving = context;
    void **blocks = realloc(serving->blocks, (serving->block_count + 1) * sizeof *blocks);
    if (!blocks) return NULL;
    serving->blocks = blocks;
    void *block = blocks[serving->block_count] = malloc(size ? size : 1);
    serving->block_count += block != NULL;
    return block;
}

static void free_blocks(struct serving *serving)
{
    while (serving->block_count > 0)
        free(serving->blocks[--serving->block_count]);
}

static enum mcp_draw_status draw_input(struct serving *serving, const struct input *input, struct mcp_drawn *drawn)
{
    zraster_picture *picture = NULL;
    zraster_error *error = NULL;
    struct zraster_bytes bytes;
    const zraster_status status = engine_draw_here(&serving->engine, input, NULL, &picture, &bytes, &error);
    if (status == ZRASTER_OK) {
        drawn->bytes = bytes.data;
        drawn->size = bytes.size;
        drawn->is_zip = strcmp(bytes.type, "application/zip") == 0;
        drawn->owner = picture;
        return MCP_DRAWN;
    }
    mcp_told_faults(error, &drawn->faults);
    zraster_error_free(error);
    zraster_picture_free(picture);
    return status == ZRASTER_CANCELLED ? MCP_CANCELLED : MCP_REFUSED;
}

static enum mcp_draw_status draw(void *context, const struct mcp_draw *draw, struct mcp_drawn *drawn)
{
    struct serving *serving = context;
    struct input *input = malloc(sizeof *input);
    enum mcp_draw_status status = MCP_REFUSED;
    if (input && mcp_files_read(input, serving->root, draw, &drawn->faults))
        status = draw_input(serving, input, drawn);
    else if (drawn->faults.count == 0)
        mcp_fault(&drawn->faults, "", "out of memory");
    if (input) mcp_files_free(input, draw);
    free(input);
    return status;
}

static void release(void *context, struct mcp_drawn *drawn)
{
    (void)context;
    zraster_picture_free(drawn->owner);
}

static enum mcp_draw_status compare(void *context, const struct mcp_compare *compare, struct mcp_told *told)
{
    const struct serving *serving = context;
    return mcp_told_compare(&serving->engine, serving->root, compare, told);
}

static enum mcp_draw_status drawing(void *context, const struct mcp_draw *draw, const char *query,
                                    struct mcp_told *told)
{
    const struct serving *serving = context;
    return mcp_told_drawing(&serving->engine, serving->root, draw, query, told);
}

static void release_told(void *context, struct mcp_told *told)
{
    (void)context;
    mcp_told_release(told);
}

/* ---- answering ---- */

static void answer(struct serving *serving, const struct bytes *line)
{
    const struct mcp_host host = {.context = serving,
                                  .version = zraster_version(),
                                  .reads_files = true,
                                  .begin = begin,
                                  .cancel = zr_cancel_flag(serving->engine.cancel),
                                  .allocate = allocate,
                                  .draw = draw,
                                  .release = release,
                                  .compare = compare,
                                  .drawing = drawing,
                                  .release_told = release_told};
    struct mcp_reply reply;
    if (mcp_handle(&host, (struct mcp_span){line->data, line->data + line->size}, NULL, &reply) == MCP_DRAWN &&
        reply.text.size > 0 && !mcp_host_is_cancelled(&host)) {
        mcp_text_put(&reply.text, "\n");
        fwrite(reply.text.data, 1, reply.text.size, stdout);
        fflush(stdout);
    }
    mcp_text_free(&reply.text);
    free_blocks(serving);
}

/* Answers the lines that wait, until there are no more. */
static void *work(void *context)
{
    struct serving *serving = context;
    for (;;) {
        pthread_mutex_lock(&serving->lock);
        while (!serving->first && !serving->is_over)
            pthread_cond_wait(&serving->changed, &serving->lock);
        struct line *line = serving->first;
        if (line && !(serving->first = line->next)) serving->last = &serving->first;
        serving->waiting -= line != NULL;
        serving->current[0] = '\0';
        zraster_cancel *before = serving->engine.cancel;
        serving->engine.cancel = zraster_cancel_new();
        interruption_raises(serving->engine.cancel);
        pthread_cond_broadcast(&serving->changed);
        pthread_mutex_unlock(&serving->lock);
        zraster_cancel_free(before);
        if (!line) return NULL;
        if (!interrupted() && !ferror(stdout)) answer(serving, &line->text);
        bytes_free(&line->text);
        free(line);
    }
}

/* ---- reading ---- */

/* Hands a line to the thread that answers. Takes over its bytes. */
static void hand_over(struct serving *serving, struct bytes *text)
{
    struct line *line = malloc(sizeof *line);
    look_for_cancel(serving, text);
    if (!line) {
        bytes_free(text);
        return;
    }
    *line = (struct line){NULL, *text};
    *text = (struct bytes){.data = NULL};
    pthread_mutex_lock(&serving->lock);
    while (serving->waiting == WAITING_MAX)
        pthread_cond_wait(&serving->changed, &serving->lock);
    *serving->last = line;
    serving->last = &line->next;
    serving->waiting++;
    pthread_cond_broadcast(&serving->changed);
    pthread_mutex_unlock(&serving->lock);
}

/* Adds bytes to a line. A line that is too long becomes "]", which is no message and is refused. */
static void add(struct bytes *line, const char *bytes, size_t size, bool *is_too_long)
{
    if (*is_too_long) return;
    if (size <= LINE_MAX_BYTES - line->size && bytes_add(line, bytes, size)) return;
    *is_too_long = true;
    bytes_free(line);
    *line = (struct bytes){.data = NULL};
    bytes_add(line, "]", 1);
}

static bool is_blank(const struct bytes *line)
{
    for (size_t i = 0; i < line->size; i++)
        if (!memchr(" \t\r", line->data[i], 3)) return false;
    return true;
}

static void read_lines(struct serving *serving)
{
    static char block[64 << 10];
    struct bytes line = {.data = NULL};
    bool is_too_long = false;
    ssize_t count;
    while (!interrupted() && (count = read(STDIN_FILENO, block, sizeof block)) > 0) {
        const char *at = block, *const end = block + count, *stop;
        while ((stop = memchr(at, '\n', (size_t)(end - at))) != NULL) {
            add(&line, at, (size_t)(stop - at), &is_too_long);
            if (!is_blank(&line)) hand_over(serving, &line);
            bytes_free(&line);
            line = (struct bytes){.data = NULL};
            is_too_long = false;
            at = stop + 1;
        }
        add(&line, at, (size_t)(end - at), &is_too_long);
    }
    if (!interrupted() && !is_blank(&line)) hand_over(serving, &line);
    bytes_free(&line);
}

static int serve(struct serving *serving)
{
    pthread_t thread;
    serving->last = &serving->first;
    mcp_memory_watch();
    pthread_mutex_init(&serving->lock, NULL);
    pthread_cond_init(&serving->changed, NULL);
    interruption_catch();
    if (pthread_create(&thread, NULL, work, serving) != 0) {
        fputs("zraster: no thread can be started\n", stderr);
        return STATUS_FAILED;
    }
    read_lines(serving);
    pthread_mutex_lock(&serving->lock);
    serving->is_over = true;
    pthread_cond_broadcast(&serving->changed);
    pthread_mutex_unlock(&serving->lock);
    pthread_join(thread, NULL);
    interruption_raises(NULL);
    zraster_cancel_free(serving->engine.cancel);
    free(serving->blocks);
    return interrupted() ? STATUS_INTERRUPTED : 0;
}

int command_mcp(struct options *options)
{
    const struct zraster_options wanted = {
        .struct_size = sizeof wanted, .memory_max = engine_memory(options, 1), .threads = options_threads(options)};
    struct serving *serving = calloc(1, sizeof *serving);
    char *root = NULL;
    int status = STATUS_FAILED;
    if (options->file_count) return free(serving), options_wrong("mcp accepts no file; --root DIR names their folder");
    if (!options->own[OPTION_ROOT])
        return free(serving), options_wrong("mcp needs --root DIR: the folder whose files an agent may read");
    root = realpath(options->own[OPTION_ROOT], NULL);
    DIR *folder = root ? opendir(root) : NULL;
    if (!folder)
        say("--root %s: %s", options->own[OPTION_ROOT], strerror(errno));
    else if (!serving || zraster_open(&wanted, &serving->engine.renderer) != ZRASTER_OK)
        fputs("zraster: out of memory\n", stderr);
    else {
        serving->root = root;
        status = serve(serving);
        zraster_close(serving->engine.renderer);
    }
    if (folder) closedir(folder);
    free(serving);
    free(root);
    return status;
}
