/* parameter_rows.h - core: parameters of a query, one row each, for clients and the daemon.
 *
 * A parameter sets the key of a scene at its JSON Pointer, and the reader of that key reads the value. Rows of one
 * object are adjacent. Pointers under /query are keys that only queries have (input/query/parameters.c).
 */
#ifndef ZR_PARAMETER_ROWS_H
#define ZR_PARAMETER_ROWS_H

/* ROW(name, pointer, ANY: for all bodies, or MESH: for meshes without a scene, kind, help). Files that
 * expand help include scene/encodings.h and scene/shadings.h. The help of `look` is printed after the names of the
 * looks. */
#define ZR_PARAMETER_ROWS(ROW)                                                                                         \
    ROW(channel, "/outputs/0/channel", ANY, NAME,                                                                      \
        "outputs instead of the scene's, with commas between them: color, depth, normals or others")                   \
    ROW(encoding, "/outputs/0/encoding", ANY, NAME,                                                                    \
        "format of the output: " ZR_ENCODING_LIST "as the channel allows (default: by channel)")                       \
    ROW(scale, "/outputs/0/scale", ANY, UNITS, "scene units per step of a 16-bit depth picture")                       \
    ROW(quality, "/outputs/0/quality", ANY, WHOLE, "quality of a jpeg or webp, 1 to 100 (default: 85)")                \
    ROW(lossless, "/outputs/0/lossless", ANY, BOOL, "exact colours in a webp (default: false)")                        \
    ROW(maxBytes, "/outputs/0/maxBytes", ANY, WHOLE,                                                                   \
        "most bytes of the picture: a jpeg or webp gets the best quality that fits")                                   \
    ROW(dpi, "/outputs/0/dpi", ANY, NUMBER,                                                                            \
        "pixels per inch that a png or jpeg names, for the size of prints (default: none)")                            \
    ROW(x, "/outputs/0/x", ANY, PIXEL, "column of the pixel for the channel fragments, from 0 at the left")            \
    ROW(y, "/outputs/0/y", ANY, PIXEL, "row of that pixel, from 0 at the top")                                         \
    ROW(compress, "/query/compress", ANY, NAME, "compression of PNGs: fast or small (default: fast)")                  \
    ROW(strict, "/query/strict", ANY, BOOL, "errors instead of warnings (default: false)")                             \
    ROW(member, "/query/member", ANY, NAME, "file to draw of a ZIP archive with several models")                       \
    ROW(colorBar, "/colorBar", ANY, BOOL, "colour bar with numbers over the picture (default: the scene's)")           \
    ROW(annotate, "/annotate", ANY, WORDS,                                                                             \
        "marks over the picture, with commas between them: box (dimensions), title, triad, scale, labels (of parts), " \
        "holes")                                                                                                       \
    ROW(title, "/title", ANY, NAME, "text of the title line (default: the name of the model)")                         \
    ROW(render, "/render", ANY, BOOL,                                                                                  \
        "pictures; false: only facts, by the channel info; nothing is drawn (default: true)")                          \
    ROW(visibility, "/visibility", ANY, BOOL,                                                                          \
        "pixels of each instance, drawn alone and visible, by the channels info and masks (default: false)")           \
    ROW(features, "/features", ANY, BOOL,                                                                              \
        "holes, bosses, fillets and planes of each part, by the channel info (default: false)")                        \
    ROW(picks, "/picks", ANY, PIXEL_LIST,                                                                              \
        "pixels that the channel info describes, with blanks between them: part, face, point, normal, distances")     \
    ROW(views, "/views", ANY, PRESETS, "several views: names of presets with commas between them")                     \
    ROW(turntable, "/turntable/frames", ANY, WHOLE, "several views: their number, from around the scene")              \
    ROW(turntableElevation, "/turntable/elevation", ANY, DEGREES,                                                      \
        "angle of the camera above the horizon (default: the look's)")                                                 \
    ROW(turntableSeconds, "/turntable/seconds", ANY, SECONDS, "time of one turn in an animation (default: 4)")         \
    ROW(orbit, "/orbit/count", ANY, WHOLE, "several views: their number, from all directions")                         \
    ROW(orbitDistance, "/orbit/distance", ANY, UNITS, "distance from the cameras to the middle (default: fitted)")     \
    ROW(sheet, "/sheet/layout", ANY, NAME,                                                                             \
        "one picture of several views: threeView, balanced, or views with the parameter views")                        \
    ROW(sheetColumns, "/sheet/columns", ANY, WHOLE, "views in a row of the sheet")                                     \
    ROW(width, "/window/width", ANY, SIDE, "width of the window (default: the scene's, of models 640)")                \
    ROW(height, "/window/height", ANY, SIDE, "height of the window (default: the scene's, of models 480)")             \
    ROW(look, "/look", MESH, NAME, "; NAME@VERSION pins a version (default: studio)")                                  \
    ROW(samples, "/samples", MESH, COUNT, "samples per pixel: 1, 4, 16 or 64 (default: the look's)")                   \
    ROW(preset, "/view/preset", MESH, NAME,                                                                            \
        "side of the camera: front, back, left, right, top, bottom or isometric (default: the look's view)")           \
    ROW(azimuth, "/view/azimuthDegrees", MESH, DEGREES, "angle of the camera to the right of the front")               \
    ROW(elevation, "/view/elevationDegrees", MESH, DEGREES, "angle of the camera above the horizon, -90 to 90")        \
    ROW(eye, "/view/eye", MESH, VECTOR, "position of the camera, in coordinates of the file")                          \
    ROW(target, "/view/target", MESH, VECTOR,                                                                          \
        "point that the camera looks at, in coordinates of the file (default: the middle)")                            \
    ROW(padding, "/view/fit/padding", MESH, NUMBER, "share of the window left free on each side, 0 to 0.45")           \
    ROW(up, "/query/up", MESH, AXIS,                                                                                   \
        "axis of the mesh that points up: x, -x, y, -y, z, -z or auto (default: z for STL and 3MF, else y)")           \
    ROW(camera, "/query/camera", MESH, NAME,                                                                           \
        "camera of a glTF file, by its name or number, instead of the look's view")                                    \
    ROW(animation, "/query/animation", MESH, NAME,                                                                     \
        "animation of a glTF file, by its name or number (default: the file's pose, without time)")                    \
    ROW(time, "/query/time", MESH, SECONDS, "time of the animation (default: 0)")                                      \
    ROW(frames, "/query/frames", MESH, WHOLE, "several views: their number, of the animation from this time on")       \
    ROW(timeEnd, "/query/timeEnd", MESH, SECONDS, "time at which the frames end (default: that of the animation)")     \
    ROW(fileLights, "/query/fileLights", MESH, BOOL, "lights of a glTF file instead of the look's (default: false)")   \
    ROW(materials, "/query/materials", MESH, NAME,                                                                     \
        "materials of the file in looks that are a material: look replaces them, keep keeps them (default: look)")     \
    ROW(projection, "/query/projection", MESH, NAME,                                                                   \
        "kind of camera: orthographic or perspective (default: the look's)")                                           \
    ROW(shading, "/shading", MESH, NAME, "model of reflection: " ZR_SHADING_LIST "or the look's (default)")            \
    ROW(color, "/materials/0/baseColorFactor", MESH, COLOR, "colour of the mesh, such as tomato or #ff6347")           \
    ROW(metallic, "/materials/0/metallicFactor", MESH, NUMBER,                                                         \
        "metalness for the shading pbr, 0 (plastic) to 1 (metal)")                                                     \
    ROW(roughness, "/materials/0/roughnessFactor", MESH, NUMBER,                                                       \
        "roughness for the shading pbr, 0 (mirror) to 1 (matt)")                                                       \
    ROW(doubleSided, "/materials/0/doubleSided", MESH, BOOL,                                                           \
        "both sides of faces; false: front sides only (default: true)")                                                \
    ROW(background, "/background", MESH, BACKGROUND, "colour behind the mesh, or transparent (default: the look's)")   \
    ROW(outline, "/outline", MESH, OUTLINE, "colour of face edges, or true or false (default: false)")                 \
    ROW(lineWidth, "/lineWidth", MESH, PIXELS, "width of outlines, 0.1 to 64 (default: 1)")                            \
    ROW(fill, "/fill", MESH, BOOL, "filled faces; false: a wireframe (default: true)")                                 \
    ROW(creaseDegrees, "/creaseDegrees", MESH, DEGREES, "largest angle between smoothly joined faces")                 \
    ROW(edges, "/edges", MESH, BOOL, "lines along silhouettes and creases (default: the look's)")                      \
    ROW(occlusion, "/occlusion", MESH, BOOL, "less ambient light in creases and holes (default: the look's)")          \
    ROW(groundShadow, "/groundShadow", MESH, BOOL, "soft shadow on the ground (default: the look's)")                  \
    ROW(environment, "/environment", MESH, NAME_OR_FALSE,                                                              \
        "light from all around: studio, metal, outdoor, a Radiance picture (.hdr) or false (default: the look's)")     \
    ROW(exposure, "/exposure", MESH, NUMBER, "factor of all light, 0 to 1e6 (default: the look's)")                    \
    ROW(toneMapping, "/toneMapping", MESH, NAME, "tone curve: none, khronos-neutral or neutral (default: the look's)") \
    ROW(ambient, "/ambient", MESH, COLOR, "ambient light instead of the look's lights")                                \
    ROW(light, "/lights/0/type", MESH, NAME,                                                                           \
        "one light instead of the look's: directional, point, spot or hemisphere (default: directional)")              \
    ROW(lightDirection, "/lights/0/direction", MESH, VECTOR, "direction in which the light travels")                   \
    ROW(lightPosition, "/lights/0/position", MESH, VECTOR, "position of a point or spot light")                        \
    ROW(lightColor, "/lights/0/color", MESH, COLOR, "colour of the light (default: white)")                            \
    ROW(lightIntensity, "/lights/0/intensity", MESH, NUMBER, "factor of the light's colour (default: 1)")              \
    ROW(shadows, "/lights/0/shadows", MESH, BOOL, "shadows of the light (default: false)")                             \
    ROW(hide, "/hide", MESH, PARTS,                                                                                    \
        "parts that are not drawn: names, patterns with * and ?, or ids, with commas between them")                    \
    ROW(isolate, "/isolate", MESH, PARTS, "the only parts that are drawn")                                             \
    ROW(ghost, "/ghost", MESH, PARTS, "translucent parts")                                                             \
    ROW(highlight, "/highlight/parts", MESH, PARTS, "parts drawn in one colour")                                       \
    ROW(highlightColor, "/highlight/color", MESH, COLOR, "colour of highlighted parts (default: #ff6a00)")             \
    ROW(explode, "/explode/factor", MESH, NUMBER,                                                                      \
        "exploded view: each part moves by this factor times its distance from the middle of all parts, "              \
        "0 to 100 (default: 0)")                                                                                       \
    ROW(explodeAxis, "/explode/axis", MESH, NAME, "axis along which parts move: x, y, z or radial (default: radial)")  \
    ROW(colors, "/colors", MESH, NAME,                                                                                 \
        "own: colours of the model; parts: one per part, by its name; materials: base colours with the file's "        \
        "numbers; "                                                                                                    \
        "x, y, z: by position (default: own)")                                                                         \
    ROW(section, "/sections/planes", MESH, PLANES,                                                                     \
        "planes that cut the mesh open: x, y or z, a share of its bounds and a side, such as x:0.5 or x:0.5:positive") \
    ROW(sectionCorner, "/sections/corner", MESH, BOOL, "removal only of what all planes cut away (default: false)")    \
    ROW(sectionHatch, "/sections/hatch", MESH, BOOL, "lines on the caps of sections (default: true)")                  \
    ROW(algorithm, "/algorithm", MESH, NAME,                                                                           \
        "visibility algorithm: halfspace, edgelist, trapezoid, scanline or painter (default: halfspace)")

#endif
