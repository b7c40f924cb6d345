/* The seeds of model files: OBJ, MTL, STL, PLY, 3MF, OFF, PCD, XYZ, glTF and its compressed views. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/seeds.h"
#include "support/input/base64.h"
#include "support/input/skinned_gltf.h"
#include "support/input/zip_file.h"

/* ---- OBJ, MTL and STL ---- */

static void write_obj_and_stl(void)
{
    static const struct text objs[] = {
        {"triangle", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"normals", "# a quad\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0.5 0 0 1\nv 0 1 0 1 1 1\nvn 0 0 1\nvt 0 0\n"
                    "f 1/1/1 2/1/1 3//1 4/1/1\nf -4//-1 -3//-1 -2//-1\n"},
        {"groups", "o a\ng b c\ns 1\nusemtl red\nv 0 0 0\r\nv 1e-1 2.5E+0 -3\r\nv +1 .5 0 1.0\r\nf 1 \\\n2 3\r\n"},
        {"lenient",
         "$ x\rusemtl a\\\nv 2e6 0 0 255 0 1\nv 0 1e7 0 1 2 3\nv 0 0 1\nvn nan 0 1\nvt x\ns 3\nf 1// 2/1/ 3//9\n"
         "s off\nf 3//1 2//1 1/2\nl 1 2/1 -1\nl 9 1\np 1 2\np x\nvp 0 0\ncall b\n"},
        {"lines", "v 0 0 0\nv 1 1 0\nl 1 2\np 1 2\n"},
    };
    static const struct text stls[] = {
        {"ascii", "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                  "endfacet\nendsolid t\n"},
        {"shouted", "SOLID\tA B\r\n FACET NORMAL nan x 0\r\n  OUTER LOOP\r\n VERTEX 1e-1 -2.5E+0 3\r\n VERTEX 1 0 0\r\n"
                    " VERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID"},
        {"odd",
         "# a\nsolid\ncolor 1 0 0\nfacet\nouter loop x\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0 1\nvertex 0 1 0\n"
         "end loop\nend facet\nunits mm\nend solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
         "vertex 0 1 0\nendloop\nendfacet 1\nsolid\n"},
        {"returns", "solid t\rfacet normal 0 0 1\router loop\rvertex 0 0 0\rvertex 1 0 0\rvertex 0 1 0\rendloop\r"
                    "endfacet\rendsolid t\r"},
    };
    static const struct text mtls[] = {
        {"values", "newmtl a\nKa 1 1 1\nKd 0.8 0.1 0.1\nKs 0.5\nNs 250\nNi 1.5\nd 0.5\nillum 2\nKe 0 1 2\n"
                   "newmtl b c\nPr 0.5\nPm 1\nTr 0.25\nTf 1 0 0\nnewmtl\nKd 1 0 0\n"},
        {"maps",
         "\xEF\xBB\xBF# x\r\nNewMtl a\r\nmap_Kd -s 2 2 1 -o 0.5 0 0 -clamp on ./t\\p.png\r\nmap_d p.png\rnorm p.png\n"
         "newmtl b c\nKd 0 0 0\nmap_Kd p.png\nmap_d p.png\nmap_Pr p.png\nmap_Pm p.png\nmap_Ke p.png\n"
         "map_Bump -bm 2 -mm 0 1 p.png\nbump q r.png\n"},
        {"odd", "Kd 1 1 1\nnewmtl a\nKd 2 -1\nd -halo x\nmap_Kd\nmap_Kd -s 1 2\nwho\ndisp p.png\nnewmtl a\nTr 1\n"},
    };
    WRITE_TEXTS("obj", objs);
    WRITE_TEXTS("mtl", mtls);
    WRITE_TEXTS("stl", stls);
    static const float corners[2][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 2}};
    unsigned char binary[84 + 2 * 50] = "binary";
    binary[80] = 2;
    for (size_t i = 0; i < 2; i++)
        memcpy(binary + 84 + 50 * i, corners[i], sizeof corners[i]); /* the machine's order, as the file's is */
    write_seed("stl", "binary", binary, sizeof binary);
    memcpy(binary, "solid", 5);
    write_seed("stl", "binary-solid", binary, sizeof binary);
    binary[84 + 49] = 0xFC; /* red, in VisCAM */
    write_seed("stl", "binary-viscam", binary, sizeof binary);
    memcpy(binary, "COLOR=\xFF\xFF\0\xFF", 10);
    write_seed("stl", "binary-magics", binary, sizeof binary);
}

