#include "bench/input/documents.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How numbers are written, and what is between two items. */
struct spelling {
    int digits;
    const char *comma;
};
static const struct spelling compact = {7, ","};

static void print_spelt(FILE *out, const zr_vec4 *v, struct spelling spelling)
{
    /* So that few have fewer: the model's own are short. */
    const double more = spelling.digits > 7 ? 1.0 / 3e9 : 0.0;
    fprintf(out, "[%.*g%s%.*g%s%.*g]", spelling.digits, (double)v->x + more, spelling.comma, spelling.digits,
            (double)v->y + more, spelling.comma, spelling.digits, (double)v->z + more);
}

static void print_xyz(FILE *out, const zr_vec4 *v)
{
    print_spelt(out, v, compact);
}

static void print_matrix(FILE *out, const char *key, const zr_mat4 *m)
{
    fprintf(out, "\"%s\":[", key);
    for (int i = 0; i < 16; i++)
        fprintf(out, "%s%.9g", i ? "," : "", (double)m->m[i]);
    fputs("]", out);
}

static void print_head(FILE *out, const struct drawing *drawing)
{
    fprintf(out, "{\"window\":{\"width\":%u,\"height\":%u},\"background\":\"#000000\",\"shading\":\"unlit\",\"view\":{",
            drawing->width, drawing->height);
    print_matrix(out, "worldToCamera", &drawing->modelview);
    fputs(",", out);
    print_matrix(out, "projectionMatrix", &drawing->projection);
    fputs("},\"outputs\":[{\"channel\":\"color\"}],", out);
}

static struct document finish(FILE *out, struct document *document)
{
    if (fclose(out) == 0) return *document;
    free(document->bytes);
    return (struct document){NULL, 0};
}

static struct document make_indexed(const struct drawing *drawing, bool colors, struct spelling spelling)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    print_head(out, drawing);
    fputs("\"meshes\":[{\"doubleSided\":true,\"positions\":[", out);
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        if (i) fputs(spelling.comma, out);
        print_spelt(out, &drawing->positions[i], spelling);
    }
    for (uint32_t i = 0; colors && i < drawing->position_count; i++) {
        const zr_vec4 *c = &drawing->colors[i];
        fprintf(out, "%s[%.3f,%.3f,%.3f]", i ? "," : "],\"colors\":[", (double)c->x, (double)c->y, (double)c->z);
    }
    fputs("],\"faces\":[", out);
    for (uint32_t f = 0; f < drawing->face_count; f++) {
        fprintf(out, "%s[", f ? spelling.comma : "");
        for (uint32_t c = drawing->face_offsets[f]; c < drawing->face_offsets[f + 1]; c++)
            fprintf(out, "%s%u", c > drawing->face_offsets[f] ? spelling.comma : "", drawing->indices[c]);
        fputs("]", out);
    }
    fputs("]}]}", out);
    return finish(out, &document);
}

struct document document_indexed(const struct drawing *drawing, bool colors)
{
    return make_indexed(drawing, colors, compact);
}

struct document document_digits(const struct drawing *drawing)
{
    return make_indexed(drawing, false, (struct spelling){17, ","});
}

struct document document_spaced(const struct drawing *drawing)
{
    return make_indexed(drawing, false, (struct spelling){7, ", "});
}

struct document document_soup(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    print_head(out, drawing);
    fputs("\"polygons\":[", out);
    for (uint32_t f = 0; f < drawing->face_count; f++) {
        fputs(f ? ",{\"vertices\":[" : "{\"vertices\":[", out);
        for (uint32_t c = drawing->face_offsets[f]; c < drawing->face_offsets[f + 1]; c++) {
            if (c > drawing->face_offsets[f]) fputs(",", out);
            print_xyz(out, &drawing->positions[drawing->indices[c]]);
        }
        fputs("]}", out);
    }
    fputs("]}", out);
    return finish(out, &document);
}

struct document document_obj(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        const zr_vec4 *v = &drawing->positions[i];
        fprintf(out, "v %.7g %.7g %.7g\n", (double)v->x, (double)v->y, (double)v->z);
    }
    for (uint32_t f = 0; f < drawing->face_count; f++) {
        fputs("f", out);
        for (uint32_t c = drawing->face_offsets[f]; c < drawing->face_offsets[f + 1]; c++)
            fprintf(out, " %u", drawing->indices[c] + 1);
        fputs("\n", out);
    }
    return finish(out, &document);
}

