#include "fuzz/mesh.h"

FUZZ_MESH(OFF)
