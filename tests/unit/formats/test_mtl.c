/* Tests OBJ with its materials: values, textures, names and faults of MTL, and the parts that o and g name. */
#include "support/input/mtl_pictures.h"
#include "support/tests.h"
#include "unit/common/input_check.h"
#include "unit/common/kept_check.h"

#define FILE_OF(name_, text)                                                                                           \
    {                                                                                                                  \
        .name = (name_), .bytes = (text), .size = sizeof(text) - 1                                                     \
    }

#define V "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"

static struct reading *read_with(const char *obj, const char *mtl, const char *strict)
{
    const struct zr_asset assets[] = {{.name = "m.mtl", .bytes = mtl, .size = strlen(mtl)},
                                      FILE_OF("c.png", PICTURE_COLORS),
                                      FILE_OF("g.png", PICTURE_GREYS),
                                      FILE_OF("a b.png", PICTURE_ALPHAS),
                                      FILE_OF("broken.png", "PNG")};
    const struct zr_request request = {
        .format = ZR_FORMAT_OBJ, .channel = "color", .strict = strict, .assets = assets, .asset_count = 5};
    return read_request(request, obj, strlen(obj), zr_limits_default(), (size_t)1 << 28);
}

/* Reads a square with the material `a`, which has these lines. */
static struct reading *read_square(const char *lines, const char *strict)
{
    char mtl[1024];
    snprintf(mtl, sizeof mtl, "newmtl a\n%s\n", lines);
    return read_with("mtllib m.mtl\n" V "usemtl a\nf 1/1 2/2 3/3 4/4\n", mtl, strict);
}

static const struct zr_material *material_of(const struct reading *reading, uint32_t face)
{
    return zr_material_of_face(reading->scene, &reading->scene->meshes[0], face);
}

/* Returns the first warning that is not about unused assets, or "". */
static const char *warning_of(const struct reading *reading)
{
    for (uint32_t i = 0; i < reading->scene->warning_count; i++)
        if (strncmp(reading->scene->warnings[i], "the asset", 9) != 0) return reading->scene->warnings[i];
    return "";
}

static bool complains(const struct reading *reading, const char *detail)
{
    for (size_t i = 0; i < zr_error_held(&reading->error); i++)
        if (strstr(reading->error.items[i].detail, detail)) return true;
    return false;
}

#define IS_NEAR(a, b) ((a) > (b)-1e-6f && (a) < (b) + 1e-6f)