static void put_u32(FILE *out, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        fputc((int)(value >> (8 * i) & 255), out);
}

static void put_f32(FILE *out, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_u32(out, bits);
}

struct document document_stl(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    fprintf(out, "%-80s", "binary");
    put_u32(out, drawing->face_count);
    for (uint32_t c = 0; c < drawing->corner_count; c++) {
        const zr_vec4 *v = &drawing->positions[drawing->indices[c]];
        for (int axis = 0; c % 3 == 0 && axis < 3; axis++)
            put_f32(out, 0.0f);
        put_f32(out, v->x);
        put_f32(out, v->y);
        put_f32(out, v->z);
        if (c % 3 == 2) fwrite("\0", 1, 2, out);
    }
    return finish(out, &document);
}

struct document document_ply(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    fprintf(out,
            "ply\nformat binary_little_endian 1.0\nelement vertex %u\nproperty float x\nproperty float y\n"
            "property float z\nelement face %u\nproperty list uchar int vertex_indices\nend_header\n",
            drawing->position_count, drawing->face_count);
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        put_f32(out, drawing->positions[i].x);
        put_f32(out, drawing->positions[i].y);
        put_f32(out, drawing->positions[i].z);
    }
    for (uint32_t c = 0; c < drawing->corner_count; c++) {
        if (c % 3 == 0) fputc(3, out);
        put_u32(out, drawing->indices[c]);
    }
    return finish(out, &document);
}

struct document document_glb(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    const uint32_t positions = 12 * drawing->position_count, indices = 4 * drawing->corner_count;
    char text[700];
    int size = snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%u}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":"
        "%u},{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}],\"accessors\":[{\"bufferView\":0,\"componentType\":"
        "5126,"
        "\"count\":%u,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"nodes\":[{\"mesh\":0}]}",
        positions + indices, positions, positions, indices, drawing->position_count, drawing->corner_count);
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    while (size % 4 != 0)
        text[size++] = ' ';
    fwrite("glTF\2\0\0\0", 1, 8, out);
    put_u32(out, 12 + 8 + (uint32_t)size + 8 + positions + indices);
    put_u32(out, (uint32_t)size);
    fwrite("JSON", 1, 4, out);
    fwrite(text, 1, (size_t)size, out);
    put_u32(out, positions + indices);
    fwrite("BIN\0", 1, 4, out);
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        put_f32(out, drawing->positions[i].x);
        put_f32(out, drawing->positions[i].y);
        put_f32(out, drawing->positions[i].z);
    }
    for (uint32_t c = 0; c < drawing->corner_count; c++)
        put_u32(out, drawing->indices[c]);
    return finish(out, &document);
}

struct document document_ply_text(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    fprintf(out,
            "ply\nformat ascii 1.0\nelement vertex %u\nproperty float x\nproperty float y\nproperty float z\n"
            "element face %u\nproperty list uchar int vertex_indices\nend_header\n",
            drawing->position_count, drawing->face_count);
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        const zr_vec4 *v = &drawing->positions[i];
        fprintf(out, "%.7g %.7g %.7g\n", (double)v->x, (double)v->y, (double)v->z);
    }
    for (uint32_t c = 0; c < drawing->corner_count; c++)
        fprintf(out, "%s%u%s", c % 3 ? " " : "3 ", drawing->indices[c], c % 3 == 2 ? "\n" : "");
    return finish(out, &document);
}

struct document document_stl_text(const struct drawing *drawing)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    fputs("solid mesh\n", out);
    for (uint32_t c = 0; c < drawing->corner_count; c++) {
        const zr_vec4 *v = &drawing->positions[drawing->indices[c]];
        if (c % 3 == 0) fputs("  facet normal 0.577350 0.577350 0.577350\n    outer loop\n", out);
        fprintf(out, "      vertex %.7g %.7g %.7g\n", (double)v->x, (double)v->y, (double)v->z);
        if (c % 3 == 2) fputs("    endloop\n  endfacet\n", out);
    }
    fputs("endsolid mesh\n", out);
    return finish(out, &document);
}
