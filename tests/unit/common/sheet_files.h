/* sheet_files.h - tests: a sheet of triangles in all formats of bare meshes, each but SMALL of more than 64 KiB, and
 * the files that some of them refer to.
 */
#ifndef ZR_TESTS_SHEET_FILES_H
#define ZR_TESTS_SHEET_FILES_H

#include <stdio.h>
#include <string.h>

#include "support/pictures/striped_images.h"

enum sheet_kind {
    NONE,
    STL,
    PLY,
    OBJ,
    OBJ_OF_MTL,
    OBJ_OF_TEXTURE,
    GLB,
    GLTF,
    GLTF_OF_BIN,
    MTL,
    OTHER_MTL,
    MTL_OF_MAP,
    BIN,
    BROKEN,
    ZEROS,
    SMALL,
    PNG,
    SHEET_KINDS
};

enum { SIDE = 50, POINTS = (SIDE + 1) * (SIDE + 1), FACES = 2 * SIDE * SIDE };

struct sheet_file {
    char *bytes;
    size_t size;
};

static float positions[POINTS][3];
static uint32_t faces[FACES][3];

static void make_sheet(void)
{
    for (int i = 0; i < POINTS; i++) {
        const float x = (float)(i % (SIDE + 1)) / SIDE, y = (float)(i / (SIDE + 1)) / SIDE;
        positions[i][0] = x;
        positions[i][1] = y;
        positions[i][2] = 0.3f * x * (1.0f - x) + 0.2f * y * y;
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE, c = a + SIDE + 1;
        const uint32_t two[2][3] = {{a, a + 1, c + 1}, {a, c + 1, c}};
        memcpy(faces[2 * (size_t)i], two, sizeof two);
    }
}

static void write_stl(FILE *out)
{
    const char zeros[80] = "";
    const uint32_t count = FACES;
    fwrite(zeros, sizeof zeros, 1, out);
    fwrite(&count, sizeof count, 1, out);
    for (int i = 0; i < FACES; i++) {
        fwrite(zeros, 12, 1, out);
        for (int k = 0; k < 3; k++)
            fwrite(positions[faces[i][k]], 12, 1, out);
        fwrite(zeros, 2, 1, out);
    }
}

static void write_ply(FILE *out)
{
    fprintf(out,
            "ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nelement face %d\nproperty list uchar uint vertex_indices\nend_header\n",
            POINTS, FACES);
    fwrite(positions, sizeof positions, 1, out);
    for (int i = 0; i < FACES; i++) {
        fputc(3, out);
        fwrite(faces[i], sizeof faces[i], 1, out);
    }
}

/* `library`: of the material, or NULL. */
static void write_obj(FILE *out, const char *library)
{
    if (library) fprintf(out, "mtllib %s\nusemtl paint\n", library);
    for (int i = 0; i < POINTS; i++)
        fprintf(out, "v %g %g %g\n", (double)positions[i][0], (double)positions[i][1], (double)positions[i][2]);
    for (int i = 0; i < POINTS; i++)
        fprintf(out, "vt %g %g\n", (double)positions[i][0], (double)positions[i][1]);
    for (int i = 0; i < FACES; i++)
        fprintf(out, "f %u/%u %u/%u %u/%u\n", faces[i][0] + 1, faces[i][0] + 1, faces[i][1] + 1, faces[i][1] + 1,
                faces[i][2] + 1, faces[i][2] + 1);
}

static void write_buffer(FILE *out)
{
    fwrite(positions, sizeof positions, 1, out);
    fwrite(faces, sizeof faces, 1, out);
}

/* `uri`: of the buffer, or NULL. `padding`: blanks that make the text long. */
static void write_gltf(FILE *out, const char *uri, int padding)
{
    fprintf(out,
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":\"sheet\"}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"accessors\":["
            "{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,1]},"
            "{\"bufferView\":1,\"componentType\":5125,\"count\":%d,\"type\":\"SCALAR\"}],\"bufferViews\":["
            "{\"buffer\":0,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],\"buffers\":["
            "{%s%s%s\"byteLength\":%zu}]}%*s",
            POINTS, 3 * FACES, sizeof positions, sizeof positions, sizeof faces, uri ? "\"uri\":\"" : "",
            uri ? uri : "", uri ? "\"," : "", sizeof positions + sizeof faces, padding, "");
}

static void write_glb(FILE *out)
{
    char text[2048];
    FILE *json = fmemopen(text, sizeof text, "w");
    write_gltf(json, NULL, 0);
    uint32_t size = (uint32_t)ftell(json);
    fclose(json);
    while (size % 4)
        text[size++] = ' ';
    const uint32_t buffer = sizeof positions + sizeof faces;
    fwrite((const uint32_t[]){0x46546C67, 2, 28 + size + buffer, size, 0x4E4F534A}, 20, 1, out);
    fwrite(text, size, 1, out);
    fwrite((const uint32_t[]){buffer, 0x004E4942}, 8, 1, out);
    write_buffer(out);
}

/* A node that the file does not have. */
static void write_broken(FILE *out)
{
    fprintf(out, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[7]}]}%*s", 1 << 17, "");
}

/* Triangles of zeros, more than the bytes of two such files. */
static void write_zeros(FILE *out)
{
    fprintf(out,
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":"
            "[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"componentType\":5126,\"count\":"
            "%d,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[0,0,0]}]}%*s",
            300000, 1 << 17, "");
}

static void write_sheet(enum sheet_kind kind, FILE *out)
{
    switch (kind) {
    case STL:
        write_stl(out);
        break;
    case PLY:
        write_ply(out);
        break;
    case OBJ:
        write_obj(out, NULL);
        break;
    case OBJ_OF_MTL:
        write_obj(out, "sheet.mtl");
        break;
    case OBJ_OF_TEXTURE:
        write_obj(out, "map.mtl");
        break;
    case GLB:
        write_glb(out);
        break;
    case GLTF:
        write_gltf(out, "data:application/octet-stream;base64,", 1 << 17);
        break; /* too short: refused */
    case GLTF_OF_BIN:
        write_gltf(out, "sheet.bin", 1 << 17);
        break;
    case MTL:
        fputs("newmtl paint\nKd 0.1 0.2 0.9\n", out);
        break;
    case OTHER_MTL:
        fputs("newmtl paint\nKd 0.9 0.2 0.1\n", out);
        break;
    case MTL_OF_MAP:
        fputs("newmtl paint\nKd 1 1 1\nmap_Kd stripes.png\n", out);
        break;
    case BIN:
        write_buffer(out);
        break;
    case BROKEN:
        write_broken(out);
        break;
    case ZEROS:
        write_zeros(out);
        break;
    default:
        fputs("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", out);
        break;
    }
}

/* Free the bytes. False without memory. */
static inline bool sheet_files_make(struct sheet_file files[SHEET_KINDS])
{
    uint8_t *png;
    make_sheet();
    for (int kind = NONE + 1; kind < PNG; kind++) {
        FILE *out = open_memstream(&files[kind].bytes, &files[kind].size);
        if (!out) return false;
        write_sheet((enum sheet_kind)kind, out);
        fclose(out);
    }
    if (!striped_files_make(1, &png, &files[PNG].size)) return false;
    files[PNG].bytes = (char *)png;
    return true;
}

#endif
