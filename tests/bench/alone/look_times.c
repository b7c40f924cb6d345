/* look_times ROUNDS MODELS MADE LIBRARY...: processor time of pictures of kept scenes, by one thread, in milliseconds:
 * the least of the rounds, in which libraries take turns. With several libraries, also the time of the first in times
 * of that of each other one. MODELS, MADE: folders of models. LIBRARY: libzraster.so.0 of a build. `make bench-looks`
 * runs it. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "api/zraster.h"

enum { LIBRARIES_MOST = 4, FOLDERS = 2 };

static const struct {
    const char *name, *model, *query;
} rows[] = {
    {"studio, bunny 512x512", "stanford-bunny.obj", "look=studio&width=512&height=512"},
    {"studio, bunny 1920x1080", "stanford-bunny.obj", "look=studio&width=1920&height=1080"},
    {"studio, gear 512x512", "parts/gear.obj", "look=studio&width=512&height=512"},
    {"studio, housing 512x512", "parts/housing.obj", "look=studio&width=512&height=512"},
    {"studio, beetle 512x512", "beetle.obj", "look=studio&width=512&height=512"},
    {"studio, suzanne 512x512", "suzanne.obj", "look=studio&width=512&height=512"},
    {"studio, spot 512x512", "spot.obj", "look=studio&width=512&height=512"},
    {"technical, bunny 512x512", "stanford-bunny.obj", "look=technical&width=512&height=512"},
    {"clay, bunny 512x512", "stanford-bunny.obj", "look=clay&width=512&height=512"},
    {"metal, bunny 512x512", "stanford-bunny.obj", "look=metal&width=512&height=512"},
    {"dark, bunny 512x512", "stanford-bunny.obj", "look=dark&width=512&height=512"},
    {"outdoor, bunny 512x512", "stanford-bunny.obj", "look=outdoor&width=512&height=512"},
    {"xray, housing 512x512", "parts/housing.obj", "look=xray&width=512&height=512"},
    {"studio, helmet 512x512", "helmet.glb", "look=studio&width=512&height=512"}, /* by python/helmet.py */
};
enum { ROWS = sizeof rows / sizeof *rows };

/* A library, its renderer with one thread, and the scene of the row. */
struct library {
    zraster *renderer;
    zraster_scene *scene;
    __typeof__(zraster_open) *open;
    __typeof__(zraster_scene_read) *read;
    __typeof__(zraster_scene_draw) *draw;
    __typeof__(zraster_scene_free) *free_scene;
    __typeof__(zraster_picture_free) *free_picture;
    double least;
};

static void *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (!found) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    return found;
}

static void load(const char *path, struct library *out)
{
    const struct zraster_options options = {.struct_size = sizeof options, .threads = 1, .memory_keep = SIZE_MAX};
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    *(void **)&out->open = symbol(library, "zraster_open");
    *(void **)&out->read = symbol(library, "zraster_scene_read");
    *(void **)&out->draw = symbol(library, "zraster_scene_draw");
    *(void **)&out->free_scene = symbol(library, "zraster_scene_free");
    *(void **)&out->free_picture = symbol(library, "zraster_picture_free");
    if (out->open(&options, &out->renderer) != ZRASTER_OK) exit(1);
}

static char *read_file(const char *folder, const char *name, size_t *size)
{
    static char body[64 << 20];
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    *size = fread(body, 1, sizeof body, file);
    fclose(file);
    return body;
}

static double used_ms(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

static void draw(struct library *library)
{
    zraster_picture *picture;
    zraster_error *error;
    const double begin = used_ms();
    if (library->draw(library->scene, NULL, &picture, &error) != ZRASTER_OK) exit(1);
    const double taken = used_ms() - begin;
    if (taken < library->least) library->least = taken;
    library->free_picture(picture);
}

static void measure(int row, int rounds, char **folders, struct library *libraries, int count)
{
    struct zraster_request request = {.struct_size = sizeof request, .query = rows[row].query};
    for (int i = 0; i < FOLDERS && !request.body; i++)
        request.body = read_file(folders[i], rows[row].model, &request.body_size);
    if (!request.body) {
        printf("%-28s left out: no %s\n", rows[row].name, rows[row].model);
        return;
    }
    for (int i = 0; i < count; i++) {
        zraster_error *error;
        libraries[i].least = 1e9;
        if (libraries[i].read(libraries[i].renderer, &request, &libraries[i].scene, &error) != ZRASTER_OK) exit(1);
    }
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < count; i++)
            draw(&libraries[i]);
    printf("%-28s", rows[row].name);
    for (int i = 0; i < count; i++)
        printf(" %8.1f", libraries[i].least);
    for (int i = 1; i < count; i++)
        printf(" %6.2f", libraries[0].least / libraries[i].least);
    printf("\n");
    fflush(stdout);
    for (int i = 0; i < count; i++)
        libraries[i].free_scene(libraries[i].scene);
}

int main(int argc, char **argv)
{
    static struct library libraries[LIBRARIES_MOST];
    const int count = argc - 2 - FOLDERS;
    if (count < 1 || count > LIBRARIES_MOST)
        return fprintf(stderr, "usage: look_times ROUNDS MODELS MADE LIBRARY...\n"), 2;
    for (int i = 0; i < count; i++)
        load(argv[2 + FOLDERS + i], &libraries[i]);
    for (int row = 0; row < ROWS; row++)
        measure(row, atoi(argv[1]), argv + 2, libraries, count);
    return 0;
}
