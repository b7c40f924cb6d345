/* Packs the bytes as the model part of a 3MF, with the settings of a slicer, and reads it. */
#include <stdlib.h>

#include "fuzz/fuzz.h"
#include "render_request.h"
#include "support/input/zip_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char project[] = "{\"filament_colour\": [\"#FF0000\", \"#00FF00\"]}";
    static const char settings[] =
        "<config><object id=\"1\"><metadata key=\"extruder\" value=\"2\"/><volume firstid=\"1\" lastid=\"1\"><metadata "
        "key=\"volume_type\" value=\"ParameterModifier\"/></volume></object><object id=\"2\"><part id=\"1\" "
        "subtype=\"normal_part\"><metadata key=\"extruder\" value=\"1\"/></part></object></config>";
    const struct zip_entry parts[] = {{"3D/3dmodel.model", (const char *)data, size, false},
                                      {"Metadata/project_settings.config", project, sizeof project - 1, false},
                                      {"Metadata/model_settings.config", settings, sizeof settings - 1, false}};
    size_t package_size;
    unsigned char *package = zip_3mf(parts, 3, &package_size);
    fuzz_request(&(struct zr_request){
        .format = ZR_FORMAT_3MF, .bytes = (const char *)package, .size = package_size, .width = "48", .height = "32"});
    free(package);
    return 0;
}