/* ---- PLY ---- */

/* Vertices of ASCII in a header of that form; binary values are the machine's, which are little-endian. */
static void write_plys(void)
{
#define XYZ "property float x\nproperty float y\nproperty float z\n"
    static const struct text texts[] = {
        {"colors", "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\n" XYZ
                   "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                   "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 255 0 0 255\n"
                   "1 0 0 0 255 0 128\n1 1 0 0 0 255 255\n0 1 0.5 9 9 9 0\n4 0 1 2 3\n3 0 1 2\n"},
        {"faces", "ply\r\nformat ascii 1.0\r\nobj_info a b\r\nelement face 1\r\nproperty float red\r\n"
                  "property float green\r\nproperty float blue\r\nproperty list int short vertex_index\r\n"
                  "element vertex 3\r\nproperty double nx\r\nproperty double ny\r\nproperty double nz\r\n"
                  "property list char float skipped\r\n" XYZ "property float s\nproperty float t\r\n"
                  "end_header\r\n0 0.5 1 3 0 1 2\r\n0 0 1 0 0 0 0 1 0\r\n0 0 1 2 5 5 1 0 0 0 1\r\n"
                  "0 0 0 1 9 0 1 0 1 1\r\n"},
        {"cloud", "ply\rformat ascii 1.0\relement vertex 2\rproperty short x\rproperty int y\rproperty char z\r"
                  "element other 1\rproperty list uchar int a\rend_header\r1 2 3\r4 5 6\r2 7 8\r"},
        {"strips", "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ "element tristrips 1\n"
                   "property list int int vertex_indices\nelement edge 1\nproperty int vertex1\n"
                   "property int vertex2\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 nan\n8 0 1 2 -1 0 1 2 0\n0 2\n"},
    };
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const unsigned char face[2][13] = {{3, 0, 0, 0, 0, 1, 0, 0, 0, 2}, {3, 2, 0, 0, 0, 1, 0, 0, 0, 0}};
    static const char header[] = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" XYZ
                                 "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    unsigned char binary[sizeof header + sizeof corners + sizeof face];
    size_t size = sizeof header - 1;
    memcpy(binary, header, size);
    memcpy(binary + size, corners, sizeof corners);
    memcpy(binary + size + sizeof corners, face, sizeof face);
    WRITE_TEXTS("ply", texts);
    write_seed("ply", "binary", binary, size + sizeof corners + sizeof face);
#undef XYZ
}

/* ---- 3MF ---- */

