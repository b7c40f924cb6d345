/* What a difference leaves behind: pixels on the terminal, pictures and numbers in files. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "reference/page/report.h"
#include "support/pictures/png.h"

enum { PATH_SIZE = 600 };

static bool make_directories(const char *path)
{
    char part[PATH_SIZE];
    for (size_t i = 1; i < sizeof part; i++) {
        if (path[i - 1] == 0) return true;
        if (path[i] != '/' && path[i] != 0) continue;
        memcpy(part, path, i);
        part[i] = 0;
        if (mkdir(part, 0777) && errno != EEXIST) {
            fprintf(stderr, "%s: %s\n", part, strerror(errno));
            return false;
        }
    }
    return true;
}

static void print_pixels(const struct report_failure *failure)
{
    const struct compare_missed *missed = &failure->pictures->missed;
    uint32_t width = failure->scene->views[0].width;
    const struct picture *sides[2] = {&failure->pictures->want, &failure->pictures->got};
    for (size_t k = 0; k < missed->count && k < COMPARE_MISSED_MAX; k++) {
        size_t i = missed->pixels[k];
        printf("# %s-%" PRIu64 ": pixel (%zu, %zu) of %" PRIu32 "x%" PRIu32 " from the top left\n", failure->label,
               failure->number, i % width, i / width, width, failure->scene->views[0].height);
        for (int side = 0; side < 2; side++) {
            const uint8_t *c = sides[side]->rgba + i * 4;
            printf("#   %s face %6" PRIu32 "  depth %.9g (%a)  colour %d %d %d %d\n", side ? "got " : "want",
                   sides[side]->owner[i], (double)sides[side]->depth[i], (double)sides[side]->depth[i], c[0], c[1],
                   c[2], c[3]);
        }
    }
}

uint8_t *report_difference_picture(const struct harness_pictures *pictures)
{
    static const uint8_t coverage[4] = {255, 40, 40, 255}, depth[4] = {255, 255, 0, 255}, color[4] = {0, 255, 255, 255};
    const struct picture *want = &pictures->want, *got = &pictures->got;
    size_t pixels = (size_t)pictures->frame->width * pictures->frame->height;
    uint8_t *out = malloc(pixels * 4);
    for (size_t i = 0; out && i < pixels; i++) {
        const uint8_t *bright = want->owner[i] != got->owner[i]                   ? coverage
                                : compare_ulp(want->depth[i], got->depth[i]) != 0 ? depth
                                                                                  : color;
        if (!compare_pixel_equal(want, got, i)) {
            memcpy(out + i * 4, bright, 4);
            continue;
        }
        for (size_t k = 0; k < 3; k++)
            out[i * 4 + k] = (uint8_t)(want->rgba[i * 4 + k] / 6 + 10);
        out[i * 4 + 3] = 255;
    }
    return out;
}

void report_pictures(const char *directory, const char *label, uint64_t number, const struct harness_pictures *pictures)
{
    if (!make_directories(directory)) return;
    uint8_t *difference = report_difference_picture(pictures);
    const struct {
        const char *name;
        const uint8_t *rgba;
    } files[] = {{"got", pictures->got.rgba}, {"want", pictures->want.rgba}, {"diff", difference}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s-%" PRIu64 "-%s.png", directory, label, number, files[i].name);
        if (files[i].rgba) png_file_write(path, files[i].rgba, pictures->frame->width, pictures->frame->height);
    }
    free(difference);
}

static void write_matrix(FILE *file, const char *name, const zr_mat4 *matrix)
{
    fprintf(file, "%s, column by column\n", name);
    for (int i = 0; i < 16; i++)
        fprintf(file, "%a%c", (double)matrix->m[i], i % 4 == 3 ? '\n' : ' ');
}

static void write_faces(FILE *file, const struct zr_mesh *mesh, uint32_t first_owner)
{
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        fprintf(file, "face %" PRIu32 "\n", first_owner + face);
        for (uint32_t c = mesh->face_offsets[face]; c < mesh->face_offsets[face + 1]; c++) {
            const zr_vec4 *p = &mesh->positions[mesh->indices[c]];
            fprintf(file, "  position %a %a %a %a", (double)p->x, (double)p->y, (double)p->z, (double)p->w);
            if (mesh->colors) {
                const zr_vec4 *k = &mesh->colors[mesh->indices[c]];
                fprintf(file, "  colour %a %a %a", (double)k->x, (double)k->y, (double)k->z);
            }
            fputc('\n', file);
        }
    }
}

static void write_numbers(const struct report_failure *failure)
{
    const struct zr_scene *scene = failure->scene;
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s-%" PRIu64 ".txt", failure->directory, failure->label, failure->number);
    FILE *file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        return;
    }
    fprintf(file, "window %" PRIu32 " %" PRIu32 "\n", scene->views[0].width, scene->views[0].height);
    fprintf(file, "faces that differ when drawn alone:");
    for (uint32_t i = 0; i < failure->alone_count; i++)
        fprintf(file, " %" PRIu32, failure->alone[i]);
    fprintf(file, "%s\n", failure->alone_count ? "" : " none");
    write_matrix(file, "world to eye", &failure->camera->world_to_eye);
    write_matrix(file, "projection", &failure->camera->projection);
    uint32_t owner = 1;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        fprintf(file, "instance %" PRIu32 "\n", i);
        write_matrix(file, "object to world", &scene->instances[i].object_to_world);
        write_faces(file, mesh, owner);
        owner += (uint32_t)zr_mesh_ids(mesh);
    }
    fclose(file);
}

void report_difference(const struct report_failure *failure)
{
    print_pixels(failure);
    report_pictures(failure->directory, failure->label, failure->number, failure->pictures);
    write_numbers(failure);
    printf("# pictures: %s/%s-%" PRIu64 "-*.png\n", failure->directory, failure->label, failure->number);
    fflush(stdout);
}