TEST(values_become_those_of_a_material)
{
    static const struct {
        const char *lines;
        float r, g, b, alpha, /* r below 0: the colour of the look */ metallic, roughness;
        const char *warning;
    } rows[] = {
        {"Kd 0.1 0.2 0.3", 0.1f, 0.2f, 0.3f, 1, 0, 0.55f, ""},
        {"kd 0.5", 0.5f, 0.5f, 0.5f, 1, 0, 0.55f, ""},
        {"  KD\t1 0 0 # red", 1, 0, 0, 1, 0, 0.55f, ""},
        {"Ns 250\nKs 1 1 1", -1, 1, 1, 1, 0, 0.75f, ""},
        {"Ns 500\nKs 0.05 0.05 0.05", -1, 1, 1, 1, 0, 0.475f, ""},
        {"Ns 5000\nKs 1 1 1", -1, 1, 1, 1, 0, 0, ""},
        {"Pr 0.3\nPm 0.7\nNs 10", -1, 1, 1, 1, 0.7f, 0.3f, ""},
        {"Kd 1 0 0\nd 0.25", 1, 0, 0, 0.25f, 0, 0.55f, ""},
        {"Tr 0.25\r\nKd 1 0 0\r", 1, 0, 0, 0.75f, 0, 0.55f, ""},
        {"Tr 0.75\nd 0.25", 1, 1, 1, 0.25f, 0, 0.55f, ""},
        {"Tr 1\nd 1", -1, 1, 1, 1, 0, 0.55f,
         "MTL: 1 material has a d and a Tr that disagree; d applies; it is line 3: 'd 1'"},
        {"Tr 1", -1, 1, 1, 1, 0, 0.55f,
         "MTL: 1 material would be invisible (d 0 or Tr 1), and is drawn opaque; it is line 2"},
        {"d -halo 0.5", 1, 1, 1, 0.5f, 0, 0.55f, "MTL: 1 option is not drawn; it is line 2: 'd -halo 0.5'"},
        {"Kd 2 0 -1", 1, 0, 0, 1, 0, 0.55f,
         "MTL: 1 value is outside of its range, and clamped; it is line 2: 'Kd 2 0 -1'"},
        {"Kd 1 0\nKd spectral a.rfl\nNs nan", -1, 1, 1, 1, 0, 0.55f,
         "MTL: 3 lines have no usable value, and are not read; the first is line 2: 'Kd 1 0'"},
        {"Ka 1 0 0\nNi 1.5\nillum 2\nTf 1 1 1\nPs 0\naniso 0\nmap_Ka x.png\n\n# x", -1, 1, 1, 1, 0, 0.55f, ""},
        {"Tf 1 0 0\nPc 1\ndisp x.png\nmap_Ks x.png", -1, 1, 1, 1, 0, 0.55f,
         "MTL: 4 properties are not drawn; the first is line 2: 'Tf 1 0 0'"},
        {"Km 3\nwhat", -1, 1, 1, 1, 0, 0.55f, "MTL: 2 lines are not known; the first is line 2: 'Km 3'"},
        {"map_Kd", -1, 1, 1, 1, 0, 0.55f, "MTL: 1 line has no usable value, and is not read; it is line 2"},
        {"map_Kd no such.png\nbump no.png", -1, 1, 1, 1, 0, 0.55f,
         "MTL: 2 textures are no parts of the request, and are not drawn; the first is line 2: 'map_Kd no such.png'"},
        {"map_Kd m.mtl", -1, 1, 1, 1, 0, 0.55f, "MTL: 1 texture cannot be read, and is not drawn; it is line 2"},
        {"Kd 0 0 0\nmap_Kd c.png", 1, 1, 1, 1, 0, 0.55f,
         "MTL: 1 Kd of 0 would hide its map_Kd, and is taken as 1; it is line 3: 'map_Kd c.png'"},
        {"Kd 0 0 0\nmap_Kd no.png", -1, 1, 1, 1, 0, 0.55f,
         "MTL: 1 material with a Kd of 0 lacks its map_Kd, and has the default colour; it is line 3: 'map_Kd no.png'"},
        {"Kd 0 0 0\nmap_Kd m.mtl\nd 0.5", 1, 1, 1, 0.5f, 0, 0.55f,
         "MTL: 1 material with a Kd of 0 lacks its map_Kd, and has the default colour; it is line 3: 'map_Kd m.mtl'"},
        {"Kd 0 0 0\nmap_d g.png", 0, 0, 0, 1, 0, 0.55f, ""},
        {"map_Kd a b.png", 1, 1, 1, 1, 0, 0.55f,
         "MTL: 1 map_Kd has an alpha below 1 and no map_d that uses it: it is drawn opaque"},
        {"map_bump g.png", -1, 1, 1, 1, 0, 0.55f, "MTL: 1 height map is not drawn; normal maps are; it is line 2"},
        {"map_Kd c.png\nmap_d -s 2 2 2 g.png", 1, 1, 1, 1, 0, 0.55f,
         "MTL: 1 map has other options than the map that it is combined with, and is not drawn; it is line 3"},
        {"map_Kd -imfchan r c.png", 1, 1, 1, 1, 0, 0.55f, "MTL: 1 option is not drawn; it is line 2"},
        {"Pr 0\nmap_Pr g.png", -1, 1, 1, 1, 0, 1, ""},
        {"newmtl a\nKd 0 1 0", 0, 1, 0, 1, 0, 0.55f,
         "MTL: 1 material is defined twice; the last definition applies; it is line 1: 'a'"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct reading *reading = read_square(rows[i].lines, NULL);
        assert_read(reading);
        const struct zr_material *got = material_of(reading, 0);
        const bool has_color = got->base_color.x == rows[i].r && got->base_color.y == rows[i].g &&
                               got->base_color.z == rows[i].b && got->base_color.w == rows[i].alpha;
        if (rows[i].r < 0.0f) assert_true(got->base_color.x > 0.1f);
        if (!has_color && rows[i].r >= 0.0f)
            fail_msg("row %zu: colour %g %g", i, (double)got->base_color.x, (double)got->base_color.w);
        if (!IS_NEAR(got->metallic, rows[i].metallic) || !IS_NEAR(got->roughness, rows[i].roughness))
            fail_msg("row %zu: metallic %g, roughness %g", i, (double)got->metallic, (double)got->roughness);
        const bool blends = rows[i].alpha < 1.0f || strstr(rows[i].lines, "map_d g");
        assert_int_equal(got->alpha_mode, blends ? ZR_ALPHA_BLEND : ZR_ALPHA_OPAQUE);
        assert_true(got->double_sided);
        const char *warning = warning_of(reading);
        if (strncmp(warning, rows[i].warning, strlen(rows[i].warning)) != 0 || (!*rows[i].warning && *warning))
            fail_msg("row %zu: '%s'", i, warning);
        reading_free(reading);
    }
}

TEST(emission_is_decoded)
{
    static const struct {
        const char *lines;
        float emitted;
    } rows[] = {{"Ke 0 0 0", 0}, {"Ke 1 1 1", 1}, {"Ke 4", 4}, {"map_Ke c.png", 1}, {"Ke 0.5 0 0", 0.2158605f}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct reading *reading = read_square(rows[i].lines, NULL);
        assert_read(reading);
        if (material_of(reading, 0)->emissive.x < rows[i].emitted - 1e-3f ||
            material_of(reading, 0)->emissive.x > rows[i].emitted + 1e-3f)
            fail_msg("row %zu: %g", i, (double)material_of(reading, 0)->emissive.x);
        reading_free(reading);
    }
}

/* ---- textures ---- */

/* Texels of c.png, and with the greys of g.png as alphas. */
#define OPAQUE_COLORS    255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 250, 250, 0, 255
#define COLORS_AND_GREYS 255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 128, 250, 250, 0, 64

TEST(maps_become_textures)
{
    static const struct {
        const char *lines;
        enum zr_texture_slot slot;
        unsigned char texels[16]; /* texels of the expected image */
        enum zr_alpha_mode mode;
    } rows[] = {
        {"map_Kd ./tex\\c.png", ZR_TEXTURE_BASE_COLOR, {OPAQUE_COLORS}, ZR_ALPHA_OPAQUE},
        {"map_Kd c.png\nmap_d g.png", ZR_TEXTURE_BASE_COLOR, {COLORS_AND_GREYS}, ZR_ALPHA_BLEND},
        {"map_Kd a b.png\nmap_d a b.png",
         ZR_TEXTURE_BASE_COLOR,
         {255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 128, 9, 9, 9, 64},
         ZR_ALPHA_BLEND},
        {"map_Kd c.png\nmap_d a b.png", ZR_TEXTURE_BASE_COLOR, {COLORS_AND_GREYS}, ZR_ALPHA_BLEND},
        {"map_d \"g.png\"",
         ZR_TEXTURE_BASE_COLOR,
         {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 128, 255, 255, 255, 64},
         ZR_ALPHA_BLEND},
        {"map_Pr g.png\nmap_Pm c.png",
         ZR_TEXTURE_METALLIC_ROUGHNESS,
         {255, 255, 255, 255, 255, 0, 0, 255, 255, 128, 0, 255, 255, 64, 250, 255},
         ZR_ALPHA_OPAQUE},
        {"norm c.png", ZR_TEXTURE_NORMAL, {OPAQUE_COLORS}, ZR_ALPHA_OPAQUE},
        {"map_Bump -bm 0.5 c.png", ZR_TEXTURE_NORMAL, {OPAQUE_COLORS}, ZR_ALPHA_OPAQUE},
        {"Ke 1 1 1\nmap_Ke c.png", ZR_TEXTURE_EMISSIVE, {OPAQUE_COLORS}, ZR_ALPHA_OPAQUE},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct reading *reading = read_square(rows[i].lines, NULL);
        assert_read(reading);
        const struct zr_material *material = material_of(reading, 0);
        assert_string_equal(warning_of(reading), "");
        assert_int_equal(material->alpha_mode, rows[i].mode);
        if (material->textures[rows[i].slot] == 0) fail_msg("row %zu: no texture", i);
        const struct zr_texture *texture = &reading->scene->textures[material->textures[rows[i].slot] - 1];
        const struct zr_image *image = &reading->scene->images[texture->image];
        assert_int_equal(image->width * image->height * image->bits, 32);
        if (memcmp(image->texels, rows[i].texels, sizeof rows[i].texels) != 0) fail_msg("row %zu: texels", i);
        if (strstr(rows[i].lines, "-bm")) assert_true(material->normal_scale == 0.5f);
        reading_free(reading);
    }
}

/* u and v of the square's four corners. v counts from the top of the image. */
TEST(options_place_the_image)
{
    static const struct {
        const char *lines;
        float first[2], third[2];
        enum zr_wrap wrap;
    } rows[] = {
        {"map_Kd c.png", {0, 1}, {1, 0}, ZR_WRAP_REPEAT},
        {"map_Kd -clamp on c.png", {0, 1}, {1, 0}, ZR_WRAP_CLAMP},
        {"map_Kd -s 2 4 1 -o 0.5 0.25 0 -blendu on -texres 512 -mm 0 1 c.png",
         {0.5f, 0.75f},
         {2.5f, -3.25f},
         ZR_WRAP_REPEAT},
        {"map_Kd -s 2 c.png", {0, 1}, {2, 0}, ZR_WRAP_REPEAT},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct reading *reading = read_square(rows[i].lines, NULL);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        const struct zr_texture *texture =
            &reading->scene->textures[material_of(reading, 0)->textures[ZR_TEXTURE_BASE_COLOR] - 1];
        float first[2], third[2];
        zr_texture_transform(texture, mesh->texcoords[mesh->indices[0]].x, mesh->texcoords[mesh->indices[0]].y, first);
        zr_texture_transform(texture, mesh->texcoords[mesh->indices[2]].x, mesh->texcoords[mesh->indices[2]].y, third);
        for (int k = 0; k < 2; k++)
            if (!IS_NEAR(first[k], rows[i].first[k]) || !IS_NEAR(third[k], rows[i].third[k]))
                fail_msg("row %zu: %g %g", i, (double)first[k], (double)third[k]);
        assert_int_equal(texture->wrap_s, rows[i].wrap);
        assert_int_equal(texture->wrap_t, rows[i].wrap);
        reading_free(reading);
    }
}

TEST(an_image_is_decoded_once)
{
    struct reading *reading =
        read_with("mtllib m.mtl\n" V "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\n",
                  "newmtl a\nmap_Kd c.png\nnewmtl b\nmap_Kd c.png\nmap_d g.png\nnewmtl c\nKd 1 0 0\nmap_Kd c.png\n"
                  "map_d g.png\n",
                  NULL);
    assert_read(reading);
    assert_int_equal(reading->scene->image_count, 3); /* c.png, g.png, and both in one */
    assert_int_equal(reading->scene->texture_count, 2);
    assert_int_equal(reading->scene->material_count, 4); /* one of them is for lines and points */
    reading_free(reading);
}

TEST(a_position_with_several_texture_coordinates_is_repeated)
{
    struct reading *reading = read_with("mtllib m.mtl\n" V "v 9 9 9 1 0 0\nusemtl a\nf 1/1 2/2 3/3\nf 1/4 3/3 4/1\n"
                                        "f 1/-1 4/1 5/9\nf 1 2 5\nl 1 2\nusemtl b\nf 1/2 2/3 3/4\n",
                                        "newmtl a\nmap_Kd c.png\nnewmtl b\nKd 1 0 0\n", NULL);
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t of[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 1, 4, 0, 1, 2};
    static const float u[] = {0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0}, v[] = {1, 1, 0, 0, 0, 1, 0, 1, 1, 1, 1, 1};
    assert_int_equal(mesh->position_count, 8); /* 1 thrice, 2 twice */
    assert_int_equal(mesh->face_count, 5);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const zr_vec4 p = mesh->positions[mesh->indices[i]], want = mesh->positions[of[i]];
        if (!zr_vec4_equal(p, want)) fail_msg("corner %zu", i);
        assert_true(mesh->colors[mesh->indices[i]].y == (of[i] == 4 ? 0.0f : 1.0f));
        if (i >= 12) continue;
        const zr_vec4 t = mesh->texcoords[mesh->indices[i]];
        if (t.x != u[i] || t.y != v[i]) fail_msg("corner %zu: %g %g", i, (double)t.x, (double)t.y);
    }
    assert_int_equal(mesh->indices[3], mesh->indices[6]);
    assert_int_equal(mesh->lines[0] * 10 + mesh->lines[1], 1);
    assert_string_equal(reading->scene->warnings[0], "OBJ: 1 corner names a texture coordinate that does not exist; it "
                                                     "is 0, 0; it is line 14: 'f 1/-1 4/1 5/9'");
    assert_string_equal(reading->scene->warnings[1],
                        "OBJ: 2 faces have a texture but no texture coordinates: they are 0, 0");
    reading_free(reading);
}

