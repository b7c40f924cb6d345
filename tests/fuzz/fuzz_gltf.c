#include "fuzz/mesh.h"

FUZZ_MESH_AT(GLTF, size / 9 % 2 ? "0.5" : NULL)