static void write_3mf(void)
{
#define MODEL "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
#define MESH                                                                                                           \
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" "               \
    "y=\"1\" z=\"-2e-1\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh>"
    static const struct text models[] = {
        {"triangle", MODEL "unit=\"inch\"><resources><object id=\"1\">" MESH
                           "</object></resources><build><item objectid=\"1\"/></build></model>"},
        {"components",
         MODEL "><resources><object id=\"1\" name=\"a&#x41;&lt;\">" MESH
               "</object><object id=\"2\"><components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 "
               "0 0 1 2 3 4\"/><component objectid=\"1\"/></components></object></resources><build>"
               "<!-- twice --><item objectid=\"2\" printable=\"0\"/><item objectid=\"2\"/></build></model>"},
        {"colours",
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" MODEL "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/"
         "material/2015/02\" requiredextensions=\"m\"><resources>"
         "<basematerials id=\"1\"><base name=\"r\" displaycolor=\"#F00000\"/></basematerials><m:colorgroup id=\"2\">"
         "<m:color color=\"#0000FF80\"/><m:color color=\"#FFFFFF\"/></m:colorgroup><object id=\"3\" pid=\"1\" "
         "pindex=\"0\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex "
         "x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" p1=\"0\" "
         "p2=\"1\" p3=\"0\"/><triangle v1=\"0\" v2=\"2\" "
         "v3=\"1\"/></triangles></mesh></object></resources><build><item "
         "objectid=\"3\"/></build></model>"},
        {"textures", MODEL
         "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"><resources>"
         "<basematerials id=\"1\"><base name=\"r\" displaycolor=\"#F00000\"/></basematerials><m:texture2d id=\"2\" "
         "path=\"/a.png\" tilestyleu=\"none\" filter=\"nearest\"/><m:texture2dgroup id=\"3\" texid=\"2\">"
         "<m:tex2coord u=\"0\" v=\"-1.5\"/></m:texture2dgroup><m:compositematerials id=\"4\" matid=\"1\" "
         "matindices=\"0 0\"><m:composite values=\"0.5 1\"/></m:compositematerials><m:multiproperties id=\"5\" "
         "pids=\"4 3\" blendmethods=\"multiply\"><m:multi pindices=\"0 0\"/></m:multiproperties><object id=\"6\" "
         "pid=\"5\">" MESH "</object></resources><build><item objectid=\"6\"/></build></model>"},
        {"paint",
         MODEL "><resources><object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" "
               "y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" "
               "v3=\"2\" paint_color=\"0C0481\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\"/><triangle v1=\"0\" v2=\"1\" "
               "v3=\"2\" paint_color=\"4482\"/></triangles></mesh></object></resources><build><item "
               "objectid=\"1\"/></build></model>"},
        {"far",
         MODEL "><resources><object id=\"1\"><mesh><vertices><vertex x=\"2e6\" y=\"0\" z=\"0\"/><vertex x=\"2e6\" "
               "y=\"1\" z=\"0\"/><vertex x=\"2e6\" y=\"1\" z=\"-2e-1\"/></vertices><triangles><triangle v1=\"0\" "
               "v2=\"1\" v3=\"2\"/></triangles></mesh></object></resources><build><item objectid=\"1\" "
               "transform=\"1 0 0 0 1 0 0 0 1 -3e6 0 0\"/></build></model>"}};
    WRITE_TEXTS("3mf", models);
    size_t size, directory;
    const struct zip_entry entries[] = {{"a", "aaaaaaaaaaaaaaaaaaaaaaaab", 25, true}, {"b/c", "stored", 6, false}};
    unsigned char *file = zip_file(entries, 2, &size, &directory);
    write_seed("zip", "two", file, size);
    free(file);
    const struct zip_entry part = {"3D/3dmodel.model", models[0].text, strlen(models[0].text), true};
    file = zip_3mf(&part, 1, &size);
    write_seed("zip", "3mf", file, size);
    free(file);
}

/* ---- glTF ---- */

/* Numbers of the file below: four corners, two triangles, normalized colours and coordinates, a PNG of one texel. */
static const struct {
    float corners[4][3];
    uint16_t square[6];
    uint8_t colors[4][4];
    int16_t uv[4][2];
    uint8_t one, pad[3];
    uint8_t png[70];
} gltf_numbers = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                  {0, 1, 2, 0, 2, 3},
                  {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {128, 128, 128, 51}},
                  {{0, 32767}, {32767, 0}, {0, 0}, {-32768, 0}},
                  1,
                  {0, 0, 0},
                  {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
                   0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
                   0x00, 0x1F, 0x15, 0xC4, 0x89, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x44, 0x41, 0x54, 0x78,
                   0xDA, 0x63, 0xF8, 0xDF, 0xE0, 0x70, 0x00, 0x00, 0x06, 0xC1, 0x02, 0x80, 0x10, 0xA8,
                   0x39, 0x61, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82}};

