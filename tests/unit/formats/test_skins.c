/* Skins of glTF: positions and normals of random matrices against doubles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/random.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

static struct random randomness = {{RANDOM_STATE_1}};

static float random_within(double low, double high)
{
    return (float)random_range(&randomness, low, high);
}

/* A triangle with two joints. */
struct skin {
    float matrices[2][16]; /* column by column */
    float positions[3][3], normals[3][3];
    float share; /* of the first joint */
};

/* Matrices shear, mirror, and scale by 0.05 to 20 along each axis. */
static void make_skin(struct skin *skin)
{
    for (int j = 0; j < 2; j++) {
        float *m = skin->matrices[j];
        memset(m, 0, sizeof skin->matrices[j]);
        for (int column = 0; column < 3; column++) {
            const double scale = pow(20.0, (double)random_within(-1, 1));
            for (int row = 0; row < 3; row++)
                m[4 * column + row] = (float)scale * random_within(-1, 1);
            m[12 + column] = random_within(-5, 5);
        }
        m[15] = 1.0f;
    }
    for (int k = 0; k < 9; k++) {
        skin->positions[k / 3][k % 3] = random_within(-1, 1);
        skin->normals[k / 3][k % 3] = random_within(0.1, 1) * (float)(random_next(&randomness) & 1 ? 1 : -1);
    }
    skin->share = random_within(0, 1);
}

static void write_nodes(FILE *out, const struct skin *skins, size_t count)
{
    fprintf(out, "\"nodes\":[{\"mesh\":0,\"skin\":0}");
    for (size_t i = 0; i < 2 * count; i++) {
        fprintf(out, ",{\"matrix\":[");
        for (int k = 0; k < 16; k++)
            fprintf(out, "%s%.9g", k ? "," : "", (double)skins[i / 2].matrices[i % 2][k]);
        fprintf(out, "]}");
    }
    fprintf(out, "],\"skins\":[{\"joints\":[");
    for (size_t i = 1; i <= 2 * count; i++)
        fprintf(out, "%s%zu", i > 1 ? "," : "", i);
    fprintf(out, "]}],");
}

enum { POSITIONS, NORMALS, JOINTS, WEIGHTS, LISTS };
static const size_t sizes[LISTS] = {12, 12, 8, 16}; /* of a vertex */

static void write_lists(FILE *out, size_t vertices)
{
    static const char *const types[LISTS] = {"5126,\"type\":\"VEC3\"", "5126,\"type\":\"VEC3\"",
                                             "5123,\"type\":\"VEC4\"", "5126,\"type\":\"VEC4\""};
    size_t offset = 0;
    fprintf(out, "\"bufferViews\":[");
    for (int i = 0; i < LISTS; i++) {
        fprintf(out, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", i ? "," : "", offset,
                sizes[i] * vertices);
        offset += sizes[i] * vertices;
    }
    fprintf(out, "],\"buffers\":[{\"byteLength\":%zu}],\"accessors\":[", offset);
    for (int i = 0; i < LISTS; i++)
        fprintf(out, "%s{\"bufferView\":%d,\"count\":%zu,\"componentType\":%s%s}", i ? "," : "", i, vertices, types[i],
                i == POSITIONS ? ",\"min\":[-1,-1,-1],\"max\":[1,1,1]" : "");
    fprintf(out, "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":2,"
                 "\"WEIGHTS_0\":3}}]}]}");
}

static void write_bytes(FILE *out, const struct skin *skins, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fwrite(skins[i].positions, sizeof skins[i].positions, 1, out);
    for (size_t i = 0; i < count; i++)
        fwrite(skins[i].normals, sizeof skins[i].normals, 1, out);
    for (size_t i = 0; i < 3 * count; i++)
        fwrite((const uint16_t[4]){(uint16_t)(i / 3 * 2), (uint16_t)(i / 3 * 2 + 1), 0, 0}, sizes[JOINTS], 1, out);
    for (size_t i = 0; i < 3 * count; i++)
        fwrite((const float[4]){skins[i / 3].share, 1.0f - skins[i / 3].share, 0, 0}, sizes[WEIGHTS], 1, out);
}

