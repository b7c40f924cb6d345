#include "zraster.h"

struct zr_limits zr_limits_default(void)
{
    return (struct zr_limits){
        .json_depth_max = 64,
        .window_side_max = 8192,
        .window_pixels_max = (uint64_t)32 * 1024 * 1024,
        .polygon_vertices_max = 1024,
        .instances_max = 100000,
        .image_pixels_max = (uint64_t)64 * 1024 * 1024,
        .coordinate_max = 1e6f,
    };
}
