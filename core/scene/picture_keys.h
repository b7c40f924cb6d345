/* picture_keys.h - scene: the keys of a scene that set values of struct zr_picture, one row each.
 *
 * The rows generate the merge with the look, the set of given keys and the search for a key that needs linear light.
 * A new key is a row here and a row in the table of its object (input/root/json_scene_fields.c, or
 * input/scene/json_picture.c).
 */
#ifndef ZR_PICTURE_KEYS_H
#define ZR_PICTURE_KEYS_H

/* ROW(ID, object of the key ("" is the scene), key, member of struct zr_picture,
 *     true if the key needs linear light, where `p` is the merged picture; an effect that is off does not need it) */
#define ZR_PICTURE_KEYS(ROW)                                                                                           \
    ROW(SIDE, "", "samples", side, false)                                                                              \
    ROW(LINE_WIDTH, "", "lineWidth", line_width, false)                                                                \
    ROW(BACKGROUND, "", "background", has_gradient, p->has_gradient)                                                   \
    ROW(TOP, "gradient", "top", top, false)                                                                            \
    ROW(BOTTOM, "gradient", "bottom", bottom, false)                                                                   \
    ROW(ENVIRONMENT, "environment", "name", environment.name, p->environment.name != ZR_ENVIRONMENT_NONE)              \
    ROW(ENVIRONMENT_INTENSITY, "environment", "intensity", environment.intensity, true)                                \
    ROW(ENVIRONMENT_ROTATION, "environment", "rotationDegrees", environment.rotation_degrees, true)                    \
    ROW(ENVIRONMENT_FRAME, "environment", "frame", environment.camera_frame, true)                                     \
    ROW(ENVIRONMENT_URI, "environment", "uri", environment.map, true)                                                  \
    ROW(ENVIRONMENT_ASSET, "environment", "asset", environment.map, true)                                              \
    ROW(TONE, "", "toneMapping", tone, p->tone != ZR_TONE_NONE)                                                        \
    ROW(EXPOSURE, "", "exposure", exposure, true)                                                                      \
    ROW(OCCLUSION, "", "occlusion", occlusion.is_on, p->occlusion.is_on)                                               \
    ROW(OCCLUSION_RADIUS, "occlusion", "radius", occlusion.radius, false)                                              \
    ROW(OCCLUSION_STRENGTH, "occlusion", "strength", occlusion.strength, false)                                        \
    ROW(GROUND, "", "groundShadow", has_ground, p->has_ground)                                                         \
    ROW(EDGES, "", "edges", edges.is_on, p->edges.is_on)                                                               \
    ROW(EDGES_COLOR, "edges", "color", edges.color, false)                                                             \
    ROW(EDGES_WIDTH, "edges", "width", edges.width, false)                                                             \
    ROW(EDGES_CREASE, "edges", "creaseDegrees", edges.crease_degrees, false)                                           \
    ROW(EDGES_FROM, "edges", "from", edges.is_from_mesh, false)                                                        \
    ROW(EDGES_HIDDEN, "edges", "hiddenLines", edges.has_hidden, false)                                                 \
    ROW(CREASE, "", "creaseDegrees", crease_degrees, true)                                                             \
    ROW(UP, "", "up", z_is_up, false)

#endif