static char *write_glb(const struct skin *skins, size_t count, size_t *size)
{
    char *text, *file;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    fprintf(out, "{\"asset\":{\"version\":\"2.0\"},");
    write_nodes(out, skins, count);
    write_lists(out, 3 * count);
    fclose(out);
    const uint32_t padded = (uint32_t)(length + 3) / 4 * 4, binary = (uint32_t)(3 * count * (12 + 12 + 8 + 16));
    out = open_memstream(&file, size);
    fwrite((const uint32_t[]){0x46546C67, 2, 12 + 8 + padded + 8 + binary, padded, 0x4E4F534A}, 20, 1, out);
    fprintf(out, "%s%.*s", text, (int)(padded - length), "   ");
    fwrite((const uint32_t[]){binary, 0x004E4942}, 8, 1, out);
    write_bytes(out, skins, count);
    fclose(out);
    free(text);
    return file;
}

/* ---- the same in doubles ---- */

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Sets the sum of a skin's matrices, column by column. */
static void blend(const struct skin *skin, double m[4][3])
{
    const double share = (double)skin->share, rest = (double)(1.0f - skin->share);
    for (int k = 0; k < 12; k++)
        m[k / 3][k % 3] = (share * (double)skin->matrices[0][k / 3 * 4 + k % 3] +
                           rest * (double)skin->matrices[1][k / 3 * 4 + k % 3]) /
                          (share + rest);
}

/* Returns the error of a normal, in units of what rounding the matrix to floats may turn it by. */
static double error_of_normal(double m[4][3], const float given[3], zr_vec3 got)
{
    double turned[3] = {0, 0, 0}, off[3], cofactors[3][3], rounding = 0.0;
    for (int k = 0; k < 3; k++) {
        cross(m[(k + 1) % 3], m[(k + 2) % 3], cofactors[k]);
        rounding += length_of(m[(k + 1) % 3]) * length_of(m[(k + 2) % 3]);
        for (int i = 0; i < 3; i++)
            turned[i] += (double)given[k] * cofactors[k][i];
    }
    const double det = m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2],
                 length = length_of(turned), of_got[3] = {(double)got.x, (double)got.y, (double)got.z};
    for (int i = 0; i < 3; i++)
        off[i] = of_got[i] / length_of(of_got) - (det < 0.0 ? -turned[i] : turned[i]) / length;
    return length_of(off) / (0x1p-23 * rounding / length);
}

static double error_of_position(double m[4][3], const float given[3], zr_vec4 got)
{
    const double of_got[3] = {(double)got.x, (double)got.y, (double)got.z};
    double off[3], sizes_of[3] = {1, 1, 1};
    for (int i = 0; i < 3; i++) {
        off[i] = of_got[i] - m[3][i];
        for (int k = 0; k < 3; k++) {
            off[i] -= (double)given[k] * m[k][i];
            sizes_of[i] += fabs((double)given[k] * m[k][i]);
        }
        sizes_of[i] += fabs(m[3][i]);
    }
    return length_of(off) / (0x1p-23 * length_of(sizes_of));
}

/* SKINS: how many. */
TEST(random_skins_are_those_of_doubles)
{
    const char *wanted = getenv("SKINS");
    const size_t count = wanted ? (size_t)strtoul(wanted, NULL, 10) : 300;
    struct skin *skins = calloc(count, sizeof *skins);
    double worst[2] = {0, 0};
    size_t size;
    for (size_t i = 0; i < count; i++)
        make_skin(&skins[i]);
    char *file = write_glb(skins, count, &size);
    struct reading *reading = read_bytes(ZR_FORMAT_GLB, file, size);
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->position_count, 3 * count);
    for (size_t i = 0; i < 3 * count; i++) {
        const struct skin *skin = &skins[i / 3];
        double m[4][3];
        blend(skin, m);
        worst[0] = fmax(worst[0], error_of_position(m, skin->positions[i % 3], mesh->positions[i]));
        worst[1] = fmax(worst[1], error_of_normal(m, skin->normals[i % 3], mesh->normals[i]));
    }
    if (wanted) print_message("%zu skins: positions %.2f, normals %.2f roundings\n", count, worst[0], worst[1]);
    assert_true(worst[0] < 4.0 && worst[1] < 4.0);
    reading_free(reading);
    free(file);
    free(skins);
}

RUN_TESTS(NULL, NULL)
