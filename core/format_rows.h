/* format_rows.h - core: formats of a request's body, one row each, for clients and the daemon. Their readers are in
 * input/formats/formats.c. */
#ifndef ZR_FORMAT_ROWS_H
#define ZR_FORMAT_ROWS_H

/* ROW(ID, extension of files, media types (the preferred one first), true if it describes a whole scene,
 *     may be binary, triangles share no corners, z is up unless the query has `up`, meaning for people) */
#define ZR_FORMAT_ROWS(ROW)                                                                                            \
    ROW(JSON, "json", "application/json", true, false, false, false,                                                   \
        "scene in JSON: geometry or files, camera, lights, outputs")                                                   \
    ROW(OBJ, "obj", "model/obj", false, false, false, false, "Wavefront OBJ with its materials (MTL) and textures")    \
    ROW(3MF, "3mf", "model/3mf application/vnd.ms-package.3dmanufacturing-3dmodel+xml", false, true, false, true,      \
        "3D manufacturing format: parts, colours and textures for printing")                                           \
    ROW(ZIP, "zip", "application/zip application/x-zip-compressed", false, true, false, false,                         \
        "archive of one model and the files that it refers to")                                                        \
    ROW(STL, "stl", "model/stl application/sla application/vnd.ms-pki.stl model/x.stl-binary model/x.stl-ascii",       \
        false, true, true, true, "triangles of a part, binary or text")                                                \
    ROW(PLY, "ply", "model/ply application/ply application/x-ply model/x-ply", false, true, false, false,              \
        "mesh or cloud of points, binary or text")                                                                     \
    ROW(GLB, "glb", "model/gltf-binary", false, true, false, false, "glTF 2.0 in one binary file")                     \
    ROW(GLTF, "gltf", "model/gltf+json", false, false, false, false, "glTF 2.0 as JSON")                               \
    ROW(OFF, "off", "model/x-off", false, false, false, false, "object file format: a mesh as text, also COFF and NOFF") \
    ROW(PCD, "pcd", "model/x-pcd", false, true, false, true, "point cloud of the Point Cloud Library")                 \
    ROW(XYZ, "xyz", "model/x-xyz", false, false, false, true, "point cloud as text, one point per line")

enum zr_format {
#define ZR_FORMAT_ENUM(ID, ...) ZR_FORMAT_##ID,
    ZR_FORMAT_ROWS(ZR_FORMAT_ENUM)
#undef ZR_FORMAT_ENUM
        ZR_FORMAT_COUNT,
    ZR_FORMAT_UNKNOWN = ZR_FORMAT_COUNT /* detected from the bytes */
};

#endif