/* ---- names ---- */

TEST(materials_are_found_by_their_names)
{
    static const struct {
        const char *obj, *mtl;
        float red[2]; /* red of the two faces; -1: the look's */
        const char *warning;
    } rows[] = {
        {"mtllib m.mtl\nusemtl a b\n" V "f 1 2 3\nusemtl c\nf 1 3 4\n",
         "\xEF\xBB\xBFNewMtl a b \nKd .25 0 0\rnewmtl c\rKd .5 0 0",
         {0.25f, 0.5f},
         ""},
        {V "f 1 2 3\nusemtl a\nf 1 3 4\nmtllib no.mtl x\\m.mtl",
         "newmtl a\nKd .25 0 0",
         {-1, 0.25f},
         "OBJ: 1 material library (mtllib) is no part of the request; it is line 12: 'mtllib no.mtl"},
        {"mtllib m.mtl\nusemtl A\n" V "f 1 2 3\nusemtl\nf 1 3 4\n",
         "newmtl a\nKd .25 0 0",
         {-1, -1},
         "OBJ: 2 materials (usemtl) are in no material library; their faces have the look's; the first is line 2: "
         "'A'"},
        {"mtllib old.mtl\nusemtl a\n" V "f 1 2 3\nf 1 3 4\n",
         "newmtl a\nKd .25 0 0",
         {0.25f, 0.25f},
         "OBJ: 1 material library (mtllib) is no part of the request; it is line 1: 'mtllib old.mtl'"},
        {"mtllib m.mtl\n" V "f 1 2 3\nf 1 3 4\n", "", {-1, -1}, ""},
        {"mtllib m.mtl\nusemtl a\n" V "f 1 2 3\nf 1 3 4\n",
         "Kd 1 1 1\nnewmtl a\nKd .25 0 0",
         {0.25f, 0.25f},
         "MTL: 1 line is before the first newmtl, and is not read; it is line 1: 'Kd 1 1 1'"},
        {"mtllib m.mtl\nusemtl a\n" V "f 1 2 3\nf 1 3 4\n",
         "\xFF\xFEn\nnewmtl a\nKd .25 0 0",
         {0.25f, 0.25f},
         "MTL: 1 line is before the first newmtl, and is not read; it is line 1: '??n' (the file is UTF-16 text; UTF-8 "
         "is "
         "read)"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct reading *reading = read_with(rows[i].obj, rows[i].mtl, NULL),
                       *strict = read_with(rows[i].obj, rows[i].mtl, "1");
        assert_read(reading);
        for (uint32_t face = 0; face < 2; face++) {
            const struct zr_material *of = material_of(reading, face);
            if (rows[i].red[face] < 0.0f ? of->base_color.y == 0.0f : of->base_color.x != rows[i].red[face])
                fail_msg("row %zu: face %u has %g", i, face, (double)of->base_color.x);
        }
        if (strncmp(warning_of(reading), rows[i].warning, strlen(rows[i].warning)) != 0 ||
            (!*rows[i].warning && *warning_of(reading)))
            fail_msg("row %zu: '%s'", i, warning_of(reading));
        assert_int_equal(strict->status, ZR_BAD_SCENE); /* a warning of unused parts, if no other */
        assert_true(complains(strict, rows[i].warning));
        reading_free(reading);
        reading_free(strict);
    }
}

TEST(objects_and_groups_are_parts)
{
    static const struct {
        const char *text;
        const char *parts[4]; /* names */
        const char *faces;    /* the part of each */
    } rows[] = {
        {"f 1 2 3\n", {NULL}, ""},
        {"usemtl a\nf 1 2 3\n", {NULL}, ""},
        {"o\nf 1 2 3\n", {""}, "0"},
        {"o box \nf 1 2 3\nf 1 2 3\n", {"box"}, "00"},
        {"f 1 2 3\no a b\nf 1 2 3\no c\no d\nf 1 2 3\no a b\nf 1 2 3\n", {"", "a b", "d"}, "0121"},
        {"o a\ng x\nf 1 2 3\ng y z\nf 1 2 3\ng\nf 1 2 3\no b\nf 1 2 3\n", {"a/x", "a/y z", "a", "b"}, "0123"},
        {"g default\nf 1 2 3\ng x\nf 1 2 3\n", {"", "x"}, "01"},
        {"g x\nf 1 2 3\no x\nf 1 2 3\n", {"x", "x"}, "01"},
        {"o \xFF\nf 1 2 3\n", {"?"}, "0"},
        {"o a\nl 1 2\n", {NULL}, ""},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[1024];
        snprintf(text, sizeof text, V "%s", rows[i].text);
        struct reading *reading = read_text(ZR_FORMAT_OBJ, text);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        uint32_t count = 0;
        while (count < 4 && rows[i].parts[count])
            count++;
        if (mesh->part_count != count || !mesh->face_parts != !count)
            fail_msg("row %zu: %u parts", i, mesh->part_count);
        for (uint32_t k = 0; k < count; k++)
            assert_string_equal(mesh->part_names[k], rows[i].parts[k]);
        for (uint32_t k = 0; k < strlen(rows[i].faces); k++)
            if (mesh->face_parts[k] != (uint32_t)(rows[i].faces[k] - '0')) fail_msg("row %zu: face %u", i, k);
        reading_free(reading);
    }
}

TEST(textures_of_unused_materials_are_no_unused_parts)
{
    struct reading *reading = read_with("mtllib m.mtl\n" V "usemtl a\nf 1/1 2/2 3/3\n",
                                        "newmtl a\nmap_Kd c.png\nnewmtl b\nKd x\nmap_Kd g.png\nnorm -s 2 a b.png\n"
                                        "map_d broken.png\n",
                                        "1");
    assert_read(reading);
    assert_int_equal(reading->scene->image_count, 1);
    reading_free(reading);
}

TEST(a_kept_file_keeps_parts_and_materials)
{
    static const char obj[] = "mtllib m.mtl\n" V "o x\nusemtl a\nf 1/1 2/2 3/3\no y\nusemtl b\nf 1/1 2/2 3/3\n",
                      mtl[] = "newmtl a\nmap_Kd c.png\nnewmtl b\nKd 1 0 0\nd 0.5\n";
    const struct zr_asset assets[] = {FILE_OF("m.mtl", mtl), FILE_OF("c.png", PICTURE_COLORS)};
    const struct zr_request request = {.format = ZR_FORMAT_OBJ, .assets = assets, .asset_count = 2};
    struct keeping *keeping = keep(request, obj, sizeof obj - 1);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(keeping_change(keeping, (struct zr_request){.look = i ? "dark" : "studio"}), ZR_OK);
        const struct zr_scene *scene = keeping->scene;
        const struct zr_mesh *mesh = &scene->meshes[0];
        assert_int_equal(mesh->part_count, 2);
        assert_string_equal(mesh->part_names[1], "y");
        assert_int_equal(zr_material_of_face(scene, mesh, 0)->textures[ZR_TEXTURE_BASE_COLOR], 1);
        assert_true(zr_material_of_face(scene, mesh, 1)->base_color.w == 0.5f);
        assert_int_equal(zr_material_of_face(scene, mesh, 1)->alpha_mode, ZR_ALPHA_BLEND);
    }
    keeping_free(keeping);
}