#define GLTF_ALL                                                                                                       \
    "\"asset\":{\"version\":\"2.0\"},\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,"                 \
    "\"byteOffset\":48,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":16,\"byteStride\":4},"        \
    "{\"buffer\":0,\"byteOffset\":76,\"byteLength\":16},{\"buffer\":0,\"byteOffset\":92,\"byteLength\":1},"            \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":70}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"     \
    "\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":4,\"componentType\":5121},"     \
    "\"values\":{\"bufferView\":0,\"byteOffset\":12}}},{\"bufferView\":1,\"componentType\":5123,\"count\":6,"          \
    "\"type\":\"SCALAR\"},{\"bufferView\":2,\"componentType\":5121,\"normalized\":true,\"count\":4,\"type\":"          \
    "\"VEC4\"},{\"bufferView\":3,\"componentType\":5122,\"normalized\":true,\"count\":4,\"type\":\"VEC2\"},"           \
    "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"SCALAR\"}],\"animations\":[{\"samplers\":[{"      \
    "\"input\":4,\"output\":0},{\"input\":4,\"output\":2}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,"       \
    "\"path\":\"translation\"}},{\"sampler\":1,\"target\":{\"node\":0,\"path\":\"rotation\"}}]}],"                     \
    "\"images\":[{\"bufferView\":5,\"mimeType\":\"image/png\"}],\"samplers\":[{\"magFilter\":9728,\"wrapS\":33648}],"  \
    "\"textures\":[{\"source\":0,\"sampler\":0}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"      \
    "{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0],\"rotation\":1}}}},\"normalTexture\":" \
    "{\"index\":0,\"scale\":2},\"alphaMode\":\"MASK\"},{\"extensions\":{\"KHR_materials_unlit\":{}},\"doubleSided\":"  \
    "true}],\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":2,\"TEXCOORD_0\""  \
    ":3},\"indices\":1,\"material\":0},{\"attributes\":{\"POSITION\":0},\"mode\":%d,\"material\":1}]}],\"nodes\":[{"   \
    "\"children\":[1],\"rotation\":[0,0.6,0,0.8]},{\"mesh\":0,\"scale\":[1,-1,1]}],\"scenes\":[{\"nodes\":[0]}],"      \
    "\"buffers\":[{\"byteLength\":166"

