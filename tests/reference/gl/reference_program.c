/* GLSL programs. */
#include "reference/gl/reference_gl.h"
#include "reference/gl/reference_texture.h"

/* NULL attaches nothing. GL keeps the shader until its program is deleted. */
static bool attach(GLuint program, GLenum type, const char *source, struct reference_error *error)
{
    GLint compiled = 0;
    if (!source) return true;
    GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) glGetShaderInfoLog(shader, (GLsizei)sizeof error->text, NULL, error->text);
    glAttachShader(program, shader);
    glDeleteShader(shader);
    return compiled;
}

GLuint reference_program(const char *vertex, const char *fragment, struct reference_error *error)
{
    GLint linked = 0;
    GLuint program = glCreateProgram();
    if (attach(program, GL_VERTEX_SHADER, vertex, error) && attach(program, GL_FRAGMENT_SHADER, fragment, error)) {
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
        if (!linked) glGetProgramInfoLog(program, (GLsizei)sizeof error->text, NULL, error->text);
    }
    if (linked) return program;
    glDeleteProgram(program);
    return 0;
}

void reference_program_delete(unsigned program)
{
    glDeleteProgram(program);
}

static void set_material(GLuint program, const struct zr_material *material)
{
    glUniform1i(glGetUniformLocation(program, "shading"), (GLint)material->shading);
    glUniform1f(glGetUniformLocation(program, "shininess"), material->shininess);
    glUniform1f(glGetUniformLocation(program, "metallic"), material->metallic);
    glUniform1f(glGetUniformLocation(program, "roughness"), material->roughness);
    glUniform1f(glGetUniformLocation(program, "grazing"), material->grazing);
    glUniform3fv(glGetUniformLocation(program, "reflectance"), 1, &material->reflectance.x);
    glUniform2fv(glGetUniformLocation(program, "coat"), 1, &material->finish.coat);
    glUniform4fv(glGetUniformLocation(program, "sheen"), 1, &material->finish.sheen.x);
    glUniform3fv(glGetUniformLocation(program, "film"), 1, &material->finish.film);
    glUniform1f(glGetUniformLocation(program, "film_thinnest"), material->finish.film_thinnest);
    glUniform3fv(glGetUniformLocation(program, "brush"), 1, &material->finish.anisotropy);
    glUniform3fv(glGetUniformLocation(program, "specular"), 1, &material->specular.x);
    glUniform3fv(glGetUniformLocation(program, "emissive"), 1, &material->emissive.x);
    glUniform3fv(glGetUniformLocation(program, "cool"), 1, &material->cool.x);
}

/* Of textures that the material has; units have the numbers of slots. */
static void set_textures(GLuint program, const struct zr_material *material, const struct zr_scene *scene)
{
    static const char *const names[] = {"base_map",      "roughness_map", "normal_map",         "occlusion_map",
                                        "emissive_map",  "coat_map",      "coat_roughness_map", "coat_normal_map",
                                        "sheen_map",     "film_map",      "film_thickness_map", "transmission_map",
                                        "thickness_map", "brush_map"};
    float has[ZR_TEXTURE_SLOTS] = {0}, second[ZR_TEXTURE_SLOTS] = {0}, rows[2 * ZR_TEXTURE_SLOTS][3] = {{0}};
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++) {
        glUniform1i(glGetUniformLocation(program, names[slot]), slot);
        if (!material || !material->textures[slot]) continue;
        const struct zr_texture *texture = &scene->textures[material->textures[slot] - 1];
        has[slot] = 1.0f;
        second[slot] = (float)texture->texcoord;
        for (int k = 0; k < 6; k++)
            rows[2 * slot + k / 3][k % 3] = texture->rows[k / 3][k % 3];
    }
    glUniform1i(glGetUniformLocation(program, "around_map"), REFERENCE_TABLE_UNIT);
    glUniform1fv(glGetUniformLocation(program, "has"), ZR_TEXTURE_SLOTS, has);
    glUniform1fv(glGetUniformLocation(program, "second"), ZR_TEXTURE_SLOTS, second);
    glUniform3fv(glGetUniformLocation(program, "rows"), 2 * ZR_TEXTURE_SLOTS, rows[0]);
    if (!material) return;
    glUniform1f(glGetUniformLocation(program, "normal_scale"), material->normal_scale);
    glUniform1f(glGetUniformLocation(program, "coat_normal_scale"), material->coat_normal_scale);
    glUniform1f(glGetUniformLocation(program, "occlusion_strength"), material->occlusion_strength);
}

/* GL passes over uniforms that the program does not have. */
void reference_program_batch(GLuint program, const struct reference_batch *batch, const struct zr_scene *textures_of)
{
    glUseProgram(program);
    if (batch->normal_rows) glUniform3fv(glGetUniformLocation(program, "normal_rows"), 3, &batch->normal_rows[0].x);
    if (batch->material) set_material(program, batch->material);
    set_textures(program, batch->textured, textures_of);
    if (batch->to_world) glUniformMatrix4fv(glGetUniformLocation(program, "to_world"), 1, GL_FALSE, batch->to_world->m);
}
