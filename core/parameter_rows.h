/* parameter_rows.h - core: what the query of a request may say, one row each: names for whoever sends and takes
 * queries. What they do is in input/parameters.c. They are read in this order: an encoding needs to know its channel,
 * and what is said goes over the look.
 */
#ifndef ZR_PARAMETER_ROWS_H
#define ZR_PARAMETER_ROWS_H

/* ROW(name, ANY: of all bodies, or MESH: of those that are a bare mesh, what stands for a value in help,
 *     what it is in words); in brackets: it is true or false, and a command line may leave it out for true */
#define ZR_PARAMETER_ROWS(ROW)                                                                                         \
    ROW(channel, ANY, "NAME", "one output instead of the scene's: color, depth, normals and others")                   \
    ROW(encoding, ANY, "NAME", "png, npy, png16 or json; each channel has a default")                                  \
    ROW(scale, ANY, "UNITS", "scene units a step of a 16-bit depth picture")                                           \
    ROW(x, ANY, "PIXELS", "of the pixel whose fragments are asked for; the leftmost has 0")                            \
    ROW(y, ANY, "PIXELS", "of that pixel; the uppermost has 0")                                                        \
    ROW(compress, ANY, "HOW", "fast (default) or small: PNGs of fewer bytes that take longer")                         \
    ROW(strict, ANY, "[BOOL]", "true: what would be warned of is refused; false (default)")                            \
    ROW(colorBar, ANY, "[BOOL]", "true: the colormap of a scene with its numbers over the picture; as the scene says") \
    ROW(look, MESH, "NAME", "studio (default), technical, clay, dark, metal, outdoor, blueprint, xray or textbook")    \
    ROW(samples, MESH, "COUNT", "for each pixel: 1, 4, 16 or 64; the look's")                                          \
    ROW(width, MESH, "PIXELS", "of the window; 640")                                                                   \
    ROW(height, MESH, "PIXELS", "of the window; 480")                                                                  \
    ROW(preset, MESH, "NAME", "front, back, left, right, top, bottom or isometric; the look's")                        \
    ROW(azimuth, MESH, "DEGREES", "seen from so far to the right of the front, instead of a preset")                   \
    ROW(elevation, MESH, "DEGREES", "and from so far above, -90 to 90")                                                \
    ROW(up, MESH, "AXIS", "y or z: the axis of the mesh that points up; z of STL, else y")                             \
    ROW(projection, MESH, "NAME", "orthographic or perspective; the look's")                                           \
    ROW(shading, MESH, "NAME", "unlit, flat, gouraud, phong, normals, pbr, gooch or xray; the look's")                 \
    ROW(color, MESH, "COLOR", "of the mesh, such as tomato or #ff6347")                                                \
    ROW(background, MESH, "COLOR", "the look's; transparent, too")                                                     \
    ROW(outline, MESH, "COLOR", "of the edges of faces; or true, or false (default)")                                  \
    ROW(fill, MESH, "[BOOL]", "true (default), or false: a wireframe")                                                 \
    ROW(doubleSided, MESH, "[BOOL]", "true (default), or false: faces that turn away are not drawn")

#endif