static void write_gltf(void)
{
    char text[4096], name[16];
    for (int mode = 0; mode <= 6; mode++) {
        char *uri = base64_of("data:;base64,", (const unsigned char *)&gltf_numbers, sizeof gltf_numbers);
        if (!uri) fail("a data: URI");
        snprintf(text, sizeof text, "{" GLTF_ALL ",\"uri\":\"%s\"}]}", mode, uri);
        free(uri);
        snprintf(name, sizeof name, "mode%d", mode);
        write_seed("gltf", name, text, strlen(text));
    }
    static const struct text posed[] = {
        {"posed", SKINNED_GLTF},
        {"moved", "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":108,\"uri\":\"data:;base64,AAAAAAA"
                  "AgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAJUkSPiVJkj63bds+JUkSP27bNj+3bVs/AACAPyVJkj9JkqQ/btu2P5I"
                  "kyT+3bds/27btPwAAAECSJAlAJUkSQLdtG0AAgP8A\"}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\""
                  "byteLength\":8},{\"buffer\":0,\"byteOffset\":8,\"byteLength\":24},{\"buffer\":0,\"byteOffset\":3"
                  "2,\"byteLength\":72},{\"buffer\":0,\"byteOffset\":104,\"byteLength\":4}],\"accessors\":[{\"buffe"
                  "rView\":0,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{\"bufferView\":1,\"componentT"
                  "ype\":5126,\"count\":2,\"type\":\"VEC3\"},{\"bufferView\":2,\"componentType\":5126,\"count\":6,"
                  "\"type\":\"VEC3\"},{\"bufferView\":3,\"componentType\":5121,\"count\":4,\"type\":\"SCALAR\",\"no"
                  "rmalized\":true},{\"bufferView\":2,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"}],\"mesh"
                  "es\":[{\"primitives\":[{\"attributes\":{\"POSITION\":4},\"targets\":[{\"POSITION\":2},{\"POSITIO"
                  "N\":4}]}]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"children\":[0]}],\"animations\":[{\"name\":\"a"
                  "\",\"samplers\":[{\"input\":0,\"output\":2,\"interpolation\":\"CUBICSPLINE\"},{\"input\":0,\"out"
                  "put\":3},{\"input\":0,\"output\":1,\"interpolation\":\"STEP\"}],\"channels\":[{\"sampler\":0,\"t"
                  "arget\":{\"node\":1,\"path\":\"translation\"}},{\"sampler\":1,\"target\":{\"node\":0,\"path\":\""
                  "weights\"}},{\"sampler\":2,\"target\":{\"node\":0,\"path\":\"scale\"}},{\"sampler\":2,\"target\""
                  ":{\"path\":\"pointer\"}}]}]}"},
        {"finished", "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,AAAAAAAA"
                     "AAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                     "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"buffer"
                     "View\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],\"materials\":[{\"extensions\":{"
                     "\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1,\"clearcoatRoughnessFactor\":0.2},\"KHR_mater"
                     "ials_sheen\":{\"sheenColorFactor\":[1,0.5,0],\"sheenRoughnessFactor\":0.3},\"KHR_materials_iride"
                     "scence\":{\"iridescenceFactor\":1,\"iridescenceIor\":1.4,\"iridescenceThicknessMaximum\":300},\""
                     "KHR_materials_anisotropy\":{\"anisotropyStrength\":0.5,\"anisotropyRotation\":1},\"KHR_materials"
                     "_transmission\":{\"transmissionFactor\":0.9},\"KHR_materials_volume\":{\"thicknessFactor\":0.5,"
                     "\"attenuationColor\":[1,0.5,0],\"attenuationDistance\":2},\"KHR_materials_dispersion\":{\"disper"
                     "sion\":3},\"KHR_materials_ior\":{\"ior\":1.4}}}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
                     "\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]}],\"nodes\":[{\"mesh\":0}]}"},
        {"lit", "{\"asset\":{\"version\":\"2.0\"},\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":"
                "\"spot\",\"range\":4,\"spot\":{\"innerConeAngle\":0.1,\"outerConeAngle\":0.5}},{\"type\":\"direc"
                "tional\",\"color\":[1,0.5,0],\"intensity\":3}]}},\"buffers\":[{\"byteLength\":36,\"uri\":\"data:"
                ";base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],\"bufferViews\":[{\"buffer\":0,\"by"
                "teLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"V"
                "EC3\"}],\"materials\":[{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor"
                "\":[0.5,0.5,0,1],\"specularFactor\":[0.2,0.2,0.3],\"glossinessFactor\":0.3},\"KHR_materials_ior"
                "\":{\"ior\":1.2},\"KHR_materials_specular\":{\"specularFactor\":0.5}}}],\"meshes\":[{\"primitive"
                "s\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"nodes\":[{\"mesh\":0},{\"translation"
                "\":[0,0,3],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},{\"rotation\":[0,0.6,0,0.8],"
                "\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}}]}"}};
    WRITE_TEXTS("gltf", posed);
    memset(text, ' ', sizeof text);
    const int length = snprintf(text + 20, sizeof text - 20, "{" GLTF_ALL "}]}", 4);
    text[20 + length] = ' ';
    const uint32_t json = (uint32_t)(length + 4) & ~3u, numbers = sizeof gltf_numbers, size = 28 + json + numbers;
    const uint32_t head[] = {0x46546C67, 2, size, json, 0x4E4F534A}, chunk[] = {numbers, 0x004E4942};
    memcpy(text, head, sizeof head);
    memcpy(text + 20 + json, chunk, sizeof chunk);
    memcpy(text + 28 + json, &gltf_numbers, numbers);
    write_seed("gltf", "binary", text, size);
}

/* ---- compressed views ---- */

