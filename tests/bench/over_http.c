#include "bench/over_http.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zip.h>

#include "bench/series.h"

/* ---- the request ---- */

static void print_vectors(FILE *out, const char *key, const zr_vec4 *v, uint32_t count)
{
    fprintf(out, "\"%s\":[", key);
    for (uint32_t i = 0; i < count; i++) {
        fprintf(out, "%s[%.9g,%.9g,%.9g,%.9g]", i ? "," : "", (double)v[i].x, (double)v[i].y, (double)v[i].z,
                (double)v[i].w);
    }
    fputs("],", out);
}

static void print_matrix(FILE *out, const char *key, const zr_mat4 *m)
{
    fprintf(out, "\"%s\":[", key);
    for (int i = 0; i < 16; i++)
        fprintf(out, "%s%.9g", i ? "," : "", (double)m->m[i]);
    fputs("]", out);
}

char *scene_json(const struct drawing *drawing)
{
    char *json = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&json, &size);
    if (!out) return NULL;
    fprintf(out, "{\"window\":{\"width\":%u,\"height\":%u},\"background\":\"#000000\",\"view\":{", drawing->width,
            drawing->height);
    print_matrix(out, "worldToCamera", &drawing->modelview);
    fputs(",", out);
    print_matrix(out, "projectionMatrix", &drawing->projection);
    fputs("},\"meshes\":[{\"shading\":\"unlit\",\"doubleSided\":true,", out);
    print_vectors(out, "positions", drawing->positions, drawing->position_count);
    print_vectors(out, "colors", drawing->colors, drawing->position_count);
    fputs("\"faces\":[", out);
    for (uint32_t f = 0; f < drawing->face_count; f++) {
        fputs(f ? ",[" : "[", out);
        for (uint32_t c = drawing->face_offsets[f]; c < drawing->face_offsets[f + 1]; c++)
            fprintf(out, "%s%u", c > drawing->face_offsets[f] ? "," : "", drawing->indices[c]);
        fputs("]", out);
    }
    fputs("]}],\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"windowDepth\"}]}", out);
    return fclose(out) == 0 ? json : NULL;
}

/* ---- the answer ---- */

/* A file of the archive; free it. */
static unsigned char *unpack(zip_t *archive, const char *name, size_t *size)
{
    zip_stat_t stat;
    if (zip_stat(archive, name, 0, &stat) != 0) return NULL;
    unsigned char *bytes = malloc(stat.size + 1);
    zip_file_t *file = bytes ? zip_fopen(archive, name, 0) : NULL;
    bool ok = file && zip_fread(file, bytes, stat.size) == (zip_int64_t)stat.size;
    if (file) zip_fclose(file);
    *size = stat.size;
    if (ok) return bytes;
    free(bytes);
    return NULL;
}

static uint8_t *decode_png(const unsigned char *bytes, size_t size, uint32_t width, uint32_t height)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_memory(&image, bytes, size)) return NULL;
    image.format = PNG_FORMAT_RGBA;
    uint8_t *pixels = image.width == width && image.height == height ? malloc(PNG_IMAGE_SIZE(image)) : NULL;
    if (pixels && png_image_finish_read(&image, NULL, pixels, 0, NULL)) return pixels;
    png_image_free(&image);
    free(pixels);
    return NULL;
}

static float *decode_npy(const unsigned char *bytes, size_t size, uint32_t width, uint32_t height)
{
    size_t data = (size_t)width * height * sizeof(float);
    if (size < 10 || memcmp(bytes, "\x93NUMPY\x01", 7) != 0) return NULL;
    size_t begin = 10u + bytes[8] + 256u * bytes[9];
    float *depth = size == begin + data ? malloc(data) : NULL;
    if (depth) memcpy(depth, bytes + begin, data);
    return depth;
}

static bool take_apart(const struct reply *reply, uint32_t width, uint32_t height, uint8_t **rgba, float **depth)
{
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *source = zip_source_buffer_create(reply->body, reply->size, 0, &error);
    zip_t *archive = source ? zip_open_from_source(source, ZIP_RDONLY, &error) : NULL;
    if (!archive) return false;
    size_t png_size = 0, npy_size = 0;
    unsigned char *png = unpack(archive, "color.png", &png_size), *npy = unpack(archive, "windowDepth.npy", &npy_size);
    zip_discard(archive);
    uint8_t *pixels = png ? decode_png(png, png_size, width, height) : NULL;
    float *depths = npy ? decode_npy(npy, npy_size, width, height) : NULL;
    free(png);
    free(npy);
    bool ok = pixels && depths;
    if (ok && rgba)
        *rgba = pixels;
    else
        free(pixels);
    if (ok && depth)
        *depth = depths;
    else
        free(depths);
    return ok;
}

/* NAME;dur=MS in a Server-Timing header. */
static double duration(const char *timing, const char *name)
{
    const char *at = strstr(timing, name);
    double ms = -1.0;
    if (at) sscanf(at + strlen(name), ";dur=%lf", &ms);
    return ms;
}

bool render_over_http(const struct daemon *daemon, const char *json, uint32_t width, uint32_t height, uint8_t **rgba,
                      float **depth, struct http_times *times)
{
    double begin = now_ms();
    struct reply reply = client_render(daemon, json);
    times->total = now_ms() - begin;
    bool ok = reply.status == 200;
    if (!ok) fprintf(stderr, "the daemon answered %ld: %s\n", reply.status, reply.body ? reply.body : "");
    const char *timing = ok ? reply_header(&reply, "Server-Timing") : "";
    times->parse = duration(timing, "parse");
    times->queue = duration(timing, "queue");
    times->render = duration(timing, "render");
    times->encode = duration(timing, "encode");
    if (ok && (rgba || depth) && !take_apart(&reply, width, height, rgba, depth)) {
        fprintf(stderr, "the daemon's answer is no archive of color.png and windowDepth.npy of this size\n");
        ok = false;
    }
    reply_free(&reply);
    return ok;
}