/* ---- hostile files ---- */

TEST(many_materials_and_long_lines_take_bounded_memory_and_time)
{
    enum { COUNT = 200000, LINE = 1 << 20 };
    char *mtl = malloc((size_t)COUNT * 24 + LINE), *at = mtl;
    assert_non_null(mtl);
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "newmtl %d\nKd 1 0 0\n", i % 1000 ? i : 0);
    at += sprintf(at, "map_Kd ");
    memset(at, 'x', LINE - 100);
    at[LINE - 100] = '\0';
    struct reading *reading =
        read_with("mtllib m.mtl\n" V "usemtl 199998\nf 1/1 2/2 3/3\nusemtl 199999\nf 1/1 2/2 3/3\n", mtl, NULL);
    assert_read(reading);
    assert_true(material_of(reading, 1)->base_color.y == 0.0f);
    assert_true(reading->arena.peak < (size_t)64 << 20);
    reading_free(reading);
    free(mtl);
}

TEST(many_names_of_files_take_bounded_memory_and_time)
{
    enum { COUNT = 1 << 20 };
    char *obj = malloc(2 * (size_t)COUNT + 256), *at = obj;
    assert_non_null(obj);
    at += sprintf(at, V "f 1 2 3\nmtllib");
    for (int i = 0; i < COUNT; i++)
        at = mempcpy(at, " x", 2);
    *at = '\0';
    struct reading *reading = read_with(obj, "", NULL);
    assert_read(reading);
    assert_true(reading->arena.peak < (size_t)8 << 20);
    reading_free(reading);
    free(obj);
}

TEST(many_coordinates_of_one_position_take_bounded_time)
{
    enum { COUNT = 50000 };
    char *obj = malloc((size_t)COUNT * 48), *at = obj;
    assert_non_null(obj);
    at += sprintf(at, "mtllib m.mtl\nusemtl a\n" V);
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "vt %d 0\nf 1/%d 2/1 3/1\n", i % 9999, i + 5);
    struct reading *reading = read_with(obj, "newmtl a\nmap_Kd c.png\n", NULL);
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].position_count, COUNT + 3);
    reading_free(reading);
    free(obj);
}

RUN_TESTS(NULL, NULL)