/* The six bytes of a layout for fuzz_meshopt.c, then the compressed bytes. */
static void write_meshopt(void)
{
    static const unsigned char attributes[68 + 6] = {0,    0,    16,       0,         4,    0,    0xA0, 2,
                                                     0x17, 0x5F, 0xF0,     0xBC,      0x77, 0xA9, 0x21, 0,
                                                     0x34, 0xB5, 1,        0x80,      0,    0,    0xC0, 9,
                                                     3,    2,    [40] = 1, [70] = 10, 20,   30,   40},
                                               triangles[] = {1,    0,  15,   0, 4, 0, 0xE1, 0xF0, 0, 1, 0x0F,
                                                              0xFF, 10, 0x0F, 4, 1, 0, 0,    0,    0, 0, 0,
                                                              0,    0,  0,    0, 0, 0, 0,    0,    0, 0},
                                               indices[] = {2, 0, 5, 0, 2, 0, 0xD1, 4, 4, 0xA1, 6, 4, 3, 0, 0, 0, 0};
    static const char view[] =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":17,\"uri\":\"data:;base64,0QQEoQYEAwAAAAA"
        "AAAAAAAA=\"},{\"byteLength\":48}],\"bufferViews\":[{\"buffer\":1,\"byteLength\":6,\"extensions\":{"
        "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteLength\":9,\"byteStride\":2,\"count\":3,\"mode\":"
        "\"INDICES\"}}}],\"accessors\":[{\"bufferView\":0,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"},"
        "{\"componentType\":5126,\"count\":300,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
        "\"POSITION\":1},\"indices\":0}]}],\"nodes\":[{\"mesh\":0}]}";
    write_seed("meshopt", "attributes", attributes, sizeof attributes);
    write_seed("meshopt", "triangles", triangles, sizeof triangles);
    write_seed("meshopt", "indices", indices, sizeof indices);
    write_seed("gltf", "compressed", view, sizeof view - 1);
}

/* ---- OFF, PCD, XYZ ---- */

static void write_points(void)
{
    static const struct text offs[] = {
        {"colors",
         "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 0 0 255 255\n0 1 0 9 9 9 9\n3 0 1 2\n3 0 2 3\n"},
        {"faces", "OFF4 2\n# a\n0 0 0\n1 0 0\n1 1 nan\n0 1 0\n4 0 1 2 3 0.5 1 0\n3 0 1 3 7\n2 0 1\n"},
        {"normals", "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 0 0 0 0\n1 0 0 0 0 1 1 0 0 0 0\n0 1 0 0 0 1 1 0 0 1 1\n3 0 1 2\n"}};
    static const struct text pcds[] = {
        {"ascii",
         "# .PCD v0.7\nVERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n0 0 0 4.2108e+06\nnan 1 1 0\n"},
        {"fields",
         "FIELDS r g b x y z v\nSIZE 1 1 1 8 4 2 4\nTYPE U U U F F I U\nCOUNT 1 1 1 1 1 1 3\nPOINTS 1\nDATA binary\n"
         "abc01234567890123456789012345"}};
    static const struct text xyzs[] = {{"names", "//X,Y,Z,R,G,B\n0,0,0,255,0,0\n1;1;1;0;0;255\n"},
                                       {"counted", "2\n0 0 0 -7 1 2 3\n1 nan 0 -8 3 2 1\n"},
                                       {"normals", "0 0 0 0 0 1\n1 0 0 0 0 1\n1e7 0 0 0 1 0\n"}};
    static const char packed[] = "FIELDS x y z\nPOINTS 2\nDATA binary_compressed\n\7\0\0\0\x18\0\0\0\2\0\0\0\xE0\x0C\2";
    WRITE_TEXTS("off", offs);
    WRITE_TEXTS("pcd", pcds);
    WRITE_TEXTS("xyz", xyzs);
    write_seed("pcd", "compressed", packed, sizeof packed - 1);
}

void write_models(void)
{
    write_points();
    write_obj_and_stl();
    write_plys();
    write_3mf();
    write_gltf();
    write_meshopt();
}
