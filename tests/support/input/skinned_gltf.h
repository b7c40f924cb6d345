/* skinned_gltf.h - tests: text of a glTF file with a skin, morph targets and a camera. */
#ifndef ZR_TESTS_SKINNED_GLTF_H
#define ZR_TESTS_SKINNED_GLTF_H

#define SKINNED_GLTF                                                                                                   \
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":76,\"uri\":\"data:;bas"                             \
    "e64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAABAAIAAAACAAMA"                             \
    "/wAA//8AAP//AAD//wAA/w==\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"bu"                             \
    "ffer\":0,\"byteOffset\":48,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":60,\"byte"                             \
    "Length\":16}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\""                             \
    "type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCA"                             \
    "LAR\"},{\"bufferView\":2,\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"},{\"co"                             \
    "mponentType\":5121,\"count\":4,\"type\":\"VEC4\"}],\"meshes\":[{\"weights\":[0.5],\""                             \
    "primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0,\"JOINTS_0\":3,\"WEIGHTS_"                             \
    "0\":2},\"indices\":1,\"targets\":[{\"POSITION\":0,\"NORMAL\":0}]}]}],\"skins\":[{\"j"                             \
    "oints\":[1]}],\"nodes\":[{\"mesh\":0,\"skin\":0,\"weights\":[2]},{\"children\":[2],"                              \
    "\"scale\":[2,2,2]},{\"mesh\":0,\"camera\":0}],\"cameras\":[{\"perspective\":{\"yfov"                              \
    "\":0.5,\"znear\":1}}]}"

#endif
